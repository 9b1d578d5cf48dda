// Cases rebuilt from public reports.
#include <set>

#include "scenarios/codec/case_codec.h"
#include "scenarios/codec/scene_codec.h"
#include "tests/scenarios/check_case.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

const std::filesystem::path directory = TS_SOURCE_DIR "/scenarios/corpus";

}  // namespace

TEST_CASE("the corpus has at least 20 cases, each with source, description and expectation",
          "[scenarios][corpus]") {
  std::set<std::string> ids;
  int checked = 0;
  for (const StoredCase& s : scenarios::load_corpus(directory)) {
    INFO(s.c.id);
    CHECK(ids.insert(s.c.id).second);
    CHECK(s.c.id.starts_with("corpus/"));
    CHECK(!s.source.empty());
    CHECK(s.description.size() > 20);
    test::check_case(s.c, s.expect);
    ++checked;
  }
  CHECK(checked >= 20);
}

TEST_CASE("corpus files have the form that the codec writes, so that diffs show only numbers",
          "[scenarios][corpus]") {
  int checked = 0;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    INFO(entry.path());
    REQUIRE(entry.path().extension() == ".json");
    CHECK(to_text(load_stored_case(entry.path())) == read_file(entry.path()));
    CHECK(load_case(entry.path()).id == "corpus/" + entry.path().stem().string());
    ++checked;
  }
  CHECK(checked >= 20);
}
