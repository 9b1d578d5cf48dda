// Files of heights: PNG images of grey values, and MuJoCo's binary format.
#include "scenarios/import/height_field.h"

#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "tests/scenarios/import/expect_error.h"
#include "tests/scenarios/import/temp_dir.h"
#include "tests/support/catch.h"

using namespace touchstone;
using test::contains;
using test::refusal;

namespace {

std::string big_endian(std::size_t x) {
  std::string s;
  for (int shift = 24; shift >= 0; shift -= 8) s.push_back(static_cast<char>(x >> shift));
  return s;
}

std::string chunk(const std::string& type, const std::string& data) {
  const std::string checked = type + data;
  const auto sum =
      crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size()));
  return big_endian(data.size()) + checked + big_endian(sum);
}

const std::string grey_8("\x08\0\0\0\0", 5);

// `rows`: each with the number of its filter first. The image data are divided into two chunks.
std::string png(std::size_t width, std::size_t height, const std::string& rows,
                const std::string& form = grey_8) {
  std::string packed(compressBound(rows.size()), '\0');
  uLongf size = packed.size();
  REQUIRE(compress(reinterpret_cast<Bytef*>(packed.data()), &size,
                   reinterpret_cast<const Bytef*>(rows.data()), rows.size()) == Z_OK);
  packed.resize(size);
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", big_endian(width) + big_endian(height) + form) +
         chunk("tEXt", "a note") + chunk("IDAT", packed.substr(0, 5)) + chunk("IDAT", packed.substr(5)) +
         chunk("IEND", "");
}

std::string little_endian(std::uint32_t x) {
  std::string s;
  for (int shift = 0; shift < 32; shift += 8) s.push_back(static_cast<char>(x >> shift));
  return s;
}

std::string binary(std::uint32_t rows, std::uint32_t columns, const std::vector<float>& heights) {
  std::string s = little_endian(rows) + little_endian(columns);
  for (const float h : heights) s += little_endian(std::bit_cast<std::uint32_t>(h));
  return s;
}

std::string refused_image(const std::string& bytes) {
  return refusal([&] { grey_png(bytes, 100, "a.png"); });
}

}  // namespace

TEST_CASE("a grey PNG image is read, whatever filters its rows have", "[import][height]") {
  // The pixels 10 20 30 / 11 22 33 / 12 24 36 / 13 26 39 / 100 0 255, a row for each filter.
  const std::string rows = std::string("\0\x0a\x14\x1e", 4) + std::string("\x01\x0b\x0b\x0b", 4) +
                           std::string("\x02\x01\x02\x03", 4) + std::string("\x03\x07\x08\x08", 4) +
                           std::string("\x04\x57\x9c\xff", 4);
  const GreyImage image = grey_png(png(3, 5, rows), 100, "a.png");
  CHECK(image.width == 3);
  CHECK(image.height == 5);
  CHECK(image.pixels ==
        std::vector<std::uint8_t>{10, 20, 30, 11, 22, 33, 12, 24, 36, 13, 26, 39, 100, 0, 255});

  const test::TempDir dir;
  const HeightGrid grid = read_height_file(dir.write("a.png", png(3, 5, rows)));
  CHECK(grid.rows == 5);
  CHECK(grid.columns == 3);
  CHECK(grid.at(0, 0) == 100);  // the last row of the image is that of least y
  CHECK(grid.at(4, 2) == 30);
}

TEST_CASE("a PNG image that is damaged or of another kind is refused", "[import][height][bad-input]") {
  const std::string rows = std::string("\0\1\2", 3) + std::string("\0\3\4", 3), good = png(2, 2, rows);
  REQUIRE(grey_png(good, 100, "a.png").pixels == std::vector<std::uint8_t>{1, 2, 3, 4});
  CHECK(contains(refused_image("GIF89a"), "a.png: is not a PNG image"));
  CHECK(contains(refused_image(good.substr(0, good.size() - 12)), "ends before the image does"));
  std::string flipped = good;
  flipped[20] = static_cast<char>(flipped[20] ^ 1);
  CHECK(contains(refused_image(flipped), "wrong checksum"));
  std::string long_chunk = good;
  long_chunk[8] = '\x7f';
  CHECK(contains(refused_image(long_chunk), "longer than the file"));
  CHECK(contains(refused_image(png(0, 2, rows)), "is empty"));
  CHECK(contains(refused_image(png(1 << 30, 1 << 30, rows)), "more than 100 pixels"));
  CHECK(contains(refused_image(png(2, 2, rows, std::string("\x08\2\0\0\0", 5))), "8-bit grey values"));
  CHECK(contains(refused_image(png(2, 2, rows, std::string("\x10\0\0\0\0", 5))), "8-bit grey values"));
  CHECK(contains(refused_image(png(2, 2, rows, std::string("\x08\0\0\0\1", 5))), "interlacing"));
  CHECK(contains(refused_image(png(2, 3, rows)), "pixels are damaged"));
  CHECK(contains(refused_image(png(2, 1, rows)), "pixels are damaged"));
  CHECK(contains(refused_image(png(2, 2, std::string("\5\1\2\0\3\4", 6))), "pixels are damaged"));
}

TEST_CASE("a binary file of heights is read, and refused by name if its size is wrong",
          "[import][height][bad-input]") {
  const test::TempDir dir;
  const auto read = [&](const std::string& bytes) { return read_height_file(dir.write("h.bin", bytes)); };
  HeightGrid grid = read(binary(2, 3, {1, 2, 3, 4, 5, 9}));
  CHECK(grid.heights == std::vector<float>{1, 2, 3, 4, 5, 9});
  normalize(grid);
  CHECK(grid.heights == std::vector<float>{0, 0.125F, 0.25F, 0.375F, 0.5F, 1});
  const auto bad = [&](const std::string& bytes) { return refusal([&] { read(bytes); }); };
  CHECK(contains(bad("1234567"), "h.bin: is too short"));
  CHECK(contains(bad(binary(2, 3, {1, 2, 3})), "has 20 bytes instead of 32 for 2 rows and 3 columns"));
  CHECK(contains(bad(binary(1, 3, {1, 2, 3})), "two rows and two columns"));
  CHECK(contains(bad(binary(1u << 31, 1u << 31, {})), "is not read"));
  CHECK(contains(bad(binary(2, 2, {1, 2, NAN, 4})), "height 2 is not finite"));
  HeightGrid wide = read(binary(2, 2, {-3e38F, 3e38F, 0, 0}));
  CHECK(contains(refusal([&] { normalize(wide); }), "more than a float can hold"));
}
