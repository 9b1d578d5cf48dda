// impact_stress [CASES] [SEED] [SAMPLES] [FAMILY] [FIRST]: random motions of random pairs, of all families or
// of number FAMILY, starting with case FIRST. The answer is checked against the gap in extended precision at
// the reported time and at random times before it, most of them shortly before, and against what is known by
// construction. Run by hand, not by ctest. `undecided`: extended precision cannot determine the gap. `grain`:
// the bodies move so fast that no double is nearer to contact.
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "core/impact/impact.h"
#include "core/narrow/pair_table.h"
#include "core/tolerance.h"
#include "tests/core/random_course.h"

using namespace touchstone;
using namespace touchstone::test;

namespace {

struct Count {
  long cases = 0, hits = 0, start = 0, failed = 0, early = 0, late = 0, missed = 0, ghost = 0, odd = 0;
  long undecided = 0, grain = 0;
  long slowest_case = -1;
  double worst = 0, slowest = 0, total = 0;
  long bad() const { return failed + early + late + missed + ghost + odd; }
};

struct Check {
  const CoursePair& c;
  const ImpactAnswer& x;
  double l, tau;
  Separation at(Wide t) const {
    return narrow::separate(c.p.a, wide_frame_at(c.p.pose_a, c.ma, t), c.p.b,
                            wide_frame_at(c.p.pose_b, c.mb, t));
  }
  // Where its bounds have not met: the certain part of the gap, but at least 0.
  Wide gap_at(Wide t, long& undecided) const {
    const Separation s = at(t);
    if (s.outcome == Outcome::answered) return s.gap;
    ++undecided;
    return std::max<Wide>(0, s.gap - s.slack);
  }
  bool overlapped_before(Rng& r, double end, int samples, long& undecided) const {
    for (int k = 0; k < samples; ++k) {
      const double back = k % 2 == 0 ? r.uniform() : std::ldexp(r.uniform(), -static_cast<int>(r.below(40)));
      const Wide t = end * (1 - static_cast<Wide>(back));
      if (gap_at(t, undecided) < -tau) return true;
    }
    return false;
  }
  // A unit normal, and points whose distance along it is the gap. Across it they are only as good as a sliver
  // simplex on a curved body allows.
  bool odd_contact() const {
    if (!x.toi || *x.toi == 0) return false;
    const Vec3 d = x.witness_w[1] - x.witness_w[0];
    return !(std::abs(x.normal_ab.norm() - 1) < 1e-12 && std::abs(d.dot(x.normal_ab)) <= 3 * tau &&
             d.norm() < 1e-8 * l);
  }
};

const char* counted(long& count, const char* what) {
  ++count;
  return what;
}

const char* judge(const Check& k, Count& n, Rng& r, int samples) {
  const auto& [c, x, l, tau] = k;
  if (x.outcome != Outcome::answered) return counted(n.failed, "not converged");
  if (k.odd_contact()) return counted(n.odd, "odd contact");
  const double end = x.toi.value_or(1);
  if (x.toi) {
    ++n.hits;
    n.start += end == 0;
    const double g = static_cast<double>(k.gap_at(end, n.undecided));
    if (end > 0) n.worst = std::max(n.worst, std::abs(g) / l);
    if (g > tau && k.gap_at(std::nextafter(end, 1.0), n.undecided) < -tau) return counted(n.grain, nullptr);
    if (g > tau) return counted(n.early, "early");
    if (c.least_gap > tau) return counted(n.ghost, "ghost");
    if (g < -tau && end > 0) return counted(n.late, "late");
  }
  if (end > c.contact_by && k.gap_at(c.contact_by, n.undecided) < -tau)
    return counted(n.missed, "missed what is known");
  if (end > 0 && k.overlapped_before(r, end, samples, n.undecided)) return counted(n.missed, "missed");
  return nullptr;
}

}  // namespace

int main(int argc, char** argv) {
  const long cases = argc > 1 ? std::atol(argv[1]) : 2000;
  const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atol(argv[2]) : 1);
  const int samples = argc > 3 ? std::atoi(argv[3]) : 60;
  const long family = argc > 4 ? std::atol(argv[4]) : -1, first = argc > 5 ? std::atol(argv[5]) : 0;
  Count counts[course_count];
  long shown = 0, bad = 0;
  for (long i = first; i < first + cases; ++i) {
    if (family >= 0 && i % course_count != family) continue;
    Rng r = Rng::stream(seed ^ 0x70f1, static_cast<std::uint64_t>(i));
    const auto kind = static_cast<CourseKind>(i % course_count);
    const CoursePair c = random_course(r, kind);
    Count& n = counts[static_cast<int>(kind)];
    const auto before = std::chrono::steady_clock::now();
    const ImpactAnswer x = time_of_impact({&c.p.a, c.p.pose_a, c.ma}, {&c.p.b, c.p.pose_b, c.mb});
    const double us = static_cast<double>((std::chrono::steady_clock::now() - before).count()) / 1e3;
    n.total += us;
    ++n.cases;
    if (us > n.slowest) {
      n.slowest = us;
      n.slowest_case = i;
    }
    const double l = scale_of(c);
    const char* why = judge({c, x, l, tolerance::core_tau_factor * 0x1p-53 * l}, n, r, samples);
    if (why && shown++ < 12) {
      std::printf(
          "case %ld %s: kinds %d %d toi %.17g steps %d sep %.3g clear %.17g L %.3g |w| %.3g %.3g by %.17g\n",
          i, why, static_cast<int>(kind_of(c.p.a)), static_cast<int>(kind_of(c.p.b)), x.toi.value_or(-1),
          x.steps, x.separation, x.clear_until, l, c.ma.angular.norm(), c.mb.angular.norm(), c.contact_by);
      const Vec3 d = x.witness_w[1] - x.witness_w[0];
      if (x.toi)
        std::printf("  gap %.3g |n|-1 %.3g d.n %.3g |d| %.3g tau %.3g\n",
                    static_cast<double>(Check{c, x, l, 0}.at(*x.toi).gap), x.normal_ab.norm() - 1,
                    d.dot(x.normal_ab), d.norm(), tolerance::core_tau_factor * 0x1p-53 * l);
    }
  }
  for (int k = 0; k < course_count; ++k) {
    const Count& n = counts[k];
    if (n.cases == 0) continue;
    bad += n.bad();
    std::printf(
        "%-12s cases %ld hits %ld (at 0: %ld) failed %ld early %ld late %ld missed %ld ghost %ld odd %ld "
        "undecided %ld grain %ld "
        "worst "
        "|gap|/L %.3g; %.2f us mean, %.0f us slowest (case %ld)\n",
        course_names[static_cast<std::size_t>(k)].data(), n.cases, n.hits, n.start, n.failed, n.early, n.late,
        n.missed, n.ghost, n.odd, n.undecided, n.grain, n.worst, n.total / static_cast<double>(n.cases),
        n.slowest, n.slowest_case);
  }
  return bad ? 1 : 0;
}
