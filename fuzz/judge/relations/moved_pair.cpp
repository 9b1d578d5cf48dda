// The same pair in another form: A and B exchanged, axes permuted, scaled, moved. The gap is the same, either
// exactly or up to the rounding of the new poses.
#include <fmt/format.h>

#include <cmath>

#include "core/math/roundoff.h"
#include "fuzz/judge/exact_map.h"
#include "fuzz/judge/relation.h"

namespace touchstone::fuzz {
namespace {

Derived same_pair(const RelationInput& in, std::string words) {
  const auto pair = pair_asked(in.c);
  Derived d;
  d.c.family = in.c.family;
  d.c.scene = extract_pair(in.c.scene, pair->first, pair->second);
  d.c.queries = same_queries(in.c);
  d.expected = implied_gaps(in);
  d.same_questions = true;
  d.words = std::move(words);
  return d;
}

// Rotates by a rational matrix about `centre`, and moves `centre` to `to`.
void move_rigidly(Scene& s, const Quat& turn, const Vec3& centre, const Vec3& to) {
  const Mat3 r = rotation_matrix(turn);
  for (Body& b : s.bodies) {
    b.pose.translation = r * (b.pose.translation - centre) + to;
    b.pose.rotation = turn * b.pose.rotation;
    if (!b.motion) continue;
    b.motion->linear = r * b.motion->linear;
    b.motion->angular = r * b.motion->angular;
  }
}

Derived moved(const RelationInput& in, const Quat& turn, const Vec3& centre, const Vec3& to,
              std::string words) {
  Derived d = same_pair(in, std::move(words));
  d.rounding = pose_rounding(d.c.scene);
  move_rigidly(d.c.scene, turn, centre, to);
  d.rounding += pose_rounding(d.c.scene);
  return d;
}

}  // namespace

std::vector<Derived> derive_questions(const RelationInput& in) {
  if (!pair_asked(in.c)) return {};
  return {same_pair(in, "asked again")};
}

std::vector<Derived> derive_swap(const RelationInput& in) {
  if (!pair_asked(in.c)) return {};
  Derived d = same_pair(in, "A and B exchanged");
  std::swap(d.c.scene.bodies[0], d.c.scene.bodies[1]);
  return {d};
}

std::vector<Derived> derive_axes(const RelationInput& in) {
  if (!pair_asked(in.c)) return {};
  std::vector<Derived> r{same_pair(in, "x and y negated")};
  const Vec3 signs(-1, -1, 1);
  turn_axes(r[0].c.scene, signs.asDiagonal());
  Derived turned = same_pair(in, "x, y, z turned into y, z, x");
  if (cycle_axes(turned.c.scene)) r.push_back(std::move(turned));
  return r;
}

std::vector<Derived> derive_scale(const RelationInput& in) {
  if (!pair_asked(in.c)) return {};
  std::vector<Derived> r;
  for (const auto& [factor, words] : {std::pair{enlarged, "scaled by 2^20"}, {reduced, "scaled by 2^-12"}}) {
    Derived d = same_pair(in, words);
    d.scale = factor;
    if (scale_by(d.c.scene, factor)) r.push_back(std::move(d));
  }
  return r;
}

std::vector<Derived> derive_rigid(const RelationInput& in) {
  const auto pair = pair_asked(in.c);
  if (!pair) return {};
  const double l = scale_of_pair(in.c.scene, pair->first, pair->second);
  const Vec3 a = in.c.scene.bodies[static_cast<std::size_t>(pair->first)].pose.translation;
  std::vector<Derived> r{moved(in, {1, 2, -2, 4}, a, Vec3::Zero(), "turned, and A brought to the origin")};
  r.push_back(moved(in, {2, -1, 4, 2}, Vec3::Zero(), Vec3(3, -2, 5) * l, "turned, and moved away by 6 L"));
  return r;
}

std::vector<Derived> derive_push(const RelationInput& in) {
  const auto pair = pair_asked(in.c);
  if (!pair) return {};
  std::vector<Derived> r;
  for (std::size_t i = 0; i < in.c.queries.size(); ++i) {
    const Observation& o = in.base.answers[i];
    if (in.c.queries[i].question != Question::contact || o.outcome != Outcome::answered) continue;
    if (!o.overlap || !*o.overlap || !o.normal || !o.depth || !std::isfinite(*o.depth)) continue;
    Derived d = same_pair(in, "B pushed by the depth along the normal");
    // Neither a surface nor an invalid direction (which is another fault) can be pushed apart.
    const double length = o.normal->stableNorm();
    if (is_mesh(d.c.scene.shape_of(0)) || is_mesh(d.c.scene.shape_of(1)) || !(length > 0.5 && length < 2))
      continue;
    d.same_questions = false;
    d.rounding = pose_rounding(d.c.scene);
    d.c.scene.bodies[1].pose.translation += *o.normal / length * *o.depth;
    d.rounding += pose_rounding(d.c.scene);
    // The Minkowski difference contains a ball of radius d* about the origin and lies behind the plane w(n):
    // a point at p along n is outside it by at most p - d* <= 2τ and inside by at most w(n) - p <= τ.
    // A biased choice of n lets p exceed d* by that share of it more.
    const auto [a, b] = *pair;
    const double tau = tau_of(in.card, o, in.c.scene, a, b, scale_of_pair(in.c.scene, a, b));
    const double bias = depth_bias(in.card, kind_of(in.c.scene.shape_of(a)), kind_of(in.c.scene.shape_of(b)));
    d.expected = {{static_cast<int>(i), {-tau, 2 * tau + bias * std::max(0.0, *o.depth)}}};
    r.push_back(std::move(d));
  }
  return r;
}

// Every number is a size. The other shapes (hull, half-space, mesh) need not contain the body's origin.
bool contains_its_origin(const Shape& shape) {
  return std::visit(
      [](const auto& s) {
        bool all = true;
        for_each_field(s, [&](auto, const auto&, Domain d) {
          all &= d == Domain::non_negative || d == Domain::positive;
        });
        return all;
      },
      shape);
}

std::vector<Derived> derive_grow(const RelationInput& in) {
  if (!pair_asked(in.c)) return {};
  Derived d = same_pair(in, "");
  for (const int i : {1, 0}) {
    Shape& shape =
        d.c.scene.shapes[static_cast<std::size_t>(d.c.scene.bodies[static_cast<std::size_t>(i)].shape)];
    if (!contains_its_origin(shape)) continue;
    d.words = i == 0 ? "A grown by an eighth" : "B grown by an eighth";
    constexpr double roundings = 16;  // eight of the diameter, in units of the radius
    d.rounding = roundings * double_roundoff * bounding_radius(shape);
    change_numbers(shape, [](auto& v, Domain) { v *= 1.125; });
    for (Expected& e : d.expected) e.gap.lo = -infinity;
    return {d};
  }
  return {};
}

namespace {

// The derivative of the distance by translations of B that the answer's points imply, and how far off it may
// be; empty where they are too near to each other, or for surfaces, whose distance is not convex. Points
// within τ of their bodies, and at most d + 3 τ apart, lie up to √(8 τ d) beside the nearest ones: their
// direction may be off by e = √(8 τ / d) and some τ / d. That lowers the gap of the planes across it by up to
// e times the extents, at most 2 L, and changes n·v by e·|v|.
struct Slope {
  Vec3 normal;
  double error;
};
std::optional<Slope> implied_slope(const RelationInput& in, const Query& q, const Observation& o,
                                   double tau) {
  constexpr double least_distance = 1e-3;  // of L
  const Scene& s = in.c.scene;
  if (!o.witness || is_mesh(s.shape_of(q.a)) || is_mesh(s.shape_of(q.b))) return std::nullopt;
  const Vec3 way = (*o.witness)[1] - (*o.witness)[0];
  const double length = way.stableNorm();
  if (!(length > least_distance * scale_of_pair(s, q.a, q.b)) || !std::isfinite(length)) return std::nullopt;
  return Slope{way / (*o.distance < 0 ? -length : length), std::sqrt(8 * tau / length) + 4 * tau / length};
}

}  // namespace

// The signed distance of convex bodies is convex in the translation of B, with the normal as its gradient:
// moved by v it is at least g + n·v, and in any case at most g + |v| and at least g - |v|. Each engine's
// distances are thus compared with the gradient that its own points imply, from both sides.
std::vector<Derived> derive_slope(const RelationInput& in) {
  const auto pair = pair_asked(in.c);
  if (!pair) return {};
  std::vector<Derived> r;
  for (std::size_t i = 0; i < in.c.queries.size(); ++i) {
    const Query& q = in.c.queries[i];
    const Observation& o = in.base.answers[i];
    if (q.question != Question::distance || o.outcome != Outcome::answered || !o.distance) continue;
    const GapInterval gap = implied_gap(in.c.scene, q, o, in.card);
    const double l = scale_of_pair(in.c.scene, q.a, q.b), tau = tau_of(in.card, o, in.c.scene, q.a, q.b, l);
    const std::optional<Slope> slope = implied_slope(in, q, o, tau);
    const Vec3 way = Vec3(0.25, -0.5, 0.375) * (l / 16);
    for (const double side : {1.0, -1.0}) {
      const Vec3 v = side * way;
      Derived d = same_pair(in, "B moved by L/24");
      d.same_questions = false;
      d.c.queries = {{Question::distance, 0, 1}};
      d.rounding = pose_rounding(d.c.scene);
      d.c.scene.bodies[1].pose.translation += v;
      d.rounding += pose_rounding(d.c.scene);
      const double length = v.norm();
      const double least =
          slope ? std::max(-length, slope->normal.dot(v) - slope->error * (length + 2 * l)) : -length;
      d.expected = {{static_cast<int>(i), {gap.lo + least, gap.hi + length}}};
      r.push_back(std::move(d));
    }
    break;
  }
  return r;
}

}  // namespace touchstone::fuzz
