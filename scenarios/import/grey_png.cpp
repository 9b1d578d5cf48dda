#include "scenarios/import/height_field.h"

#include <zlib.h>

#include <cstdlib>
#include <string_view>

#include "core/base/input_error.h"

namespace touchstone {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::uint32_t big_endian(std::string_view s) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<std::uint8_t>(s[k]);
  return value;
}

struct Chunk {
  std::string_view type, data;
};

class Chunks {
 public:
  Chunks(std::string_view bytes, const std::string& place) : rest_(bytes), place_(place) {
    constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";
    if (!rest_.starts_with(signature)) fail("is not a PNG image");
    rest_.remove_prefix(signature.size());
  }

  Chunk next() {
    constexpr std::size_t around = 12;  // length, type and checksum
    if (rest_.size() < around) fail("ends before the image does");
    const std::size_t length = big_endian(rest_);
    if (length > rest_.size() - around) fail("has a chunk that is longer than the file");
    const std::string_view checked = rest_.substr(4, 4 + length);
    const auto sum =
        crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size()));
    if (sum != big_endian(rest_.substr(8 + length))) fail("has a chunk with a wrong checksum");
    rest_.remove_prefix(around + length);
    return {checked.substr(0, 4), checked.substr(4)};
  }

  [[noreturn]] void fail(const std::string& reason) const { throw InputError(place_, reason); }

 private:
  std::string_view rest_;
  const std::string& place_;
};

GreyImage header_of(const Chunks& in, const Chunk& c, std::size_t most_pixels) {
  constexpr std::size_t header_bytes = 13;
  if (c.type != "IHDR" || c.data.size() != header_bytes) in.fail("does not begin with an image header");
  GreyImage image;
  image.width = big_endian(c.data);
  image.height = big_endian(c.data.substr(4));
  if (image.width == 0 || image.height == 0) in.fail("is empty");
  if (image.width > most_pixels / image.height)
    in.fail("has more than " + std::to_string(most_pixels) + " pixels");
  // Bit depth, colour type, compression, filter method, interlacing.
  if (c.data.substr(8) != std::string_view("\x08\0\0\0\0", 5))
    in.fail("is not an image of 8-bit grey values without alpha and interlacing");
  return image;
}

Bytes inflated(const Chunks& in, const std::string& data, std::size_t size) {
  Bytes out(size);
  uLongf length = size;
  const int code = uncompress(out.data(), &length, reinterpret_cast<const Bytef*>(data.data()),
                              static_cast<uLong>(data.size()));
  if (code != Z_OK || length != size) in.fail("its pixels are damaged");
  return out;
}

// The one of a, b and c that is nearest to a + b − c, the first of them if several are.
std::uint8_t nearest_to_sum(int a, int b, int c) {
  const int p = a + b - c, to_a = std::abs(p - a), to_b = std::abs(p - b), to_c = std::abs(p - c);
  return static_cast<std::uint8_t>(to_a <= to_b && to_a <= to_c ? a : to_b <= to_c ? b : c);
}

// What the row's filter adds to a pixel with these neighbours.
int predicted(int filter, int left, int above, int corner) {
  switch (filter) {
    case 1:
      return left;
    case 2:
      return above;
    case 3:
      return (left + above) / 2;
    case 4:
      return nearest_to_sum(left, above, corner);
    default:
      return 0;
  }
}

}  // namespace

GreyImage grey_png(const std::string& bytes, std::size_t most_pixels, const std::string& place) {
  Chunks in(bytes, place);
  GreyImage image = header_of(in, in.next(), most_pixels);
  std::string data;
  for (Chunk c = in.next(); c.type != "IEND"; c = in.next()) {
    if (c.type == "IDAT") data.append(c.data);
  }
  const std::size_t row_bytes = image.width + 1;
  const Bytes filtered = inflated(in, data, row_bytes * image.height);
  image.pixels.resize(image.width * image.height);
  for (std::size_t y = 0; y < image.height; ++y) {
    const int filter = filtered[y * row_bytes];
    if (filter > 4) in.fail("its pixels are damaged");
    for (std::size_t x = 0; x < image.width; ++x) {
      const std::size_t at = y * image.width + x;
      const int left = x > 0 ? image.pixels[at - 1] : 0, above = y > 0 ? image.pixels[at - image.width] : 0;
      const int corner = x > 0 && y > 0 ? image.pixels[at - image.width - 1] : 0;
      image.pixels[at] =
          static_cast<std::uint8_t>(filtered[y * row_bytes + 1 + x] + predicted(filter, left, above, corner));
    }
  }
  return image;
}

}  // namespace touchstone
