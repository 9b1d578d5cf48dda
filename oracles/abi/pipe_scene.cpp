#include "oracles/abi/pipe_scene.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "oracles/abi/plugin_scene.h"
#include "scenarios/codec/scene_fields.h"

namespace touchstone::pipe {
namespace {

double finite(double x) { return std::isfinite(x) ? x : throw NotFinite{}; }
Json numbers(const double* p, std::size_t n) {
  Json j = Json::array();
  for (std::size_t i = 0; i < n; ++i) j.push_back(finite(p[i]));
  return j;
}
Json points(const double* p, std::size_t n) {
  Json j = Json::array();
  for (std::size_t i = 0; i < n; ++i) j.push_back(numbers(p + 3 * i, 3));
  return j;
}
Json triangles(const ts_shape& s) {
  Json j = Json::array();
  for (std::size_t i = 0; i < s.triangle_count; ++i)
    j.push_back({s.triangles[3 * i], s.triangles[3 * i + 1], s.triangles[3 * i + 2]});
  return j;
}

bool has_lists(std::int32_t kind) { return kind == TS_HULL || kind == TS_MESH; }

// Field names as in the scene's JSON form (scene.schema.json).
Json shape(const ts_shape& s) {
  const Shape empty = shape_of_kind(static_cast<ShapeKind>(s.kind));
  Json j = {{"type", type_name(empty)}};
  const double* size = s.size;
  for_each_size(empty, [&](auto name, const double*, std::size_t n) {
    j[std::string(name)] = n == 1 ? Json(finite(*size)) : numbers(size, n);
    size += n;
  });
  if (!has_lists(s.kind)) return j;
  j["vertices"] = points(s.vertices, s.vertex_count);
  j["triangles"] = triangles(s);
  return j;
}

std::int32_t kind_named(const std::string& type) {
  for (std::int32_t k = 0; k < shape_kind_count; ++k)
    if (type == type_name(static_cast<ShapeKind>(k))) return k;
  throw std::runtime_error("the command's receipt names an unknown type of shape: " + type.substr(0, 40));
}

Json pose(const ts_pose& p) {
  return {{"translation", numbers(p.translation, 3)}, {"rotation", numbers(p.rotation, 4)}};
}

Json body(const ts_body& b) {
  Json j = {{"shape", b.shape}, {"static", b.is_static != 0}, {"group", b.group}, {"pose", pose(b.pose)}};
  if (b.has_motion) j["motion"] = {{"linear", numbers(b.linear, 3)}, {"angular", numbers(b.angular, 3)}};
  return j;
}

Json step(const ts_step& s) {
  Json j = {{"op", scene_fields::op_names[static_cast<std::size_t>(s.op)]}};
  if (s.op != TS_QUERY) j["body"] = s.body;
  if (s.op == TS_INSERT || s.op == TS_MOVE) j["pose"] = pose(s.pose);
  return j;
}

// The index of an existing shape or body.
std::int32_t number_of(const Json& j, const char* what, std::size_t count) {
  const auto n = j.at(what).get<std::int64_t>();
  if (n < 0 || n >= static_cast<std::int64_t>(count))
    throw std::runtime_error("the command's receipt names a " + std::string(what) + " that does not exist");
  return static_cast<std::int32_t>(n);
}

template <std::size_t N>
void read_into(const Json& j, double (&out)[N]) {
  if (j.size() > N) throw std::runtime_error("the command's receipt has too many numbers");
  for (std::size_t k = 0; k < j.size(); ++k) out[k] = j.at(k).get<double>();
}

/// A shape parsed from the scene's JSON form into the ABI's form; owns the arrays that it points to.
struct HeldShape {
  ts_shape shape{};
  std::vector<double> vertices;
  std::vector<std::int32_t> triangles;

  explicit HeldShape(const Json& j) {
    shape.kind = kind_named(j.at("type"));
    const Shape empty = shape_of_kind(static_cast<ShapeKind>(shape.kind));
    double* size = shape.size;
    for_each_size(empty, [&](auto name, const double*, std::size_t n) {
      const Json& field = j.at(std::string(name));
      for (std::size_t k = 0; k < n; ++k) *size++ = n == 1 ? field.get<double>() : field.at(k).get<double>();
    });
    if (has_lists(shape.kind)) read_lists(j);
  }
  HeldShape(const HeldShape&) = delete;
  HeldShape& operator=(const HeldShape&) = delete;

 private:
  void read_lists(const Json& j) {
    for (const Json& v : j.at("vertices"))
      for (std::size_t k = 0; k < 3; ++k) vertices.push_back(v.at(k).get<double>());
    for (const Json& t : j.value("triangles", Json::array()))
      for (std::size_t k = 0; k < 3; ++k) triangles.push_back(t.at(k).get<std::int32_t>());
    shape.vertices = vertices.data();
    shape.vertex_count = vertices.size() / 3;
    shape.triangles = triangles.data();
    shape.triangle_count = triangles.size() / 3;
  }
};

}  // namespace

Json scene_of(const ts_scene& s) {
  Json j = {{"shapes", Json::array()},
            {"bodies", Json::array()},
            {"steps", Json::array()},
            {"ignored", Json::array()}};
  for (std::size_t i = 0; i < s.shape_count; ++i) j["shapes"].push_back(shape(s.shapes[i]));
  for (std::size_t i = 0; i < s.body_count; ++i) j["bodies"].push_back(body(s.bodies[i]));
  for (std::size_t i = 0; i < s.step_count; ++i) j["steps"].push_back(step(s.steps[i]));
  for (std::size_t i = 0; i < s.ignored_count; ++i)
    j["ignored"].push_back({s.ignored[2 * i], s.ignored[2 * i + 1]});
  if (s.margin != 0) j["margin"] = finite(s.margin);
  return j;
}

void read_receipt(const Json& j, const ts_scene& scene, const ts_received& received) {
  for (const Json& s : j.value("shapes", Json::array())) {
    if (s.contains("as")) {
      const HeldShape held(s["as"]);
      received.other_shape(received.ctx, number_of(s, "shape", scene.shape_count), &held.shape);
      continue;
    }
    double size[4] = {};
    std::vector<double> vertices;
    read_into(s.at("size"), size);
    for (const Json& v : s.value("vertices", Json::array()))
      for (std::size_t k = 0; k < 3; ++k) vertices.push_back(v.at(k).get<double>());
    received.shape(received.ctx, number_of(s, "shape", scene.shape_count), size, vertices.data(),
                   vertices.size() / 3);
  }
  for (const Json& b : j.value("bodies", Json::array())) {
    double matrix[9] = {}, translation[3] = {};
    if (b.at("matrix").size() != 9 || b.at("translation").size() != 3)
      throw std::runtime_error("the command's receipt lacks a matrix of 9 or a translation of 3 numbers");
    read_into(b["matrix"], matrix);
    read_into(b["translation"], translation);
    received.body(received.ctx, number_of(b, "body", scene.body_count), matrix, translation);
  }
}

}  // namespace touchstone::pipe
