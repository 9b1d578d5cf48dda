// The same scene in another frame or unit of length, without rounding: what is true of one is true of the
// other, to the last bit. The poses of a script's steps change with those of the bodies.
#pragma once

#include <array>
#include <type_traits>

#include "core/scene/scene.h"

namespace touchstone::fuzz {

/// Calls f(number, domain) for the doubles and vectors of the shape and recomputes derived data.
template <class F>
void change_numbers(Shape& shape, F&& f) {
  std::visit(
      [&](auto& s) {
        for_each_field(s, [&](auto, auto& v, Domain domain) {
          using V = std::decay_t<decltype(v)>;
          if constexpr (std::is_same_v<V, double> || std::is_same_v<V, Vec3>) f(v, domain);
          if constexpr (std::is_same_v<V, std::vector<Vec3>>)
            for (Vec3& p : v) f(p, domain);
        });
      },
      shape);
  if (auto* h = hull_if(shape)) *h = make_hull(std::move(h->vertices));
}

/// Maps world and body axes together by a signed permutation m of determinant 1: every number keeps its bits.
/// Precondition: no shape has an axis that m moves.
void turn_axes(Scene& s, const Mat3& m);
/// Capsule, cylinder, cone (a half height): their z axis is fixed by the shape.
bool has_own_axis(const Shape& s);
/// Turns the axes x, y, z into y, z, x. False, with nothing changed, when a shape has its own axis.
bool cycle_axes(Scene& s);

/// Turns the world by half a turn about one of its axes (0, 1, 2): signs change, and quaternion components
/// change places. Any shape.
void half_turn(Scene& s, int axis);

/// False when a sum is not exact: the result is then a different scene.
bool translate_by(Scene& s, const Vec3& by);

/// Scales by a power of two. False, with nothing changed, when a number is so small or large that the product
/// is not exact.
bool scale_by(Scene& s, double factor);
/// Factors of the scale at which a pair is asked again: powers of two, so that its numbers scale exactly.
inline constexpr double enlarged = 0x1p20, reduced = 0x1p-12;

}  // namespace touchstone::fuzz
