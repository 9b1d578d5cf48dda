// Stated answers: an engine's answers, stated by hand, get the ruling that the judge gives the engine; and
// lines that are damaged at random are refused or answered, never worse.
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/input_error.h"
#include "fuzz/answer/pair_answer.h"
#include "fuzz/answer/query_line.h"
#include "fuzz/judge/judge.h"
#include "oracles/core/core_engine.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/random/family.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

bool is_pair_case(const Case& c) {
  return c.scene.bodies.size() == 2 && !c.queries.empty() && is_pair_question(c.queries[0].question);
}

// Makes some of the answers wrong: by a thousandth of the scale, or in the verdict.
void spoil(Observation& o, double l, Rng& rng) {
  constexpr double share = 0x1p-10;
  if (o.distance && rng.below(2) == 0) *o.distance += l * share;
  if (o.depth && rng.below(2) == 0) *o.depth -= l * share;
  if (o.toi && rng.below(2) == 0) o.toi.reset();
  if (o.normal && !o.distance && rng.below(4) == 0) *o.normal = -*o.normal;
}

}  // namespace

TEST_CASE("a stated answer gets the ruling that the judge gives an engine for it", "[answer]") {
  CoreEngine core;
  EngineCard plain = core.card();
  plain.source.clear();  // no claims: τ is that of stated answers
  std::map<Ruling, int> rulings;
  int cases = 0;
  for (std::uint64_t i = 0; cases < 300; ++i) {
    const Case c = fuzz::make_case(6, i);
    if (!is_pair_case(c)) continue;
    ++cases;
    Rng rng = Rng::stream(6, i);
    CaseObservations observed = core.run({&c, 1})[0];
    observed.received = {};
    for (Observation& o : observed.answers) {
      o.claimed_tolerance = 0;
      o.moment.reset();  // the gradient needs the normal, which is left out below
      if (rng.below(2) == 0) spoil(o, scale_of_pair(c.scene, 0, 1), rng);
    }
    fuzz::Truth truth(c.scene);
    const std::vector<Judgement> judged = fuzz::judge(c, plain, observed, truth);
    for (std::size_t q = 0; q < c.queries.size(); ++q) {
      const Query& query = c.queries[q];
      const Observation& o = observed.answers[q];
      if (o.outcome != Outcome::answered || query.a != 0 || query.b != 1) continue;
      // A stated answer has no field for these.
      if (query.question == Question::within || query.question == Question::contact_within ||
          query.question == Question::ray)
        continue;
      fuzz::StatedAnswer stated{o, query.question == Question::time_of_impact};
      if (!stated.states_anything()) continue;
      INFO(c.id << " " << to_string(query.question));
      if (query.question == Question::distance) {
        // The judge leaves the normal of a distance alone; stated, it is judged, and the core's is right.
        const Judgement all = fuzz::judge_stated(c.scene, stated);
        if (judged[q].faults.empty())
          for (const FaultReport& f : all.faults) FAIL_CHECK(to_string(f.fault) << ": " << f.words);
        stated.pair.normal.reset();
        stated.pair.depth.reset();
      }
      const Judgement j = fuzz::judge_stated(c.scene, stated);
      CHECK(to_string(j.ruling()) == to_string(judged[q].ruling()));
      ++rulings[j.ruling()];
    }
  }
  CHECK(rulings[Ruling::right] > 300);
  CHECK(rulings[Ruling::wrong] > 50);
}

TEST_CASE("the bracket of an answer is within what its certificates prove", "[answer]") {
  int certified = 0, cases = 0;
  for (std::uint64_t i = 0; cases < 200; ++i) {
    const Case c = fuzz::make_case(7, i);
    if (!is_pair_case(c)) continue;
    ++cases;
    const Placed a{&c.scene.shape_of(0), c.scene.bodies[0].pose},
        b{&c.scene.shape_of(1), c.scene.bodies[1].pose};
    const fuzz::PairAnswer r = fuzz::answer_pair(a, b, {.certificates = true, .normals = false});
    INFO(c.id << " " << r.not_certified);
    CHECK(r.certified == r.not_certified.empty());
    // Both contain the truth.
    CHECK(r.proof->gap.lo <= r.truth.gap.hi);
    CHECK(r.proof->gap.hi >= r.truth.gap.lo);
    certified += r.certified;
    if (!r.certified || !std::isfinite(r.proof->gap.lo)) continue;
    CHECK(r.proof->gap.lo <= r.proof->gap.hi);
  }
  CHECK(certified > 140);
}

TEST_CASE("the normals of a box are listed, those of flat shapes are not searched for", "[answer]") {
  const Shape cube = Box{{1, 1, 1}};
  const Shape triangle = make_hull({{0, 0, 0}, {0.1, 0.2, 0.3}, {0.3, -0.1, 0.7}});
  Pose beside;
  beside.translation = {0.5, 0.25, 0.125};
  const Placed a{&cube, Pose{}}, b{&cube, beside}, flat{&triangle, Pose{}};
  const auto both = fuzz::answer_pair(a, b);
  REQUIRE(both.normals);
  CHECK(both.normals->normals.size() == 1);
  CHECK_FALSE(fuzz::answer_pair(flat, flat).normals);
  CHECK_FALSE(fuzz::answer_pair(a, flat).normals);
}

TEST_CASE("a damaged line of a capture is refused with its place, or is another question", "[answer]") {
  const std::string line =
      R"({"touchstone_query":1,"engine":"e","a":{"type":"box","numbers":[1,1,1],"pose":[0,0,0,0,0,0,1]},)"
      R"("b":"sphere 0.5 at 0 0 1.75 rot 0 0 1 30deg","answer":{"overlap":false,"distance":0.25,"normal":[0,0,1],)"
      R"("witness":[0,0,1,0,0,1.25],"points":[{"position":[0,0,1],"depth":"NaN"}],"time_of_impact":null}})";
  Rng rng = Rng::stream(8, 0);
  const std::string bytes = "0123456789.-eE\"[]{},:nulltrue \\\x01\xff";
  int refused = 0, read = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string s = line;
    for (std::uint64_t k = 0; k <= rng.below(4); ++k) {
      const std::size_t at = rng.below(s.size());
      if (rng.below(3) == 0)
        s.erase(at, 1 + rng.below(8));
      else
        s[at] = bytes[rng.below(bytes.size())];
      if (s.empty()) s = " ";
    }
    try {
      const fuzz::QueryLine q =
          fuzz::query_line_from_json(parse_json(s, "capture.jsonl:1"), "capture.jsonl:1");
      REQUIRE(q.scene.bodies.size() == 2);
      ++read;
    } catch (const InputError& e) {
      ++refused;
      const std::string what = e.what();
      INFO(s << "\n" << what);
      CHECK(what.starts_with("capture.jsonl:1"));
    }
  }
  CHECK(refused > 5000);
  CHECK(read > 100);
}
