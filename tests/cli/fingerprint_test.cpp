// touchstone fingerprint as a user meets it.
#include <nlohmann/json.hpp>

#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/workspace.h"

using namespace touchstone::test;
using Json = nlohmann::json;

namespace {

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

}  // namespace

TEST_CASE("fingerprints of one engine are the same, with any number of jobs and from another build's folder",
          "[fingerprint]") {
  const Workspace w("fingerprint");
  const Run one = w.touchstone("fingerprint core --cases 1200 --jobs 1 -o one.json");
  INFO(one.out << one.err);
  REQUIRE(one.code == 0);
  CHECK(says(one.out, "1,200 cases of set 1"));
  REQUIRE(
      w.touchstone("fingerprint core --cases 1200 --jobs 3 --of-build " TS_BINARY_DIR " -o two.json").code ==
      0);
  CHECK(read_all(w.dir / "one.json") == read_all(w.dir / "two.json"));
  CHECK(w.touchstone("fingerprint core --cases 1200 --run-with env -o env.json").code == 0);
  CHECK(read_all(w.dir / "one.json") == read_all(w.dir / "env.json"));
  const Run same = w.touchstone("fingerprint --compare one.json core --cases 1200");
  INFO(same.out << same.err);
  CHECK(same.code == 0);
  CHECK(says(same.out, " answers of both, 0 differ\n"));
}

TEST_CASE("a comparison names the answers that differ, and the first case", "[fingerprint]") {
  const Workspace w("fingerprint-compare");
  const Run r = w.touchstone("fingerprint --compare core core-f32 --cases 300 -o first.json");
  INFO(r.out << r.err);
  REQUIRE(r.code == 1);
  CHECK(says(r.out, "distance         "));
  CHECK(says(r.out, "\nfirst: case "));
  CHECK(says(r.out, "\n  A: {\"outcome\""));
  CHECK(says(r.out, "\n  B: {\"outcome\""));
  const Json first = parsed<Json>(read_all(w.dir / "first.json"));
  CHECK(first["queries"].size() == 1);
  CHECK(w.touchstone("replay first.json --engines core").code == 0);
  const Run json = w.touchstone("fingerprint --compare core core-f32 --cases 300 --json");
  CHECK(parsed<Json>(json.out)["differ"].get<int>() > 0);
}

TEST_CASE("fingerprint refuses bad input", "[fingerprint]") {
  const Workspace w("fingerprint-bad");
  w.write("bad.json", "{\"touchstone_fingerprint\": 1}");
  const std::pair<const char*, const char*> bad[] = {
      {"", "needs an engine, or --compare A B"},
      {"nothing", "engine nothing: unknown"},
      {"core,core-f32", "names more than one engine"},
      {"core --cases 20001", "--cases"},
      {"--compare bad.json core", "bad.json"},
      {"--compare none.json core", "none.json"},
      {"core --of-build .", "touchstone-host: is missing"},
      {"core --run-with no-such-program", "there is no such program"},
      {"core -o bad.json/f.json", "bad.json: cannot be created"},
  };
  for (const auto& [args, reason] : bad) {
    const Run r = w.touchstone("fingerprint " + std::string(args));
    INFO(args << ": " << r.out << r.err);
    CHECK(r.code == 2);
    CHECK(says(r.err, reason));
  }
}
