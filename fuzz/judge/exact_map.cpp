#include "fuzz/judge/exact_map.h"

#include <algorithm>
#include <cmath>

namespace touchstone::fuzz {
namespace {

bool is_size(Domain d) { return d == Domain::positive || d == Domain::non_negative; }

template <class F>
void for_each_pose(Scene& s, F&& f) {
  for (Body& b : s.bodies) f(b.pose);
  for (Step& step : s.script)
    if (step.pose) f(*step.pose);
}

}  // namespace

void turn_axes(Scene& s, const Mat3& m) {
  for (Shape& shape : s.shapes)
    change_numbers(shape, [&](auto& v, Domain domain) {
      if constexpr (std::is_same_v<std::decay_t<decltype(v)>, Vec3>)
        v = is_size(domain) ? Vec3((m * v).cwiseAbs()) : Vec3(m * v);
    });
  for_each_pose(s, [&](Pose& p) {
    p.translation = m * p.translation;
    const Vec3 q = m * Vec3(p.rotation.x, p.rotation.y, p.rotation.z);
    p.rotation = {q.x(), q.y(), q.z(), p.rotation.w};
  });
  for (Body& b : s.bodies) {
    if (!b.motion) continue;
    b.motion->linear = m * b.motion->linear;
    b.motion->angular = m * b.motion->angular;
  }
}

bool has_own_axis(const Shape& s) {
  bool has = false;
  std::visit(
      [&](const auto& x) {
        for_each_field(x, [&](std::string_view name, const auto&, Domain) { has |= name == "half_height"; });
      },
      s);
  return has;
}

bool cycle_axes(Scene& s) {
  if (std::any_of(s.shapes.begin(), s.shapes.end(), has_own_axis)) return false;
  Mat3 cycle;
  cycle << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  turn_axes(s, cycle);
  return true;
}

namespace {

bool scales(double v, double factor) {
  constexpr double least_scaled = 0x1p-500;  // squares of smaller numbers may underflow
  const double scaled = v * factor;
  return std::isfinite(scaled) && scaled / factor == v && (v == 0 || std::abs(scaled) > least_scaled);
}

bool scales(const Vec3& v, double factor) {
  return scales(v[0], factor) && scales(v[1], factor) && scales(v[2], factor);
}

bool is_length(Domain domain) { return domain != Domain::nonzero_vector; }

bool scales(const Shape& shape, double factor) {
  bool all = true;
  std::visit(
      [&](const auto& s) {
        for_each_field(s, [&](auto, const auto& v, Domain domain) {
          using V = std::decay_t<decltype(v)>;
          if constexpr (std::is_same_v<V, double>) all &= scales(v, factor);
          if constexpr (std::is_same_v<V, Vec3>) all &= !is_length(domain) || scales(v, factor);
          if constexpr (std::is_same_v<V, std::vector<Vec3>>)
            for (const Vec3& p : v) all &= scales(p, factor);
        });
      },
      shape);
  return all;
}

}  // namespace

bool scale_by(Scene& s, double factor) {
  // Check before changing anything: a hull cannot be built from invalid numbers.
  for (const Shape& shape : s.shapes)
    if (!scales(shape, factor)) return false;
  for (const Body& b : s.bodies)
    if (!scales(b.pose.translation, factor) || (b.motion && !scales(b.motion->linear, factor))) return false;
  for (const Step& step : s.script)
    if (step.pose && !scales(step.pose->translation, factor)) return false;
  if (!scales(s.margin, factor)) return false;
  for (Shape& shape : s.shapes)
    change_numbers(shape, [&](auto& v, Domain domain) {
      if constexpr (std::is_same_v<std::decay_t<decltype(v)>, double>)
        v *= factor;
      else if (is_length(domain))
        v *= factor;
    });
  for_each_pose(s, [&](Pose& p) { p.translation *= factor; });
  for (Body& b : s.bodies)
    if (b.motion) b.motion->linear *= factor;
  s.margin *= factor;
  return true;
}

void half_turn(Scene& s, int axis) {
  Vec3 signs = Vec3::Constant(-1);
  signs[axis] = 1;
  Vec3 h = Vec3::Zero();
  h[axis] = 1;
  for_each_pose(s, [&](Pose& p) {
    p.translation = p.translation.cwiseProduct(signs);
    p.rotation = Quat{h.x(), h.y(), h.z(), 0} * p.rotation;
  });
  for (Body& b : s.bodies) {
    if (!b.motion) continue;
    b.motion->linear = b.motion->linear.cwiseProduct(signs);
    b.motion->angular = b.motion->angular.cwiseProduct(signs);
  }
}

bool translate_by(Scene& s, const Vec3& by) {
  bool exact = true;
  for_each_pose(s, [&](Pose& p) {
    for (int k = 0; k < 3; ++k) {
      // Knuth's TwoSum: what rounding left out.
      const double x = p.translation[k], sum = x + by[k], back = sum - x;
      exact &= std::isfinite(sum) && (x - (sum - back)) + (by[k] - back) == 0;
      p.translation[k] = sum;
    }
  });
  return exact;
}

}  // namespace touchstone::fuzz
