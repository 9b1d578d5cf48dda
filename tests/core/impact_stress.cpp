// impact_stress [CASES] [SEED]: random motions of random pairs; the answer is compared with dense sampling of
// the gap. Run by hand, not by ctest.
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "core/ccd/impact.h"
#include "core/narrow/pair_table.h"
#include "core/tolerance.h"
#include "tests/core/random_pair.h"

using namespace touchstone;
using namespace touchstone::test;

int main(int argc, char** argv) {
  const long cases = argc > 1 ? std::atol(argv[1]) : 2000;
  const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atol(argv[2]) : 1);
  long hits = 0, start = 0, not_converged = 0, early = 0, late = 0, missed = 0, most_steps = 0;
  double worst = 0, slowest = 0, total = 0;
  for (long i = 0; i < cases; ++i) {
    Rng r = Rng::stream(seed ^ 0x70f1, static_cast<std::uint64_t>(i));
    const auto ka = static_cast<ShapeKind>(r.below(7)), kb = static_cast<ShapeKind>(r.below(8));
    Pair p = random_pair(r, ka, kb, r.chance(0.1) ? Regime::near : Regime::separate);
    Motion ma, mb;
    const Vec3 gap = p.pose_b.translation - p.pose_a.translation;
    const auto spin = [&] {
      return r.chance(0.2) ? 500 * r.uniform() : (r.chance(0.3) ? 0 : 6 * r.uniform());
    };
    ma.linear = gap * r.uniform(0, 1.5) + r.unit_vector() * gap.norm() * 0.2,
    ma.angular = r.unit_vector() * spin();
    if (r.chance(0.5))
      mb.linear = r.unit_vector() * gap.norm() * r.uniform(0, 1), mb.angular = r.unit_vector() * spin();
    if (kind_of(p.a) == ShapeKind::half_space) ma = {};
    if (kind_of(p.b) == ShapeKind::half_space) mb = {};
    const auto before = std::chrono::steady_clock::now();
    const ImpactAnswer x = time_of_impact({&p.a, p.pose_a, ma}, {&p.b, p.pose_b, mb});
    const double us = static_cast<double>((std::chrono::steady_clock::now() - before).count()) / 1e3;
    total += us;
    if (us > slowest) slowest = us;
    most_steps = std::max<long>(most_steps, x.steps);
    const auto gap_at = [&](Wide t) {
      return narrow::separate(p.a, wide_frame_at(p.pose_a, ma, t), p.b, wide_frame_at(p.pose_b, mb, t)).gap;
    };
    const double l = std::max({scale_of(p), (p.pose_a.translation + ma.linear).cwiseAbs().maxCoeff(),
                               (p.pose_b.translation + mb.linear).cwiseAbs().maxCoeff()});
    const double tau = tolerance::core_tau_factor * 0x1p-53 * l;
    const char* why = nullptr;
    if (x.outcome != Outcome::answered) ++not_converged, why = "not converged";
    const double end = x.toi.value_or(1);
    if (x.toi) {
      ++hits;
      if (*x.toi == 0) ++start;
      const double g = static_cast<double>(gap_at(*x.toi));
      if (*x.toi > 0) worst = std::max(worst, std::abs(g) / l);
      if (g > tau) ++early, why = "early";
      if (g<-tau&& * x.toi> 0) ++late, why = "late";
    }
    if (x.outcome == Outcome::answered)
      for (int k = 0; k < 300; ++k) {
        const Wide t = end * (k + r.uniform()) / 300;
        if (t < end && gap_at(t) < -tau) {
          ++missed, why = "missed";
          break;
        }
      }
    if (why && early + late + missed + not_converged < 8)
      std::printf("case %ld %s: kinds %d %d toi %.17g steps %d sep %.3g clear %.3g L %.3g |w| %.3g %.3g\n", i,
                  why, static_cast<int>(ka), static_cast<int>(kb), x.toi.value_or(-1), x.steps, x.separation,
                  x.clear_until, l, ma.angular.norm(), mb.angular.norm());
  }
  std::printf(
      "cases %ld hits %ld (at 0: %ld) not_converged %ld early %ld late %ld missed %ld worst |gap|/L %.3g; "
      "%.1f us mean, %.0f us slowest, %ld steps most\n",
      cases, hits, start, not_converged, early, late, missed, worst, total / static_cast<double>(cases),
      slowest, most_steps);
  return early + late + missed + not_converged ? 1 : 0;
}
