// A convex body in libccd's form: a support mapping and a centre in the world frame. Written for this adapter
// from the definitions of the shapes, independently of the project's own support mappings.
#pragma once

#include <ccd/ccd.h>
#include <ccd/vec3.h>

#include <cmath>

#include "core/math/pose.h"
#include "oracles/abi/plugin_kit.h"

namespace touchstone::libccd {

struct Object {
  const ts_shape* shape = nullptr;
  Mat3 rotation;
  Vec3 translation;
  // libccd does not report that a search reached its iteration limit; this count shows it.
  mutable unsigned long support_calls = 0;
};

inline Vec3 farthest_in_disc(double radius, const Vec3& d) {
  const double r = std::sqrt(d.x() * d.x() + d.y() * d.y());
  return r > 0 ? Vec3(radius * d.x() / r, radius * d.y() / r, 0) : Vec3::Zero();
}

inline Vec3 farthest_vertex(const ts_shape& s, const Vec3& d) {
  const double* best = s.vertices;
  double reach = -HUGE_VAL;
  for (std::size_t i = 0; i < s.vertex_count; ++i) {
    const double* v = s.vertices + 3 * i;
    const double along = v[0] * d.x() + v[1] * d.y() + v[2] * d.z();
    if (along > reach) {
      reach = along;
      best = v;
    }
  }
  return {best[0], best[1], best[2]};
}

/// The kinds that farthest_local() knows.
inline bool has_support(const ts_shape& s) {
  const int kind = kit::core_of(s.kind).kind;
  return kind >= TS_SPHERE && kind <= TS_HULL;
}

/// Without the ball. Precondition: has_support(s), `kind` of its core.
inline Vec3 farthest_in_core(int kind, const ts_shape& s, const Vec3& d) {
  const double length = d.norm();
  const double up = d.z() >= 0 ? 1 : -1;
  switch (kind) {
    case TS_SPHERE:
      return length > 0 ? Vec3(d * (s.size[0] / length)) : Vec3::Zero();
    case TS_BOX:
      return {std::copysign(s.size[0], d.x()), std::copysign(s.size[1], d.y()),
              std::copysign(s.size[2], d.z())};
    case TS_CAPSULE: {
      const Vec3 ball = length > 0 ? Vec3(d * (s.size[0] / length)) : Vec3::Zero();
      return ball + Vec3(0, 0, up * s.size[1]);
    }
    case TS_CYLINDER:
      return farthest_in_disc(s.size[0], d) + Vec3(0, 0, up * s.size[1]);
    case TS_CONE: {
      const Vec3 rim = farthest_in_disc(s.size[0], d) - Vec3(0, 0, s.size[1]);
      const Vec3 apex(0, 0, s.size[1]);
      return apex.dot(d) > rim.dot(d) ? apex : rim;
    }
    case TS_ELLIPSOID: {
      // max d·(S u) over unit u is reached at u = S d / |S d|.
      const Vec3 axes(s.size[0], s.size[1], s.size[2]);
      const Vec3 scaled = axes.cwiseProduct(d);
      const double n = scaled.norm();
      return n > 0 ? Vec3(axes.cwiseProduct(scaled / n)) : Vec3::Zero();
    }
    default:
      return farthest_vertex(s, d);
  }
}

/// Precondition: has_support(s).
inline Vec3 farthest_local(const ts_shape& s, const Vec3& d) {
  const kit::Core core = kit::core_of(s.kind);
  const Vec3 p = farthest_in_core(core.kind, s, d);
  const double length = d.norm();
  return length > 0 ? Vec3(p + d * (core.radius_of(s) / length)) : p;
}

inline void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* out) {
  const Object& o = *static_cast<const Object*>(object);
  ++o.support_calls;
  const Vec3 d(direction->v[0], direction->v[1], direction->v[2]);
  const Vec3 p = o.rotation * farthest_local(*o.shape, o.rotation.transpose() * d) + o.translation;
  ccdVec3Set(out, p.x(), p.y(), p.z());
}

/// The centre of a primitive is its origin, which lies inside; that of a hull is the mean of its vertices.
inline void center(const void* object, ccd_vec3_t* out) {
  const Object& o = *static_cast<const Object*>(object);
  Vec3 mean = Vec3::Zero();
  if (kit::core_of(o.shape->kind).kind == TS_HULL) {
    for (std::size_t i = 0; i < o.shape->vertex_count; ++i)
      mean += Vec3(o.shape->vertices[3 * i], o.shape->vertices[3 * i + 1], o.shape->vertices[3 * i + 2]);
    mean /= static_cast<double>(o.shape->vertex_count);
  }
  const Vec3 p = o.rotation * mean + o.translation;
  ccdVec3Set(out, p.x(), p.y(), p.z());
}

}  // namespace touchstone::libccd
