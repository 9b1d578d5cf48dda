#include "tests/bench/impact_cases.h"

#include <numbers>

#include "core/narrow/narrow_phase.h"
#include "tests/bench/bench_shape.h"

namespace touchstone::bench {
namespace {

Vec3 spin_of(Rng& r, Course course) {
  constexpr double eighth = std::numbers::pi / 4, turn = 2 * std::numbers::pi;
  switch (course) {
    case Course::translation:
    case Course::graze:
      return Vec3::Zero();
    case Course::turn:
      return r.vector(0.3, eighth);
    case Course::spin:
      return r.vector(3 * turn, 10 * turn);
    default:
      return r.vector(eighth, 2.5);
  }
}

// B starts `away` along n from a pose in which its gap across `way` is small.
void aim_past(Rng& r, MovingCase& c) {
  const Vec3 n = r.unit_vector(), u = r.unit_vector();
  const double offset = r.binary_scale(-30, -10) * (r.chance(0.5) ? 1 : -1);
  c.pose_b.translation = c.pose_a.translation + 6 * n;
  const DistanceAnswer d = distance({&c.a, c.pose_a}, {&c.b, c.pose_b});
  const Vec3 m = d.normal;
  c.pose_b.translation -= m * (d.distance - offset);
  const Vec3 way = (u - u.dot(m) * m) * r.uniform(4, 8);
  c.pose_b.translation -= way * r.uniform(0.3, 0.7);
  c.motion_b.linear = way;
}

}  // namespace

std::vector<MovingCase> make_moving_cases(const MovingKind& kind, Course course, int count,
                                          std::uint64_t seed) {
  std::vector<MovingCase> all;
  for (int i = 0; i < count; ++i) {
    Rng r = Rng::stream(seed, static_cast<std::uint64_t>(i));
    MovingCase c{make_shape(r, kind.a, kind.vertices), make_shape(r, kind.b, kind.vertices), {}, {}, {}, {}};
    c.pose_a.rotation = r.rotation();
    c.pose_b.rotation = r.rotation();
    c.pose_a.translation = r.unit_vector();
    if (course == Course::graze) {
      aim_past(r, c);
    } else {
      c.pose_b.translation = c.pose_a.translation + r.uniform(3, 6) * r.unit_vector();
      const DistanceAnswer d = distance({&c.a, c.pose_a}, {&c.b, c.pose_b});
      const Vec3 way = c.pose_a.translation - c.pose_b.translation;
      const Vec3 linear = (way.normalized() + 0.25 * r.unit_vector()) * (d.distance * r.uniform(0.9, 1.8));
      c.motion_b = {linear, spin_of(r, course)};
    }
    if (course == Course::both) {
      c.motion_a = {c.motion_b.linear * -r.uniform(0.2, 0.8), spin_of(r, course)};
      c.motion_b.linear += c.motion_a.linear;
    }
    all.push_back(std::move(c));
  }
  return all;
}

}  // namespace touchstone::bench
