// Meshes that are height fields, for engines with a shape of that kind.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace touchstone::kit {

struct HeightField {
  std::size_t rows = 0, columns = 0;  // of points, at least 2
  std::array<double, 2> cell{};       // lengths of a cell along x and y
};

namespace detail {

/// Coordinates of a grid may differ by a few roundings from multiples of the cell's length, as share of the
/// whole length. Tested by tests/scenarios/import/recognised_field_test.cpp.
inline constexpr double grid_roundings = 0x1p-50;

/// Whether n numbers, at(i), are evenly spaced around 0; returns their step, else 0.
template <class At>
double even_step(std::size_t n, At at) {
  const double length = at(n - 1) - at(0), step = length / static_cast<double>(n - 1);
  if (!(length > 0) || !std::isfinite(length)) return 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double place = step * (static_cast<double>(i) - static_cast<double>(n - 1) / 2);
    if (!(std::abs(at(i) - place) <= grid_roundings * length)) return 0;
  }
  return step;
}

/// The triangles of scenarios/value/height_surface.h.
inline bool are_of_grid(std::span<const std::int32_t> triangles, std::size_t rows, std::size_t columns) {
  std::size_t next = 0;
  const auto is_next = [&](std::size_t a, std::size_t b, std::size_t c) {
    const std::array<std::size_t, 3> wanted{a, b, c};
    return std::ranges::all_of(
        wanted, [&](std::size_t v) { return triangles[next++] == static_cast<std::int32_t>(v); });
  };
  for (std::size_t r = 0; r + 1 < rows; ++r)
    for (std::size_t c = 0; c + 1 < columns; ++c) {
      const std::size_t corner = r * columns + c, above = corner + columns;
      if (!is_next(corner, corner + 1, above + 1) || !is_next(corner, above + 1, above)) return false;
    }
  return true;
}

}  // namespace detail

/// The grid of a mesh that is written as a scene's height fields are: points row by row, columns along +x and
/// rows along +y, evenly spaced and centred at the origin; each cell two triangles, counter-clockwise from
/// above, that share the diagonal from its corner of least x and y. The z of each point is its height.
/// `vertices`: n×3; `triangles`: m×3. Any other mesh has none.
inline std::optional<HeightField> height_field_of(std::span<const double> vertices,
                                                  std::span<const std::int32_t> triangles) {
  const std::size_t points = vertices.size() / 3;
  if (triangles.size() < 6 || triangles[0] != 0 || triangles[1] != 1 || triangles[2] < 3) return std::nullopt;
  HeightField f;
  f.columns = static_cast<std::size_t>(triangles[2]) - 1;
  f.rows = points / f.columns;
  if (f.rows < 2 || f.rows * f.columns != points) return std::nullopt;
  if (triangles.size() != 6 * (f.rows - 1) * (f.columns - 1)) return std::nullopt;
  if (!detail::are_of_grid(triangles, f.rows, f.columns)) return std::nullopt;
  const auto coordinate = [&](std::size_t row, std::size_t column, std::size_t axis) {
    return vertices[3 * (row * f.columns + column) + axis];
  };
  f.cell = {detail::even_step(f.columns, [&](std::size_t c) { return coordinate(0, c, 0); }),
            detail::even_step(f.rows, [&](std::size_t r) { return coordinate(r, 0, 1); })};
  if (!(f.cell[0] > 0 && f.cell[1] > 0)) return std::nullopt;
  for (std::size_t r = 0; r < f.rows; ++r)
    for (std::size_t c = 0; c < f.columns; ++c)
      if (coordinate(r, c, 0) != coordinate(0, c, 0) || coordinate(r, c, 1) != coordinate(r, 0, 1) ||
          !std::isfinite(coordinate(r, c, 2)))
        return std::nullopt;
  return f;
}

/// The same of a mesh with lists of points and of triples, such as TriangleMesh.
template <class Mesh>
std::optional<HeightField> height_field_of(const Mesh& m) requires requires {
  m.vertices.front().data();
}
{
  if (m.vertices.empty() || m.triangles.empty()) return std::nullopt;
  return height_field_of({m.vertices.front().data(), 3 * m.vertices.size()},
                         {m.triangles.front().data(), 3 * m.triangles.size()});
}

}  // namespace touchstone::kit
