// touchstone judge: a stored campaign is judged again without its engines.
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/workspace.h"

using namespace touchstone::test;
namespace fs = std::filesystem;

namespace {

std::map<std::string, std::string> files_in(const fs::path& directory) {
  std::map<std::string, std::string> files;
  for (const auto& e : fs::recursive_directory_iterator(directory))
    if (e.is_regular_file()) files[fs::relative(e.path(), directory).string()] = read_all(e.path());
  return files;
}

// Without the last line.
std::string before_verdict(const std::string& text) {
  return text.substr(0, text.rfind('\n', text.size() - 2) + 1);
}

}  // namespace

TEST_CASE("judge prints what fuzz printed, without the engine", "[cli][judge]") {
  const Workspace w("judge");
  fs::copy(TS_BINARY_DIR "/lib/libtouchstone_mutants.so", w.dir / "mine.so");
  const Run fuzz = w.touchstone(
      "fuzz --cases 128 --seed 3 --engines core,./mine.so:depth_halved --subject depth_halved "
      "--keep-answers --out run");
  INFO(fuzz.out << fuzz.err);
  REQUIRE(fuzz.code == 1);
  fs::remove(w.dir / "mine.so");
  const Run judge = w.touchstone("judge run -o again");
  INFO(judge.out << judge.err);
  CHECK(judge.code == 1);
  CHECK(judge.out.find("Judged again: the same as stored.") != std::string::npos);
  CHECK(files_in(w.dir / "again/findings") == files_in(w.dir / "run/findings"));
  CHECK(read_all(w.dir / "again/summary.json") == read_all(w.dir / "run/summary.json"));
  CHECK(w.touchstone("report again").code == 0);
  CHECK(w.touchstone("judge run -o again").code == 2);
  // Without -o, the stored findings are shown: everything but the last lines is the same text.
  const Run there = w.touchstone("judge run --jobs 1");
  const auto next =
      fuzz.out.find("To see one, or all on a page");  // by commands that name the plug-in: judge asks none
  REQUIRE(next != std::string::npos);
  CHECK(there.out.starts_with(fuzz.out.substr(0, next)));
  CHECK(there.out.ends_with(fuzz.out.substr(before_verdict(fuzz.out).size())));
  const Run one = w.touchstone("judge run --engine core --json --junit j.xml");
  CHECK(one.code == 0);
  const auto j = parsed<nlohmann::json>(one.out);
  CHECK(j.at("changes").at("none") == true);
  CHECK(j.at("engines").size() == 1);
  CHECK(j.at("findings").empty());
  CHECK(read_all(w.dir / "j.xml").find("<testsuites name=\"touchstone\">") != std::string::npos);
  REQUIRE(w.touchstone("judge run --junit j.xml").code == 1);
  const std::string xml = read_all(w.dir / "j.xml");
  CHECK(xml.find("known since the stored result") != std::string::npos);
  CHECK(xml.find("<failure") == std::string::npos);
}

TEST_CASE("judge refuses what it cannot judge", "[cli][judge]") {
  const Workspace w("judge");
  const auto refused = [&](const std::string& arguments, const std::string& why) {
    const Run r = w.touchstone("judge " + arguments);
    INFO(r.out << r.err);
    CHECK(r.code == 2);
    CHECK(r.err.find(why) != std::string::npos);
  };
  REQUIRE(w.touchstone("fuzz --cases 32 --engines core --out plain").code == 0);
  REQUIRE(w.touchstone("fuzz --cases 32 --engines core --keep-answers --out kept").code == 0);
  refused("nowhere", "nowhere: does not hold a campaign");
  refused("plain", "plain: keeps no answers; run the campaign with --keep-answers");
  refused("kept --engine fcl-libccd", "gave none of the answers; those are of core");
  // A campaign with other settings is not resumed.
  CHECK(w.touchstone("fuzz --cases 32 --engines core --keep-answers --out plain").code == 2);
  const std::string good = read_all(w.dir / "kept/answers.bin");
  w.write("kept/answers.bin", good.substr(0, good.size() / 2));
  refused("kept", "kept/answers.bin: has ");
  fs::remove(w.dir / "kept/answers.bin");
  fs::create_symlink("/dev/zero", w.dir / "kept/answers.bin");
  refused("kept", "kept/answers.bin: is a device, not a file");
}

TEST_CASE("a campaign that was ended before its first chunk proves nothing", "[cli][judge]") {
  const Workspace w("judge");
  REQUIRE(w.touchstone("fuzz --cases 32 --engines core --keep-answers --out kept").code == 0);
  auto state = parsed<nlohmann::ordered_json>(read_all(w.dir / "kept/state.json"));
  state.erase("answers_bytes");
  state["result"]["cases"] = 0;
  w.write("kept/state.json", state.dump());
  CHECK(w.touchstone("judge kept").code == 3);
}
