#include "oracles/abi/protocol.h"

#include <utility>

#include "core/shape/hull_edges.h"

namespace touchstone::protocol {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

struct PutField {
  Writer& w;
  void operator()(double v) const { w.put(v); }
  void operator()(const Vec3& v) const { w.put(v); }
  void operator()(const std::vector<Vec3>& v) const {
    w.count(v.size());
    for (const Vec3& p : v) w.put(p);
  }
  void operator()(const Triangles& v) const {
    w.count(v.size());
    for (const auto& t : v) w.put(t[0]).put(t[1]).put(t[2]);
  }
};

struct GetField {
  Reader& r;
  void operator()(double& v) const { v = r.get<double>(); }
  void operator()(Vec3& v) const { v = r.vec3(); }
  void operator()(std::vector<Vec3>& v) const {
    v.resize(r.count(24));
    for (Vec3& p : v) p = r.vec3();
  }
  void operator()(Triangles& v) const {
    v.resize(r.count(12));
    for (auto& t : v)
      for (int& i : t) i = r.get<std::int32_t>();
  }
};

void put_shape(Writer& w, const Shape& shape) {
  w.put(static_cast<std::uint8_t>(shape.index()));
  const PutField put{w};
  std::visit([&](const auto& s) { for_each_field(s, [&](auto, const auto& v, Domain) { put(v); }); }, shape);
  if (const auto* h = hull_if(shape)) {
    put(h->faces);
    w.put(h->dimension);
  }
}

void check_indices(const Triangles& triangles, std::size_t vertex_count) {
  for (const auto& t : triangles)
    for (int i : t)
      if (i < 0 || static_cast<std::size_t>(i) >= vertex_count)
        throw Malformed("a vertex index out of range");
}

Shape get_shape(Reader& r) {
  Shape shape = shape_of_kind(static_cast<ShapeKind>(r.tag(static_cast<std::uint8_t>(shape_kind_count))));
  const GetField get{r};
  std::visit([&](auto& s) { for_each_field(s, [&](auto, auto& v, Domain) { get(v); }); }, shape);
  if (auto* h = hull_if(shape)) {
    get(h->faces);
    h->dimension = r.get<std::int32_t>();
    if (h->vertices.empty() || h->dimension < 0 || h->dimension > 3) throw Malformed("an invalid hull");
    check_indices(h->faces, h->vertices.size());
    derive_edges(*h);
  }
  if (const TriangleMesh* m = triangles_if(shape)) check_indices(m->triangles, m->vertices.size());
  return shape;
}

void put_pose(Writer& w, const Pose& p) { w.put(p.translation).put(p.rotation); }

Pose get_pose(Reader& r) {
  Pose p;
  p.translation = r.vec3();
  p.rotation = r.quat();
  return p;
}

void put_body(Writer& w, const Body& b) {
  w.put(b.shape).put(static_cast<std::uint8_t>(b.is_static)).put(b.group);
  put_pose(w, b.pose);
  w.put(static_cast<std::uint8_t>(b.motion.has_value()));
  if (b.motion) w.put(b.motion->linear).put(b.motion->angular);
}

Body get_body(Reader& r, std::size_t shape_count) {
  Body b;
  b.shape = r.get<std::int32_t>();
  if (b.shape < 0 || static_cast<std::size_t>(b.shape) >= shape_count)
    throw Malformed("a shape index out of range");
  b.is_static = r.flag();
  b.group = r.get<std::int32_t>();
  b.pose = get_pose(r);
  if (r.flag()) {
    const Vec3 linear = r.vec3(), angular = r.vec3();
    b.motion = Motion{linear, angular};
  }
  return b;
}

Step get_step(Reader& r, std::size_t body_count) {
  Step s;
  s.op = static_cast<Step::Op>(r.tag(4));
  s.body = r.get<std::int32_t>();
  if (s.op != Step::Op::query && (s.body < 0 || static_cast<std::size_t>(s.body) >= body_count))
    throw Malformed("a body index out of range");
  if (r.flag()) s.pose = get_pose(r);
  return s;
}

}  // namespace

void put_scene(Writer& w, const Scene& scene) {
  w.count(scene.shapes.size());
  for (const Shape& s : scene.shapes) put_shape(w, s);
  w.count(scene.bodies.size());
  for (const Body& b : scene.bodies) put_body(w, b);
  w.count(scene.ignored.size());
  for (auto [a, b] : scene.ignored) w.put(a).put(b);
  w.count(scene.script.size());
  for (const Step& s : scene.script) {
    w.put(static_cast<std::uint8_t>(s.op)).put(s.body).put(static_cast<std::uint8_t>(s.pose.has_value()));
    if (s.pose) put_pose(w, *s.pose);
  }
  w.put(scene.margin);
}

Scene get_scene(Reader& r) {
  Scene scene;
  scene.shapes.resize(r.count(9));
  for (Shape& s : scene.shapes) s = get_shape(r);
  scene.bodies.resize(r.count(66));
  for (Body& b : scene.bodies) b = get_body(r, scene.shapes.size());
  scene.ignored.resize(r.count(8));
  for (auto& [a, b] : scene.ignored) {
    a = r.get<std::int32_t>();
    b = r.get<std::int32_t>();
  }
  scene.script.resize(r.count(6));
  for (Step& s : scene.script) s = get_step(r, scene.bodies.size());
  scene.margin = r.get<double>();
  return scene;
}

void put_received(Writer& w, const ReceivedScene& received) {
  w.count(received.shapes.size());
  for (const auto& s : received.shapes) {
    w.put(static_cast<std::uint8_t>(s.has_value()));
    if (s) put_shape(w, *s);
  }
  w.count(received.bodies.size());
  for (const auto& b : received.bodies) {
    w.put(static_cast<std::uint8_t>(b.has_value()));
    if (!b) continue;
    for (int i = 0; i < 3; ++i) w.put(Vec3(b->matrix.row(i)));
    w.put(b->translation);
  }
}

ReceivedScene get_received(Reader& r, const Scene& sent) {
  const auto count = [&](std::size_t most) {
    const std::size_t n = r.count(1);
    if (n > most) throw Malformed("more shapes or bodies than were sent");
    return n;
  };
  ReceivedScene received;
  received.shapes.resize(count(sent.shapes.size()));
  for (auto& s : received.shapes)
    if (r.flag()) s = get_shape(r);
  received.bodies.resize(count(sent.bodies.size()));
  for (auto& b : received.bodies) {
    if (!r.flag()) continue;
    Placement p;
    for (int i = 0; i < 3; ++i) p.matrix.row(i) = r.vec3();
    p.translation = r.vec3();
    b = p;
  }
  return received;
}

}  // namespace touchstone::protocol
