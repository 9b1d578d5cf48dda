#include "fuzz/cover/cover.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/base/input_error.h"
#include "fuzz/cover/exact_hull.h"

namespace touchstone::fuzz {
namespace {

constexpr std::size_t most_points = 4096;  // of a piece
/// The exact signs of orientation hold for coordinates from 1e-90 to 1e90.
constexpr double largest_coordinate = 1e90;

Triangle triangle_of(const TriangleMesh& m, std::size_t i) {
  Triangle t;
  for (std::size_t k = 0; k < 3; ++k) t[k] = m.vertices[static_cast<std::size_t>(m.triangles[i][k])];
  return t;
}

void require_moderate(const Vec3& v, const std::string& what) {
  for (const double x : {v.x(), v.y(), v.z()})
    if (!(std::abs(x) <= largest_coordinate) || (x != 0 && std::abs(x) < 1 / largest_coordinate))
      throw InputError(what, fmt::format("has a coordinate {} that is not between {:g} and {:g}", x,
                                         1 / largest_coordinate, largest_coordinate));
}

ExactHull hull_of(const std::vector<Vec3>& points, const std::string& name) {
  if (points.size() > most_points)
    throw InputError(name, fmt::format("has {} points; a piece may have {}", points.size(), most_points));
  for (const Vec3& v : points) require_moderate(v, name);
  auto hull = exact_hull(points);
  if (!hull) throw InputError(name, "is flat: its points are in one plane, and it contains no volume");
  return std::move(*hull);
}

Uncovered witness_of(int triangle, const referee::Rational3& p) {
  return {triangle,
          {referee::text_of(p.x), referee::text_of(p.y), referee::text_of(p.z)},
          {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)}};
}

Json bracket_json(const referee::Bracket& b) { return Json::array({number(b.lo), number(b.hi)}); }

Json reach_json(const Reach& r) { return {{"distance", bracket_json(r.bracket)}, {"at", vector(r.at)}}; }

}  // namespace

Cover cover(const TriangleMesh& mesh, const std::vector<std::vector<Vec3>>& pieces,
            const std::vector<std::string>& names, const CoverProgress& progress,
            const std::atomic<bool>& stop) {
  Cover c;
  c.triangles = mesh.triangles.size();
  c.pieces = pieces.size();
  for (const Vec3& v : mesh.vertices) require_moderate(v, "the mesh");
  std::vector<ExactHull> hulls;
  std::vector<Hull> shapes;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    hulls.push_back(hull_of(pieces[i], names[i]));
    shapes.push_back(make_hull(hulls.back().points));
    progress("pieces", i + 1, pieces.size());
  }
  for (std::size_t i = 0; i < mesh.triangles.size() && !stop; ++i) {
    if (const auto p = uncovered_point(triangle_of(mesh, i), hulls)) {
      c.uncovered.push_back(static_cast<int>(i));
      if (!c.witness) c.witness = witness_of(static_cast<int>(i), *p);
    }
    progress("triangles", i + 1, mesh.triangles.size());
  }
  if (!c.uncovered.empty()) c.sticks_out = sticking_out(mesh, c.uncovered, shapes, stop);
  c.closed = is_closed(mesh);
  progress("measures", 1, 3);
  c.union_volume = volume_of_union(hulls, stop);
  progress("measures", 2, 3);
  if (c.closed) {
    c.mesh_volume = std::abs(volume_inside(mesh));
    c.reaches_beyond = reaching_beyond(hulls, mesh, stop);
  }
  c.interrupted = stop;
  return c;
}

Json to_json(const Cover& c) {
  Json j = {{"touchstone_cover", 1},
            {"triangles", c.triangles},
            {"pieces", c.pieces},
            {"covers", c.covers()},
            {"uncovered_triangles", c.uncovered}};
  if (c.witness)
    j["witness"] = {{"triangle", c.witness->triangle},
                    {"exact", c.witness->exact},
                    {"point", vector(c.witness->rounded)}};
  j["sticks_out"] = reach_json(c.sticks_out);
  j["closed"] = c.closed;
  if (c.reaches_beyond) j["reaches_beyond"] = reach_json(*c.reaches_beyond);
  j["union_volume"] = bracket_json(c.union_volume);
  if (c.mesh_volume) {
    j["mesh_volume"] = number(*c.mesh_volume);
    j["excess_volume"] =
        bracket_json({c.union_volume.lo - *c.mesh_volume, c.union_volume.hi - *c.mesh_volume});
  }
  j["interrupted"] = c.interrupted;
  return j;
}

}  // namespace touchstone::fuzz
