#include "scenarios/import/model/mjcf_document.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/input_error.h"
#include "scenarios/import/height_field.h"
#include "scenarios/import/pose_algebra.h"
#include "scenarios/text/printable.h"

namespace touchstone {
namespace {

// With fromto, the pose and the length are those of the segment.
void apply_segment(const MjcfElement& g, const std::string& type, std::vector<double>& size, Pose& pose) {
  const auto v = g.numbers("fromto");
  if (v.size() != 6) g.xml().fail("fromto has " + std::to_string(v.size()) + " numbers instead of 6");
  if (!is_any(type, {"capsule", "cylinder", "ellipsoid", "box"}))
    g.xml().fail("fromto does not fit a " + printable(type));
  if (size.empty()) g.xml().fail("lacks a size");
  const Vec3 from(v[0], v[1], v[2]), to(v[3], v[4], v[5]);
  const Vec3 along = from - to;
  if (along.isZero(0)) g.xml().fail("fromto is a point");
  const double half = along.stableNorm() / 2;
  size = type == "capsule" || type == "cylinder" ? std::vector{size[0], half}
                                                 : std::vector{size[0], size[0], half};
  pose = {(from + to) / 2, from_z_to(along)};
}

float finite_float(double x) {
  if (std::abs(x) > std::numeric_limits<float>::max())
    throw InputError("", "a height is too large for a float");
  return static_cast<float>(x);
}

// The heights in the file itself, if any, are written from the greatest y to the least.
HeightGrid written_heights(const MjcfElement& f) {
  const double rows = f.number("nrow", 0), columns = f.number("ncol", 0);
  if (rows != std::floor(rows) || columns != std::floor(columns))
    throw InputError("", "nrow and ncol must be whole numbers");
  require_grid_size(rows, columns, "");
  HeightGrid grid{static_cast<std::size_t>(rows), static_cast<std::size_t>(columns), {}};
  grid.heights.resize(grid.rows * grid.columns);
  if (!f.text("elevation")) return grid;
  const std::vector<double> v = f.numbers("elevation");
  if (v.size() != grid.heights.size())
    throw InputError("", "elevation has " + std::to_string(v.size()) + " numbers instead of " +
                             std::to_string(grid.heights.size()));
  for (std::size_t r = 0; r < grid.rows; ++r)
    for (std::size_t c = 0; c < grid.columns; ++c)
      grid.heights[r * grid.columns + c] = finite_float(v[(grid.rows - 1 - r) * grid.columns + c]);
  return grid;
}

class ShapeReader {
 public:
  ShapeReader(const MjcfDocument& document, ImportContext& context)
      : document_(document), context_(context) {}

  std::optional<Shape> shape_in(const MjcfElement& g, Pose& pose) {
    const std::string type = g.text("type").value_or("sphere");
    if (type == "mesh") return mesh_in(g);
    if (type == "hfield") return height_field_in(g);
    if (g.text("mesh")) {
      context_.refuse(g.xml(), "fits a " + printable(type) + " to a mesh, which is not supported");
      return std::nullopt;
    }
    if (type == "plane") return Shape(HalfSpace{Vec3::UnitZ(), 0});
    std::vector<double> size = g.numbers("size");
    if (g.text("fromto")) apply_segment(g, type, size, pose);
    if (!is_any(type, {"sphere", "capsule", "cylinder", "box", "ellipsoid"})) {
      context_.refuse(g.xml(), "type " + printable(type) + " cannot be represented");
      return std::nullopt;
    }
    return sized_shape(type, size, g.xml());
  }

 private:
  // MuJoCo collides the convex hulls of meshes.
  std::optional<Shape> mesh_in(const MjcfElement& g) {
    const std::string name = g.text("mesh").value_or("");
    const MjcfElement m(document_.need_asset("mesh", name, g.xml()), document_.defaults(), "");
    try {
      return mesh_of(m);
    } catch (const InputError& e) {
      context_.refuse(e.place(), e.reason());
      return std::nullopt;
    }
  }

  Shape mesh_of(const MjcfElement& m) {
    const Vec3 scale = m.vec3("scale").value_or(Vec3::Ones());
    if (m.text("refpos") || m.text("refquat")) m.xml().fail("refpos and refquat are not supported");
    if (!m.text("file")) {
      const auto v = m.numbers("vertex");
      if (v.size() < 12 || v.size() % 3 != 0) m.xml().fail("needs a file, or four vertices or more");
      std::vector<Vec3> points;
      for (std::size_t i = 0; i < v.size(); i += 3)
        points.push_back(Vec3(v[i], v[i + 1], v[i + 2]).cwiseProduct(scale));
      try {
        Shape hull = make_hull(std::move(points));
        validate(hull);
        return hull;
      } catch (const InputError& e) {
        m.xml().fail(e.what());
      }
    }
    return context_.mesh(document_.asset_file(m), scale, true, m.xml().place());
  }

  std::optional<Shape> height_field_in(const MjcfElement& g) {
    const std::string name = g.text("hfield").value_or("");
    const MjcfElement field(document_.need_asset("hfield", name, g.xml()), document_.defaults(), "");
    try {
      return height_field_of(field);
    } catch (const InputError& e) {
      context_.refuse(field.xml(), e.place() == field.xml().place() ? e.reason() : e.what());
      return std::nullopt;
    }
  }

  // MuJoCo fills it down to a base, whose thickness is the fourth size; here it is a surface.
  Shape height_field_of(const MjcfElement& f) const {
    HeightGrid grid = f.text("file") ? read_height_file(document_.asset_file(f)) : written_heights(f);
    normalize(grid);
    const std::vector<double> size = f.numbers("size");
    if (size.size() != 4 || !std::all_of(size.begin(), size.end(), [](double x) { return x > 0; }))
      throw InputError("", "needs a size of four positive numbers");
    return surface_of(grid, size[0], size[1], size[2]);
  }

  const MjcfDocument& document_;
  ImportContext& context_;
};

}  // namespace

Shape sized_shape(const std::string& type, const std::vector<double>& size, const XmlElement& e) {
  const std::size_t need = type == "sphere" ? 1 : type == "capsule" || type == "cylinder" ? 2 : 3;
  if (size.size() < need)
    e.fail("size has " + std::to_string(size.size()) + " numbers instead of " + std::to_string(need));
  if (type == "sphere") return Sphere{size[0]};
  if (type == "capsule") return Capsule{size[0], size[1]};
  if (type == "cylinder") return Cylinder{size[0], size[1]};
  if (type == "box") return Box{Vec3(size[0], size[1], size[2])};
  return Ellipsoid{Vec3(size[0], size[1], size[2])};
}

std::optional<Shape> mjcf_shape(const MjcfElement& geom, const MjcfDocument& document, ImportContext& context,
                                Pose& pose) {
  return ShapeReader(document, context).shape_in(geom, pose);
}

}  // namespace touchstone
