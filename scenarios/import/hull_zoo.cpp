#include "scenarios/import/hull_zoo.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include "core/base/input_error.h"
#include "scenarios/codec/scene_codec.h"
#include "scenarios/import/text_lines.h"

namespace touchstone {
namespace {

constexpr int max_count = 1 << 20;

std::vector<int> read_polygon(TextLines& in, int vertex_count) {
  in.need("a face");
  const int k = in.integer(0, 3, vertex_count);
  in.need_tokens(static_cast<std::size_t>(k) + 1);
  std::vector<int> face;
  for (int i = 1; i <= k; ++i) face.push_back(in.integer(static_cast<std::size_t>(i), 0, vertex_count - 1));
  return face;
}

ZooHull read_hull(TextLines& in, int id) {
  in.need("a hull");
  if (in.token(0) != "hull" || in.integer(1) != id) in.fail("expected: hull " + std::to_string(id));
  in.need_tokens(4);
  const int vertices = in.integer(2, 4, max_count), faces = in.integer(3, 4, max_count);
  ZooHull h;
  h.id = id;
  for (int i = 0; i < vertices; ++i) {
    in.need("a vertex");
    in.need_tokens(3);
    h.vertices.push_back(in.vec3(0));
  }
  for (int i = 0; i < faces; ++i) h.faces.push_back(read_polygon(in, vertices));
  return h;
}

void read_table(std::vector<ZooHull>& zoo, const std::filesystem::path& file) {
  TextLines in(file, ',');
  in.need_header(
      "id,category,nv,nf,source_repo,source_path,component,transform,ext_x,ext_y,ext_z,volume,min_dihedral_"
      "rad,"
      "min_edge,max_edge");
  for (ZooHull& h : zoo) {
    in.need("a row for hull " + std::to_string(h.id));
    in.need_tokens(15);
    if (in.integer(0) != h.id || in.integer(2) != static_cast<int>(h.vertices.size()) ||
        in.integer(3) != static_cast<int>(h.faces.size()))
      in.fail("id, nv and nf are not those of hull " + std::to_string(h.id));
    h.category = std::string(in.token(1));
    h.min_dihedral_rad = in.number(12);
  }
  if (in.next()) in.fail("there are more rows than hulls");
}

std::uint32_t uint32_at(const std::string& bytes, std::size_t at) {
  std::uint32_t v = 0;
  for (unsigned i = 0; i < 4; ++i)
    v |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  return v;
}

}  // namespace

std::vector<ZooHull> load_hull_zoo(const std::filesystem::path& directory) {
  TextLines in(directory / "zoo.txt", ' ');
  in.need("cdh-hulls 1");
  if (in.token_count() != 2 || in.token(0) != "cdh-hulls" || in.integer(1) != 1)
    in.fail("expected: cdh-hulls 1");
  in.need("the count");
  if (in.token(0) != "count") in.fail("expected: count N");
  in.need_tokens(2);
  const int count = in.integer(1, 0, max_count);
  std::vector<ZooHull> zoo;
  for (int i = 0; i < count; ++i) zoo.push_back(read_hull(in, i));
  in.need("end");
  if (in.token(0) != "end") in.fail("expected: end");
  read_table(zoo, directory / "zoo.csv");
  return zoo;
}

std::vector<std::vector<Vec3>> load_point_clouds(const std::filesystem::path& path) {
  const std::string file = path.string(), bytes = read_file(path);
  std::vector<std::vector<Vec3>> clouds;
  for (std::size_t at = 0; at < bytes.size();) {
    const auto cut_off = [&] {
      throw InputError(file, "is cut off in cloud " + std::to_string(clouds.size()));
    };
    if (bytes.size() - at < 4) cut_off();
    const std::size_t n = uint32_at(bytes, at);
    at += 4;
    if ((bytes.size() - at) / 12 < n) cut_off();
    std::vector<Vec3>& cloud = clouds.emplace_back();
    cloud.reserve(n);
    for (std::size_t i = 0; i < n; ++i, at += 12) {
      const auto coordinate = [&](std::size_t k) {
        return double{std::bit_cast<float>(uint32_at(bytes, at + 4 * k))};
      };
      cloud.emplace_back(coordinate(0), coordinate(1), coordinate(2));
      if (!cloud.back().allFinite())
        throw InputError(file, "point " + std::to_string(i) + " of cloud " +
                                   std::to_string(clouds.size() - 1) + " is not finite");
    }
  }
  return clouds;
}

}  // namespace touchstone
