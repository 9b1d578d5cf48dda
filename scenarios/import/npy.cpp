#include "scenarios/import/real_scene.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/input_error.h"
#include "scenarios/codec/scene_codec.h"

namespace touchstone {
namespace {

std::uint64_t little_endian(std::string_view bytes, std::size_t at, std::size_t n) {
  std::uint64_t v = 0;
  for (std::size_t i = 0; i < n; ++i)
    v |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  return v;
}

std::string_view value_of(std::string_view header, std::string_view key, const std::string& file) {
  const std::size_t at = header.find(key);
  if (at == std::string_view::npos) throw InputError(file, "NumPy header has no " + std::string(key));
  std::string_view v = header.substr(at + key.size());
  while (!v.empty() && (v.front() == ' ' || v.front() == ':')) v.remove_prefix(1);
  return v;
}

std::array<std::size_t, 3> shape_of(std::string_view header, const std::string& file) {
  std::string_view v = value_of(header, "'shape'", file);
  std::array<std::size_t, 3> shape{};
  const char* p = v.data();
  const char* const end = v.data() + v.size();
  for (std::size_t i = 0; i < 3; ++i) {
    while (p != end && (*p == '(' || *p == ' ' || *p == ',')) ++p;
    const auto r = std::from_chars(p, end, shape[i]);
    // The bound keeps the product of three axes within 64 bits.
    if (r.ec != std::errc{} || shape[i] > (1u << 20)) throw InputError(file, "NumPy shape must be (F, N, C)");
    p = r.ptr;
  }
  while (p != end && (*p == ' ' || *p == ',')) ++p;
  if (p == end || *p != ')') throw InputError(file, "NumPy shape must be (F, N, C)");
  return shape;
}

}  // namespace

Npy3 load_npy3(const std::filesystem::path& path) {
  const std::string file = path.string(), bytes = read_file(path);
  if (bytes.size() < 10 || bytes.compare(0, 8, std::string_view("\x93NUMPY\x01\x00", 8)) != 0)
    throw InputError(file, "is not a NumPy file of format 1.0");
  const std::size_t data = 10 + static_cast<std::size_t>(little_endian(bytes, 8, 2));
  if (bytes.size() < data) throw InputError(file, "is cut off within its header");
  const std::string_view header = std::string_view(bytes).substr(10, data - 10);
  if (!value_of(header, "'descr'", file).starts_with("'<f8'"))
    throw InputError(file, "must hold type '<f8' (little-endian double)");
  if (!value_of(header, "'fortran_order'", file).starts_with("False"))
    throw InputError(file, "is not in C order");
  Npy3 a;
  a.shape = shape_of(header, file);
  const std::size_t n = a.shape[0] * a.shape[1] * a.shape[2];
  if (bytes.size() != data + 8 * n)
    throw InputError(file, "has " + std::to_string(bytes.size() - data) + " bytes of data, its shape needs " +
                               std::to_string(8 * n));
  a.values.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    a.values[i] = std::bit_cast<double>(little_endian(bytes, data + 8 * i, 8));
    if (!std::isfinite(a.values[i])) throw InputError(file, "value " + std::to_string(i) + " is not finite");
  }
  return a;
}

}  // namespace touchstone
