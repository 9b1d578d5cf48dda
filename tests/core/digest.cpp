// Prints hashes of answers of the core, to be compared between machines: ts_core_digest [cases].
//   float64_alone   the narrow phase in double only; no extended precision takes part
//   boxes           loose boxes (double)
//   impacts, extended, exact_boxes   extended precision takes part: equal where Wide is the same
#include <cstdio>
#include <cstdlib>

#include "core/base/hash.h"
#include "core/broad/body_box.h"
#include "core/impact/impact.h"
#include "tests/core/random_course.h"

using namespace touchstone;
using namespace touchstone::test;

namespace {

// The others place bodies by answers in extended precision.
constexpr std::array regimes{Regime::separate, Regime::deep, Regime::contained, Regime::coaxial,
                             Regime::aligned};
constexpr std::array courses{CourseKind::translation, CourseKind::slow_turn, CourseKind::fast_turn,
                             CourseKind::thin_wall};

void add(Hasher& h, const Vec3& v) { h.add(v.x()).add(v.y()).add(v.z()); }

void add(Hasher& h, const Aabb& b) {
  add(h, b.lo);
  add(h, b.hi);
}

void add(Hasher& h, const DistanceAnswer& r) {
  h.add(static_cast<int>(r.outcome)).add(r.distance).add(r.error_bound);
  add(h, r.normal);
  add(h, r.witness[0]);
  add(h, r.witness[1]);
}

void add(Hasher& h, const ContactAnswer& r) {
  h.add(static_cast<int>(r.outcome)).add(r.overlap).add(r.depth).add(r.error_bound);
  add(h, r.normal);
  for (const ContactPoint& p : r.manifold) {
    add(h, p.position);
    h.add(p.depth).add(static_cast<int>(p.feature));
  }
}

void add(Hasher& h, const ImpactAnswer& r) {
  h.add(static_cast<int>(r.outcome)).add(r.toi.value_or(2)).add(r.separation).add(r.clear_until);
  add(h, r.normal_ab);
  add(h, r.witness_w[0]);
  add(h, r.witness_w[1]);
}

void print(const char* name, const Hasher& h) {
  std::printf("%s %016llx\n", name, static_cast<unsigned long long>(h.value()));
}

}  // namespace

int main(int argc, char** argv) {
  const int cases = argc > 1 ? std::atoi(argv[1]) : 2000;
  Hasher alone, boxes, impacts, extended, exact_boxes;
  Rng rng(2026);
  for (int i = 0; i < cases; ++i) {
    const ShapeKind kind_a = course::kind(rng),
                    kind_b = i % 9 == 0 ? ShapeKind::half_space : course::kind(rng);
    const Pair p = random_pair(rng, kind_a, kind_b, regimes[static_cast<std::size_t>(i) % regimes.size()]);
    const PlacedShape a = p.placed_a(), b = p.placed_b();
    const OverlapAnswer o = overlap(a, b, Arithmetic::float64_alone);
    alone.add(static_cast<int>(o.outcome)).add(o.overlap).add(o.error_bound);
    add(alone, distance(a, b, Arithmetic::float64_alone));
    add(alone, contact(a, b, Arithmetic::float64_alone));
    for (const PlacedShape* x : {&a, &b}) {
      add(boxes, broad::loose_box(*x->shape, x->pose, 4 * extent(*x->shape)));
      add(exact_boxes, broad::body_box(*x->shape, x->pose));
    }
    if (i % 10 == 0) add(extended, distance(a, b));
    if (i % 10 != 1) continue;
    const CoursePair c = random_course(rng, courses[static_cast<std::size_t>(i / 10) % courses.size()]);
    add(impacts, time_of_impact({&c.p.a, c.p.pose_a, c.ma}, {&c.p.b, c.p.pose_b, c.mb}));
  }
  std::printf("cases %d\nwide %d bits\n", cases, std::numeric_limits<Wide>::digits);
  print("float64_alone", alone);
  print("boxes", boxes);
  print("impacts", impacts);
  print("extended", extended);
  print("exact_boxes", exact_boxes);
}
