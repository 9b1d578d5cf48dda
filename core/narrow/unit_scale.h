// Pairs so small or large that the products of lengths in extended precision would leave its range, brought
// to unit size by a power of two, which is exact. Needed only where Wide has the exponents of double:
// products of up to six lengths occur, and their low parts must be normal numbers too.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/math/wide.h"
#include "core/narrow/collider.h"

namespace touchstone::narrow {

/// Sizes from 2^-unit_scale_range to 2^unit_scale_range are computed as they are.
inline constexpr int unit_scale_range = 64;

/// The largest number that is a length. For a half-space, about its distance from the body's origin.
inline double largest_length(const Shape& shape) {
  double most = 0;
  const auto take = [&](double x) { most = std::max(most, std::abs(x)); };
  if (const auto* h = std::get_if<HalfSpace>(&shape)) {
    take(std::ldexp(h->offset, -std::ilogb(h->normal.cwiseAbs().maxCoeff())));
    return std::min(most, std::numeric_limits<double>::max());
  }
  std::visit(
      [&](const auto& s) {
        for_each_field(s, [&](auto, const auto& v, Domain) {
          using V = std::decay_t<decltype(v)>;
          if constexpr (std::is_same_v<V, double>) take(v);
          if constexpr (std::is_same_v<V, Vec3>) take(v.cwiseAbs().maxCoeff());
          if constexpr (std::is_same_v<V, std::vector<Vec3>>)
            for (const Vec3& p : v) take(p.cwiseAbs().maxCoeff());
        });
      },
      shape);
  return most;
}

inline Vec3 scaled(const Vec3& v, int exponent) {
  return v.unaryExpr([&](double x) { return std::ldexp(x, exponent); });
}
inline WideVec scaled(const WideVec& v, int exponent) {
  return v.unaryExpr([&](const Wide& x) { return ldexp(x, exponent); });
}

/// The shape with lengths times 2^exponent, and a half-space's normal of length about one.
inline Shape scaled(Shape shape, int exponent) {
  if (auto* h = std::get_if<HalfSpace>(&shape)) {
    const int normal = -std::ilogb(h->normal.cwiseAbs().maxCoeff());
    h->normal = scaled(h->normal, normal);
    h->offset = std::ldexp(h->offset, normal + exponent);
    return shape;
  }
  std::visit(
      [&](auto& s) {
        for_each_field(s, [&](auto, auto& v, Domain) {
          using V = std::decay_t<decltype(v)>;
          if constexpr (std::is_same_v<V, double>) v = std::ldexp(v, exponent);
          if constexpr (std::is_same_v<V, Vec3>) v = scaled(v, exponent);
          if constexpr (std::is_same_v<V, std::vector<Vec3>>)
            for (Vec3& p : v) p = scaled(p, exponent);
        });
      },
      shape);
  return shape;
}

/// The power of two, as an exponent, that brings a pair to unit size; 0 if its size is in range. `way`: how
/// far the bodies move. P: PlacedShape or MovingShape.
template <class P>
int unit_scale(const P& a, const P& b, double way = 0) {
  if constexpr (wide_holds_squares) return 0;
  const double apart = (b.pose.translation / 2 - a.pose.translation / 2).cwiseAbs().maxCoeff();
  const auto length = [](const P& p) {
    return p.collider && is_bounded(kind_of(*p.shape)) ? p.collider->largest_length()
                                                       : largest_length(*p.shape);
  };
  const double size = std::max({length(a), length(b), apart, way});
  const auto normal_in_range = [](const Shape& s) {
    const auto* h = std::get_if<HalfSpace>(&s);
    return !h || std::abs(std::ilogb(h->normal.cwiseAbs().maxCoeff())) <= unit_scale_range;
  };
  const int e = size > 0 ? -std::ilogb(size) : 0;
  const bool in_range =
      std::abs(e) <= unit_scale_range && normal_in_range(*a.shape) && normal_in_range(*b.shape);
  return in_range ? 0 : (e == 0 ? 1 : e);
}

/// A pair with lengths times 2^exponent. Coordinates in which both stand at the same place are counted from
/// there: only the others are sure to stay finite.
template <class P>
struct ScaledPair {
  Shape shape_a, shape_b;
  P a, b;
  Vec3 origin = Vec3::Zero();  // not scaled
  ScaledPair(const P& x, const P& y, int exponent)
      : shape_a(scaled(*x.shape, exponent)), shape_b(scaled(*y.shape, exponent)) {
    a.shape = &shape_a;
    b.shape = &shape_b;
    a.pose = x.pose;
    b.pose = y.pose;
    for (int k = 0; k < 3; ++k)
      if (x.pose.translation[k] == y.pose.translation[k]) origin[k] = x.pose.translation[k];
    a.pose.translation = scaled(Vec3(x.pose.translation - origin), exponent);
    b.pose.translation = scaled(Vec3(y.pose.translation - origin), exponent);
    if constexpr (requires { a.motion; }) {
      a.motion = {scaled(x.motion.linear, exponent), x.motion.angular};
      b.motion = {scaled(y.motion.linear, exponent), y.motion.angular};
    }
  }
  ScaledPair(const ScaledPair&) = delete;
  ScaledPair& operator=(const ScaledPair&) = delete;
};

}  // namespace touchstone::narrow
