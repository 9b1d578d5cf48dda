// The failures of a run compared with a file of expected ones.
#include "reports/record/expected.h"

#include "core/base/input_error.h"
#include "reports/record/result.h"
#include "reports/text/junit.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::fuzz;

namespace {

const std::string today = "2026-11-23T02:00:00Z";

ExpectedFailure entry(const std::string& case_id, const std::string& fault, const std::string& until = "") {
  return {{case_id, "e", "contact"}, fault, "reason of " + fault, until};
}

Failure failure(const std::string& case_id, const std::string& fault) {
  return {{case_id, "e", "contact"}, fault, "words of " + fault};
}

ShownFailures shown(const std::vector<std::string>& answered, const std::vector<Failure>& failures) {
  ShownFailures s;
  for (const std::string& id : answered) s.answered.insert({id, "e", "contact"});
  s.failures = failures;
  return s;
}

std::vector<ExpectedFailure> read(const Json& j) { return expected_from_json(JsonReader(j, "x.json")); }

std::string refusal(const Json& j) {
  try {
    read(j);
    return "";
  } catch (const InputError& e) {
    return e.what();
  }
}

bool contains(const std::string& text, const std::string& part) {
  INFO(text);
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("expected failures, newly wrong answers and fixed ones are told apart", "[expected]") {
  const std::vector<ExpectedFailure> expected{entry("a", "missed"), entry("b", "any"), entry("c", "missed"),
                                              entry("d", "missed")};
  const auto c = compare(expected,
                         shown({"a", "b", "c"}, {failure("b", "late"), failure("a", "missed"),
                                                 failure("a", "missed"), failure("a", "ghost")}),
                         today);
  REQUIRE(c.as_expected.size() == 2);
  CHECK(c.as_expected[0].failure.asked.case_id == "a");
  CHECK(c.as_expected[1].why == "reason of any");
  REQUIRE(c.newly_wrong.size() == 1);
  CHECK(c.newly_wrong[0].failure.fault == "ghost");
  CHECK(c.newly_wrong[0].why.empty());
  CHECK(c.fixed == std::vector{expected[2]});
  CHECK(c.not_asked == std::vector{expected[3]});
  CHECK(summary_of(c) == "2 wrong as expected, 1 fixed, 1 newly wrong, 1 not asked");
  const std::string text = reports::expected_text(c);
  CHECK(contains(text, "newly wrong:\n  a: e contact ghost\n    words of ghost\n"));
  CHECK(contains(text, "  c: e contact missed\n    reason of missed\n"));
}

TEST_CASE("an expectation holds through its last day", "[expected]") {
  const auto on = [](const char* date) {
    return compare({entry("a", "missed", "2026-11-23")}, shown({"a"}, {failure("a", "missed")}), date);
  };
  CHECK(on("2026-11-23T23:59:59Z").newly_wrong.empty());
  const auto after = on("2026-11-24T00:00:00Z");
  CHECK(after.as_expected.empty());
  REQUIRE(after.newly_wrong.size() == 1);
  CHECK(after.newly_wrong[0].why == "expected until 2026-11-23: reason of missed");
  CHECK(after.fixed.empty());
}

TEST_CASE("what a run showed, recorded, is what the next run expects", "[expected]") {
  const std::vector<ExpectedFailure> expected{entry("a", "missed"), entry("b", "missed", "2026-01-01"),
                                              entry("c", "missed"), entry("d", "missed")};
  const auto run =
      shown({"a", "b", "c"}, {failure("a", "missed"), failure("b", "missed"), failure("c", "late")});
  const auto recorded = as_shown(expected, compare(expected, run, today), "new");
  const auto written = read(to_json(recorded));
  CHECK(written == recorded);
  REQUIRE(written.size() == 4);
  CHECK(written[0] == expected[0]);
  CHECK(written[1].reason == "new");  // it had ended
  CHECK(written[1].until.empty());
  CHECK(written[2].fault == "late");
  CHECK(written[3] == expected[3]);  // nothing is known about it
  const auto again = compare(written, run, today);
  CHECK(again.newly_wrong.empty());
  CHECK(again.fixed.empty());
}

TEST_CASE("a file of expected failures is checked, and errors name the place", "[expected]") {
  const Json good = to_json({entry("a", "missed", "2026-12-31"), entry("b", "any")});
  CHECK(read(good).size() == 2);
  const auto with = [&](const char* field, const Json& value) {
    Json j = good;
    j["failures"][1][field] = value;
    return refusal(j);
  };
  CHECK(contains(with("until", "never"), "x.json: failures[1].until"));
  CHECK(contains(with("until", "2026-02-30"), "x.json: failures[1].until"));
  CHECK(contains(with("reason", " "), "x.json: failures[1].reason"));
  CHECK(contains(with("question", "colour"), "x.json: failures[1].question"));
  CHECK(contains(with("engine", "a\nb"), "x.json: failures[1].engine"));
  CHECK(contains(with("case", ""), "x.json: failures[1].case"));
  CHECK(contains(with("fault", 7), "x.json: failures[1].fault"));
  CHECK(contains(with("unknown", 1), "unknown"));
  Json twice = good;
  twice["failures"][1] = twice["failures"][0];
  CHECK(contains(refusal(twice), "x.json: failures[1]: is there twice"));
  Json later = good;
  later["touchstone_expected"] = 2;
  CHECK(contains(refusal(later), "touchstone_expected"));
  CHECK(contains(refusal(Json::array()), "x.json"));
}

TEST_CASE("JUnit has one test a question; strict, a fixed failure fails", "[expected]") {
  const auto run = shown({"a", "b", "c", "d"}, {failure("a", "missed"), failure("b", "late")});
  const auto c = compare({entry("a", "missed"), entry("c", "missed")}, run, today);
  const std::string lenient = reports::expected_junit(run, c, false),
                    strict = reports::expected_junit(run, c, true);
  CHECK(contains(lenient, "name=\"e\" tests=\"4\" failures=\"1\" skipped=\"1\""));
  CHECK(contains(lenient, "<skipped message=\"missed as expected: reason of missed\"/>"));
  CHECK(contains(lenient, "<failure message=\"newly wrong: late\">words of late</failure>"));
  CHECK(contains(strict, "failures=\"2\""));
  CHECK(contains(strict, "<failure message=\"fixed: missed\">"));
}

TEST_CASE("the kind of a failure is the same wherever in the code it happens", "[expected]") {
  CHECK(kind_of_fault("crashed_distance-inl-h-177") == "crashed");
  CHECK(kind_of_fault("threw_epa") == "threw");
  CHECK(kind_of_fault("timed_out") == "timed_out");
  CHECK(kind_of_fault("distance_off") == "distance_off");
  CHECK(kind_of_fault("relation_exchanged") == "relation_exchanged");
}
