// One judged case, and what changed between two results, as text: neither asks the referee or an engine.
#include "tests/support/catch.h"

#include "reports/record/judged_case.h"
#include "reports/text/record_text.h"

using namespace touchstone;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// Two spheres that overlap, a wrong answer and an engine without the query.
fuzz::JudgedCase judged() {
  fuzz::JudgedCase j;
  j.c.id = "a case";
  j.c.scene.shapes = {Sphere{1}};
  j.c.scene.bodies.resize(2);
  j.c.scene.bodies[1].pose.translation = Vec3(1.5, 0, 0);
  j.c.queries = {{Question::contact, 0, 1}, {Question::time_of_impact, 0, 1}};
  fuzz::RefereeAnswer depth;
  depth.verdict = "overlap";
  depth.gap = {-0.5, -0.5};
  depth.normal = Vec3(1, 0, 0);
  depth.depth_certificate.kind = Certificate::Kind::depth_direction;
  depth.depth_certificate.offset = 0.5;
  depth.depth_certificate.direction = Vec3(1, 0, 0);
  fuzz::RefereeAnswer impact;
  impact.verdict = "impact";
  impact.time = {0.25, 0.5};
  j.referee = {depth, impact};
  Observation wrong;
  wrong.outcome = Outcome::answered;
  wrong.overlap = true;
  wrong.depth = 0.25;
  Judgement of_wrong;
  of_wrong.outcome = Outcome::answered;
  FaultReport fault;
  fault.fault = Fault::infeasible;
  fault.words = "it does not separate";
  of_wrong.faults = {fault};
  j.engines = {{"liar", {wrong, no_answer(Outcome::unsupported, "")}, {of_wrong, {}}}};
  return j;
}

}  // namespace

TEST_CASE("a judged case shows the referee's answer beside the engine's", "[replay]") {
  const std::string text = reports::replay_text(judged());
  INFO(text);
  CHECK(has(text, "a case\n  body 0: sphere radius 1"));
  CHECK(has(text, "referee: overlap, signed distance -0.5 exactly\n    depth is least along n = (1 0 0)\n"));
  CHECK(has(text, "moving B by 0.5 along\n      (1 0 0) separates it from A"));
  CHECK(has(text, "liar                   WRONG   overlap, depth 0.25, 0 points"));
  CHECK(has(text, "infeasible: it does not separate"));
  CHECK(has(text, "referee: impact, t in [0.25, 0.5]"));
  CHECK(has(text, "cannot: liar"));
}

TEST_CASE("the JSON of a judged case has an exact certificate where one was asked for", "[replay]") {
  fuzz::JudgedCase j = judged();
  fuzz::Json plain = fuzz::to_json(j);
  CHECK(plain["queries"][0]["referee"]["gap"] == fuzz::Json::array({-0.5, -0.5}));
  CHECK(plain["queries"][0]["engines"]["liar"]["ruling"] == "wrong");
  CHECK_FALSE(plain["queries"][1]["referee"].contains("certificate"));
  j.exact = true;
  j.referee[1].certificate = {{"kind", "impact"}};
  CHECK(fuzz::to_json(j)["queries"][1]["referee"]["certificate"]["kind"] == "impact");
}

TEST_CASE("changes are listed, and long lists are cut", "[judge-again]") {
  fuzz::ResultChanges c;
  CHECK(reports::changes_text(c) == "Judged again: the same as stored.\n");
  c.none = false;
  for (int i = 0; i < 25; ++i) c.appeared.push_back("key" + std::to_string(i));
  c.gone = {"old"};
  c.changed = {{"both", 3, 4, true, true, false}};
  c.counts = {{"liar", "contact", "wrong", 1, 2}};
  const std::string text = reports::changes_text(c);
  INFO(text);
  CHECK(has(text, "NOT the same as stored"));
  CHECK(has(text, "findings that appeared (25):\n    key0\n"));
  CHECK(has(text, "key19\n    and 5 more\n"));
  CHECK(has(text, "findings that went (1):\n    old\n"));
  CHECK(has(text, "both: 3 -> 4 answers, another first case\n"));
  CHECK(has(text, "liar contact: wrong 1 -> 2\n"));
}
