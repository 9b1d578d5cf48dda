// The core's time of impact, for each pair of shapes and course. Other engines are measured by `chart`.
//
//   bench_impact [--cases 200] [--rounds 9] [--filter box-box] [--course swing] [--no-truth]
//
// mean: the thread's CPU time over a pass of different cases, minimum over the rounds. median, p99: over the
// cases, of the minimum time of each over the rounds, clock overhead subtracted. Against the referee: hits of
// the truth; missed: reports no hit although the bodies overlap by more than 64 units of rounding; ghost: a
// hit that does not exist; late, early: by the depth and the gap at the reported time, in the same units;
// |dt|: distance from the referee's bracket as a fraction of the step, over the hits found; gap: at the
// reported time, over L.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/impact/impact.h"
#include "core/scene/scene.h"
#include "oracles/referee/referee.h"
#include "tests/bench/impact_cases.h"
#include "tests/bench/pair_options.h"

namespace {

using namespace touchstone;
using namespace touchstone::bench;

struct MovingPair {
  MovingShape a, b;
};

double scale_of(const MovingCase& c) {
  Scene s;
  s.shapes = {c.a, c.b};
  s.bodies.resize(2);
  s.bodies[0].pose = c.pose_a;
  s.bodies[0].motion = c.motion_a;
  s.bodies[1].shape = 1;
  s.bodies[1].pose = c.pose_b;
  s.bodies[1].motion = c.motion_b;
  return scale_of_pair(s, 0, 1);
}

struct Judged {
  long missed = 0, ghost = 0, late = 0, early = 0, failed = 0, steps = 0;
  std::vector<double> dt, gap;
};

void judge_one(const MovingCase& c, const referee::TimeTruth& truth, const ImpactAnswer& f, Judged& j) {
  using Verdict = referee::TimeTruth::Verdict;
  const Placed a{&c.a, c.pose_a}, b{&c.b, c.pose_b};
  const double l = scale_of(c), tau = 0x1p-46 * l;
  if (f.outcome != Outcome::answered) {
    ++j.failed;
    return;
  }
  if (!f.toi) {
    j.missed += truth.verdict == Verdict::hit &&
                referee::certified_depth_before(a, c.motion_a, b, c.motion_b, 1) > tau;
    return;
  }
  const double t = std::clamp(*f.toi, 0.0, 1.0);
  const referee::Bracket gap = referee::gap_at(a, c.motion_a, b, c.motion_b, t);
  j.gap.push_back(std::max({gap.lo, -gap.hi, 0.0}) / l);
  if (gap.lo > tau) (truth.verdict == Verdict::none ? j.ghost : j.early) += 1;
  if (truth.verdict != Verdict::hit) return;
  j.dt.push_back(std::max({truth.t_lo - t, t - truth.t_hi, 0.0}));
  if (t > truth.t_lo && t > 0)
    j.late += -gap.hi > tau || referee::certified_depth_before(a, c.motion_a, b, c.motion_b, t) > tau;
}

void run_cell(const MovingKind& kind, Course course, const PairOptions& o, const Ticks& clock) {
  const auto cases = make_moving_cases(kind, course, o.cases, 1);
  std::vector<MovingPair> pairs;
  for (const MovingCase& c : cases)
    pairs.push_back({{&c.a, c.pose_a, c.motion_a}, {&c.b, c.pose_b, c.motion_b}});
  std::vector<ImpactAnswer> found(cases.size());
  PairTimes times(cases.size());
  for (int r = 0; r < o.rounds; ++r)
    times.round(
        1, [&](std::size_t i) { found[i] = time_of_impact(pairs[i].a, pairs[i].b, ImpactDetail::time); });
  std::vector<referee::TimeTruth> truth;
  for (std::size_t i = 0; o.truth && i < cases.size(); ++i) {
    const MovingCase& c = cases[i];
    truth.push_back(referee::judge_motion({&c.a, c.pose_a}, c.motion_a, {&c.b, c.pose_b}, c.motion_b));
  }
  const auto hits = std::count_if(truth.begin(), truth.end(), [](const referee::TimeTruth& t) {
    return t.verdict == referee::TimeTruth::Verdict::hit;
  });
  const std::vector<double> ns = times.each_ns(clock);
  Judged j;
  for (const ImpactAnswer& f : found) j.steps += f.steps;
  for (std::size_t i = 0; i < truth.size(); ++i) judge_one(cases[i], truth[i], found[i], j);
  fmt::print(
      "{:<20} {:<12} {:>9.0f} {:>9.0f} {:>9.0f} {:>6.1f} {:>5} {:>6} {:>5} {:>5} {:>5} {:>6} {:>8.1e} "
      "{:>8.1e} {:>8.1e}\n",
      kind.name, course_names[static_cast<int>(course)], times.mean_ns, quantile(ns, 0.5), quantile(ns, 0.99),
      static_cast<double>(j.steps) / static_cast<double>(cases.size()), hits, j.missed, j.ghost, j.late,
      j.early, j.failed, quantile(j.dt, 0.5), quantile(j.dt, 1), quantile(j.gap, 1));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  PairOptions o;
  o.rounds = 9;
  if (!parse(argc, argv, "--course", o) || !o.only.empty()) {
    fmt::print(stderr,
               "bench_impact [--cases N] [--rounds N] [--filter PAIR] [--course COURSE] [--no-truth]\n");
    return 2;
  }
  const Ticks clock;
  fmt::print("{:<20} {:<12} {:>9} {:>9} {:>9} {:>6} {:>5} {:>6} {:>5} {:>5} {:>5} {:>6} {:>8} {:>8} {:>8}\n",
             "pair", "course", "mean ns", "median ns", "p99 ns", "steps", "hits", "missed", "ghost", "late",
             "early", "failed", "|dt| p50", "max", "gap max");
  for (const MovingKind& kind : moving_kinds)
    for (const Course course :
         {Course::translation, Course::graze, Course::turn, Course::swing, Course::spin, Course::both}) {
      if (!o.filter.empty() && kind.name.find(o.filter) == std::string_view::npos) continue;
      if (!o.column.empty() && o.column != course_names[static_cast<int>(course)]) continue;
      run_cell(kind, course, o, clock);
    }
  return 0;
}
