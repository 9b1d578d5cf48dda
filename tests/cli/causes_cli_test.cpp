// `touchstone causes` when the disk is full or it is interrupted: what was recorded stays, the exit code and
// the last line say what happened, and the next call goes on.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/workspace.h"

using namespace touchstone::test;
namespace fs = std::filesystem;

namespace {

const std::string liar = TS_BINARY_DIR "/lib/libtouchstone_mutants.so:overlap_always";
const std::string causes = "causes lies --engines " + liar + " ";

void make_campaign(const Workspace& w, int cases) {
  REQUIRE(w.touchstone("fuzz --cases " + std::to_string(cases) + " --relations 0 --engines " + liar +
                       " --out lies")
              .code == 1);
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string id_of_first(const Workspace& w) {
  return parsed<nlohmann::json>(read_all(w.dir / "lies/causes.json")).at("causes").at(0).at("id");
}

}  // namespace

TEST_CASE("causes that cannot be stored are printed all the same", "[cli][causes]") {
  const Workspace w("causes-cli");
  make_campaign(w, 64);
  fs::create_symlink("/dev/full", w.dir / "lies/causes.json");
  const Run full = w.touchstone(causes + "--again");
  INFO(full.out << full.err);
  CHECK(full.code == 3);
  CHECK(contains(full.out, "overlap_always"));
  CHECK(contains(full.err, "not stored with the campaign: lies/causes.json: "));
  CHECK(contains(full.err, "No space left on device"));
  fs::remove(w.dir / "lies/causes.json");
  const Run out = w.touchstone(causes + "-o /dev/full");
  CHECK(out.code == 2);
  CHECK(contains(out.err, "/dev/full: "));
  REQUIRE(fs::exists(w.dir / "lies/causes.json"));  // stored before that
  const std::string stored = read_all(w.dir / "lies/causes.json");
  CHECK(w.run(TS_BINARY_DIR "/bin/touchstone " + causes + ">/dev/full").code == 3);
  CHECK(read_all(w.dir / "lies/causes.json") == stored);
}

TEST_CASE("interrupted causes say so, leave the stored ones alone, and go on", "[cli][causes]") {
  const Workspace w("causes-cli");
  make_campaign(w, 400);
  const auto start = std::chrono::steady_clock::now();
  REQUIRE(w.touchstone(causes + "--jobs 1").code == 0);
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - start;
  const std::string stored = read_all(w.dir / "lies/causes.json"),
                    state = read_all(w.dir / "lies/state.json");
  // A part of the time that it took: at an unlucky moment it has not begun, or is done.
  bool caught = false;
  for (const double part : {0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8}) {
    const Run r = w.touchstone(causes + "--jobs 1 --again",
                               "timeout --preserve-status -s HUP " + std::to_string(part * whole.count()));
    CHECK(read_all(w.dir / "lies/causes.json") == stored);
    CHECK(read_all(w.dir / "lies/state.json") == state);
    CHECK_FALSE(fs::exists(w.dir / "lies/causes.json.part"));
    if (r.code != 3) continue;
    INFO(r.out << r.err);
    CHECK(contains(r.err, "touchstone: interrupted"));
    const std::string examined = read_all(w.dir / "lies/causes.examined");
    const auto lines = std::count(examined.begin(), examined.end(), '\n');
    if (lines < 2) continue;  // nothing was examined yet
    CHECK(contains(r.err, "goes on after the " + std::to_string(lines - 1) + " findings"));
    caught = true;
    break;
  }
  CHECK(caught);
  CHECK(w.touchstone(causes + "--jobs 1 --again").code == 0);  // goes on
  CHECK(read_all(w.dir / "lies/causes.json") == stored);
  CHECK_FALSE(fs::exists(w.dir / "lies/causes.examined"));
  // Triage does not take incomplete causes for all of them.
  fs::remove(w.dir / "lies/causes.json");
  for (const double part : {0.5, 0.4, 0.6, 0.3, 0.7}) {
    const Run r = w.touchstone("triage lies --ledger known.db --jobs 1 --engines " + liar,
                               "timeout --preserve-status -s HUP " + std::to_string(part * whole.count()));
    if (r.code != 3) continue;
    CHECK(contains(r.err, "touchstone: interrupted"));
    CHECK_FALSE(fs::exists(w.dir / "lies/causes.json"));
    const Run all = w.touchstone("triage lies --ledger known.db --json --engines " + liar);
    for (const auto& t : parsed<nlohmann::json>(all.out)) CHECK(t.at("standing") == "new");
    break;
  }
}

TEST_CASE("two commands do not find the causes of one campaign at the same time", "[cli][causes]") {
  const Workspace w("causes-cli");
  make_campaign(w, 400);
  const std::string program = TS_BINARY_DIR "/bin/touchstone ";
  const Run second =
      w.run(program + causes +
            "--jobs 1 >/dev/null 2>&1 & p=$!; until [ \"$(cat lies/lock)\" = $p ]; do sleep 0.1; "
            "done; " +
            program + causes + "; r=$?; kill -9 $p; wait $p; exit $r");
  INFO(second.out << second.err);
  CHECK(second.code == 2);
  CHECK(contains(second.err, "lies: is in use: process "));
  CHECK(w.touchstone(causes).code == 0);  // the lock ends with its process
}

TEST_CASE("a cause is shown by its code before and after it is examined", "[cli][causes]") {
  const Workspace w("causes-cli");
  make_campaign(w, 64);
  const Run report = w.touchstone("report lies");
  REQUIRE(report.code == 0);
  const std::size_t at = report.out.find("\n  ", report.out.find("Causes: code"));
  REQUIRE(at != std::string::npos);
  const std::string code = report.out.substr(at + 3, report.out.find(' ', at + 3) - at - 3);
  const Run at_once = w.touchstone("causes lies --cause " + code);
  INFO(report.out << at_once.out << at_once.err);
  CHECK(at_once.code == 0);
  CHECK(contains(at_once.out, "Not examined yet: "));
  CHECK(contains(at_once.out, " replay lies/findings/overlap_always."));
  CHECK_FALSE(fs::exists(w.dir / "lies/causes.json"));
  REQUIRE(w.touchstone(causes).code == 0);
  const std::string id = id_of_first(w);
  const Run by_code = w.touchstone("causes lies --cause " + id.substr(id.rfind('-') + 1));
  CHECK(by_code.code == 0);
  CHECK(contains(by_code.out, id));
  CHECK_FALSE(contains(by_code.out, "Not examined yet"));
  CHECK(contains(by_code.out, " causes lies --cause " + id + " --markdown\n"));
  CHECK(w.touchstone("causes lies --cause zzzzzz").code == 2);
  const Run regrouped = w.touchstone("causes lies --cause " + code);  // as the campaign named it
  CHECK(regrouped.code == 0);
  CHECK(contains(regrouped.err, code + ": its findings were grouped anew"));
  CHECK(contains(regrouped.out, "overlap_always"));
}
