// The line of a terminal that says how far a command is.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace touchstone::cli {

/// "120 of 400 pairs" on stderr, written anew when the whole percentage changes; nothing unless stderr is a
/// terminal.
class ProgressLine {
 public:
  void show(std::string_view what, std::uint64_t done, std::uint64_t of) {
    const std::uint64_t percent = of > 0 ? 100 * done / of : 0;
    if (!live_ || (what == what_ && percent == percent_)) return;
    what_ = what;
    percent_ = percent;
    fmt::print(stderr, "\r\033[K{} of {} {}", done, of, what);
  }
  void clear() const {
    if (live_) fmt::print(stderr, "\r\033[K");
  }

 private:
  bool live_ = isatty(2) == 1;
  std::string what_;
  std::uint64_t percent_ = 0;
};

}  // namespace touchstone::cli
