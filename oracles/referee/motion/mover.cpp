#include "oracles/referee/motion/mover.h"

#include <algorithm>

#include "oracles/referee/exact/exact_pair.h"
#include "oracles/referee/work.h"

namespace touchstone::referee {
namespace {

// The axis about which the shape is a body of revolution.
std::optional<Rational3> local_axis(const CoreForm& f) {
  using K = CoreForm::Kind;
  if (f.kind == K::segment || f.kind == K::cylinder || f.kind == K::cone) return Rational3{0, 0, 1};
  if (f.kind != K::ellipsoid) return std::nullopt;
  if (f.size.x() == f.size.y()) return Rational3{0, 0, 1};
  if (f.size.y() == f.size.z()) return Rational3{1, 0, 0};
  if (f.size.x() == f.size.z()) return Rational3{0, 1, 0};
  return std::nullopt;
}

// False for a rotation that maps the set onto itself at all times: about the centre of a ball, or about the
// axis of a body of revolution, decided exactly.
bool rotation_shows(const Placed& p, const Vec3& angular, const std::optional<std::vector<Vec3>>& core) {
  if (angular.isZero(0)) return false;
  if (core && std::all_of(core->begin(), core->end(), [](const Vec3& v) { return v.isZero(0); }))
    return false;
  const auto axis = local_axis(core_form(p));
  if (!axis || !std::holds_alternative<Pose>(p.pose)) return true;
  const Rational3 u = world_point(p.pose, *axis) - world_point(p.pose, {0, 0, 0});
  return !is_zero(cross(u, exact(angular)));
}

}  // namespace

Mover::Mover(const Placed& p, const Motion& m, const Vec3& minus_linear, std::optional<std::size_t> triangle)
    : placed_(p), motion_(m), minus_(minus_linear) {
  if (triangle) {
    const auto& mesh = std::get<TriangleMesh>(*p.shape);
    core_.emplace();
    for (int k : mesh.triangles[*triangle]) core_->push_back(mesh.vertices[static_cast<std::size_t>(k)]);
  } else {
    core_ = core_points(p);
    radius_ = core_form(p).radius;
  }
  spins_ = rotation_shows(p, m.angular, core_);
  if (!spins_) motion_.angular = Vec3::Zero();
}

// A velocity times a time, added to a translation, relative to both: a difference, a product and a sum.
constexpr Real shift_rounding = 3 * unit;

Frame Mover::frame(double t, const Vec3& origin, bool turned) const {
  Motion turning = motion_;
  turning.linear = Vec3::Zero();
  if (!turned) turning.angular = Vec3::Zero();
  Frame f = frame_at(placed_, turning, t, origin);
  const Real3 shift = static_cast<Real>(t) * velocity();
  f.translation = f.translation + shift;
  f.translation_error += shift_rounding * (largest(shift) + largest(f.translation));
  return f;
}

Solid Mover::body(const Frame& f) const {
  spend(300 + 10 * static_cast<std::int64_t>(core_ ? core_->size() : 1));
  return core_ ? make_body(*core_, radius_, f) : make_body(placed_, f);
}

std::optional<Rational3> Mover::single_point() const {
  if (!core_ || radius_ > 0 || spins_) return std::nullopt;
  const auto is_first = [&](const Vec3& v) { return v == core_->front(); };
  if (!std::all_of(core_->begin(), core_->end(), is_first)) return std::nullopt;
  return world_point(placed_.pose, exact(core_->front()));
}

Operand Mover::at(double t, const Vec3& origin) const {
  Operand r{body(frame(t, origin, true)), std::nullopt};
  if (core_ && (!spins_ || t == 0))
    r.exact = ExactBody{*core_, radius_, placed_.pose, motion_.linear, minus_, {t}};
  return r;
}

Operand Mover::swept(double from, double to, const Vec3& origin) const {
  Operand r{body(frame(from, origin, false)), std::nullopt};
  const Real3 sweep = (static_cast<Real>(to) - static_cast<Real>(from)) * velocity();
  add_sweep(r.body, sweep, value_rounding * largest(sweep));
  if (core_) r.exact = ExactBody{*core_, radius_, placed_.pose, motion_.linear, minus_, {from, to}};
  return r;
}

Operand Mover::orbit(double t, const Vec3& origin) const {
  if (!spins_) return at(t, origin);
  const Frame f = frame(t, origin, false);
  return {make_orbit(body(f), f.translation, angular()), std::nullopt};
}

std::optional<MovingRay> ray_between(const Mover& a, const Mover& b) {
  const auto p = a.single_point(), q = b.single_point();
  if (!p == !q || a.spins() || b.spins()) return std::nullopt;
  const Mover &point = p ? a : b, &body = p ? b : a;
  const Rational3 centre = world_point(body.placed().pose, {0, 0, 0}), drift = body.exact_velocity();
  auto ray = Ray::past(body.placed(), (p ? *p : *q) - centre, point.exact_velocity() - drift);
  if (!ray) return std::nullopt;
  return MovingRay{std::move(*ray), centre, drift, p.has_value()};
}

}  // namespace touchstone::referee
