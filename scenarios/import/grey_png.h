// Grey images in PNG (ISO/IEC 15948).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace touchstone {

struct GreyImage {
  std::size_t width = 0, height = 0;
  std::vector<std::uint8_t> pixels;  // row by row from the top
};

/// An image of 8-bit grey values without alpha, not interlaced. Throws InputError at `place` for any other,
/// for one of more than `most_pixels`, and for damage: lengths, order and checksums of chunks are checked.
GreyImage grey_png(const std::string& bytes, std::size_t most_pixels, const std::string& place);

}  // namespace touchstone
