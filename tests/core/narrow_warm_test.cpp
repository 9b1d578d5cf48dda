// A search warm-started where the last one ended gives the same verdict, and the same value within both
// bounds, from frame to frame of bodies that pass, touch and interpenetrate, and from any initial direction.
#include "core/tolerance.h"
#include "tests/core/random_pair.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::test;

namespace {

struct Tally {
  long asked = 0, overlaps = 0, remembered = 0;
};

// One question with and without memory.
void compare(const Pair& p, Arithmetic arithmetic, PairMemory& memory, Tally& t) {
  const PlacedShape a = p.placed_a(), b = p.placed_b();
  ++t.asked;
  t.remembered += memory.direction != Vec3(Vec3::Zero());
  PairMemory m = memory;
  const OverlapAnswer o0 = overlap(a, b, arithmetic), o1 = overlap(a, b, arithmetic, &m);
  const ContactAnswer c0 = contact(a, b, arithmetic), c1 = contact(a, b, arithmetic, &memory);
  const DistanceAnswer d0 = distance(a, b, arithmetic), d1 = distance(a, b, arithmetic, &memory);
  const bool single = arithmetic == Arithmetic::float32;
  if (single && (o0.outcome != o1.outcome || c0.outcome != c1.outcome || d0.outcome != d1.outcome)) return;
  REQUIRE(o0.outcome == o1.outcome);
  REQUIRE(c0.outcome == c1.outcome);
  REQUIRE(d0.outcome == d1.outcome);
  if (d0.outcome != Outcome::answered) return;
  const double bounds = d0.error_bound + d1.error_bound, slight = 0x1p-52 * std::abs(d0.distance);
  CHECK(std::abs(d0.distance - d1.distance) <= bounds + slight);
  // In float, a value within its bound of zero may have either sign.
  const bool clear = !single || std::abs(d0.distance) > bounds;
  if (clear) CHECK(o0.overlap == o1.overlap);
  if (clear) CHECK(c0.overlap == c1.overlap);
  t.overlaps += c0.overlap;
  if (!c0.overlap || !c1.overlap) return;
  CHECK(std::abs(c0.depth - c1.depth) <= c0.regret_bound + c1.regret_bound + slight);
  CHECK(c1.error_bound <= tolerance::core_tau_factor * (single ? 0x1p-23 : 0x1p-53) * scale_of(p) * 1.02);
}

}  // namespace

TEST_CASE("an answer with the memory of the last frame equals the one without, within both bounds",
          "[narrow][warm]") {
  Tally t;
  for (int a = 0; a < 7; ++a)
    for (int b = 0; b < 7; ++b)
      for (int round = 0; round < 6; ++round) {
        Rng r = Rng::stream(51, static_cast<std::uint64_t>((round * 7 + a) * 7 + b));
        Pair p = random_pair(r, static_cast<ShapeKind>(a), static_cast<ShapeKind>(b),
                             round % 2 ? Regime::near : Regime::shallow);
        const double size = scale_of(p);
        const Vec3 drift = r.unit_vector() * (r.uniform(0.001, 0.1) * size), spin = r.unit_vector() * 0.05;
        p.pose_b.translation -= 4 * drift;
        PairMemory in_double, in_float;
        for (int frame = 0; frame < 8; ++frame) {
          INFO(type_name(p.a) << " " << type_name(p.b) << " round " << round << " frame " << frame);
          compare(p, Arithmetic::float64, in_double, t);
          compare(p, Arithmetic::float32, in_float, t);
          p.pose_b.translation += drift;
          p.pose_b.rotation = Quat{spin.x(), spin.y(), spin.z(), 1} * p.pose_b.rotation;
        }
      }
  INFO(t.asked << " asked, " << t.overlaps << " overlaps, " << t.remembered << " with a memory");
  CHECK(t.overlaps * 10 > t.asked);
  CHECK(t.overlaps * 10 < t.asked * 9);
  CHECK(t.remembered * 2 > t.asked);
}

TEST_CASE("an arbitrary memory does no harm", "[narrow][warm]") {
  Tally t;
  const double big = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 1200; ++i) {
    Rng r = Rng::stream(52, static_cast<std::uint64_t>(i));
    const Pair p = random_pair(r, static_cast<ShapeKind>(r.below(7)), static_cast<ShapeKind>(r.below(7)),
                               static_cast<Regime>(r.below(regime_count)));
    PairMemory m;
    for (auto& corners : m.features.corner)
      for (std::int32_t& k : corners) k = static_cast<std::int32_t>(r.below(30)) - 2;
    for (std::int32_t& k : m.features.opposite) k = static_cast<std::int32_t>(r.below(30)) - 2;
    switch (i % 6) {
      case 0:
        m.direction = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
        break;
      case 1:
        m.direction = Vec3(big, 0, 0);
        break;
      case 2:
        m.direction = r.unit_vector() * 1e-300;
        break;
      case 3:
        m.direction = r.unit_vector() * 1e300;
        break;
      default:
        m.direction = r.unit_vector();
    }
    INFO(type_name(p.a) << " " << type_name(p.b) << " case " << i);
    compare(p, Arithmetic::float64, m, t);
  }
  CHECK(t.overlaps * 4 > t.asked);
}
