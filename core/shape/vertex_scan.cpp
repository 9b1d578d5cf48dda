#include "core/shape/vertex_scan.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/shape/vertex_scan.cpp"
#include <hwy/foreach_target.h>  // includes this file once per target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace touchstone::convex::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<double>;
using F = hn::Rebind<float, D>;
using VD = hn::Vec<D>;

// Dot products of one vertex per lane.
template <class R>
struct Dots;

template <>
struct Dots<double> {
  D tag;
  VD x, y, z;
  HWY_INLINE explicit Dots(const double* d)
      : x(hn::Set(tag, d[0])), y(hn::Set(tag, d[1])), z(hn::Set(tag, d[2])) {}
  HWY_INLINE VD operator()(const double* p) const {
    VD a, b, c;
    hn::LoadInterleaved3(D(), p, a, b, c);
    return hn::Add(hn::Add(hn::Mul(a, x), hn::Mul(b, y)), hn::Mul(c, z));
  }
};

template <>
struct Dots<float> {
  F tag;
  hn::Vec<F> x, y, z;
  HWY_INLINE explicit Dots(const float* d)
      : x(hn::Set(tag, d[0])), y(hn::Set(tag, d[1])), z(hn::Set(tag, d[2])) {}
  HWY_INLINE hn::Vec<F> operator()(const double* p) const {
    VD a, b, c;
    hn::LoadInterleaved3(D(), p, a, b, c);
    const F f;
    return hn::Add(hn::Add(hn::Mul(hn::DemoteTo(f, a), x), hn::Mul(hn::DemoteTo(f, b), y)),
                   hn::Mul(hn::DemoteTo(f, c), z));
  }
};

template <class R>
std::size_t farthest_scalar(const double* p, std::size_t n, const R* d) {
  std::size_t best = 0;
  R most = -std::numeric_limits<R>::infinity();
  for (std::size_t i = 0; i < n; ++i, p += 3) {
    const R dot = (static_cast<R>(p[0]) * d[0] + static_cast<R>(p[1]) * d[1]) + static_cast<R>(p[2]) * d[2];
    if (dot > most) {
      most = dot;
      best = i;
    }
  }
  return best;
}

template <class R>
std::size_t farthest(const double* p, std::size_t n, const R* d) {
  const Dots<R> dots(d);
  const auto tag = dots.tag;
  const std::size_t lanes = hn::Lanes(tag);
  if (n < lanes) return farthest_scalar(p, n, d);
  auto most = dots(p), where = hn::Iota(tag, R(0)), at = where;
  const auto step = hn::Set(tag, static_cast<R>(lanes));
  std::size_t i = lanes;
  const auto look = [&](std::size_t from, auto index) HWY_ATTR {
    const auto dot = dots(p + 3 * from);
    where = hn::IfThenElse(hn::Gt(dot, most), index, where);
    most = hn::Max(dot, most);
  };
  for (; i + lanes <= n; i += lanes) {
    at = hn::Add(at, step);
    look(i, at);
  }
  // If they do not fill the lanes, the last vertices are processed in an overlapping batch.
  if (i < n) look(n - lanes, hn::Iota(tag, static_cast<R>(n - lanes)));
  const auto top = hn::MaxOfLanes(tag, most);
  const auto none = hn::Set(tag, std::numeric_limits<R>::infinity());
  return static_cast<std::size_t>(
      hn::GetLane(hn::MinOfLanes(tag, hn::IfThenElse(hn::Eq(most, top), where, none))));
}

std::size_t farthest_64(const double* p, std::size_t n, const double* d) { return farthest<double>(p, n, d); }
std::size_t farthest_32(const double* p, std::size_t n, const float* d) { return farthest<float>(p, n, d); }

template <class R>
std::size_t above(const double* p, std::size_t n, const R* d, R least, std::int32_t* out, std::size_t room) {
  const Dots<R> dots(d);
  const auto tag = dots.tag;
  const std::size_t lanes = hn::Lanes(tag);
  const auto limit = hn::Set(tag, least);
  std::size_t found = 0, i = 0;
  const auto take = [&](std::size_t k) {
    if (found < room) out[found] = static_cast<std::int32_t>(k);
    ++found;
  };
  for (; i + lanes <= n; i += lanes) {
    const auto mask = hn::Ge(dots(p + 3 * i), limit);
    if (hn::AllFalse(tag, mask)) continue;
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, mask, bits);
    for (std::size_t k = 0; k < lanes; ++k)
      if (bits[k / 8] >> (k % 8) & 1) take(i + k);
  }
  for (; i < n; ++i) {
    const double* q = p + 3 * i;
    if ((static_cast<R>(q[0]) * d[0] + static_cast<R>(q[1]) * d[1]) + static_cast<R>(q[2]) * d[2] >= least)
      take(i);
  }
  return found;
}

std::size_t above_64(const double* p, std::size_t n, const double* d, double least, std::int32_t* out,
                     std::size_t room) {
  return above<double>(p, n, d, least, out, room);
}
std::size_t above_32(const double* p, std::size_t n, const float* d, float least, std::int32_t* out,
                     std::size_t room) {
  return above<float>(p, n, d, least, out, room);
}

double largest(const double* p, std::size_t n) {
  const D tag;
  const std::size_t lanes = hn::Lanes(tag);
  double most = 0;
  std::size_t i = 0;
  if (n >= lanes) {
    auto top = hn::Zero(tag);
    const auto look = [&](std::size_t from) HWY_ATTR {
      VD a, b, c;
      hn::LoadInterleaved3(tag, p + 3 * from, a, b, c);
      top = hn::Max(top, hn::Add(hn::Add(hn::Mul(a, a), hn::Mul(b, b)), hn::Mul(c, c)));
    };
    for (; i + lanes <= n; i += lanes) look(i);
    if (i < n) look(n - lanes);
    return hn::GetLane(hn::MaxOfLanes(tag, top));
  }
  for (; i < n; ++i, p += 3) most = std::max(most, p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  return most;
}

}  // namespace
}  // namespace touchstone::convex::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace touchstone::convex {

HWY_EXPORT(farthest_64);
HWY_EXPORT(farthest_32);
HWY_EXPORT(above_64);
HWY_EXPORT(above_32);
HWY_EXPORT(largest);

std::size_t farthest_vertex(std::span<const Vec3> v, const V3<double>& d) {
  return HWY_DYNAMIC_DISPATCH(farthest_64)(v.front().data(), v.size(), d.data());
}

std::size_t farthest_vertex(std::span<const Vec3> v, const V3<float>& d) {
  return HWY_DYNAMIC_DISPATCH(farthest_32)(v.front().data(), v.size(), d.data());
}

std::size_t vertices_above(std::span<const Vec3> v, const V3<double>& d, double least,
                           std::span<std::int32_t> out) {
  return HWY_DYNAMIC_DISPATCH(above_64)(v.front().data(), v.size(), d.data(), least, out.data(), out.size());
}

std::size_t vertices_above(std::span<const Vec3> v, const V3<float>& d, float least,
                           std::span<std::int32_t> out) {
  return HWY_DYNAMIC_DISPATCH(above_32)(v.front().data(), v.size(), d.data(), least, out.data(), out.size());
}

double largest_norm_sq(std::span<const Vec3> v) {
  return HWY_DYNAMIC_DISPATCH(largest)(v.front().data(), v.size());
}

}  // namespace touchstone::convex

#endif
