// The width of text in a terminal.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace touchstone::test {

/// Characters, not bytes. None of those that the program prints is wide.
inline std::ptrdiff_t characters(std::string_view utf8) {
  return std::count_if(utf8.begin(), utf8.end(),
                       [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
}

}  // namespace touchstone::test
