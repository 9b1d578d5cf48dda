// Bound. Let u = 2⁻⁶⁴, which the relative error of an operation of Wide does not exceed, and R̃ the computed
// rotation.
//  * Each entry of R is a sum of at most four products of doubles, divided by |q|². A product of doubles
//  rounds
//    once and a sum of four such terms at most three more times; all terms are <= |q|² in magnitude. The
//    numerator is within 4u|q|², the denominator within relative 4u, and the quotient rounds once more:
//    |R̃ − R| <= 10u entrywise. Squares of doubles cannot overflow or lose the largest term in Wide: where its
//    exponents are those of double, q is scaled first.
//  * A box bound along an axis is t + Σ R_k s_k, or a square root of Σ (R_k s_k)², or a maximum of dot
//  products:
//    at most eight more roundings, each relative to a partial result of magnitude at most S + |t|, where
//    S = Σ|s_k| (or the largest |vertex|₁): error <= (3·10 + 8)·u·S + 2u|t| < 2⁻⁵⁸·(S + |t|) = 64u(S + |t|).
//  * The widened bound is rounded to the nearest double and stepped outward if that moved it inward.
// The same holds for double with u = 2⁻⁵³: 2⁻⁴⁷·(S + |t|) = 64u(S + |t|) also covers the rounding of the last
// sum, so no step outward is needed; underflow loses less than 2⁻¹⁰⁰⁰. For denormal results, the step outward
// is at least one denormal; what Wide itself may lose there is added (`lost`).
#include "core/broad/body_box.h"

#include <cmath>
#include <limits>

#include "core/math/wide.h"
#include "core/tolerance.h"

namespace touchstone::broad {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

double round_down(Wide x) {
  const double d = static_cast<double>(x);
  return static_cast<Wide>(d) > x ? std::nextafter(d, -inf) : d;
}
double round_up(Wide x) { return -round_down(-x); }

// Slack for the rounding of a sum of two Wides: two units of its last place.
constexpr Wide sum_slack = 0x1p-62;
// Slack for the rounding of |ω| and of its product with a radius.
constexpr Wide turn_slack = 0x1p-60;

// Covers what Wide may lose to underflow, a few units of the least double.
constexpr double lost = wide_holds_squares ? 0 : 16 * std::numeric_limits<double>::denorm_min();

// The sum, rounded away from zero in the direction of `b`.
Wide outward(Wide a, Wide b) {
  const Wide sum = a + b, slack = sum_slack * abs(sum);
  return b < 0 ? sum - slack : sum + slack;
}

// Extent of the shape along one world axis about the body's origin; `row` is that row of the rotation.
template <class T>
Interval<T> extent_along(const Shape& shape, const V3<T>& row) {
  return std::visit([&](const auto& s) { return s.extent_along(row); }, shape);
}

// S in the bound at the top of this file.
Wide coordinate_sum(const Shape& shape) {
  return std::visit([](const auto& s) { return s.coordinate_sum(); }, shape);
}

// Handles a plane that is exactly perpendicular to a world axis: the rotation is exactly the identity or a
// half turn about a body axis, and the normal has one component.
void tighten_half_space(const HalfSpace& h, const Pose& pose, Aabb& box) {
  const Quat& q = pose.rotation;
  const int turning = (q.x != 0) + (q.y != 0) + (q.z != 0) + (q.w != 0);
  const int components = static_cast<int>((h.normal.array() != 0).count());
  if (turning != 1 || components != 1) return;
  int axis = 0;
  h.normal.cwiseAbs().maxCoeff(&axis);
  const double kept[3] = {q.x, q.y, q.z};
  const Wide flip = q.w != 0 || kept[axis] != 0 ? 1 : -1;
  const int e = wide_holds_squares ? 0 : -std::ilogb(h.normal[axis]);
  const Wide n = flip * ldexp(Wide(h.normal[axis]), e), t = pose.translation[axis];
  const Wide foot = ldexp(Wide(h.offset), e) / n;
  const Wide at = t + foot;
  const Wide slack = tolerance::box_error_factor * (abs(t) + abs(foot)) + lost;
  if (n > 0)
    box.hi[axis] = round_up(at + slack);
  else
    box.lo[axis] = round_down(at - slack);
}

// Contains the body rotated about its origin by any angle up to θ = |ω|. Two boxes do: that of the ball of
// radius r about the origin, and the box at the start widened by r·θ, because no point is farther than r from
// the axis and a chord is no longer than its arc. θ and the product round by less than 2⁻⁶⁰.
Aabb turning_box(const Aabb& at_start, double r, const Pose& pose, const Vec3& angular) {
  const Aabb ball = body_box(Sphere{r}, pose);
  const Wide way = wide_norm(angular.cast<Wide>()) * static_cast<Wide>(r) * (1 + turn_slack) + lost;
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = std::max(ball.lo[axis], round_down(outward(at_start.lo[axis], -way)));
    box.hi[axis] = std::min(ball.hi[axis], round_up(outward(at_start.hi[axis], way)));
  }
  return box;
}

// 64u(S + |t|) for double; see the bound at the top of this file.
constexpr double loose_factor = 0x1p-47;
// Covers what underflow may lose.
constexpr double underflow_slack = 0x1p-1000;
// box_size is converted to double; one rounding.
constexpr double size_rounding = 1 + 0x1p-52;

}  // namespace

Aabb body_box(const Shape& shape, const Pose& pose) {
  const WideFrame f = wide_frame(pose);
  const Wide size = coordinate_sum(shape);
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto e = extent_along<Wide>(shape, f.rotation.row(axis).transpose());
    const Wide t = f.translation[axis], slack = tolerance::box_error_factor * (size + abs(t)) + lost;
    box.lo[axis] = round_down(t + e.lo - slack);
    box.hi[axis] = round_up(t + e.hi + slack);
  }
  if (const auto* h = std::get_if<HalfSpace>(&shape)) tighten_half_space(*h, pose, box);
  return box;
}

Aabb swept_box(const Shape& shape, const Pose& pose, const Motion& motion) {
  Aabb start = body_box(shape, pose);
  if (!is_bounded(kind_of(shape))) return start;
  if (!motion.angular.isZero(0)) start = turning_box(start, bounding_radius(shape), pose, motion.angular);
  Aabb box = start;
  for (int axis = 0; axis < 3; ++axis) {
    // The end box is the start box translated by v; the sum is rounded outward.
    const Wide v = motion.linear[axis];
    box.lo[axis] =
        std::min(box.lo[axis], round_down((start.lo[axis] + v) - sum_slack * abs(start.lo[axis] + v)));
    box.hi[axis] =
        std::max(box.hi[axis], round_up((start.hi[axis] + v) + sum_slack * abs(start.hi[axis] + v)));
  }
  return box;
}

Aabb loose_box(const Shape& shape, const Pose& pose, double size) {
  if (!is_bounded(kind_of(shape))) return body_box(shape, pose);
  const Mat3 r = rotation_matrix(pose.rotation);
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto e = extent_along<double>(shape, r.row(axis).transpose());
    const double t = pose.translation[axis];
    const double slack = loose_factor * (size + abs(t)) + underflow_slack;
    box.lo[axis] = t + e.lo - slack;
    box.hi[axis] = t + e.hi + slack;
  }
  return box;
}

Aabb loose_swept_box(const Aabb& start, const Pose& pose, const Motion& motion, double reach) {
  Aabb box = start;
  if (!motion.angular.isZero(0)) {
    const double way = motion.angular.norm() * reach * (1 + loose_factor);
    box.lo.array() -= way;
    box.hi.array() += way;
    const Vec3 slack = loose_factor * (pose.translation.cwiseAbs() + Vec3::Constant(reach));
    box.lo = box.lo.cwiseMax(pose.translation - Vec3::Constant(reach) - slack);
    box.hi = box.hi.cwiseMin(pose.translation + Vec3::Constant(reach) + slack);
  }
  const Aabb first = box;
  box.lo = box.lo.cwiseMin(first.lo + motion.linear);
  box.hi = box.hi.cwiseMax(first.hi + motion.linear);
  const Vec3 slack =
      loose_factor * (box.lo.cwiseAbs().cwiseMax(box.hi.cwiseAbs()) + motion.linear.cwiseAbs()) +
      Vec3::Constant(underflow_slack);
  box.lo -= slack;
  box.hi += slack;
  return box;
}

double box_size(const Shape& shape) { return static_cast<double>(coordinate_sum(shape)) * size_rounding; }

}  // namespace touchstone::broad
