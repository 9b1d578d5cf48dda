// The rim of a disc about the z axis: what cylinder and cone share.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/shape/feature.h"

namespace touchstone::convex {

/// Of the polygon that represents a round face in manifolds, inscribed in the circle: 99.4 % of the disc's
/// area.
inline constexpr int rim_corners = 32;

/// On the unit circle, counter-clockwise from (1, 0); corners on the axes are exact.
inline const std::array<std::array<double, 2>, rim_corners>& rim() {
  static const auto corners = [] {
    std::array<std::array<double, 2>, rim_corners> c;
    constexpr std::size_t quarter = rim_corners / 4;
    for (std::size_t k = 0; k < rim_corners; ++k) {
      const double angle = 2 * std::numbers::pi / rim_corners * static_cast<double>(k);
      c[k] = k == 0        ? std::array{1.0, 0.0}
             : k < quarter ? std::array{std::cos(angle), std::sin(angle)}
                           : std::array{-c[k - quarter][1], c[k - quarter][0]};
    }
    return c;
  }();
  return corners;
}

/// Of a rim at z = ±h from the origin. In double and float a bound without a root; the errors reported by
/// extended precision are relative to the length itself.
template <class R>
R rim_reach(R radius, R h) {
  return is_hardware<R> ? radius + h : sqrt(radius * radius + h * h);
}

/// A point of the rim farthest along d.
template <class R>
V3<R> rim_support(R radius, R z, const V3<R>& d) {
  const R n = flat_length(d), k = n > 0 ? radius / n : R(0);
  return {n > 0 ? d[0] * k : radius, d[1] * k, z};
}

/// r/ρ along the rim's tangent.
template <class R>
M3<R> rim_derivative(R radius, const V3<R>& d) {
  M3<R> m = M3<R>::Zero();
  const R rho = flat_length(d);
  if (!(rho > 0)) return m;
  const R x = -d[1] / rho, y = d[0] / rho, k = radius / rho;
  m(0, 0) = k * x * x;
  m(0, 1) = m(1, 0) = k * x * y;
  m(1, 1) = k * y * y;
  return m;
}

/// Outwards from the axis along d.
template <class R>
V3<R> radial(const V3<R>& d, R rho) {
  return rho > 0 ? V3<R>(d[0] / rho, d[1] / rho, 0) : V3<R>(V3<R>::UnitX());
}

/// The support point of a rim about `centre`.
template <class R>
FeaturePoint<R> rim_point(R radius, const V3<R>& centre, const V3<R>& d) {
  const R rho = flat_length(d);
  const V3<R> out = radial(d, rho);
  FeaturePoint<R> r;
  r.p = centre + radius * out;
  r.t = V3<R>(-out[1], out[0], 0);
  r.k = rho > 0 ? radius / rho : R(0);
  return r;
}

template <class R>
Feature<R> rim_feature(R z) {
  Feature<R> f;
  f.kind = FeatureKind::round;
  f.p = V3<R>(0, 0, z);
  return f;
}

template <class R>
Feature<R> disc_feature(const V3<R>& p) {
  return face_feature<R>(p, V3<R>(0, 0, p[2] < 0 ? R(-1) : R(1)));
}

/// Of a rim's radius: nearer to the axis than this, the disc is touched and not the rim. Only a guess.
template <class R>
inline constexpr R disc_share = R(0.9);

/// From support points on one rim. Their mean, `foot`, is well inside it where the disc is touched; where the
/// rim itself is touched they are close to each other, and their mean is close to the rim.
template <class R>
Feature<R> rim_or_disc(R radius, const V3<R>& p, const V3<R>& foot) {
  return flat_length(foot) < disc_share<R> * radius ? disc_feature<R>(p) : rim_feature<R>(p[2]);
}

/// Cosine to the axis above which a disc is worth trying instead of its rim.
template <class R>
inline constexpr R disc_cosine = R(0.9);

/// Replaces a rim by its disc if a direction d close to the axis suggests it.
template <class R>
bool rim_to_disc(Feature<R>& f, const V3<R>& d) {
  if (f.kind != FeatureKind::round || !(abs(d[2]) > disc_cosine<R>)) return false;
  f = disc_feature<R>(f.p);
  return true;
}

/// The rim as a summand of the core: its part of the support function is radius·|P m|, P the projection along
/// the axis.
template <class R>
void add_rim_curvature(R radius, const Tangents<R>& at, const Cap<R>& cap, TangentForm<R>& form) {
  const R most = cap.most_sine(abs(at.m[2]));
  // m × x = y, m × y = −x, up to one sign for both.
  form.add(radius / (most * most * most), at.y[2], -at.x[2]);
}

/// The polygon that represents the rim of a disc at height z. Its corners turn with the body; but where the
/// disc leans, the rim's support point takes the place of the nearest one. Ids: `highest` of the support
/// point, first + k of corner k.
template <class R, class Out>
void add_rim_corners(R radius, R z, const FaceQuery<R>& at, std::uint32_t highest, std::uint32_t first,
                     Out&& out) {
  const R flat = flat_length(at.d);
  std::array<V3<R>, rim_corners> corner;
  std::size_t nearest = 0;
  R most = -1;
  for (std::size_t i = 0; i < rim_corners; ++i) {
    const auto& [x, y] = rim()[i];
    corner[i] = {radius * static_cast<R>(x), radius * static_cast<R>(y), z};
    if (const R along = at.d[0] * corner[i][0] + at.d[1] * corner[i][1]; along > most) {
      most = along;
      nearest = i;
    }
  }
  const bool leans = 2 * flat * radius > at.tolerance;
  for (std::size_t i = 0; i < rim_corners; ++i)
    if (leans && i == nearest)
      out.add(rim_support(radius, z, at.d), highest);
    else
      out.add(corner[i], first + static_cast<std::uint32_t>(i));
}

}  // namespace touchstone::convex
