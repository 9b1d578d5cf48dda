#include "oracles/box3d/shapes.h"

#include <box3d/constants.h>

#include "oracles/abi/plugin_kit.h"

namespace touchstone::box3d_adapter {
namespace {

b3Vec3 to_b3(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

HullPtr make_hull(const ts_shape& s) {
  if (s.dimension < 3) throw kit::Unsupported("Box3D's hulls are never flat (docs/collision.md)");
  if (s.vertex_count > B3_MAX_HULL_VERTICES)
    throw kit::Unsupported("Box3D's hulls have at most 128 vertices");
  std::vector<b3Vec3> points;
  for (std::size_t i = 0; i < s.vertex_count; ++i) points.push_back(to_b3(kit::vec3(s.vertices + 3 * i)));
  const int count = static_cast<int>(points.size());
  HullPtr hull(b3CreateHull(points.data(), count, count));
  if (!hull) throw kit::Unsupported("b3CreateHull refuses these points");
  return hull;
}

std::vector<double> numbers_of(const b3HullData& hull) {
  std::vector<double> numbers;
  const b3Vec3* points = b3GetHullPoints(&hull);
  for (int i = 0; i < hull.vertexCount; ++i)
    for (const double x : to_vec3(points[i])) numbers.push_back(x);
  return numbers;
}

void report_sphere(int index, double radius, const ts_received& to) {
  ts_shape sphere{};
  sphere.kind = TS_SPHERE;
  sphere.size[0] = radius;
  kit::report_other_shape(to, index, sphere);
}

}  // namespace

Shape make_shape(const ts_shape& s) {
  const auto f = [&](int i) { return static_cast<float>(s.size[i]); };
  switch (s.kind) {
    case TS_SPHERE:
      return b3Sphere{{0, 0, 0}, f(0)};
    case TS_CAPSULE:
      // constants.h asks for a sphere instead of a very short capsule.
      if (2 * f(1) < B3_MIN_CAPSULE_LENGTH) return b3Sphere{{0, 0, 0}, f(0)};
      return b3Capsule{{0, 0, -f(1)}, {0, 0, f(1)}, f(0)};
    case TS_BOX:
      return b3MakeBoxHull(f(0), f(1), f(2));
    case TS_HULL:
      return make_hull(s);
    default:
      kit::no_such_shape("Box3D");
  }
}

const b3HullData* hull_of(const Shape& shape) {
  if (const auto* box = std::get_if<b3BoxHull>(&shape)) return &box->base;
  if (const auto* hull = std::get_if<HullPtr>(&shape)) return hull->get();
  return nullptr;
}

Proxy make_proxy(const Shape& shape) {
  if (const auto* sphere = std::get_if<b3Sphere>(&shape)) return {{sphere->center}, sphere->radius};
  if (const auto* capsule = std::get_if<b3Capsule>(&shape))
    return {{capsule->center1, capsule->center2}, capsule->radius};
  const b3HullData& hull = *hull_of(shape);
  const b3Vec3* points = b3GetHullPoints(&hull);
  return {{points, points + hull.vertexCount}, 0};
}

b3WorldTransform make_transform(const Pose& pose) {
  b3WorldTransform t;
  using Scalar = decltype(t.p.x);
  t.p = {static_cast<Scalar>(pose.translation.x()), static_cast<Scalar>(pose.translation.y()),
         static_cast<Scalar>(pose.translation.z())};
  const Quat q = normalized(pose.rotation);
  t.q = {{static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)},
         static_cast<float>(q.w)};
  return t;
}

Mat3 rotation_of(const b3Quat& q) {
  const double x = q.v.x, y = q.v.y, z = q.v.z, w = q.s;
  Mat3 m;
  m << 1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),  //
      2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),   //
      2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y);
  return m;
}

void report_shape(int index, const ts_shape& asked, const Shape& held, const ts_received& to) {
  double size[4] = {asked.size[0], asked.size[1], asked.size[2], asked.size[3]};
  if (const auto* sphere = std::get_if<b3Sphere>(&held)) {
    size[0] = sphere->radius;
    if (asked.kind != TS_SPHERE) return report_sphere(index, size[0], to);
  }
  if (const auto* capsule = std::get_if<b3Capsule>(&held)) {
    size[0] = capsule->radius;
    size[1] = capsule->center2.z;
  }
  if (const auto* box = std::get_if<b3BoxHull>(&held)) kit::store(to_vec3(box->boxPoints[0]), size);
  if (const auto* hull = std::get_if<HullPtr>(&held)) {
    const std::vector<double> numbers = numbers_of(**hull);
    return to.shape(to.ctx, index, size, numbers.data(), numbers.size() / 3);
  }
  to.shape(to.ctx, index, size, nullptr, 0);
}

void report_body(int index, const b3WorldTransform& held, const ts_received& to) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = rotation_of(held.q);
  const double translation[3] = {held.p.x, held.p.y, held.p.z};
  to.body(to.ctx, index, rows.data(), translation);
}

}  // namespace touchstone::box3d_adapter
