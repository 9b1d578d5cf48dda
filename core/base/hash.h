// FNV-1a, 64 bit, over bytes in a fixed order. Used for case names and to compare runs, not for security.
// Doubles are hashed by bit pattern, so -0 and +0 differ, as they do for the engines.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <string_view>

namespace touchstone {

class Hasher {
 public:
  Hasher& bytes(const void* data, std::size_t n) {
    const auto* p = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < n; ++i) state_ = (state_ ^ p[i]) * 0x100000001b3ULL;
    return *this;
  }
  Hasher& add(std::uint64_t v) {
    for (int i = 0; i < 8; ++i, v >>= 8) state_ = (state_ ^ (v & 0xff)) * 0x100000001b3ULL;
    return *this;
  }
  template <std::integral T>
  Hasher& add(T v) {
    return add(static_cast<std::uint64_t>(static_cast<std::int64_t>(v)));
  }
  Hasher& add(double v) { return add(std::bit_cast<std::uint64_t>(v)); }
  Hasher& add(std::string_view s) { return add(s.size()).bytes(s.data(), s.size()); }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

}  // namespace touchstone
