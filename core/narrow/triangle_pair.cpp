#include "core/narrow/triangle_pair.h"

#include <algorithm>
#include <cmath>

#include "core/math/roundoff.h"

namespace touchstone::narrow {
namespace {

// Square of a direction's length, in the fourth power of the scene's unit, below which it may have lost
// digits to underflow: no such direction is tried.
constexpr double least_square = 0x1p-900;

// Both triangles relative to the first corner of A.
struct Local {
  Triangle a, b;
  double rounding;
  Local(const Triangle& x, const Triangle& y) {
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] = x[k] - x[0];
      b[k] = y[k] - x[0];
    }
    rounding = triangle_rounding * double_roundoff * local_size(x, y);
  }
};

struct Range {
  double lo, hi;
};
Range along(const Triangle& t, const Vec3& n) {
  const double x = n.dot(t[0]), y = n.dot(t[1]), z = n.dot(t[2]);
  return {std::min(std::min(x, y), z), std::max(std::max(x, y), z)};
}

// Takes the bound of the gap along n and -n if it is the best so far.
void try_axis(const Local& t, const Vec3& n, AxisGap& best) {
  const double sq = n.squaredNorm();
  if (!(sq > least_square)) return;
  const Range a = along(t.a, n), b = along(t.b, n);
  const double ahead = b.lo - a.hi, behind = a.lo - b.hi, length = std::sqrt(sq);
  const double lo = std::max(ahead, behind) / length - t.rounding;
  if (lo > best.lo) best = {lo, n * ((ahead >= behind ? 1 : -1) / length)};
}

AxisGap no_axis() { return {-infinity, Vec3::Zero()}; }

AxisGap by_faces(const Local& t) {
  AxisGap best = no_axis();
  try_axis(t, (t.a[1] - t.a[0]).cross(t.a[2] - t.a[0]), best);
  try_axis(t, (t.b[1] - t.b[0]).cross(t.b[2] - t.b[0]), best);
  return best;
}

double clamped(double x) { return std::min(std::max(x, 0.0), 1.0); }

struct Nearest {
  double sq = infinity;
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();
  void take(const Vec3& p, const Vec3& q) {
    const double d = (q - p).squaredNorm();
    if (d >= sq) return;
    sq = d;
    a = p;
    b = q;
  }
};

// Points p + s·d and q + t·e, s and t in [0, 1].
void segments(const Vec3& p, const Vec3& d, double dd, const Vec3& q, const Vec3& e, double ee,
              Nearest& best) {
  const Vec3 r = p - q;
  const double f = e.dot(r), c = d.dot(r), de = d.dot(e), denominator = dd * ee - de * de;
  double s = denominator > 0 ? clamped((de * f - c * ee) / denominator) : 0;
  double t = ee > 0 ? (de * s + f) / ee : 0;
  if (t < 0 || t > 1) {
    t = clamped(t);
    s = dd > 0 ? clamped((t * de - c) / dd) : 0;
  }
  best.take(p + s * d, q + t * e);
}

// The face of a triangle as origin, edges and normal.
struct Face {
  Vec3 origin, along, across, normal;
  double sq;
  explicit Face(const Triangle& t)
      : origin(t[0]),
        along(t[1] - t[0]),
        across(t[2] - t[0]),
        normal(along.cross(across)),
        sq(normal.squaredNorm()) {}

  // The foot of p on the plane, if it lies in the triangle: weights of both edges, not negative.
  bool foot(const Vec3& p, Vec3& out) const {
    const Vec3 d = p - origin;
    const double v = d.cross(across).dot(normal), w = along.cross(d).dot(normal);
    if (!(sq > 0) || v < 0 || w < 0 || v + w > sq) return false;
    const double y = clamped(v / sq), z = std::min(w / sq, 1 - y);
    out = origin + y * along + z * across;
    return true;
  }
};

Nearest nearest_points(const Local& t) {
  Nearest best;
  std::array<Vec3, 3> d, e;
  std::array<double, 3> dd{}, ee{};
  for (std::size_t k = 0; k < 3; ++k) {
    d[k] = t.a[(k + 1) % 3] - t.a[k];
    e[k] = t.b[(k + 1) % 3] - t.b[k];
    dd[k] = d[k].squaredNorm();
    ee[k] = e[k].squaredNorm();
  }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) segments(t.a[i], d[i], dd[i], t.b[j], e[j], ee[j], best);
  const Face a(t.a), b(t.b);
  Vec3 foot;
  for (const Vec3& p : t.a)
    if (b.foot(p, foot)) best.take(p, foot);
  for (const Vec3& p : t.b)
    if (a.foot(p, foot)) best.take(foot, p);
  return best;
}

AxisGap by_axes(const Local& t, double enough) {
  const Vec3 d[3] = {t.a[1] - t.a[0], t.a[2] - t.a[1], t.a[0] - t.a[2]};
  const Vec3 e[3] = {t.b[1] - t.b[0], t.b[2] - t.b[1], t.b[0] - t.b[2]};
  AxisGap best = by_faces(t);
  for (const Vec3& x : d)
    for (const Vec3& y : e) {
      if (best.lo > enough) return best;
      try_axis(t, x.cross(y), best);
    }
  return best;
}

// The sign of the volume u·(v×w) wherever the four corners it is made of are within the displacement: 0 if
// that does not decide it. Each vector may be off by twice the displacement and a rounding.
int certain_sign(const Vec3& u, const Vec3& v, const Vec3& w, double displacement) {
  const double volume = u.dot(v.cross(w));
  const double lu = u.norm(), lv = v.norm(), lw = w.norm();
  const double off = 2 * displacement + double_roundoff * (lu + lv + lw);
  const double shift = off * (lu * lv + lv * lw + lw * lu) + off * off * (lu + lv + lw + off);
  const double rounding = triangle_rounding * double_roundoff * lu * lv * lw;
  const double error = 2 * (shift + rounding);  // twice: the bound is rounded itself
  return volume > error ? 1 : (volume < -error ? -1 : 0);
}

bool edge_crosses(const Vec3& p, const Vec3& q, const Triangle& t, double displacement) {
  const Vec3 pq = q - p, x = t[0] - p, y = t[1] - p, z = t[2] - p;
  const int side = certain_sign(pq, x, y, displacement);
  return side != 0 && certain_sign(pq, y, z, displacement) == side &&
         certain_sign(pq, z, x, displacement) == side;
}

// Signs of the corners of `of` relative to the plane of `plane`.
std::array<int, 3> sides(const Triangle& plane, const Triangle& of, double displacement) {
  const Vec3 d = plane[1] - plane[0], e = plane[2] - plane[0];
  std::array<int, 3> r;
  for (std::size_t k = 0; k < 3; ++k) r[k] = certain_sign(of[k] - plane[0], d, e, displacement);
  return r;
}

bool some_edge_crosses(const Triangle& edges, const Triangle& face, double displacement) {
  const std::array<int, 3> side = sides(face, edges, displacement);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (side[k] * side[next] < 0 && edge_crosses(edges[k], edges[next], face, displacement)) return true;
  }
  return false;
}

}  // namespace

double local_size(const Triangle& a, const Triangle& b) {
  double most = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    most = std::max(most, (b[k] - a[0]).squaredNorm());
    if (k > 0) most = std::max(most, (a[k] - a[0]).squaredNorm());
  }
  return 2 * std::sqrt(most);
}

double gap_by_faces(const Triangle& a, const Triangle& b) { return by_faces(Local(a, b)).lo; }

AxisGap gap_by_axes(const Triangle& a, const Triangle& b, double enough) {
  return by_axes(Local(a, b), enough);
}

TriangleGap triangle_gap(const Triangle& a, const Triangle& b, double enough) {
  const Local t(a, b);
  TriangleGap r{-infinity, infinity, a[0], b[0], Vec3::Zero()};
  const Nearest n = nearest_points(t);
  const double distance = std::sqrt(n.sq);
  if (distance > 0) r.normal = (n.b - n.a) / distance;
  r.hi = distance + t.rounding;
  r.a = a[0] + n.a;
  r.b = a[0] + n.b;
  AxisGap lower = no_axis();
  try_axis(t, n.b - n.a, lower);
  r.lo = lower.lo;
  // Points that are not the nearest, or whose difference is noise: triangles that meet or nearly do.
  if (!(r.lo >= r.hi - 4 * t.rounding)) r.lo = std::max(r.lo, by_axes(t, infinity).lo);
  if (r.lo > enough) r.hi = infinity;
  return r;
}

bool cross_certainly(const Triangle& a, const Triangle& b, double displacement) {
  return some_edge_crosses(a, b, displacement) || some_edge_crosses(b, a, displacement);
}

}  // namespace touchstone::narrow
