// Exact signs of small determinants of doubles, by floating-point expansions (Shewchuk 1997, "Adaptive
// precision floating-point arithmetic and fast robust geometric predicates", §2). When a forward error bound
// already decides the sign, the cost is one determinant. Exact as long as no partial product underflows or
// overflows: coordinates are zero or between 1e-95 and 1e+95 in magnitude.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "core/math/error_free.h"
#include "core/math/pose.h"
#include "core/tolerance.h"

namespace touchstone {

/// A sum of non-overlapping doubles, smallest first; represents its exact sum.
class Expansion {
 public:
  Expansion() = default;
  explicit Expansion(double x) {
    if (x != 0) terms_.push_back(x);
  }
  static Expansion difference(double a, double b) {
    const Rounded d = two_sum(a, -b);
    return Expansion(d.error).plus(d.value);
  }
  Expansion operator+(const Expansion& o) const {
    Expansion r = *this;
    for (double t : o.terms_) r = r.plus(t);
    return r;
  }
  Expansion operator-(const Expansion& o) const {
    Expansion r = *this;
    for (double t : o.terms_) r = r.plus(-t);
    return r;
  }
  Expansion operator*(const Expansion& o) const {
    Expansion r;
    for (double x : terms_)
      for (double y : o.terms_) {
        const Rounded p = two_product(x, y);
        r = r.plus(p.error).plus(p.value);
      }
    return r;
  }
  int sign() const { return terms_.empty() ? 0 : (terms_.back() > 0 ? 1 : -1); }

 private:
  // Grow-expansion with zero elimination.
  Expansion plus(double b) const {
    Expansion r;
    double q = b;
    for (double t : terms_) {
      const Rounded s = two_sum(q, t);
      if (s.error != 0) r.terms_.push_back(s.error);
      q = s.value;
    }
    if (q != 0) r.terms_.push_back(q);
    return r;
  }
  std::vector<double> terms_;
};

/// Sign of the determinant |b-a, c-a| in the plane.
inline int orient2d_sign(double ax, double ay, double bx, double by, double cx, double cy) {
  using X = Expansion;
  return (X::difference(bx, ax) * X::difference(cy, ay) - X::difference(by, ay) * X::difference(cx, ax))
      .sign();
}

/// Sign of det(b-a, c-a, d-a): > 0 when a, b, c appear clockwise seen from d.
inline int orient3d_sign(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double det = u.dot(v.cross(w));
  const double bound = tolerance::orientation_filter *
                       u.cwiseAbs().dot(Vec3(std::abs(v.y() * w.z()) + std::abs(v.z() * w.y()),
                                             std::abs(v.z() * w.x()) + std::abs(v.x() * w.z()),
                                             std::abs(v.x() * w.y()) + std::abs(v.y() * w.x())));
  if (std::abs(det) > bound && bound > std::numeric_limits<double>::min()) return det > 0 ? 1 : -1;
  using X = Expansion;
  const auto d3 = [&](const Vec3& p, int i) { return X::difference(p[i], a[i]); };
  const X minor_x = d3(c, 1) * d3(d, 2) - d3(c, 2) * d3(d, 1);
  const X minor_y = d3(c, 2) * d3(d, 0) - d3(c, 0) * d3(d, 2);
  const X minor_z = d3(c, 0) * d3(d, 1) - d3(c, 1) * d3(d, 0);
  return (d3(b, 0) * minor_x + d3(b, 1) * minor_y + d3(b, 2) * minor_z).sign();
}

}  // namespace touchstone
