#include "core/narrow/filtered/box_lanes.h"

#include <algorithm>
#include <utility>

#include "core/narrow/filtered/closed_forms.h"
#include "core/narrow/filtered/query.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/narrow/filtered/box_lanes.cpp"
#include <hwy/foreach_target.h>  // includes this file once per target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace touchstone::narrow::filtered::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<double>;
static_assert(hn::MaxLanes(D()) <= PoseLanes::most_lanes);

// A number in each lane.
struct Num {
  hn::Vec<D> v;
};
using Truth = hn::Mask<D>;

HWY_INLINE Num number(double x) { return {hn::Set(D(), x)}; }
HWY_INLINE Num operator+(Num x, Num y) { return {hn::Add(x.v, y.v)}; }
HWY_INLINE Num operator-(Num x, Num y) { return {hn::Sub(x.v, y.v)}; }
HWY_INLINE Num operator*(Num x, Num y) { return {hn::Mul(x.v, y.v)}; }
HWY_INLINE Num operator-(Num x) { return {hn::Neg(x.v)}; }
HWY_INLINE Num size(Num x) { return {hn::Abs(x.v)}; }
HWY_INLINE Num larger(Num x, Num y) { return {hn::Max(x.v, y.v)}; }
HWY_INLINE Truth operator<(Num x, Num y) { return hn::Lt(x.v, y.v); }
HWY_INLINE Truth operator<=(Num x, Num y) { return hn::Le(x.v, y.v); }
HWY_INLINE Truth both(Truth x, Truth y) { return hn::And(x, y); }
HWY_INLINE Truth either(Truth x, Truth y) { return hn::Or(x, y); }

struct Quat4 {
  Num x, y, z, w;
};
struct Matrix {
  Num c[3][3];  // row, column
};

HWY_INLINE Num load(const PoseLanes& p, int row, std::size_t at) {
  return {hn::Load(D(), p.row[static_cast<std::size_t>(row)].data() + at)};
}
HWY_INLINE Quat4 rotation(const PoseLanes& p, std::size_t at) {
  return {load(p, 3, at), load(p, 4, at), load(p, 5, at), load(p, 6, at)};
}

// As matrix() in query.h.
HWY_INLINE Matrix matrix(const Quat4& s) {
  const Num xx = s.x * s.x, yy = s.y * s.y, zz = s.z * s.z, ww = s.w * s.w, two = number(2);
  const Num k = {hn::Div(hn::Set(D(), 1), (xx + yy + zz + ww).v)};
  const Num xy = s.x * s.y, xz = s.x * s.z, yz = s.y * s.z, wx = s.w * s.x, wy = s.w * s.y, wz = s.w * s.z;
  return {{{(ww + xx - yy - zz) * k, two * (xy - wz) * k, two * (xz + wy) * k},
           {two * (xy + wz) * k, (ww - xx + yy - zz) * k, two * (yz - wx) * k},
           {two * (xz - wy) * k, two * (yz + wx) * k, (ww - xx - yy + zz) * k}}};
}

// As in rounded_pose(): whether the quaternion is used as it is.
HWY_INLINE Truth is_plain(const Quat4& q) {
  const Num n = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  return both(number(least_quat_norm_sq) < n, n < number(largest_quat_norm_sq));
}

// BoxPair, and the verdict. `usable`: the quaternions are used as they are.
struct Pair {
  Matrix m;  // B to A
  Num t[3], a[3], b[3], length, displacement;
  Truth usable, apart, certain;

  HWY_INLINE void faces() {
    Num most = number(-std::numeric_limits<double>::infinity());
    for (int i = 0; i < 3; ++i)
      most = larger(most, size(t[i]) - (a[i] + (size(m.c[i][0]) * b[0] + size(m.c[i][1]) * b[1] +
                                                size(m.c[i][2]) * b[2])));
    for (int j = 0; j < 3; ++j)
      most = larger(most,
                    size(t[0] * m.c[0][j] + t[1] * m.c[1][j] + t[2] * m.c[2][j]) -
                        (b[j] + (size(m.c[0][j]) * a[0] + size(m.c[1][j]) * a[1] + size(m.c[2][j]) * a[2])));
    apart = displacement < most;
    certain = most < -displacement;
  }

  // The axes on edge i of A and those of B, with the widths that they have in common (EdgeWidths).
  HWY_INLINE void edges(int i) {
    const int k = (i + 1) % 3, l = (i + 2) % 3;
    Num width[3];
    for (int j = 0; j < 3; ++j) {
      const int next = (j + 1) % 3;
      width[j] = size(m.c[l][next] * m.c[k][j] - m.c[k][next] * m.c[l][j]);
    }
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const Num x = m.c[k][j], y = m.c[l][j], ax = size(x), ay = size(y);
      const Num radius_a = a[k] * ay + a[l] * ax, radius_b = b[j1] * width[j] + b[j2] * width[j2];
      const Num s = size(t[l] * x - t[k] * y) - (radius_a + radius_b), limit = displacement * (ax + ay);
      certain = both(certain, s <= -limit);
      apart = either(apart, limit < s);
    }
  }
};

// As relative() and box_pair().
HWY_INLINE Pair pair_at(const LaneBoxes& boxes, const PoseLanes& a, const PoseLanes& b, std::size_t at) {
  const Quat4 p = rotation(a, at), q = rotation(b, at);
  Pair r;
  r.m =
      matrix({p.w * q.x - p.x * q.w - p.y * q.z + p.z * q.y, p.w * q.y + p.x * q.z - p.y * q.w - p.z * q.x,
              p.w * q.z - p.x * q.y + p.y * q.x - p.z * q.w, p.w * q.w + p.x * q.x + p.y * q.y + p.z * q.z});
  const Matrix to_world = matrix(p);
  Num d[3];
  for (int k = 0; k < 3; ++k) d[k] = load(b, k, at) - load(a, k, at);
  r.length = number(boxes.largest);
  for (int k = 0; k < 3; ++k) {
    r.t[k] = to_world.c[0][k] * d[0] + to_world.c[1][k] * d[1] + to_world.c[2][k] * d[2];
    r.a[k] = number(boxes.a[static_cast<std::size_t>(k)]);
    r.b[k] = number(boxes.b[static_cast<std::size_t>(k)]);
    r.length = larger(r.length, size(r.t[k]));
  }
  // As displacement_of().
  const Num offset = size(r.t[0]) + size(r.t[1]) + size(r.t[2]);
  r.displacement = number(u<double>) * (number(8 * boxes.sum_a + 36 * boxes.sum_b) + number(20) * offset);
  r.usable = both(is_plain(p), is_plain(q));
  return r;
}

void boxes_meet(const LaneBoxes& boxes, const PoseLanes& a, const PoseLanes& b, std::size_t count,
                BoxVerdicts& out) {
  const D tag;
  const auto one = hn::Set(tag, 1);
  for (std::size_t at = 0; at < count; at += hn::Lanes(tag)) {
    Pair p = pair_at(boxes, a, b, at);
    p.faces();
    for (int i = 0; i < 3; ++i) p.edges(i);
    hn::Store(hn::IfThenElseZero(both(p.usable, p.apart), one), tag, out.apart.data() + at);
    hn::Store(hn::IfThenElseZero(both(p.usable, p.certain), one), tag, out.meeting.data() + at);
    hn::Store(p.displacement.v, tag, out.bound.data() + at);
    hn::Store(p.length.v, tag, out.length.data() + at);
  }
}

}  // namespace
}  // namespace touchstone::narrow::filtered::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace touchstone::narrow::filtered {

HWY_EXPORT(boxes_meet);

void PoseLanes::fill(std::span<const Pose> poses) {
  const std::size_t used = (poses.size() + most_lanes - 1) / most_lanes * most_lanes;
  for (std::size_t i = 0; i < used; ++i) {
    const Pose& p = poses[std::min(i, poses.size() - 1)];
    for (std::size_t k = 0; k < 3; ++k) row[k][i] = p.translation[static_cast<Eigen::Index>(k)];
    row[3][i] = p.rotation.x;
    row[4][i] = p.rotation.y;
    row[5][i] = p.rotation.z;
    row[6][i] = p.rotation.w;
  }
}

LaneBoxes::LaneBoxes(const Box& first, const Box& second)
    : sum_a(first.half_extents.sum()),
      sum_b(second.half_extents.sum()),
      largest(std::max(first.half_extents.maxCoeff(), second.half_extents.maxCoeff())) {
  for (std::size_t k = 0; k < 3; ++k) {
    a[k] = first.half_extents[static_cast<Eigen::Index>(k)];
    b[k] = second.half_extents[static_cast<Eigen::Index>(k)];
  }
}

void boxes_meet(const LaneBoxes& boxes, const PoseLanes& a, const PoseLanes& b, std::size_t count,
                BoxVerdicts& out) {
  HWY_DYNAMIC_DISPATCH(boxes_meet)(boxes, a, b, count, out);
  for (std::size_t i = 0; i < count; ++i)
    if (!detail::squares_hold(out.length[i])) out.meeting[i] = out.apart[i] = 0;
}

}  // namespace touchstone::narrow::filtered

#endif
