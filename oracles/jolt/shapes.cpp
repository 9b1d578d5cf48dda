#include "oracles/jolt/shapes.h"

#include <Jolt/Physics/Collision/Shape/BoxShape.h>
#include <Jolt/Physics/Collision/Shape/CapsuleShape.h>
#include <Jolt/Physics/Collision/Shape/ConvexHullShape.h>
#include <Jolt/Physics/Collision/Shape/CylinderShape.h>
#include <Jolt/Physics/Collision/Shape/SphereShape.h>
#include <Jolt/Physics/Collision/Shape/TaperedCylinderShape.h>
#include <Jolt/Physics/PhysicsSettings.h>

#include <algorithm>
#include <numbers>

#include "oracles/abi/plugin_kit.h"

namespace touchstone::jolt_adapter {
namespace {

// Relative to a shape of size 1, about the rounding of floats.
constexpr float tuned_tolerance = 1e-7F;

float convex_radius(const Setting& setting, double most) {
  return setting.tuned ? 0 : std::min(JPH::cDefaultConvexRadius, static_cast<float>(most));
}

Held created(const JPH::ShapeSettings& settings, double claim) {
  const JPH::ShapeSettings::ShapeResult made = settings.Create();
  if (made.HasError())
    throw kit::Unsupported("Jolt refuses the shape: " + std::string(made.GetError().c_str()));
  return {made.Get(), claim};
}

Held make_box(const ts_shape& s, const Setting& setting) {
  const float radius = convex_radius(setting, std::min({s.size[0], s.size[1], s.size[2]}));
  JPH::BoxShapeSettings settings(
      JPH::Vec3(static_cast<float>(s.size[0]), static_cast<float>(s.size[1]), static_cast<float>(s.size[2])),
      radius);
  settings.SetEmbedded();
  return created(settings, (std::numbers::sqrt3 - 1) * radius);
}

Held make_cylinder(const ts_shape& s, const Setting& setting) {
  const float radius = convex_radius(setting, std::min(s.size[0], s.size[1]));
  JPH::CylinderShapeSettings settings(static_cast<float>(s.size[1]), static_cast<float>(s.size[0]), radius);
  settings.SetEmbedded();
  return created(settings, (std::numbers::sqrt2 - 1) * radius);
}

Held make_hull(const ts_shape& s, const Setting& setting) {
  std::vector<JPH::Vec3> points;
  for (std::size_t i = 0; i < s.vertex_count; ++i) {
    const double* v = s.vertices + 3 * i;
    points.push_back(JPH::Vec3(static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])));
  }
  JPH::ConvexHullShapeSettings settings(points.data(), static_cast<int>(points.size()),
                                        setting.tuned ? 0 : JPH::cDefaultConvexRadius);
  settings.SetEmbedded();
  if (setting.tuned) settings.mHullTolerance = 0;
  const double claim =
      setting.tuned ? 0 : double{settings.mMaxErrorConvexRadius} + double{settings.mHullTolerance};
  return created(settings, claim);
}

}  // namespace

float Setting::tolerance() const { return tuned ? tuned_tolerance : JPH::cDefaultCollisionTolerance; }

Held make_shape(const ts_shape& s, const Setting& setting) {
  const auto f = [&](int i) { return static_cast<float>(s.size[i]); };
  switch (s.kind) {
    case TS_SPHERE: {
      JPH::SphereShapeSettings settings(f(0));
      settings.SetEmbedded();
      return created(settings, 0);
    }
    case TS_CAPSULE: {
      JPH::CapsuleShapeSettings settings(f(1), f(0));
      settings.SetEmbedded();
      return created(settings, 0);
    }
    case TS_CONE: {
      JPH::TaperedCylinderShapeSettings settings(f(1), 0, f(0), 0);
      settings.SetEmbedded();
      return created(settings, 0);
    }
    case TS_BOX:
      return make_box(s, setting);
    case TS_CYLINDER:
      return make_cylinder(s, setting);
    case TS_HULL:
      return make_hull(s, setting);
    default:
      throw kit::Unsupported("the adapter makes none of Jolt's shapes of this kind");
  }
}

Placed make_placed(const ts_pose& pose, int kind) {
  const Pose asked = kit::pose_of(pose);
  Quat q = normalized(asked.rotation);
  // A quarter turn about x takes y to z.
  if (stands_on_z(kind)) {
    const double half = std::numbers::sqrt2 / 2;
    q = {half * (q.x + q.w), half * (q.y + q.z), half * (q.z - q.y), half * (q.w - q.x)};
  }
  using Real = JPH::Real;
  return {JPH::Quat(static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z),
                    static_cast<float>(q.w)),
          JPH::RVec3(static_cast<Real>(asked.translation.x()), static_cast<Real>(asked.translation.y()),
                     static_cast<Real>(asked.translation.z()))};
}

void report_shape(int index, const ts_shape& asked, const ts_received& to) {
  double size[4];
  for (int i = 0; i < 4; ++i) size[i] = static_cast<float>(asked.size[i]);
  std::vector<double> numbers(3 * asked.vertex_count);
  std::transform(asked.vertices, asked.vertices + numbers.size(), numbers.begin(),
                 [](double x) { return double{static_cast<float>(x)}; });
  to.shape(to.ctx, index, size, numbers.data(), asked.vertex_count);
}

void report_body(int index, const Placed& held, int kind, const ts_received& to) {
  const double x = held.rotation.GetX(), y = held.rotation.GetY(), z = held.rotation.GetZ(),
               w = held.rotation.GetW();
  Mat3 m;  // of a unit quaternion, as JPH::Mat44::sRotation computes it
  m << 1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),  //
      2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),   //
      2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y);
  if (stands_on_z(kind)) {
    const Vec3 up = m.col(1);
    m.col(1) = -m.col(2);
    m.col(2) = up;
  }
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = m;
  const double translation[3] = {held.translation.GetX(), held.translation.GetY(), held.translation.GetZ()};
  to.body(to.ctx, index, rows.data(), translation);
}

}  // namespace touchstone::jolt_adapter
