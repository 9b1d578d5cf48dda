#include "scenarios/codec/scene_codec.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>

#include "core/base/input_error.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/codec/json_reader.h"
#include "scenarios/codec/scene_fields.h"
#include "scenarios/value/height_surface.h"

namespace touchstone {
namespace {

using Json = nlohmann::ordered_json;
namespace fields = scene_fields;

Json to_json(double v) { return v; }
Json to_json(const Vec3& v) { return Json::array({v.x(), v.y(), v.z()}); }
Json to_json(const std::vector<Vec3>& v) {
  Json j = Json::array();
  for (const Vec3& p : v) j.push_back(to_json(p));
  return j;
}
Json to_json(const std::vector<std::array<int, 3>>& v) {
  Json j = Json::array();
  for (const auto& t : v) j.push_back(t);
  return j;
}

// Bitwise: a translation of -0 is not the default and must be kept.
bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool is_plus_zero(const Vec3& v) { return same_bits(v.x(), 0) && same_bits(v.y(), 0) && same_bits(v.z(), 0); }
bool is_identity(const Quat& q) {
  return same_bits(q.x, 0) && same_bits(q.y, 0) && same_bits(q.z, 0) && same_bits(q.w, 1);
}

Json to_json(const Pose& p) {
  Json j = Json::object();
  if (!is_plus_zero(p.translation)) j["translation"] = to_json(p.translation);
  if (!is_identity(p.rotation))
    j["rotation"] = Json::array({p.rotation.x, p.rotation.y, p.rotation.z, p.rotation.w});
  return j;
}

Json to_json(const Motion& m) {
  Json j = Json::object();
  if (!is_plus_zero(m.linear)) j["linear"] = to_json(m.linear);
  if (!is_plus_zero(m.angular)) j["angular"] = to_json(m.angular);
  return j;
}

Json to_json(const Body& b) {
  Json j = Json::object();
  if (!b.name.empty()) j["name"] = b.name;
  j["shape"] = b.shape;
  if (Json pose = to_json(b.pose); !pose.empty()) j["pose"] = std::move(pose);
  if (b.motion) j["motion"] = to_json(*b.motion);
  if (b.is_static) j["static"] = true;
  if (b.group != -1) j["group"] = b.group;
  return j;
}

Json to_json(const Step& s) {
  Json j{{"op", fields::op_names[static_cast<std::size_t>(s.op)]}};
  if (s.op != Step::Op::query) j["body"] = s.body;
  if (s.pose && (s.op == Step::Op::insert || s.op == Step::Op::move)) j["pose"] = to_json(*s.pose);
  return j;
}

void read(const JsonReader& r, double& v) { v = r.number(); }
void read(const JsonReader& r, Vec3& v) { v = r.vec3(); }
void read(const JsonReader& r, std::vector<Vec3>& v) { v = r.points(); }
void read(const JsonReader& r, std::vector<std::array<int, 3>>& v) { v = r.triples(); }

constexpr std::string_view padding_name = "padding", height_field_name = "height_field";

double read_padding(const JsonReader& r) {
  const double padding = r.number();
  if (!(padding >= 0) || !std::isfinite(padding)) r.fail("is not a number of at least 0");
  return padding;
}

template <class S>
Shape read_fields(const JsonReader& r) {
  S read_shape;
  std::vector<std::string_view> known{"type"};
  for_each_field(read_shape, [&](auto name, auto&, Domain) { known.push_back(name); });
  // Any shape but a mesh may state a padding; a padded one has it as a field of its own.
  const bool may_be_padded = !has_triangles<S> && std::ranges::find(known, padding_name) == known.end();
  if (may_be_padded) known.push_back(padding_name);
  if (has_triangles<S> && r.has(padding_name)) r[padding_name].fail("a mesh cannot be padded");
  r.require_object(known);
  for_each_field(read_shape, [&](auto name, auto& value, Domain) { read(r[name], value); });
  Shape shape = std::move(read_shape);
  if (Hull* hull = hull_if(shape)) {
    try {
      *hull = make_hull(std::move(hull->vertices));
    } catch (const InputError& e) {
      throw InputError(r.place() + "." + e.place(), e.reason());
    }
  }
  if (may_be_padded && r.has(padding_name)) return *padded(shape, read_padding(r[padding_name]));
  return shape;
}

template <std::size_t I = 0>
Shape read_shape_named(const JsonReader& r, const std::string& type) {
  if constexpr (I == std::variant_size_v<Shape>) {
    std::string list;
    for (int k = 0; k < shape_kind_count; ++k)
      list += (k ? ", " : "") + std::string(type_name(static_cast<ShapeKind>(k)));
    r["type"].fail("unknown shape " + Json(type).dump(-1, ' ', true, Json::error_handler_t::replace) +
                   "; known are " + list + ", " + std::string(height_field_name));
  } else {
    using S = std::variant_alternative_t<I, Shape>;
    return type == S::type ? read_fields<S>(r) : read_shape_named<I + 1>(r, type);
  }
}

// A mesh that is declared solid is the shape "solid_mesh", whose triangles validate() checks.
Shape read_mesh_declared(const JsonReader& r) {
  static constexpr auto known = std::to_array<std::string_view>({"type", "vertices", "triangles", "solid"});
  r.require_object(known);
  TriangleMesh mesh;
  for_each_field(mesh, [&](auto name, auto& value, Domain) { read(r[name], value); });
  if (!r["solid"].boolean()) return mesh;
  return SolidMesh(std::move(mesh));
}

constexpr std::size_t most_heights = std::size_t{1} << 20;  // two million triangles

double read_cell(const JsonReader& r) {
  const double side = r.number();
  if (!(side > 0)) r.fail("is not a number above 0");
  return side;
}

// Another way to write a mesh. The grid is centred at the body's origin.
Shape read_height_field(const JsonReader& r) {
  static constexpr auto known = std::to_array<std::string_view>({"type", "cell", "heights"});
  r.require_object(known);
  const auto sides = r["cell"].items(2);
  const double dx = read_cell(sides[0]), dy = read_cell(sides[1]);
  std::vector<std::vector<double>> heights;
  std::size_t count = 0;
  for (const JsonReader& row : r["heights"].items()) {
    std::vector<double>& to = heights.emplace_back();
    for (const JsonReader& h : row.items()) to.push_back(h.number());
    if (to.size() < 2) row.fail("has fewer than two heights");
    if (to.size() != heights.front().size()) row.fail("has another number of heights than the first row");
    if ((count += to.size()) > most_heights)
      r["heights"].fail(fmt::format("has more than {} heights", most_heights));
  }
  if (heights.size() < 2) r["heights"].fail("has fewer than two rows");
  return centred_height_surface(heights.size(), heights.front().size(), dx, dy,
                                [&](std::size_t row, std::size_t column) { return heights[row][column]; });
}

Shape read_shape(const JsonReader& r) {
  r.require_object();
  const std::string type = r["type"].string();
  if (type == height_field_name) return read_height_field(r);
  return type == TriangleMesh::type && r.has("solid") ? read_mesh_declared(r) : read_shape_named(r, type);
}

Pose read_pose(const JsonReader& r) {
  r.require_object(fields::pose);
  Pose p;
  if (r.has("translation")) p.translation = r["translation"].vec3();
  if (r.has("rotation")) {
    const auto q = r["rotation"].items(4);
    p.rotation = {q[0].number(), q[1].number(), q[2].number(), q[3].number()};
  }
  return p;
}

Motion read_motion(const JsonReader& r) {
  r.require_object(fields::motion);
  Motion m;
  if (r.has("linear")) m.linear = r["linear"].vec3();
  if (r.has("angular")) m.angular = r["angular"].vec3();
  return m;
}

Body read_body(const JsonReader& r) {
  r.require_object(fields::body);
  Body b;
  if (r.has("name")) b.name = r["name"].string();
  b.shape = r["shape"].integer();
  if (r.has("pose")) b.pose = read_pose(r["pose"]);
  if (r.has("motion")) b.motion = read_motion(r["motion"]);
  if (r.has("static")) b.is_static = r["static"].boolean();
  if (r.has("group")) b.group = r["group"].integer();
  return b;
}

BodyPair read_pair(const JsonReader& r) {
  const auto v = r.items(2);
  return {v[0].integer(), v[1].integer()};
}

Step read_step(const JsonReader& r) {
  r.require_object();
  const std::string op = r["op"].string();
  const auto it = std::find(fields::op_names.begin(), fields::op_names.end(), op);
  if (it == fields::op_names.end()) r["op"].fail("must be insert, move, remove or query");
  const auto index = static_cast<std::size_t>(it - fields::op_names.begin());
  r.require_object(fields::of_op[index]);
  Step s;
  s.op = static_cast<Step::Op>(index);
  if (s.op != Step::Op::query) s.body = r["body"].integer();
  if (r.has("pose")) s.pose = read_pose(r["pose"]);
  return s;
}

void read_version(const JsonReader& r) {
  const JsonReader v = r[fields::version_field];
  if (v.integer() != fields::version)
    v.fail("version " + std::to_string(v.integer()) + " is not known; this build reads version " +
           std::to_string(fields::version));
}

// Writes a list in the text form: one item per line.
void write_list(std::string& out, const char* name, const Json& items) {
  out += std::string(",\n \"") + name + "\": [";
  for (std::size_t i = 0; i < items.size(); ++i) out += (i ? ",\n  " : "\n  ") + to_line(items[i]);
  out += items.empty() ? "]" : "\n ]";
}

}  // namespace

nlohmann::ordered_json to_json(const Shape& shape) {
  Json j{{"type", type_name(shape)}};
  std::visit(
      [&](const auto& s) {
        for_each_field(s, [&](auto name, const auto& v, Domain) { j[name] = to_json(v); });
      },
      shape);
  return j;
}

nlohmann::ordered_json to_json(const Scene& scene) {
  Json j{{fields::version_field, fields::version}};
  if (!scene.name.empty()) j["name"] = scene.name;
  j["shapes"] = Json::array();
  for (const Shape& s : scene.shapes) j["shapes"].push_back(to_json(s));
  j["bodies"] = Json::array();
  for (const Body& b : scene.bodies) j["bodies"].push_back(to_json(b));
  for (const auto& [a, b] : scene.ignored) j["ignored"].push_back(Json::array({a, b}));
  for (const Step& s : scene.script) j["script"].push_back(to_json(s));
  if (scene.margin != 0) j["margin"] = scene.margin;
  return j;
}

Scene scene_from_json(const nlohmann::ordered_json& j, const std::string& place) {
  const JsonReader r(j, place);
  r.require_object(fields::scene);
  read_version(r);
  Scene scene;
  if (r.has("name")) scene.name = r["name"].string();
  for (const JsonReader& s : r["shapes"].items()) scene.shapes.push_back(read_shape(s));
  for (const JsonReader& b : r["bodies"].items()) scene.bodies.push_back(read_body(b));
  if (r.has("ignored"))
    for (const JsonReader& p : r["ignored"].items()) scene.ignored.push_back(read_pair(p));
  if (r.has("script"))
    for (const JsonReader& s : r["script"].items()) scene.script.push_back(read_step(s));
  if (r.has("margin")) scene.margin = r["margin"].number();
  try {
    validate(scene);
  } catch (const InputError& e) {
    throw InputError(json_place(place, e.place()), e.reason());
  }
  std::sort(scene.ignored.begin(), scene.ignored.end());
  return scene;
}

Scene scene_from_text(const std::string& text, const std::string& place) {
  return scene_from_json(parse_json(text, place), place);
}

std::string to_text(const Scene& scene) {
  const Json j = to_json(scene);
  std::string out = "{\"touchstone_scene\": " + std::to_string(fields::version);
  if (j.contains("name")) out += ",\n \"name\": " + to_line(j["name"]);
  for (const char* list : {"shapes", "bodies", "ignored", "script"})
    if (j.contains(list)) write_list(out, list, j[list]);
  if (j.contains("margin")) out += ",\n \"margin\": " + to_line(j["margin"]);
  return out + "\n}\n";
}

Scene load_scene(const std::filesystem::path& file) {
  return scene_from_text(read_file(file), file.string());
}

void save_scene(const Scene& scene, const std::filesystem::path& file) { write_file(file, to_text(scene)); }

}  // namespace touchstone
