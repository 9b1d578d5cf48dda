// NumPy arrays of format 1.0, little-endian doubles, C order, three axes: recorded poses.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <vector>

namespace touchstone {

struct Npy3 {
  std::array<std::size_t, 3> shape{};  // frames, bodies, columns
  std::vector<double> values;
  std::span<const double> row(std::size_t i, std::size_t j) const {
    return std::span(values).subspan((i * shape[1] + j) * shape[2], shape[2]);
  }
};

/// Throws InputError "file: reason" on another format, a file of the wrong length, or a value that is not
/// finite.
Npy3 load_npy3(const std::filesystem::path& file);

}  // namespace touchstone
