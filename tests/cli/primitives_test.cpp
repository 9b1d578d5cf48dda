// touchstone primitives: published queries and random ones, and what it refuses.
#include <nlohmann/json.hpp>

#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/workspace.h"

namespace fs = std::filesystem;
using touchstone::test::read_all;
using touchstone::test::Run;
using touchstone::test::Workspace;

namespace {

const std::string published = TS_SOURCE_DIR "/tests/data/published/ccd";

}  // namespace

TEST_CASE("the core is right in every published query of the repository", "[primitives]") {
  const Workspace w("primitives");
  const Run r = w.touchstone("primitives " + published);
  INFO(r.err);
  CHECK(r.code == 0);
  CHECK(r.out.find("core: 0 of 223 queries wrong") != std::string::npos);
  CHECK(r.out.find("unit-tests") != std::string::npos);
  std::istringstream lines(r.out);
  for (std::string line; std::getline(lines, line);) CHECK(line.size() <= 80);
}

TEST_CASE("random queries are the same for the same seed, and some of them hit", "[primitives]") {
  const Workspace w("primitives-random");
  const auto counts = [&](const std::string& arguments) {
    const Run r = w.touchstone("primitives --json " + arguments);
    CHECK(r.code == 0);
    auto rows = touchstone::test::parsed<nlohmann::json>(r.out).at("primitives");
    for (auto& row : rows) {
      row.erase("median_ns");
      row.erase("p99_ns");
    }
    return rows;
  };
  const auto rows = counts("--random 400 --seed 5");
  REQUIRE(rows.size() == 2);
  for (const auto& row : rows) {
    CHECK(row.at("queries") == 200);
    CHECK(row.at("hits") > 20);
    CHECK(row.at("missed") == 0);
    CHECK(row.at("ghost") == 0);
    CHECK(row.at("late") == 0);
  }
  CHECK(counts("--random 400 --seed 5") == rows);
  CHECK(counts("--random 400 --seed 6") != rows);
}

TEST_CASE("a wrong verdict in a file is counted as the file's, not as the core's", "[primitives]") {
  const Workspace w("primitives-source");
  fs::create_directories(w.dir / "set/vertex-face");
  std::string text = read_all(published + "/unit-tests/vertex-face/data_0_0.csv");
  // The verdict is the last column of each of a query's eight rows.
  std::size_t at = 0;
  for (int row = 0; row < 8; ++row) {
    at = text.find('\n', at);
    REQUIRE(at != std::string::npos);
    text[at - 1] = text[at - 1] == '0' ? '1' : '0';
    ++at;
  }
  w.write("set/vertex-face/data.csv", text);
  const Run r = w.touchstone("primitives set");
  CHECK(r.code == 0);
  CHECK(r.out.find("1 verdicts stated in the files are not the exact ones") != std::string::npos);
}

TEST_CASE("what is no query is refused with its place", "[primitives]") {
  const Workspace w("primitives-refused");
  CHECK(w.touchstone("primitives").code == 2);
  CHECK(w.touchstone("primitives absent").code == 2);
  for (const std::string tolerance : {"nan", "inf", "-1", "0", "wide"})
    CHECK(w.touchstone("primitives --random 10 --tolerance " + tolerance).code == 2);
  w.write("loose.csv", "0,1,0,1,0,1,0\n");
  const Run loose = w.touchstone("primitives loose.csv");
  CHECK(loose.code == 2);
  CHECK(loose.err.find("vertex-face") != std::string::npos);
  fs::create_directories(w.dir / "set/edge-edge");
  w.write("set/edge-edge/data.csv", "0,1,0,1,0\n");
  const Run damaged = w.touchstone("primitives set");
  CHECK(damaged.code == 2);
  CHECK(damaged.err.find("data.csv:1") != std::string::npos);
  fs::create_directories(w.dir / "empty");
  CHECK(w.touchstone("primitives empty").code == 2);
}

TEST_CASE("contacts that a tolerance allows are not judged, and are counted", "[primitives]") {
  const Workspace w("primitives-tolerance");
  const Run r = w.touchstone("primitives --json --random 400 --seed 5 --tolerance 0.1");
  CHECK(r.code == 0);
  std::uint64_t open = 0;
  const auto document = touchstone::test::parsed<nlohmann::json>(r.out);
  for (const auto& row : document.at("primitives")) {
    open += row.at("not_judged").get<std::uint64_t>();
    CHECK(row.at("ghost") == 0);
    CHECK(row.at("missed") == 0);
  }
  CHECK(open > 0);
  const Run text = w.touchstone("primitives --random 400 --seed 5 --tolerance 0.1");
  CHECK(text.out.find(std::to_string(open) + " contacts that do not exist") != std::string::npos);
}
