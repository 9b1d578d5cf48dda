#include "scenarios/import/model/gltf_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/base/input_error.h"
#include "scenarios/import/fcl_motion.h"
#include "scenarios/import/mesh_import.h"
#include "scenarios/import/pose_algebra.h"
#include "scenarios/text/printable.h"

namespace touchstone {
namespace {

// A matrix's columns may be off perpendicular by this share of their lengths: the roundings of float32.
constexpr double shear_rounding = 1e-5;

constexpr std::size_t most_vertices = std::size_t{1} << 22;

constexpr int type_u8 = 5121, type_u16 = 5123, type_u32 = 5125, type_float = 5126;

std::uint32_t little_endian(const char* at, std::size_t bytes) {
  std::uint32_t v = 0;
  for (std::size_t i = 0; i < bytes; ++i)
    v |= static_cast<std::uint32_t>(static_cast<unsigned char>(at[i])) << (8 * i);
  return v;
}

std::optional<std::string> from_base64(std::string_view text) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::string out;
  std::uint32_t bits = 0;
  int have = 0;
  for (const char c : text) {
    const std::size_t d = digits.find(c);
    if (d == std::string_view::npos) return std::nullopt;
    bits = (bits << 6 | static_cast<std::uint32_t>(d)) & 0xffffff;
    have += 6;
    if (have >= 8) out.push_back(static_cast<char>(bits >> (have -= 8) & 0xff));
  }
  return out;
}

std::size_t component_size(int component, const JsonReader& a) {
  switch (component) {
    case type_u8:
      return 1;
    case type_u16:
      return 2;
    case type_u32:
    case type_float:
      return 4;
    default:
      a.fail("has a type of components that is not read");
  }
}

std::uint64_t optional_count(const JsonReader& j, std::string_view field) {
  return j.has(field) ? count_of(j[field]) : 0;
}

std::vector<double> numbers(const JsonReader& j, std::size_t exactly) {
  std::vector<double> v;
  for (const JsonReader& x : j.items(exactly)) v.push_back(x.number());
  return v;
}

GltfTransform of_matrix(const JsonReader& j) {
  const std::vector<double> v = numbers(j, 16);
  if (v[3] != 0 || v[7] != 0 || v[11] != 0 || v[15] != 1) j.fail("is not an affine transform");
  GltfTransform t;
  t.pose.translation = {v[12], v[13], v[14]};
  Mat3 r;
  for (int c = 0; c < 3; ++c) {
    const auto k = static_cast<std::size_t>(4 * c);
    r.col(c) = Vec3(v[k], v[k + 1], v[k + 2]);
    t.scale[c] = r.col(c).stableNorm();
    if (!(t.scale[c] > 0)) j.fail("has a scale of 0");
    r.col(c) /= t.scale[c];
  }
  if (r.determinant() < 0) {
    r = -r;
    t.scale = -t.scale;
  }
  if (!((r.transpose() * r - Mat3::Identity()).cwiseAbs().maxCoeff() <= shear_rounding)) j.fail("has shear");
  t.pose.rotation = normalized(quaternion_of(r));
  return t;
}

}  // namespace

GltfFile::GltfFile(const std::filesystem::path& file, const ImportContext& context)
    : file_(file), context_(context) {
  const std::string bytes = read_file(file);
  if (bytes.starts_with("glTF"))
    split_binary(bytes);
  else
    json_ = parse_json(bytes, file.string(), JsonLimits{});
  root().require_object();
  const JsonReader asset = root()["asset"];
  if (!asset["version"].string().starts_with("2")) asset["version"].fail("only glTF 2 is read");
}

// A header of 12 bytes, then chunks: length, type, data.
void GltfFile::split_binary(const std::string& bytes) {
  bool has_json = false;
  for (std::size_t at = 12; at < bytes.size();) {
    if (bytes.size() - at < 8) throw InputError(file_.string(), "is cut off in the head of a chunk");
    const std::size_t length = little_endian(bytes.data() + at, 4);
    const std::string_view type(bytes.data() + at + 4, 4);
    if (bytes.size() - at - 8 < length)
      throw InputError(file_.string(), "is cut off: a chunk states " + std::to_string(length) + " bytes");
    const std::string_view data(bytes.data() + at + 8, length);
    if (type == "JSON" && !has_json) {
      json_ = parse_json(data, file_.string(), JsonLimits{});
      has_json = true;
    } else if (type == std::string_view("BIN\0", 4) && binary_.empty()) {
      binary_ = data;
    }
    at += 8 + length;
  }
  if (!has_json) throw InputError(file_.string(), "has no JSON chunk");
}

std::size_t GltfFile::count(std::string_view list) const {
  const auto it = json_.find(list);
  if (it == json_.end()) return 0;
  if (!it->is_array()) root()[list].fail("is not a list");
  return it->size();
}

JsonReader GltfFile::element(std::string_view list, std::size_t i) const {
  return {json_.at(std::string(list)).at(i), file_.string(),
          std::string(list).append("[").append(std::to_string(i)).append("]")};
}

JsonReader GltfFile::element(std::string_view list, const JsonReader& user) const {
  const std::uint64_t i = count_of(user);
  const std::size_t n = count(list);
  if (i >= n)
    user.fail("names number " + std::to_string(i) + " of " + std::string(list) + ", which has " +
              std::to_string(n));
  return element(list, i);
}

GltfTransform GltfFile::transform_of(const JsonReader& node) {
  if (node.has("matrix")) return of_matrix(node["matrix"]);
  GltfTransform t;
  if (node.has("translation")) t.pose.translation = node["translation"].vec3();
  if (node.has("scale")) t.scale = node["scale"].vec3();
  if (!node.has("rotation")) return t;
  const std::vector<double> q = numbers(node["rotation"], 4);
  if (q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 0) node["rotation"].fail("is zero");
  t.pose.rotation = normalized(Quat{q[0], q[1], q[2], q[3]});
  return t;
}

std::optional<GltfTransform> GltfFile::composed(const GltfTransform& outer, const GltfTransform& inner) {
  const Vec3 &s = outer.scale, &t = inner.pose.translation;
  GltfTransform r;
  r.pose = compose(outer.pose, {s.cwiseProduct(t), {}});
  if (s.x() == s.y() && s.y() == s.z()) {
    r.pose.rotation = outer.pose.rotation * inner.pose.rotation;
    r.scale = s.x() * inner.scale;
    return r;
  }
  if (inner.pose.rotation != Quat{}) return std::nullopt;
  r.pose.rotation = outer.pose.rotation;
  r.scale = s.cwiseProduct(inner.scale);
  return r;
}

const std::string& GltfFile::buffer(const JsonReader& index) const {
  const std::uint64_t i = count_of(index);
  const auto known = buffers_.find(i);
  if (known != buffers_.end()) return known->second;
  const JsonReader b = element("buffers", index);
  std::string bytes;
  if (!b.has("uri")) {
    if (i != 0 || binary_.empty()) b.fail("has no uri, and the file no binary chunk");
    bytes = binary_;
  } else if (const std::string uri = b["uri"].string(); uri.starts_with("data:")) {
    const std::size_t comma = uri.find(";base64,");
    auto decoded =
        comma == std::string::npos ? std::nullopt : from_base64(std::string_view(uri).substr(comma + 8));
    if (!decoded) b["uri"].fail("is not data in base64");
    bytes = std::move(*decoded);
  } else {
    bytes = read_file(context_.resolve(uri, file_.parent_path(), b["uri"].place()));
  }
  return buffers_.emplace(i, std::move(bytes)).first->second;
}

GltfFile::Accessor GltfFile::accessor(const JsonReader& index, const std::string& type) const {
  const JsonReader a = element("accessors", index);
  if (a["type"].string() != type) a["type"].fail("is not " + type);
  if (a.has("sparse")) a.fail("is sparse, which is not read");
  if (!a.has("bufferView")) a.fail("has no bufferView");
  const JsonReader view = element("bufferViews", a["bufferView"]);
  if (view.has("extensions")) view.fail("is compressed, which is not read");
  Accessor r;
  r.bytes = &buffer(view["buffer"]);
  r.component = a["componentType"].integer();
  r.count = count_of(a["count"]);
  const std::uint64_t from = optional_count(view, "byteOffset"), length = count_of(view["byteLength"]),
                      inside = optional_count(a, "byteOffset");
  const std::size_t size = component_size(r.component, a) * (type == "VEC3" ? 3 : 1);
  r.stride = view.has("byteStride") ? count_of(view["byteStride"]) : size;
  if (from > r.bytes->size() || length > r.bytes->size() - from)
    view.fail("reaches beyond its buffer of " + std::to_string(r.bytes->size()) + " bytes");
  if (r.stride < size || r.count == 0 || inside > length || length - inside < size ||
      (r.count - 1) > (length - inside - size) / r.stride)
    a.fail("does not fit in its bufferView of " + std::to_string(length) + " bytes");
  r.offset = from + inside;
  return r;
}

std::vector<Vec3> GltfFile::positions(const JsonReader& index) const {
  const Accessor a = accessor(index, "VEC3");
  if (a.component != type_float) index.fail("names positions that are not floats");
  std::vector<Vec3> all;
  all.reserve(a.count);
  for (std::size_t i = 0; i < a.count; ++i) {
    Vec3 p;
    for (int k = 0; k < 3; ++k)
      p[k] = std::bit_cast<float>(
          little_endian(a.bytes->data() + a.offset + i * a.stride + 4 * static_cast<std::size_t>(k), 4));
    if (!p.allFinite()) index.fail("names a position that is not finite: number " + std::to_string(i));
    all.push_back(p);
  }
  return all;
}

std::vector<std::uint32_t> GltfFile::indices(const JsonReader& index) const {
  const Accessor a = accessor(index, "SCALAR");
  if (a.component == type_float) index.fail("names indices that are floats");
  const std::size_t size = component_size(a.component, index);
  std::vector<std::uint32_t> all;
  all.reserve(a.count);
  for (std::size_t i = 0; i < a.count; ++i)
    all.push_back(little_endian(a.bytes->data() + a.offset + i * a.stride, size));
  return all;
}

namespace {

// The corners of triangle i of a list (4), a strip (5) or a fan (6).
std::array<std::size_t, 3> corner_numbers(int mode, std::size_t i) {
  if (mode == 4) return {3 * i, 3 * i + 1, 3 * i + 2};
  if (mode == 5) return {i, i + 1 + i % 2, i + 2 - i % 2};
  return {i + 1, i + 2, 0};
}

}  // namespace

void GltfFile::add_triangles(const JsonReader& mesh, const GltfTransform& transform, TriangleMesh& to) const {
  const Mat3 r = rotation_matrix(transform.pose.rotation);
  for (const JsonReader& p : mesh["primitives"].items()) {
    const int mode = p.has("mode") ? p["mode"].integer() : 4;
    if (mode >= 0 && mode < 4) continue;  // points and lines
    if (mode < 0 || mode > 6) p["mode"].fail("is none of glTF's");
    if (p.has("targets")) p.fail("has morph targets, which are not read");
    if (p.has("extensions") && p["extensions"].has("KHR_draco_mesh_compression"))
      p.fail("is compressed, which is not read");
    const std::vector<Vec3> points = positions(p["attributes"]["POSITION"]);
    std::vector<std::uint32_t> order;
    if (p.has("indices"))
      order = indices(p["indices"]);
    else
      for (std::size_t i = 0; i < points.size(); ++i) order.push_back(static_cast<std::uint32_t>(i));
    for (const std::uint32_t i : order)
      if (i >= points.size())
        p.fail("names vertex " + std::to_string(i) + " of " + std::to_string(points.size()));
    if (to.vertices.size() + points.size() > most_vertices ||
        to.triangles.size() + order.size() > most_vertices)
      p.fail("makes a mesh of more than " + std::to_string(most_vertices) + " vertices or triangles");
    const int first = static_cast<int>(to.vertices.size());
    for (const Vec3& x : points)
      to.vertices.push_back(transform.pose.translation + r * transform.scale.cwiseProduct(x));
    const std::size_t n = mode == 4 ? order.size() / 3 : order.size() < 3 ? 0 : order.size() - 2;
    for (std::size_t i = 0; i < n; ++i) {
      auto c = corner_numbers(mode, i);
      if (transform.scale.prod() < 0) std::swap(c[1], c[2]);
      to.triangles.push_back({first + static_cast<int>(order[c[0]]), first + static_cast<int>(order[c[1]]),
                              first + static_cast<int>(order[c[2]])});
    }
  }
}

}  // namespace touchstone
