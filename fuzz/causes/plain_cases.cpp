#include "fuzz/causes/plain_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace touchstone::fuzz {
namespace {

using ShapePair = std::pair<Shape, Shape>;

std::array<ShapePair, 4> shape_pairs() {
  const Shape sphere = Sphere{1}, cube = Box{Vec3::Ones()};
  return {ShapePair{sphere, sphere}, ShapePair{cube, cube}, ShapePair{sphere, cube}, ShapePair{cube, sphere}};
}

double power_of_two_near(double x) {
  constexpr double touching = 0x1p-50;  // of the size: less is a rounding
  if (std::abs(x) < touching) return 0;
  return std::copysign(std::exp2(std::round(std::log2(std::abs(x)))), x);
}

// The bodies of the pair with these shapes, the second `gap` beside the first along x. Bodies that shared a
// shape share one.
Case side_by_side(const Case& c, const BodyPair& p, const ShapePair& shapes, double gap) {
  Case r = c;
  const bool is_shared = shapes.first == shapes.second && c.scene.bodies[0].shape == c.scene.bodies[1].shape;
  r.scene.shapes = is_shared ? std::vector{shapes.first} : std::vector{shapes.first, shapes.second};
  Body &first = r.scene.bodies[static_cast<std::size_t>(p.first)],
       &second = r.scene.bodies[static_cast<std::size_t>(p.second)];
  first.pose = second.pose = {};
  first.shape = 0;
  second.shape = is_shared ? 0 : 1;
  second.pose.translation.x() = 2 + std::max(-2.0, gap);
  return r;
}

// How the second body passes the first. The bodies meet after gap / speed if nothing turns and the offset
// is 0.
struct Course {
  double gap, speed;              // along x, towards each other
  double offset = 0;              // of the second body along y
  double turn_a = 0, turn_b = 0;  // about z
  double share_of_a = 0;          // of the speed
};
constexpr Course courses[] = {
    {.gap = 1, .speed = 2},
    {.gap = 1, .speed = 2, .share_of_a = 1},
    {.gap = 1, .speed = 2, .turn_b = 1},
    {.gap = 1, .speed = 2, .turn_a = 1},
    {.gap = 1, .speed = 2, .turn_a = 1, .turn_b = -0.5, .share_of_a = 0.5},
    {.gap = 1, .speed = 4, .offset = 1.75},
    {.gap = 1, .speed = 4, .offset = 1.75, .turn_b = 1},
    {.gap = 1, .speed = 16},
    {.gap = 15, .speed = 16},
    {.gap = 64, .speed = 128},
    {.gap = 4096, .speed = 8192},
    {.gap = 1.0 / 128, .speed = 1.0 / 64},
    {.gap = 2, .speed = 2},
    {.gap = 0, .speed = 1},
    {.gap = -1, .speed = 1},
    {.gap = 2, .speed = 1},
    {.gap = 1, .speed = 8, .offset = 3},
    {.gap = 1, .speed = -2},
    {.gap = 1, .speed = 2, .turn_b = 3},
    {.gap = 1, .speed = 2, .turn_a = 3},
};

Case on_course(const Case& c, const BodyPair& p, const ShapePair& shapes, const Course& course) {
  Case r = side_by_side(c, p, shapes, course.gap);
  Body &a = r.scene.bodies[static_cast<std::size_t>(p.first)],
       &b = r.scene.bodies[static_cast<std::size_t>(p.second)];
  b.pose.translation.y() = course.offset;
  const double speed_a = course.speed * course.share_of_a, speed_b = course.speed - speed_a;
  a.motion.reset();
  if (speed_a != 0 || course.turn_a != 0) a.motion = Motion{Vec3(speed_a, 0, 0), Vec3(0, 0, course.turn_a)};
  b.motion.reset();
  if (speed_b != 0 || course.turn_b != 0) b.motion = Motion{Vec3(-speed_b, 0, 0), Vec3(0, 0, course.turn_b)};
  return r;
}

// Shares of the size, the largest first: those of the interventions that move bodies together and apart.
constexpr double shares[] = {0.5, 0x1p-8, 0x1p-20, 0x1p-40};

}  // namespace

std::vector<Case> plain_pairs(const Case& c, const TruePair& p) {
  const double own = power_of_two_near(p.gap / p.size);
  std::vector<double> gaps;
  if (own != 0)
    for (const double share : shares) gaps.push_back(std::copysign(share, own));
  gaps.push_back(own);
  std::vector<Case> all;
  for (const double gap : gaps)
    for (const ShapePair& shapes : shape_pairs()) all.push_back(side_by_side(c, {p.a, p.b}, shapes, gap));
  return all;
}

std::vector<Case> plain_impacts(const Case& c, const BodyPair& p) {
  std::vector<Case> all;
  for (const Course& course : courses)
    for (const ShapePair& shapes : shape_pairs()) all.push_back(on_course(c, p, shapes, course));
  return all;
}

}  // namespace touchstone::fuzz
