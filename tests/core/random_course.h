// Random motions of random pairs for time-of-impact tests, with what is known about them by construction.
#pragma once

#include <cmath>
#include <numbers>

#include "tests/core/random_pair.h"

namespace touchstone::test {

enum class CourseKind { translation, slow_turn, fast_turn, thin_wall, graze, near_start };
inline constexpr int course_count = 6;
inline constexpr std::array<std::string_view, course_count> course_names{
    "translation", "slow turn", "fast turn", "thin wall", "graze", "near start"};

struct CoursePair {
  Pair p;
  Motion ma, mb;
  /// A time by which they are certainly in contact, if known.
  double contact_by = 2;
  /// Lower bound on the gap over all times; −infinity if not known.
  double least_gap = -HUGE_VAL;
};

/// L of truth.md §3 for the pair in motion.
inline double scale_of(const CoursePair& c) {
  double l = scale_of(c.p);
  for (const auto& [pose, m] : {std::pair{&c.p.pose_a, &c.ma}, std::pair{&c.p.pose_b, &c.mb}})
    l = std::max(l, (pose->translation + m->linear).cwiseAbs().maxCoeff());
  return l;
}

namespace course {

inline ShapeKind kind(Rng& rng) { return static_cast<ShapeKind>(rng.below(7)); }

inline void travel(Rng& rng, CoursePair& c) {
  const Vec3 d = c.p.pose_b.translation - c.p.pose_a.translation;
  const Vec3 aside = rng.unit_vector() * d.norm();
  c.ma.linear = d * rng.uniform(0, 1.5) + aside * 0.2;
  if (!rng.chance(0.5)) return;
  const Vec3 way = rng.unit_vector() * d.norm();
  c.mb.linear = way * rng.uniform(0, 1);
}

inline void turn(Rng& rng, CoursePair& c, double least, double most) {
  if (rng.chance(0.7)) c.ma.angular = rng.vector(least, most);
  if (rng.chance(0.5) || c.ma.angular.isZero(0)) c.mb.angular = rng.vector(least, most);
  if (rng.chance(0.1)) {
    c.ma.linear.setZero();
    c.mb.linear.setZero();
  }
}

// A body flies through a plate whose thickness is 1e-1 to 1e-6 of its travel and whose rim is far away.
inline void thin_wall(Rng& rng, CoursePair& c) {
  const double size = rng.binary_scale(-8, 0), travel = size * rng.binary_scale(3, 17);
  const double thick = travel * std::pow(10, rng.uniform(-6.5, -1));
  c.p.a = Box{{0.5 * thick, 8 * size, 8 * size}};
  c.p.b = random_shape(rng, kind(rng), false);
  scale_shape(c.p.b, size);
  c.p.pose_b.rotation = rng.rotation();
  const Vec3 way = Vec3{1, rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3)} * travel;
  const Vec3 through{0, rng.uniform(-2, 2) * size, rng.uniform(-2, 2) * size};
  c.contact_by = rng.uniform(0.1, 0.9);
  c.p.pose_b.translation = through - c.contact_by * way;
  c.mb.linear = way;
  if (rng.chance(0.5)) c.mb.angular = rng.vector(0, 12);
  // A hull need not contain its origin, so the time of contact is not known.
  if (kind_of(c.p.b) == ShapeKind::hull) c.contact_by = 2;
}

// At contact_by the gap along n is `gap` and the velocity is perpendicular to n, so the gap is at its
// minimum.
inline void graze(Rng& rng, CoursePair& c) {
  const ShapeKind kind_a = kind(rng), kind_b = kind(rng);
  c.p = random_pair(rng, kind_a, kind_b, Regime::separate);
  const double size = std::max(extent(c.p.a), extent(c.p.b));
  const double sign = rng.chance(0.5) ? 1 : -1;
  const double gap = sign * rng.binary_scale(-44, -6) * size;
  aim(c.p, gap);
  aim(c.p, gap);
  const Separation s = separation(c.p.placed_a(), c.p.placed_b());
  const Vec3 n = s.normal.cast<double>(), u = rng.unit_vector();
  const Vec3 way = (u - u.dot(n) * n) * size * rng.uniform(1, 9);
  const double t = rng.uniform(0.2, 0.8);
  c.p.pose_b.translation -= t * way;
  c.mb.linear = way;
  const double rounding = 0x1p-49 * scale_of(c);
  if (gap < -rounding) c.contact_by = t;
  if (gap > 0) c.least_gap = static_cast<double>(s.gap) - rounding;
}

}  // namespace course

inline CoursePair random_course(Rng& rng, CourseKind kind) {
  CoursePair c;
  if (kind == CourseKind::thin_wall) {
    course::thin_wall(rng, c);
    return c;
  }
  if (kind == CourseKind::graze) {
    course::graze(rng, c);
    return c;
  }
  const ShapeKind kind_a = course::kind(rng);
  const ShapeKind kind_b = rng.chance(0.1) ? ShapeKind::half_space : course::kind(rng);
  const Regime regime =
      kind == CourseKind::near_start ? static_cast<Regime>(rng.below(regime_count)) : Regime::separate;
  c.p = random_pair(rng, kind_a, kind_b, regime);
  course::travel(rng, c);
  if (kind == CourseKind::slow_turn) course::turn(rng, c, 0.01, std::numbers::pi / 4);
  if (kind == CourseKind::fast_turn) course::turn(rng, c, 1, rng.chance(0.2) ? 500 : 20);
  if (kind == CourseKind::near_start && rng.chance(0.5)) course::turn(rng, c, 0.01, 6);
  if (kind_of(c.p.a) == ShapeKind::half_space) c.ma = {};
  if (kind_of(c.p.b) == ShapeKind::half_space) c.mb = {};
  return c;
}

}  // namespace touchstone::test
