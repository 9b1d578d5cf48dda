// Every expectation against the referee, which is independent of it.
#include <cmath>
#include <cstdio>

#include "oracles/referee/referee.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/handmade/scenario.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

struct Tally {
  int verdicts = 0, gaps = 0, impacts = 0, undecided = 0;
};

Placed placed(const Scene& s, int i) { return {&s.shape_of(i), s.bodies[static_cast<std::size_t>(i)].pose}; }

// By the referee's contract, cylinders, cones and ellipsoids have brackets of up to 1e-14·L.
double slack(const Scene& s) { return 1e-14 * scale_of_pair(s, 0, 1); }

// The only pairs that the referee may leave undecided: a round shape without rational support that touches
// exactly.
bool may_be_open(const Scene& s, const Expectation& e) {
  bool round = false;
  for (int i : {0, 1}) {
    const ShapeKind k = kind_of(s.shape_of(i));
    round |= k == ShapeKind::cylinder || k == ShapeKind::cone || k == ShapeKind::ellipsoid;
  }
  return round && e.gap && std::abs(e.gap->value) <= slack(s);
}

void check_pair(const Scene& s, const Expectation& e, Tally& t) {
  if (!e.overlap && !e.gap) return;
  const auto truth = referee::judge_pair(placed(s, 0), placed(s, 1));
  INFO("referee: " << referee::to_string(truth.verdict) << " [" << truth.gap.lo << ", " << truth.gap.hi
                   << "]");
  if (truth.verdict == referee::Verdict::undecided) {
    ++t.undecided;
    std::printf("referee undecided: %s\n", s.name.c_str());
    CHECK(may_be_open(s, e));
  } else if (e.overlap) {
    CHECK((truth.verdict == referee::Verdict::overlap) == *e.overlap);
    ++t.verdicts;
  }
  if (!e.gap) return;
  CHECK(truth.gap.lo <= e.gap->value + e.gap->tolerance + slack(s));
  CHECK(truth.gap.hi >= e.gap->value - e.gap->tolerance - slack(s));
  ++t.gaps;
}

void check_impact(const Scene& s, const Expectation& e, Tally& t) {
  if (!e.impact) return;
  const auto motion = [&](std::size_t i) { return s.bodies[i].motion.value_or(Motion{}); };
  const auto truth = referee::judge_motion(placed(s, 0), motion(0), placed(s, 1), motion(1));
  using Verdict = referee::TimeTruth::Verdict;
  INFO("referee: " << (truth.verdict == Verdict::hit    ? "hit"
                       : truth.verdict == Verdict::none ? "none"
                                                        : "undecided")
                   << " [" << truth.t_lo << ", " << truth.t_hi << "] " << truth.note);
  if (truth.verdict == Verdict::undecided) {
    ++t.undecided;
    std::printf("referee undecided in time: %s (%s)\n", s.name.c_str(), truth.note.c_str());
    return;
  }
  CHECK((truth.verdict == Verdict::hit) == e.impact->hit);
  ++t.impacts;
  if (!e.impact->hit) return;
  CHECK(truth.t_lo <= e.impact->time + e.impact->tolerance);
  CHECK(truth.t_hi >= e.impact->time - e.impact->tolerance);
}

}  // namespace

TEST_CASE("the referee agrees with every scenario", "[scenarios][referee]") {
  Tally t;
  for (const auto& s : scenarios::catalog()) {
    INFO(s.folder << "/" << s.name);
    const Scene scene = s.make().scene;
    check_pair(scene, s.expect, t);
    check_impact(scene, s.expect, t);
  }
  std::printf("scenarios: %d verdicts, %d gaps, %d impacts, %d undecided\n", t.verdicts, t.gaps, t.impacts,
              t.undecided);
  CHECK(t.verdicts >= 80);
  CHECK(t.gaps >= 90);
  CHECK(t.impacts >= 20);
}

TEST_CASE("the referee agrees with every corpus case", "[scenarios][corpus][referee]") {
  Tally t;
  for (const StoredCase& s : scenarios::load_corpus(TS_SOURCE_DIR "/scenarios/corpus")) {
    INFO(s.c.id);
    check_pair(s.c.scene, s.expect, t);
    check_impact(s.c.scene, s.expect, t);
  }
  std::printf("corpus: %d verdicts, %d gaps, %d impacts, %d undecided\n", t.verdicts, t.gaps, t.impacts,
              t.undecided);
  CHECK(t.gaps >= 20);
  CHECK(t.impacts >= 10);
}
