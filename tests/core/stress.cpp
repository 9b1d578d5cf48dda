// stress [CASES] [SEED] [SEARCH]: random pairs over every regime, judged by bounds and, for every SEARCH-th
// overlapping one, by a search for a better direction. Prints a table and the first failures; exit code 1 on
// any. Run by hand, not by ctest.
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "core/base/exact_text.h"
#include "core/tolerance.h"
#include "tests/core/least_width.h"
#include "tests/core/random_pair.h"

using namespace touchstone;
using namespace touchstone::test;

namespace {

struct Tally {
  long cases = 0, overlaps = 0, not_converged = 0, loose = 0, feasibility = 0, witness = 0, regret = 0;
  double worst_feasibility = 0, worst_regret = 0, worst_slack = 0, ns = 0;
};

void describe(const Pair& p) {
  for (const auto* s : {&p.a, &p.b})
    std::visit(
        [&](const auto& x) {
          std::printf("    %s", std::string(std::remove_cvref_t<decltype(x)>::type).c_str());
          for_each_field(x, [&](auto, const auto& v, Domain) {
            using T = std::remove_cvref_t<decltype(v)>;
            if constexpr (std::is_same_v<T, double>) std::printf(" %s", to_text(v).c_str());
            if constexpr (std::is_same_v<T, Vec3>) std::printf(" (%.17g %.17g %.17g)", v.x(), v.y(), v.z());
            if constexpr (std::is_same_v<T, std::vector<Vec3>>)
              for (const Vec3& q : v) std::printf(" (%.17g %.17g %.17g)", q.x(), q.y(), q.z());
          });
          std::printf("\n");
        },
        *s);
  for (const auto* q : {&p.pose_a, &p.pose_b})
    std::printf("    pose (%.17g %.17g %.17g) [%.17g %.17g %.17g %.17g]\n", q->translation.x(),
                q->translation.y(), q->translation.z(), q->rotation.x, q->rotation.y, q->rotation.z,
                q->rotation.w);
}

}  // namespace

int main(int argc, char** argv) {
  const long cases = argc > 1 ? std::atol(argv[1]) : 20000;
  const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atol(argv[2]) : 1);
  const long search = argc > 3 ? std::atol(argv[3]) : 20;
  std::array<Tally, regime_count> table;
  long failures = 0;
  for (long i = 0; i < cases; ++i) {
    Rng r = Rng::stream(seed, static_cast<std::uint64_t>(i));
    const auto ka = static_cast<ShapeKind>(r.below(7)), kb = static_cast<ShapeKind>(r.below(7));
    const auto regime = static_cast<Regime>(r.below(regime_count));
    const Pair p = random_pair(r, ka, kb, regime);
    Tally& t = table[static_cast<std::size_t>(regime)];
    const auto start = std::chrono::steady_clock::now();
    const Separation s = separation(p.placed_a(), p.placed_b());
    t.ns += static_cast<double>((std::chrono::steady_clock::now() - start).count());
    ++t.cases;
    const double l = scale_of(p), tau = tolerance::core_tau_factor * 0x1p-53 * l;
    const Width width(p.a, p.pose_a, p.b, p.pose_b);
    bool bad = false;
    const char* why = "";
    if (s.outcome != Outcome::answered) {
      ++t.not_converged;
      bad = true;
      why = "not converged";
    }
    if (s.gap <= 0) ++t.overlaps;
    if (s.slack > tau / 2) ++t.loose;
    t.worst_slack = std::max(t.worst_slack, l > 0 ? static_cast<double>(s.slack) / l : 0);
    const WideVec n = s.normal.cast<double>().cast<Wide>();
    const double feasibility = static_cast<double>(width(n) + s.gap);
    t.worst_feasibility = std::max(t.worst_feasibility, l > 0 ? feasibility / l : 0);
    if (!(std::abs(feasibility) <= tau)) {
      ++t.feasibility;
      bad = true;
      why = "feasibility";
    }
    if (!(abs((s.b - s.a).norm() - abs(s.gap)) <= tau)) {
      ++t.witness;
      bad = true;
      why = "witness";
    }
    if (s.gap <= 0 && i % search == 0) {
      const double regret = static_cast<double>(-s.gap - width.least(r, 60, n));
      t.worst_regret = std::max(t.worst_regret, l > 0 ? regret / l : 0);
      if (regret > tau) {
        ++t.regret;
        bad = true;
        why = "regret";
      }
    }
    if (bad && ++failures <= 40) {
      std::printf(
          "case %ld %s: %s gap %.6Lg slack %.3Lg local %.3Lg size %.3Lg L %.3g feas %.3g |b-a| %.6Lg\n", i,
          regime_names[static_cast<std::size_t>(regime)].data(), why, s.gap, s.slack, s.local_slack, s.size,
          l, feasibility, (s.b - s.a).norm());
      describe(p);
    }
  }
  std::printf("%-14s %8s %8s %6s %6s %6s %6s %6s %9s %9s %9s %8s\n", "regime", "cases", "overlap", "notcv",
              "loose", "feas", "witn", "regret", "feas/L", "regret/L", "slack/L", "us");
  for (int k = 0; k < regime_count; ++k) {
    const Tally& t = table[static_cast<std::size_t>(k)];
    std::printf("%-14s %8ld %8ld %6ld %6ld %6ld %6ld %6ld %9.2e %9.2e %9.2e %8.1f\n",
                regime_names[static_cast<std::size_t>(k)].data(), t.cases, t.overlaps, t.not_converged,
                t.loose, t.feasibility, t.witness, t.regret, t.worst_feasibility, t.worst_regret,
                t.worst_slack, t.ns / 1e3 / static_cast<double>(std::max(1L, t.cases)));
  }
  return failures ? 1 : 0;
}
