// Time of impact, ours and others in one run: for each pair of shapes and course every contestant in turn,
// round after round, so that a change in the machine's speed affects all of them alike.
//
//   bench_impact [--cases 200] [--rounds 9] [--filter box-box] [--course swing] [--only core] [--no-truth]
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
#include "tests/bench/ticks.h"

namespace {

using namespace touchstone;
using namespace touchstone::bench;

class Ours final : public ImpactContestant {
 public:
  explicit Ours(const std::vector<MovingCase>& cases) {
    for (const MovingCase& c : cases)
      pairs_.push_back({{&c.a, c.pose_a, c.motion_a}, {&c.b, c.pose_b, c.motion_b}});
  }
  void ask(std::size_t i, FoundImpact& out) override {
    const ImpactAnswer r = time_of_impact(pairs_[i].a, pairs_[i].b, ImpactDetail::time);
    out.failed = r.outcome != Outcome::answered;
    out.t = r.toi;
    out.steps = r.steps;
  }

 private:
  struct Two {
    MovingShape a, b;
  };
  std::vector<Two> pairs_;
};

ImpactContestantPtr make_ours(const MovingKind&, Course, const std::vector<MovingCase>& cases) {
  return std::make_unique<Ours>(cases);
}

struct Entrant {
  std::string_view name;
  ImpactMaker make;
};

constexpr Entrant entrants[] = {
    {"core", &make_ours},
#ifdef TS_BENCH_BULLET
    {"bullet-subsimplex", &make_impact_bullet_subsimplex},
    {"bullet-continuous", &make_impact_bullet_continuous},
#endif
#ifdef TS_BENCH_FCL
    {"fcl-advancement", &make_impact_fcl},
#endif
};

struct Row {
  std::string_view name;
  ImpactContestantPtr subject;
  std::vector<FoundImpact> found;
  std::vector<std::uint64_t> least;
  double mean = HUGE_VAL;
};

void pass(Row& row) {
  const std::size_t n = row.found.size();
  const double start = clock_ns(CLOCK_THREAD_CPUTIME_ID);
  for (std::size_t i = 0; i < n; ++i) row.subject->ask(i, row.found[i]);
  row.mean = std::min(row.mean, (clock_ns(CLOCK_THREAD_CPUTIME_ID) - start) / static_cast<double>(n));
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint64_t t = tick();
    row.subject->ask(i, row.found[i]);
    row.least[i] = std::min(row.least[i], tick() - t);
  }
}

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

void judge_one(const MovingCase& c, const referee::TimeTruth& truth, const FoundImpact& f, Judged& j) {
  using Verdict = referee::TimeTruth::Verdict;
  const Placed a{&c.a, c.pose_a}, b{&c.b, c.pose_b};
  const double l = scale_of(c), tau = 0x1p-46 * l;
  j.failed += f.failed;
  if (f.failed) return;
  if (!f.t) {
    j.missed += truth.verdict == Verdict::hit &&
                referee::certified_depth_before(a, c.motion_a, b, c.motion_b, 1) > tau;
    return;
  }
  const double t = std::clamp(*f.t, 0.0, 1.0);
  const referee::Bracket gap = referee::gap_at(a, c.motion_a, b, c.motion_b, t);
  j.gap.push_back(std::max({gap.lo, -gap.hi, 0.0}) / l);
  if (gap.lo > tau) (truth.verdict == Verdict::none ? j.ghost : j.early) += 1;
  if (truth.verdict != Verdict::hit) return;
  j.dt.push_back(std::max({truth.t_lo - t, t - truth.t_hi, 0.0}));
  if (t > truth.t_lo && t > 0)
    j.late += -gap.hi > tau || referee::certified_depth_before(a, c.motion_a, b, c.motion_b, t) > tau;
}

struct Options {
  int cases = 200, rounds = 9;
  std::string filter, course, only;
  bool truth = true;
};

void run_cell(const MovingKind& kind, Course course, const Options& o, const Ticks& clock) {
  const auto cases = make_moving_cases(kind, course, o.cases, 1);
  std::vector<Row> rows;
  for (const Entrant& e : entrants)
    if (!o.only.empty() && e.name != o.only)
      continue;
    else if (auto subject = e.make(kind, course, cases))
      rows.push_back({e.name, std::move(subject), std::vector<FoundImpact>(cases.size()),
                      std::vector<std::uint64_t>(cases.size(), ~std::uint64_t{0})});
  for (int r = 0; r < o.rounds; ++r)
    for (Row& row : rows) pass(row);
  std::vector<referee::TimeTruth> truth;
  for (std::size_t i = 0; o.truth && i < cases.size(); ++i) {
    const MovingCase& c = cases[i];
    truth.push_back(referee::judge_motion({&c.a, c.pose_a}, c.motion_a, {&c.b, c.pose_b}, c.motion_b));
  }
  const auto hits = std::count_if(truth.begin(), truth.end(), [](const referee::TimeTruth& t) {
    return t.verdict == referee::TimeTruth::Verdict::hit;
  });
  for (const Row& row : rows) {
    std::vector<double> ns;
    for (const std::uint64_t t : row.least) ns.push_back(clock.ns(t));
    Judged j;
    for (const FoundImpact& f : row.found) j.steps += f.steps;
    for (std::size_t i = 0; i < truth.size(); ++i) judge_one(cases[i], truth[i], row.found[i], j);
    fmt::print(
        "{:<20} {:<12} {:<18} {:>9.0f} {:>9.0f} {:>9.0f} {:>6.1f} {:>5} {:>6} {:>5} {:>5} {:>5} {:>6} "
        "{:>8.1e} {:>8.1e} {:>8.1e}\n",
        kind.name, course_names[static_cast<int>(course)], row.name, row.mean, quantile(ns, 0.5),
        quantile(ns, 0.99), static_cast<double>(j.steps) / static_cast<double>(cases.size()), hits, j.missed,
        j.ghost, j.late, j.early, j.failed, quantile(j.dt, 0.5), quantile(j.dt, 1), quantile(j.gap, 1));
  }
  std::fflush(stdout);
}

bool parse(int argc, char** argv, Options& o) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view key = argv[i];
    if (key == "--no-truth") {
      o.truth = false;
      continue;
    }
    if (++i == argc) return false;
    if (key == "--cases")
      o.cases = std::max(1, std::atoi(argv[i]));
    else if (key == "--rounds")
      o.rounds = std::max(1, std::atoi(argv[i]));
    else if (key == "--filter")
      o.filter = argv[i];
    else if (key == "--only")
      o.only = argv[i];
    else if (key == "--course")
      o.course = argv[i];
    else
      return false;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  if (!parse(argc, argv, o)) {
    fmt::print(stderr,
               "bench_impact [--cases N] [--rounds N] [--filter PAIR] [--course COURSE] [--only NAME] "
               "[--no-truth]\n");
    return 2;
  }
  const Ticks clock;
  fmt::print(
      "{:<20} {:<12} {:<18} {:>9} {:>9} {:>9} {:>6} {:>5} {:>6} {:>5} {:>5} {:>5} {:>6} {:>8} {:>8} {:>8}\n",
      "pair", "course", "contestant", "mean ns", "median ns", "p99 ns", "steps", "hits", "missed", "ghost",
      "late", "early", "failed", "|dt| p50", "max", "gap max");
  for (const MovingKind& kind : moving_kinds)
    for (const Course course :
         {Course::translation, Course::graze, Course::turn, Course::swing, Course::spin, Course::both}) {
      if (!o.filter.empty() && kind.name.find(o.filter) == std::string_view::npos) continue;
      if (!o.course.empty() && o.course != course_names[static_cast<int>(course)]) continue;
      run_cell(kind, course, o, clock);
    }
  return 0;
}
