#include <array>
#include <cmath>

#include "core/impact/filtered/translation.h"

namespace touchstone::impact::filtered {
namespace {

// √3, rounded up.
constexpr double corner_factor = 1.7321;
// Below this, an edge axis has no usable direction.
constexpr double least_length_sq = 1e-200;

// The boxes meet along the axis while |p + q t| <= r, all three multiplied by its length; p >= 0.
struct Axis {
  double p, q, r, length;
  double separation(double t) const { return std::abs(p + q * t) - r; }
};

class Boxes {
 public:
  Boxes(const Translation& m, const Vec& ha, const Vec& hb) : ha_(ha), hb_(hb), at_(relative(m.a, m.b)) {
    v_ = at_.a_to_world.transpose() * m.velocity;
    constant_ = 8 * ha.norm() + 36 * hb.norm() + 5 * at_.offset.norm();
    speed_ = v_.norm();
  }
  double error(double t) const {
    return u<double> * bound_margin * (constant_ + 16 * (at_.offset + t * v_).norm() + 6 * t * speed_);
  }

  Search run(double accuracy) {
    const double e0 = error(0), e1 = error(1);
    if (gather(e0, e1)) return missed();
    if (first_ < 0) return {.end = SearchEnd::unsure};
    const Axis& a = axis_[static_cast<std::size_t>(first_)];
    double e = error(enter_);
    const double t = std::max(0.0, (a.p - a.r - aimed_errors * e * a.length) / -a.q);
    e = error(t);
    const double s = a.separation(t) / a.length;
    if (!(t <= 1 && s > certain_errors * e)) return {.end = SearchEnd::unsure};
    double gap = s + e;
    for (int k = 0; k < count_; ++k) {
      const Axis& x = axis_[static_cast<std::size_t>(k)];
      const double other = x.separation(t);
      if (k == first_ || other < -2 * e * x.length) continue;
      // Passed: separated from here on, on the other side of the slab.
      if (other > certain_errors * e * x.length && x.separation(1) > certain_errors * e1 * x.length &&
          (x.p + x.q * t) * (x.p + x.q) > 0)
        return missed();
      // Bounds the gap by the corner of the octants that contain the normals at the nearest points.
      gap = std::max(gap, corner_factor * (std::max(s, other / x.length) + e));
    }
    if (!(gap <= accuracy)) return {.end = SearchEnd::unsure};
    Search r{.end = SearchEnd::hit, .clear_until = t, .gap = s, .steps = 1};
    r.normal = at_.a_to_world * normal();
    return r;
  }

 private:
  static Search missed() { return {.end = SearchEnd::clear, .clear_until = 1, .steps = 1}; }

  // Returns whether the axis separates all the time. The last axis to be entered becomes `first_`.
  bool take(int index, double p, double q, double r, double length, double e0, double e1) {
    if (p < 0) {
      p = -p;
      q = -q;
    }
    const Axis a{p, q, r, length};
    const int k = count_++;
    axis_[static_cast<std::size_t>(k)] = a;
    index_[static_cast<std::size_t>(k)] = index;
    if (!(p - r > certain_errors * e0 * length)) return false;
    if (p + q - r > certain_errors * e1 * length) return true;
    if (const double t = (p - r) / -q; q < 0 && t > enter_) {
      enter_ = t;
      first_ = k;
    }
    return false;
  }

  bool gather(double e0, double e1) {
    const M3<double>& m = at_.b_to_a;
    const Vec& d = at_.offset;
    for (int i = 0; i < 3; ++i) {
      const double r =
          ha_[i] + std::abs(m(i, 0)) * hb_[0] + std::abs(m(i, 1)) * hb_[1] + std::abs(m(i, 2)) * hb_[2];
      if (take(i, d[i], v_[i], r, 1, e0, e1)) return true;
    }
    for (int j = 0; j < 3; ++j) {
      const auto c = m.col(j);
      const double r = hb_[j] + std::abs(c[0]) * ha_[0] + std::abs(c[1]) * ha_[1] + std::abs(c[2]) * ha_[2];
      if (take(3 + j, c.dot(d), c.dot(v_), r, 1, e0, e1)) return true;
    }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (edge(i, j, e0, e1)) return true;
    return false;
  }

  // e_i × b_j: zero along i, −m(l, j) along k, m(k, j) along l.
  bool edge(int i, int j, double e0, double e1) {
    const int k = (i + 1) % 3, l = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    const M3<double>& m = at_.b_to_a;
    const double x = m(k, j), y = m(l, j), length_sq = x * x + y * y;
    if (!(length_sq > least_length_sq)) return false;
    const double r = ha_[k] * std::abs(y) + ha_[l] * std::abs(x) +
                     hb_[j1] * std::abs(m(l, j1) * x - m(k, j1) * y) +
                     hb_[j2] * std::abs(m(l, j2) * x - m(k, j2) * y);
    return take(6 + 3 * i + j, at_.offset[l] * x - at_.offset[k] * y, v_[l] * x - v_[k] * y, r,
                std::sqrt(length_sq), e0, e1);
  }

  Vec normal() const {
    const int index = index_[static_cast<std::size_t>(first_)];
    Vec n = Vec::Zero();
    if (index < 3)
      n[index] = 1;
    else if (index < 6)
      n = at_.b_to_a.col(index - 3);
    else
      n = Vec::Unit((index - 6) / 3).cross(Vec(at_.b_to_a.col((index - 6) % 3))).normalized();
    return n.dot(at_.offset) < 0 ? Vec(-n) : n;
  }

  const Vec &ha_, &hb_;
  narrow::filtered::Relative<double> at_;
  Vec v_;
  double constant_ = 0, speed_ = 0, enter_ = -1;
  std::array<Axis, 15> axis_;
  std::array<int, 15> index_;
  int count_ = 0, first_ = -1;
};

}  // namespace

Search translating_boxes(const Translation& m, const Vec& half_a, const Vec& half_b, double accuracy) {
  return Boxes(m, half_a, half_b).run(accuracy);
}

}  // namespace touchstone::impact::filtered
