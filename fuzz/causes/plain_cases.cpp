#include "fuzz/causes/plain_cases.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "fuzz/causes/plain_shapes.h"
#include "fuzz/judge/exact_map.h"

namespace touchstone::fuzz {
namespace {

double power_of_two_near(double x) {
  constexpr double touching = 0x1p-50;  // of the size: less is a rounding
  if (std::abs(x) < touching) return 0;
  return std::copysign(std::exp2(std::round(std::log2(std::abs(x)))), x);
}

// The bodies of the pair with these shapes, the second `gap` beside the first along x. Bodies that shared a
// shape share one.
Case side_by_side(const Case& c, const BodyPair& p, const PlainPair& shapes, double gap) {
  Case r = c;
  const bool is_shared = shapes.first == shapes.second && c.scene.bodies[0].shape == c.scene.bodies[1].shape;
  r.scene.shapes = is_shared ? std::vector{shapes.first} : std::vector{shapes.first, shapes.second};
  Body &first = r.scene.bodies[static_cast<std::size_t>(p.first)],
       &second = r.scene.bodies[static_cast<std::size_t>(p.second)];
  first.pose = second.pose = {};
  first.shape = 0;
  second.shape = is_shared ? 0 : 1;
  const double reach = shapes.reach_first + shapes.reach_second;
  second.pose.translation.x() = reach + std::max(-reach, gap);
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

Case on_course(const Case& c, const BodyPair& p, const PlainPair& shapes, const Course& course) {
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

// What else a fault may need: another direction or place, bodies of two sizes, turned, or one in the other.
struct Arrangement {
  Numbers towards = {1, 0, 0};  // from the first body to the second
  Numbers at = {0, 0, 0};       // the first body
  double size_a = 1, size_b = 1;
  bool turned_a = false, turned_b = false;
  bool is_inside = false;  // the second body, not quite at the centre of the first
};
constexpr Arrangement arrangements[] = {
    {.towards = {-1, 0, 0}},
    {.towards = {0, 1, 0}},
    {.towards = {0, 0, 1}},
    {.towards = {0, 0, -1}},
    {.at = {16, 32, 64}},
    {.at = {-16, -32, -64}},
    {.at = {4096, 0, 0}},
    {.size_a = 16},
    {.size_b = 16},
    {.turned_a = true},
    {.turned_b = true},
    {.turned_a = true, .turned_b = true},
    {.towards = {1, 0.5, 0.25}},
    {.at = {16, 32, 64}, .turned_a = true, .turned_b = true},
    {.size_a = 4, .is_inside = true},
    {.size_b = 4, .is_inside = true},
    {.at = {16, 32, 64}, .size_a = 4, .is_inside = true},
};

PlainPair sized(const PlainPair& p, double first, double second) {
  PlainPair r = p;
  change_numbers(r.first, [first](auto& v, Domain) { v *= first; });
  change_numbers(r.second, [second](auto& v, Domain) { v *= second; });
  r.reach_first *= first;
  r.reach_second *= second;
  return r;
}

// Empty where the gap cannot be had.
std::optional<Case> arranged(const Case& c, const BodyPair& p, const PlainPair& shapes,
                             const Arrangement& how, double gap) {
  const PlainPair sizes = sized(shapes, how.size_a, how.size_b);
  Case r = side_by_side(c, p, sizes, gap);
  Pose &a = r.scene.bodies[static_cast<std::size_t>(p.first)].pose,
       &b = r.scene.bodies[static_cast<std::size_t>(p.second)].pose;
  const Quat turn = normalized(Quat{0.25, 0.125, 0.5, 1});
  if (how.turned_a) a.rotation = turn;
  if (how.turned_b) b.rotation = turn;
  const double between = how.is_inside ? 0.25 : sizes.reach_first + sizes.reach_second + gap;
  a.translation = vec3(how.at);
  b.translation = a.translation + vec3(how.towards) * between;
  const bool is_exact = shapes.is_exact && !how.turned_a && !how.turned_b && vec3(how.towards).norm() == 1;
  if (how.is_inside) return gap < 0 ? std::optional(r) : std::nullopt;
  return is_exact ? std::optional(r) : with_gap(r, gap);
}

// The gap is set by the referee where it is not plain.
std::optional<Case> with_plain_gap(const Case& c, const BodyPair& p, const PlainPair& shapes, double gap) {
  const Case r = side_by_side(c, p, shapes, gap);
  return shapes.is_exact ? std::optional(r) : with_gap(r, gap);
}

std::vector<double> plain_gaps(const TruePair& p) {
  const double own = power_of_two_near(p.gap / p.size);
  std::vector<double> gaps;
  if (own != 0)
    for (const double share : shares) gaps.push_back(std::copysign(share, own));
  gaps.push_back(own);
  return gaps;
}

void add_if_any(std::vector<Case>& to, std::optional<Case> c) {
  if (c) to.push_back(*std::move(c));
}

std::vector<PlainPair> own_pairs_of(const Case& c, const BodyPair& p) {
  return own_pairs(c.scene.shape_of(p.first), c.scene.shape_of(p.second));
}

}  // namespace

std::vector<Case> plain_pairs(const Case& c, const TruePair& p) {
  const std::vector<double> gaps = plain_gaps(p);
  const BodyPair pair{p.a, p.b};
  std::vector<Case> all;
  for (const auto& kinds : {common_pairs(), own_pairs_of(c, pair)}) {
    for (const double gap : gaps)
      for (const PlainPair& shapes : kinds) add_if_any(all, with_plain_gap(c, pair, shapes, gap));
    for (const Arrangement& how : arrangements)
      for (const PlainPair& shapes : kinds) add_if_any(all, arranged(c, pair, shapes, how, gaps.front()));
  }
  return all;
}

std::vector<Case> nearest_plain_pairs(const Case& c, const TruePair& p) {
  std::vector<Case> all;
  for (const PlainPair& shapes : common_pairs())
    all.push_back(side_by_side(c, {p.a, p.b}, shapes, power_of_two_near(p.gap / p.size)));
  return all;
}

std::vector<Case> plain_impacts(const Case& c, const BodyPair& p) {
  std::vector<Case> all;
  for (const auto& kinds : {common_pairs(), own_pairs_of(c, p)})
    for (const Course& course : courses)
      for (const PlainPair& shapes : kinds) all.push_back(on_course(c, p, shapes, course));
  return all;
}

}  // namespace touchstone::fuzz
