// Height fields as surfaces.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/shape/triangle_mesh.h"

namespace touchstone {

/// Heights over a grid of points: columns along +x, rows along +y.
struct HeightGrid {
  std::size_t rows = 0, columns = 0;
  std::vector<float> heights;  // rows·columns, row by row, the one of least y first
  float at(std::size_t row, std::size_t column) const { return heights[row * columns + column]; }
};

/// The most heights that a grid may have: a mesh of two million triangles.
inline constexpr std::size_t most_heights = std::size_t{1} << 20;

/// Throws InputError at `place` for fewer than two rows or columns, or too many heights.
void require_grid_size(double rows, double columns, const std::string& place);

/// A PNG image of 8-bit grey values, its top row the one of greatest y; or MuJoCo's own format: rows and
/// columns as 32-bit integers, then the heights as 32-bit floats, all little-endian. By the file's ending.
/// Throws InputError naming the file.
HeightGrid read_height_file(const std::filesystem::path& file);

/// Subtracts the least height and divides by the greatest that remains, if that is not zero; in floats, as
/// MuJoCo does.
void normalize(HeightGrid& grid);

/// The grid over [−half_x, half_x] × [−half_y, half_y], its heights times `height` as z. See
/// height_surface. Precondition: require_grid_size.
TriangleMesh surface_of(const HeightGrid& grid, double half_x, double half_y, double height);

struct GreyImage {
  std::size_t width = 0, height = 0;
  std::vector<std::uint8_t> pixels;  // row by row from the top
};

/// An image of 8-bit grey values without alpha, not interlaced. Throws InputError at `place` for any other,
/// for one of more than `most_pixels`, and for damage: lengths, order and checksums of chunks are checked.
GreyImage grey_png(const std::string& bytes, std::size_t most_pixels, const std::string& place);

}  // namespace touchstone
