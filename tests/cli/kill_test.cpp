// kill -9 at random moments: a killed command, run again, ends with the same files as an uninterrupted run.
// TOUCHSTONE_KILLS: number of kills of each command (by hand: 100).
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "tests/support/catch.h"
#include "tests/support/causes_by_hand.h"
#include "tests/support/parsed.h"
#include "tests/support/workspace.h"

using namespace touchstone::test;
namespace fs = std::filesystem;

namespace {

const std::string program_path = TS_BINARY_DIR "/bin/touchstone ";
const std::string overlap_liar = TS_BINARY_DIR "/lib/libtouchstone_mutants.so:overlap_always";

int kills() {
  const char* text = std::getenv("TOUCHSTONE_KILLS");
  return text ? std::max(1, std::atoi(text)) : 2;
}

// Every file except those with times and locks; the answers, if they are kept.
std::map<std::string, std::string> findings_of(const fs::path& campaign) {
  std::map<std::string, std::string> files;
  for (const auto& e : fs::recursive_directory_iterator(campaign / "findings"))
    if (e.is_regular_file()) files[fs::relative(e.path(), campaign).string()] = read_all(e.path());
  if (fs::exists(campaign / "answers.bin")) files["answers"] = read_all(campaign / "answers.bin");
  files["digest"] = parsed<nlohmann::json>(read_all(campaign / "summary.json")).at("digest");
  return files;
}

// Starts a command and kills it by its process id after a random part of `whole_ms`. True if it was still
// running.
bool killed(const Workspace& w, const std::string& arguments, std::mt19937_64& rng, int whole_ms) {
  const int ms = 1 + static_cast<int>(rng() % static_cast<std::uint64_t>(whole_ms));
  const std::string seconds = std::to_string(ms / 1000) + "." + std::to_string(1000 + ms % 1000).substr(1);
  const Run r = w.run(program_path + arguments + " >/dev/null 2>&1 & p=$!; sleep " + seconds +
                      "; kill -9 $p 2>/dev/null; wait $p; exit $?");
  return r.code == 137;
}

int elapsed_ms(const Workspace& w, const std::string& arguments, int& code) {
  const auto start = std::chrono::steady_clock::now();
  code = w.touchstone(arguments).code;
  const auto took = std::chrono::steady_clock::now() - start;
  return 1 + static_cast<int>(std::chrono::duration_cast<std::chrono::milliseconds>(took).count());
}

}  // namespace

TEST_CASE("a killed campaign, resumed until it ends, finds what an uninterrupted one finds", "[kill]") {
  const Workspace w("kill");
  const std::string fuzz =
      "fuzz --cases 600 --seed 5 --jobs 2 --keep-answers --engines core," + overlap_liar + " --out ";
  int code = 0;
  int longest_ms = elapsed_ms(w, fuzz + "whole", code);
  REQUIRE(code == 0);
  std::mt19937_64 rng(17);
  bool caught = false;
  for (int i = 0; i < kills() || !caught; ++i) {
    const std::string out = "killed" + std::to_string(i);
    // Twice, so that a resumed campaign is killed too. The first run may have been slower than those that
    // follow: whenever one has ended before it was killed, the next is killed earlier.
    for ([[maybe_unused]] const int run : {0, 1})
      if (killed(w, fuzz + out, rng, longest_ms))
        caught = true;
      else
        longest_ms = std::max(1, longest_ms / 2);
    const Run r = w.touchstone(fuzz + out);
    INFO(r.err);
    CHECK((r.code == 0 || r.err.find("holds a finished campaign") != std::string::npos));
    CHECK(findings_of(w.dir / out) == findings_of(w.dir / "whole"));
    fs::remove_all(w.dir / out);
  }
}

TEST_CASE("a killed merge, run again, gives the same result", "[kill][merge]") {
  const Workspace w("kill");
  for (const std::string shard : {"0", "1"})
    REQUIRE(w.touchstone("fuzz --cases 256 --seed 5 --keep-answers --engines core," + overlap_liar +
                         " --shard " + shard + "/2 --out part" + shard)
                .code == 0);
  int code = 0;
  const int whole = elapsed_ms(w, "merge whole part0 part1", code);
  REQUIRE(code == 0);
  std::mt19937_64 rng(18);
  for (int i = 0; i < kills(); ++i) {
    const std::string out = "killed" + std::to_string(i);
    killed(w, "merge " + out + " part0 part1", rng, whole);
    const Run r = w.touchstone("merge " + out + " part0 part1");
    INFO(r.err);
    CHECK((r.code == 0 || r.err.find("holds a campaign already") != std::string::npos));
    CHECK(findings_of(w.dir / out) == findings_of(w.dir / "whole"));
    fs::remove_all(w.dir / out);
  }
}

TEST_CASE("a killed triage has reported whatever it put into the ledger", "[kill][triage]") {
  const Workspace w("kill");
  REQUIRE(w.touchstone("fuzz --cases 128 --seed 5 --engines " + overlap_liar + " --out lies").code == 1);
  write_causes_by_hand(w.dir / "lies");
  const auto triage = [](const std::string& i) {
    return "triage lies --json --date 2026-11-23 --engines " + overlap_liar + " --ledger l" + i +
           ".db --junit j" + i + ".xml";
  };
  const auto cases = [&](const std::string& json) {
    std::map<std::string, std::string> r;
    for (const auto& f : parsed<nlohmann::json>(json)) r[f.at("id")] = f.at("case").dump();
    return r;
  };
  int code = 0;
  const int whole_ms = elapsed_ms(w, triage("whole"), code);
  REQUIRE(code == 1);
  const auto whole = cases(w.touchstone(triage("whole")).out);
  std::mt19937_64 rng(19);
  for (int k = 0; k < kills(); ++k) {
    const std::string i = std::to_string(k);
    killed(w, triage(i), rng, whole_ms);
    const std::string said =
        fs::exists(w.dir / ("j" + i + ".xml")) ? read_all(w.dir / ("j" + i + ".xml")) : "";
    const Run again = w.touchstone(triage(i));
    INFO(again.err);
    CHECK((again.code == 1 || said.find("<failure message=\"new\">") != std::string::npos));
    CHECK(cases(w.touchstone(triage(i)).out) == whole);
  }
}

TEST_CASE("killed causes leave the stored ones whole, and are found again", "[kill][causes]") {
  const Workspace w("kill");
  REQUIRE(w.touchstone("fuzz --cases 128 --seed 5 --engines " + overlap_liar + " --out lies").code == 1);
  const std::string causes = "causes lies --engines " + overlap_liar + " ";
  int code = 0;
  const int whole_ms = elapsed_ms(w, causes, code);
  REQUIRE(code == 0);
  const std::string whole = read_all(w.dir / "lies/causes.json");
  const auto campaign = findings_of(w.dir / "lies");
  std::mt19937_64 rng(21);
  int caught = 0;
  for (int i = 0; i < kills(); ++i) {
    caught += killed(w, causes + "--again", rng, whole_ms);
    CHECK(read_all(w.dir / "lies/causes.json") == whole);
    fs::remove(w.dir / "lies/causes.json");
    caught += killed(w, causes, rng, whole_ms);
    if (fs::exists(w.dir / "lies/causes.json")) CHECK(read_all(w.dir / "lies/causes.json") == whole);
    CHECK(w.touchstone(causes).code == 0);
    CHECK(read_all(w.dir / "lies/causes.json") == whole);
    CHECK(findings_of(w.dir / "lies") == campaign);
  }
  CHECK(caught > 0);
}

TEST_CASE("a killed certification leaves its certificate whole or not at all", "[kill][certify]") {
  const Workspace w("kill");
  const std::string certify = "certify --subject grid --level boxes --limit 40 -o ";
  int code = 0;
  const int whole_ms = elapsed_ms(w, certify + "whole.json", code);
  REQUIRE(code == 0);
  std::mt19937_64 rng(20);
  for (int i = 0; i < kills(); ++i) {
    killed(w, certify + "killed.json", rng, whole_ms);
    if (fs::exists(w.dir / "killed.json"))
      CHECK(read_all(w.dir / "killed.json") == read_all(w.dir / "whole.json"));
    CHECK(w.touchstone(certify + "killed.json").code == 0);
    CHECK(read_all(w.dir / "killed.json") == read_all(w.dir / "whole.json"));
    fs::remove(w.dir / "killed.json");
  }
}
