#include "oracles/ode/shapes.h"

#include <cmath>

namespace touchstone::ode_adapter {
namespace {

// ODE takes a unit quaternion, w first.
void unit_quaternion(const double q[4], dQuaternion out) {
  double most = 0;
  for (int k = 0; k < 4; ++k) most = std::max(most, std::abs(q[k]));
  for (int k = 0; k < 4; ++k) out[(k + 1) % 4] = q[k] / most;
  dNormalize4(out);
}

// As updateZeroSizedFlag in box.cpp, sphere.cpp, capsule.cpp, cylinder.cpp. A capsule may have zero length.
bool has_no_size(const ts_shape& s) {
  const double* z = s.size;
  if (s.kind == TS_BOX) return z[0] == 0 || z[1] == 0 || z[2] == 0;
  if (s.kind == TS_CYLINDER) return z[0] == 0 || z[1] == 0;
  return (s.kind == TS_SPHERE || s.kind == TS_CAPSULE) && z[0] == 0;
}

Vec3 row(const dReal* r, int i) { return {r[4 * i], r[4 * i + 1], r[4 * i + 2]}; }

void place_plane(dxGeom& g, const ts_shape& s, const ts_pose& pose) {
  dQuaternion q;
  dMatrix3 r;
  unit_quaternion(pose.rotation, q);
  dQtoR(q, r);
  const Vec3 n = kit::vec3(s.size), world(row(r, 0).dot(n), row(r, 1).dot(n), row(r, 2).dot(n));
  dGeomPlaneSetParams(&g, world.x(), world.y(), world.z(),
                      s.size[3] + world.dot(kit::vec3(pose.translation)));
}

std::unique_ptr<Hull> make_hull_data(const ts_shape& s) {
  if (s.kind != TS_HULL) return nullptr;
  if (s.dimension < 3) throw kit::Unsupported("ODE's convex needs its origin inside: no flat hulls");
  auto hull = std::make_unique<Hull>();
  const auto vertex = [&](std::size_t i) { return kit::vec3(s.vertices + 3 * i); };
  for (std::size_t i = 0; i < s.vertex_count; ++i)
    hull->centre += vertex(i) / static_cast<double>(s.vertex_count);
  for (std::size_t i = 0; i < s.vertex_count; ++i)
    for (const double x : Vec3(vertex(i) - hull->centre)) hull->points.push_back(x);
  const auto held = [&](std::int32_t i) { return kit::vec3(&hull->points[3 * static_cast<std::size_t>(i)]); };
  for (std::size_t i = 0; i < s.triangle_count; ++i) {
    const std::int32_t* t = s.triangles + 3 * i;
    const Vec3 n = (held(t[1]) - held(t[0])).cross(held(t[2]) - held(t[0])).normalized();
    hull->planes.insert(hull->planes.end(), {n.x(), n.y(), n.z(), n.dot(held(t[0]))});
    hull->polygons.insert(hull->polygons.end(), {3U, static_cast<unsigned>(t[0]), static_cast<unsigned>(t[1]),
                                                 static_cast<unsigned>(t[2])});
  }
  return hull;
}

[[noreturn]] void refuse_no_size() {
  throw kit::Unsupported("ODE ignores geometries of zero size: GEOM_ZERO_SIZED");
}

GeomPtr make_geom(const ts_shape& s, const Hull* hull) {
  const double* z = s.size;
  // ODE's assertions would abort the process.
  if (s.kind != TS_HALF_SPACE && s.kind != TS_HULL && !(z[0] >= 0 && z[1] >= 0 && z[2] >= 0))
    throw kit::Unsupported("ODE refuses sizes that are negative or NaN");
  // A point may be the start of a ray.
  if (has_no_size(s) && s.kind != TS_SPHERE) refuse_no_size();
  switch (s.kind) {
    case TS_SPHERE:
      return GeomPtr(dCreateSphere(nullptr, z[0]));
    case TS_BOX:
      return GeomPtr(dCreateBox(nullptr, 2 * z[0], 2 * z[1], 2 * z[2]));
    case TS_CAPSULE:
      return GeomPtr(dCreateCapsule(nullptr, z[0], 2 * z[1]));
    case TS_CYLINDER:
      return GeomPtr(dCreateCylinder(nullptr, z[0], 2 * z[1]));
    case TS_HALF_SPACE:
      return GeomPtr(dCreatePlane(nullptr, z[0], z[1], z[2], z[3]));
    case TS_HULL:
      return GeomPtr(dCreateConvex(nullptr, hull->planes.data(),
                                   static_cast<unsigned>(hull->planes.size() / 4), hull->points.data(),
                                   static_cast<unsigned>(hull->points.size() / 3), hull->polygons.data()));
    default:
      kit::no_such_shape("ODE, as the adapter uses it,");
  }
}

void place(dxGeom& g, const ts_shape& s, const Hull* hull, const ts_pose& pose) {
  if (s.kind == TS_HALF_SPACE) return place_plane(g, s, pose);
  dQuaternion q;
  unit_quaternion(pose.rotation, q);
  dGeomSetQuaternion(&g, q);
  Vec3 at = kit::vec3(pose.translation);
  if (hull) {
    const dReal* r = dGeomGetRotation(&g);
    at += Vec3(row(r, 0).dot(hull->centre), row(r, 1).dot(hull->centre), row(r, 2).dot(hull->centre));
  }
  dGeomSetPosition(&g, at.x(), at.y(), at.z());
}

// A hull is reported relative to its centre; the pose of each of its bodies is shifted accordingly.
void report_shape(int index, const ts_shape& s, const Hull* hull, const ts_received& to) {
  if (hull) to.shape(to.ctx, index, s.size, hull->points.data(), hull->points.size() / 3);
}

void report_body(int index, dxGeom& g, const ts_shape& s, const ts_received& to) {
  if (s.kind == TS_HALF_SPACE) return;
  const dReal *r = dGeomGetRotation(&g), *t = dGeomGetPosition(&g);
  const double matrix[9] = {r[0], r[1], r[2], r[4], r[5], r[6], r[8], r[9], r[10]};
  const double translation[3] = {t[0], t[1], t[2]};
  to.body(to.ctx, index, matrix, translation);
}

// ODE is initialised once per process.
void start_ode() {
  static const bool started = [] {
    dInitODE2(0);
    dAllocateODEDataForThread(dAllocateMaskAll);
    return true;
  }();
  (void)started;
}

}  // namespace

World::World(const ts_scene& scene, const ts_received& received) : scene_(scene) {
  start_ode();
  for (std::size_t i = 0; i < scene.shape_count; ++i) {
    hulls_.push_back(make_hull_data(scene.shapes[i]));
    report_shape(static_cast<int>(i), scene.shapes[i], hulls_.back().get(), received);
  }
  for (int i = 0; i < static_cast<int>(scene.body_count); ++i) {
    const auto number = static_cast<std::size_t>(scene.bodies[i].shape);
    const ts_shape& s = scene.shapes[number];
    geoms_.push_back(make_geom(s, hulls_[number].get()));
    dGeomSetData(geom(i), reinterpret_cast<void*>(static_cast<std::intptr_t>(i)));
    put(i, scene.bodies[i].pose);
    report_body(i, *geom(i), s, received);
  }
}

void World::require_sizes() const {
  for (int i = 0; i < static_cast<int>(scene_.body_count); ++i)
    if (has_no_size(scene_.shapes[scene_.bodies[i].shape])) refuse_no_size();
}

void World::put(int body, const ts_pose& pose) const {
  const auto number = static_cast<std::size_t>(scene_.bodies[body].shape);
  place(*geom(body), scene_.shapes[number], hulls_[number].get(), pose);
}

}  // namespace touchstone::ode_adapter
