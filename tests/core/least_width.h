// A second opinion on depth: w(n) = h_A(n) + h_B(−n) from its definition, with support functions written out
// here in Wide, and its minimum by search over the sphere. Shares no code with the narrow phase.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/math/rng.h"
#include "core/math/wide.h"
#include "core/shape/shape.h"

namespace touchstone::test {

inline Wide height_along(const Shape& s, const WideVec& d) {
  const Wide len = d.norm(), rho = sqrt(d.x() * d.x() + d.y() * d.y());
  if (const auto* x = std::get_if<Sphere>(&s)) return x->radius * len;
  if (const auto* x = std::get_if<Box>(&s)) return d.cwiseAbs().dot(x->half_extents.cast<Wide>());
  if (const auto* x = std::get_if<Capsule>(&s)) return x->radius * len + x->half_height * abs(d.z());
  if (const auto* x = std::get_if<Cylinder>(&s)) return x->radius * rho + x->half_height * abs(d.z());
  if (const auto* x = std::get_if<Cone>(&s))
    return std::max<Wide>(x->half_height * d.z(), x->radius * rho - x->half_height * d.z());
  if (const auto* x = std::get_if<Ellipsoid>(&s)) return x->semi_axes.cast<Wide>().cwiseProduct(d).norm();
  Wide best = -std::numeric_limits<Wide>::infinity();
  for (const Vec3& v : std::get<Hull>(s).vertices) best = std::max(best, d.dot(v.cast<Wide>()));
  return best;
}

class Width {
 public:
  Width(const Shape& a, const Pose& pa, const Shape& b, const Pose& pb)
      : a_(a),
        b_(b),
        ra_(wide_rotation(pa.rotation)),
        rb_(wide_rotation(pb.rotation)),
        offset_(pb.translation.cast<Wide>() - pa.translation.cast<Wide>()) {}

  Wide operator()(const WideVec& n) const {
    const WideVec u = n.normalized();
    return height_along(a_, ra_.transpose() * u) + height_along(b_, rb_.transpose() * -u) - offset_.dot(u);
  }

  /// The minimum found from starts over the sphere and the bodies' axes, each improved by pattern search.
  Wide least(Rng& r, int starts, const WideVec& hint) const {
    std::vector<std::pair<Wide, WideVec>> seeds{{(*this)(hint), hint}};
    const auto add = [&](const WideVec& n) {
      if (n.norm() > 0) seeds.emplace_back((*this)(n), n.normalized());
    };
    for (int k = 0; k < 3; ++k) {
      add(ra_.col(k));
      add(-ra_.col(k));
      add(rb_.col(k));
      add(-rb_.col(k));
    }
    add(offset_);
    add(-offset_);
    for (int k = 0; k < starts; ++k) add(r.unit_vector().cast<Wide>());
    std::partial_sort(seeds.begin(), seeds.begin() + 4, seeds.end(),
                      [](auto& x, auto& y) { return x.first < y.first; });
    Wide best = seeds[0].first;
    for (int k = 0; k < 4; ++k) best = std::min(best, improve(seeds[static_cast<std::size_t>(k)]));
    return best;
  }

 private:
  Wide improve(std::pair<Wide, WideVec> at) const {
    int left = 400;
    for (Wide step = 0.2; step > 1e-10 && left-- > 0;) {
      const WideVec u = at.second.unitOrthogonal(), v = at.second.cross(u);
      bool better = false;
      for (int k = 0; k < 12; ++k) {
        const Wide angle = k * std::numbers::pi_v<Wide> / 6;
        const WideVec n = (at.second + step * (cos(angle) * u + sin(angle) * v)).normalized();
        if (const Wide w = (*this)(n); w < at.first) {
          at = {w, n};
          better = true;
        }
      }
      if (!better) step *= 0.5;
    }
    return at.first;
  }
  const Shape &a_, &b_;
  WideMat ra_, rb_;
  WideVec offset_;
};

}  // namespace touchstone::test
