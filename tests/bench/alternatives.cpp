// What a time of impact costs, and what is lost without one: the end pose only, N sub-steps, speculative
// contact, and core/impact, on the same motions, judged by the referee.
//
//   bench_alternatives [--cases 200] [--rounds 3] [--most 1024] [--csv FILE]
//
// missed: the referee has a hit and the method does not; ghost: the reverse, with a certified gap throughout.
// Gap error of the hits that both have: |signed gap at the reported time| / L, by the core's own narrow
// phase. µs: minimum over the rounds for each case; median and mean over the cases.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>

#include "core/impact/alternatives.h"
#include "core/math/rng.h"
#include "core/narrow/narrow_phase.h"
#include "core/scene/scene.h"
#include "oracles/referee/referee.h"
#include "tests/bench/ticks.h"

namespace {

using namespace touchstone;
using namespace touchstone::bench;

struct Case {
  Shape a, b;
  Pose pose_a, pose_b;
  Motion motion_a;
  MovingShape moving_a() const { return {&a, pose_a, motion_a}; }
  MovingShape moving_b() const { return {&b, pose_b, {}}; }
};

Shape some_shape(Rng& r) {
  switch (r.below(4)) {
    case 0:
      return Sphere{r.uniform(0.2, 1)};
    case 1:
      return Box{{r.uniform(0.2, 1), r.uniform(0.2, 1), r.uniform(0.2, 1)}};
    case 2:
      return Capsule{r.uniform(0.2, 0.5), r.uniform(0.2, 1)};
    default: {
      std::vector<Vec3> v;
      for (int i = 0; i < 32; ++i) v.push_back(r.unit_vector().normalized());
      return make_hull(std::move(v));
    }
  }
}

// B is at the origin; A starts at `away` and aims at a point within `off` of it, arriving in mid-step.
Case aimed(Rng& r, Shape a, Shape b, double away, double off, double spin) {
  Case c{std::move(a), std::move(b), {}, {}, {}};
  const Vec3 from = r.unit_vector().normalized() * away, target = r.vector(0, off);
  c.pose_a = {from, r.rotation()};
  c.pose_b.rotation = r.rotation();
  c.motion_a = {(target - from) * r.uniform(1.2, 2.5), r.unit_vector().normalized() * spin};
  return c;
}

struct Family {
  const char* name;
  std::function<Case(Rng&)> make;
};

const std::vector<Family>& families() {
  static const std::vector<Family> all{
      {"translation, a size a step", [](Rng& r) { return aimed(r, some_shape(r), some_shape(r), 3, 2, 0); }},
      {"slow turning",
       [](Rng& r) { return aimed(r, some_shape(r), some_shape(r), 3, 2, r.uniform(0.1, 0.8)); }},
      {"fast turning", [](Rng& r) { return aimed(r, some_shape(r), some_shape(r), 3, 2, r.uniform(3, 30)); }},
      {"bullet and wall",
       [](Rng& r) {
         const double thin = std::ldexp(1.0, -static_cast<int>(4 + r.below(8)));
         return aimed(r, Sphere{thin}, Box{{thin, 1, 1}}, 20, 1.5, 0);
       }},
      {"grazing", [](Rng& r) {
         // They pass at a distance of the sum of their radii, give or take a thousandth.
         Case c{Sphere{0.5}, Box{{0.5, 0.5, 0.5}}, {}, {}, {}};
         c.pose_a.translation = Vec3(-4 + r.uniform(-1, 1), r.uniform(-0.4, 0.4), 1 + r.uniform(-1e-3, 1e-3));
         c.motion_a.linear = Vec3(8, 0, 0);
         return c;
       }}};
  return all;
}

struct Method {
  std::string name;
  std::function<ImpactAnswer(const MovingShape&, const MovingShape&)> ask;
};

std::vector<Method> methods(int most) {
  std::vector<Method> all{{"end pose", &end_pose_impact}};
  for (int n = 1; n <= most; n *= 2)
    all.push_back({fmt::format("{} sub-steps", n),
                   [n](const MovingShape& a, const MovingShape& b) { return substep_impact(a, b, n); }});
  for (const double margin : {0.1, 1.0})
    all.push_back(
        {fmt::format("speculative, margin {:g}", margin),
         [margin](const MovingShape& a, const MovingShape& b) { return speculative_impact(a, b, margin); }});
  all.push_back(
      {"time of impact", [](const MovingShape& a, const MovingShape& b) { return time_of_impact(a, b); }});
  return all;
}

double scale_of(const Case& c) {
  return std::max({extent(c.a), extent(c.b), c.pose_a.translation.cwiseAbs().maxCoeff(),
                   (c.pose_a.translation + c.motion_a.linear).cwiseAbs().maxCoeff()});
}

double gap_at(const Case& c, double t) {
  const PlacedShape a{&c.a, pose_at(c.pose_a, c.motion_a, t)}, b{&c.b, c.pose_b};
  return distance(a, b).distance;
}

struct Result {
  long missed = 0, ghosts = 0, failed = 0;
  std::vector<double> us, error;
};

Result measure(const Method& m, const std::vector<Case>& cases, const std::vector<referee::TimeTruth>& truth,
               int rounds, const Ticks& clock) {
  Result r;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const MovingShape a = cases[i].moving_a(), b = cases[i].moving_b();
    double least = HUGE_VAL;
    ImpactAnswer x;
    for (int k = 0; k < rounds; ++k) {
      const std::uint64_t from = tick();
      x = m.ask(a, b);
      least = std::min(least, clock.ns(tick() - from) / 1000);
    }
    r.us.push_back(least);
    r.failed += x.outcome != Outcome::answered;
    using V = referee::TimeTruth::Verdict;
    r.missed += truth[i].verdict == V::hit && !x.toi;
    r.ghosts += truth[i].verdict == V::none && x.toi;
    if (truth[i].verdict == V::hit && x.toi)
      r.error.push_back(std::abs(gap_at(cases[i], *x.toi)) / scale_of(cases[i]));
  }
  return r;
}

}  // namespace

int main(int argc, char** argv) {
  int count = 200, rounds = 3, most = 1024;
  std::ofstream csv;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (!std::strcmp(argv[i], "--cases")) count = std::max(1, std::atoi(argv[i + 1]));
    if (!std::strcmp(argv[i], "--rounds")) rounds = std::max(1, std::atoi(argv[i + 1]));
    if (!std::strcmp(argv[i], "--most")) most = std::atoi(argv[i + 1]);
    if (!std::strcmp(argv[i], "--csv")) csv.open(argv[i + 1]);
  }
  csv << "family,method,cases,hits,undecided,missed,ghosts,failed,gap_error_median,gap_error_max,us_median,"
         "us_mean\n";
  const Ticks clock;
  for (std::size_t f = 0; f < families().size(); ++f) {
    std::vector<Case> cases;
    std::vector<referee::TimeTruth> truth;
    long hits = 0, undecided = 0;
    for (int i = 0; i < count; ++i) {
      Rng r = Rng::stream(500 + f, static_cast<std::uint64_t>(i));
      cases.push_back(families()[f].make(r));
      const Case& c = cases.back();
      truth.push_back(referee::judge_motion({&c.a, c.pose_a}, c.motion_a, {&c.b, c.pose_b}, {}));
      hits += truth.back().verdict == referee::TimeTruth::Verdict::hit;
      undecided += truth.back().verdict == referee::TimeTruth::Verdict::undecided;
    }
    fmt::print("\n{}: {} cases, {} hits, {} undecided\n{:24} {:>8} {:>6} {:>6} {:>12} {:>12} {:>10} {:>10}\n",
               families()[f].name, count, hits, undecided, "", "missed %", "ghosts", "failed", "gap median",
               "gap max", "median µs", "mean µs");
    for (const Method& m : methods(most)) {
      const Result r = measure(m, cases, truth, rounds, clock);
      double sum = 0;
      for (double us : r.us) sum += us;
      const double mean = sum / static_cast<double>(r.us.size());
      fmt::print("{:24} {:8.1f} {:6} {:6} {:12.2e} {:12.2e} {:10.3f} {:10.3f}\n", m.name,
                 hits ? 100.0 * static_cast<double>(r.missed) / static_cast<double>(hits) : 0.0, r.ghosts,
                 r.failed, quantile(r.error, 0.5), quantile(r.error, 1), quantile(r.us, 0.5), mean);
      csv << fmt::format("\"{}\",\"{}\",{},{},{},{},{},{},{},{},{},{}\n", families()[f].name, m.name, count,
                         hits, undecided, r.missed, r.ghosts, r.failed, quantile(r.error, 0.5),
                         quantile(r.error, 1), quantile(r.us, 0.5), mean);
    }
  }
}
