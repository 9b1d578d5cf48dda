// A height field as a surface of triangles.
#pragma once

#include <cstddef>

#include "core/shape/triangle_mesh.h"

namespace touchstone {

/// The surface over a grid of points: at(row, column), rows along +y, columns along +x. Each cell is two
/// triangles, which share the diagonal from its corner of least x and y to the opposite one; they are
/// counter-clockwise from above. Precondition: at least two rows and columns.
template <class At>
TriangleMesh height_surface(std::size_t rows, std::size_t columns, At&& at) {
  TriangleMesh m;
  m.vertices.reserve(rows * columns);
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) m.vertices.push_back(at(r, c));
  const int width = static_cast<int>(columns);
  for (int r = 0; r + 1 < static_cast<int>(rows); ++r)
    for (int c = 0; c + 1 < width; ++c) {
      const int corner = r * width + c, above = corner + width;
      m.triangles.push_back({corner, corner + 1, above + 1});
      m.triangles.push_back({corner, above + 1, above});
    }
  return m;
}

/// The same with cells of dx times dy, centred at the origin: what a scene's "height_field" denotes. The
/// height is height(row, column).
template <class Height>
TriangleMesh centred_height_surface(std::size_t rows, std::size_t columns, double dx, double dy,
                                    Height&& height) {
  const auto offset = [](std::size_t i, std::size_t n) {
    return static_cast<double>(i) - static_cast<double>(n - 1) / 2;
  };
  return height_surface(rows, columns, [&](std::size_t r, std::size_t c) {
    return Vec3(dx * offset(c, columns), dy * offset(r, rows), height(r, c));
  });
}

}  // namespace touchstone
