#include "scenarios/import/height_field.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/base/input_error.h"
#include "scenarios/codec/scene_codec.h"
#include "scenarios/import/mesh_import.h"
#include "scenarios/value/height_surface.h"

namespace touchstone {
namespace {

std::uint32_t little_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 4; k-- > 0;) value = value << 8 | static_cast<std::uint8_t>(bytes[at + k]);
  return value;
}

HeightGrid from_binary(const std::string& bytes, const std::string& place) {
  constexpr std::size_t header = 8, size = 4;
  if (bytes.size() < header) throw InputError(place, "is too short for the number of rows and columns");
  const std::uint32_t rows = little_endian(bytes, 0), columns = little_endian(bytes, size);
  require_grid_size(rows, columns, place);
  HeightGrid grid{rows, columns, {}};
  const std::size_t count = grid.rows * grid.columns;
  if (bytes.size() != header + size * count)
    throw InputError(place, "has " + std::to_string(bytes.size()) + " bytes instead of " +
                                std::to_string(header + size * count) + " for " + std::to_string(rows) +
                                " rows and " + std::to_string(columns) + " columns");
  for (std::size_t i = 0; i < count; ++i) {
    const auto h = std::bit_cast<float>(little_endian(bytes, header + size * i));
    if (!std::isfinite(h)) throw InputError(place, "height " + std::to_string(i) + " is not finite");
    grid.heights.push_back(h);
  }
  return grid;
}

HeightGrid from_image(const std::string& bytes, const std::string& place) {
  const GreyImage image = grey_png(bytes, most_heights, place);
  require_grid_size(static_cast<double>(image.height), static_cast<double>(image.width), place);
  HeightGrid grid{image.height, image.width, {}};
  for (std::size_t row = image.height; row-- > 0;)
    for (std::size_t column = 0; column < image.width; ++column)
      grid.heights.push_back(static_cast<float>(image.pixels[row * image.width + column]));
  return grid;
}

}  // namespace

void require_grid_size(double rows, double columns, const std::string& place) {
  if (!(rows >= 2 && columns >= 2)) throw InputError(place, "a height field needs two rows and two columns");
  if (rows * columns > static_cast<double>(most_heights))
    throw InputError(place,
                     "a height field of more than " + std::to_string(most_heights) + " heights is not read");
}

HeightGrid read_height_file(const std::filesystem::path& file) {
  constexpr std::uintmax_t most_bytes = std::uintmax_t{16} << 20;
  const std::string bytes = read_file(file, most_bytes);
  return lower_extension(file) == ".png" ? from_image(bytes, file.string())
                                         : from_binary(bytes, file.string());
}

void normalize(HeightGrid& grid) {
  const auto [least, greatest] = std::minmax_element(grid.heights.begin(), grid.heights.end());
  const float from = *least, range = *greatest - from;
  if (!std::isfinite(range)) throw InputError("", "the heights differ by more than a float can hold");
  for (float& h : grid.heights) {
    h -= from;
    if (range > 0) h /= range;
  }
}

TriangleMesh surface_of(const HeightGrid& grid, double half_x, double half_y, double height) {
  const double dx = 2 * half_x / static_cast<double>(grid.columns - 1),
               dy = 2 * half_y / static_cast<double>(grid.rows - 1);
  return height_surface(grid.rows, grid.columns, [&](std::size_t r, std::size_t c) {
    return Vec3(dx * static_cast<double>(c) - half_x, dy * static_cast<double>(r) - half_y,
                height * static_cast<double>(grid.at(r, c)));
  });
}

}  // namespace touchstone
