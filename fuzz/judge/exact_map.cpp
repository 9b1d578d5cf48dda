#include "fuzz/judge/exact_map.h"

#include <algorithm>
#include <cmath>

namespace touchstone::fuzz {
namespace {

bool is_size(Domain d) { return d == Domain::positive || d == Domain::non_negative; }

}  // namespace

void turn_axes(Scene& s, const Mat3& m) {
  for (Shape& shape : s.shapes)
    change_numbers(shape, [&](auto& v, Domain domain) {
      if constexpr (std::is_same_v<std::decay_t<decltype(v)>, Vec3>)
        v = is_size(domain) ? Vec3((m * v).cwiseAbs()) : Vec3(m * v);
    });
  for (Body& b : s.bodies) {
    b.pose.translation = m * b.pose.translation;
    const Vec3 q = m * Vec3(b.pose.rotation.x, b.pose.rotation.y, b.pose.rotation.z);
    b.pose.rotation = {q.x(), q.y(), q.z(), b.pose.rotation.w};
    if (b.motion) b.motion->linear = m * b.motion->linear, b.motion->angular = m * b.motion->angular;
  }
}

bool has_own_axis(const Shape& s) {
  const ShapeKind k = kind_of(s);
  return k == ShapeKind::capsule || k == ShapeKind::cylinder || k == ShapeKind::cone;
}

bool scale_by(Scene& s, double factor) {
  bool exact = true;
  const auto number = [&](double& v) {
    const double scaled = v * factor;
    exact &= std::isfinite(scaled) && scaled / factor == v && (v == 0 || std::abs(scaled) > 0x1p-500);
    v = scaled;
  };
  for (Shape& shape : s.shapes)
    change_numbers(shape, [&](auto& v, Domain domain) {
      if constexpr (std::is_same_v<std::decay_t<decltype(v)>, double>)
        number(v);
      else if (domain != Domain::nonzero_vector)
        for (double& e : v) number(e);
    });
  for (Body& b : s.bodies) {
    for (double& e : b.pose.translation) number(e);
    if (b.motion)
      for (double& e : b.motion->linear) number(e);
  }
  return exact;
}

void half_turn(Scene& s, int axis) {
  Vec3 signs = Vec3::Constant(-1);
  signs[axis] = 1;
  Vec3 h = Vec3::Zero();
  h[axis] = 1;
  const auto turn = [&](Pose& p) {
    p.translation = p.translation.cwiseProduct(signs);
    p.rotation = Quat{h.x(), h.y(), h.z(), 0} * p.rotation;
  };
  for (Body& b : s.bodies) {
    turn(b.pose);
    if (!b.motion) continue;
    b.motion->linear = b.motion->linear.cwiseProduct(signs);
    b.motion->angular = b.motion->angular.cwiseProduct(signs);
  }
}

bool translate_by(Scene& s, const Vec3& by) {
  bool exact = true;
  for (Body& b : s.bodies)
    for (int k = 0; k < 3; ++k) {
      // Knuth's TwoSum: what rounding left out.
      const double x = b.pose.translation[k], sum = x + by[k], back = sum - x;
      exact &= std::isfinite(sum) && (x - (sum - back)) + (by[k] - back) == 0;
      b.pose.translation[k] = sum;
    }
  return exact;
}

}  // namespace touchstone::fuzz
