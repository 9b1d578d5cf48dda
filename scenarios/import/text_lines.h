// Line-oriented text: blank-separated tokens or CSV, with "file:line: reason" for whatever does not parse.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/pose.h"

namespace touchstone {

/// Walks over the lines of a file, and over the tokens of a line.
class TextLines {
 public:
  TextLines(const std::filesystem::path& file, char separator);

  /// Next line that is neither empty nor, for blank-separated text, a `#` comment. False at the end.
  bool next();
  /// Same, but the end of the file is an error: `expected` says what is missing.
  void need(std::string_view expected);
  [[noreturn]] void fail(const std::string& reason) const;
  std::string place() const;

  std::size_t token_count() const { return tokens_.size(); }
  void need_tokens(std::size_t n) const;
  std::string_view token(std::size_t i) const;  // refuses when the line has fewer
  double number(std::size_t i) const;           // finite
  int integer(std::size_t i) const;
  int integer(std::size_t i, int lo, int hi) const;
  Vec3 vec3(std::size_t first) const;
  Quat quat(std::size_t first) const;  // x y z w
  /// First line must be exactly these column names.
  void need_header(std::string_view columns);

 private:
  std::string file_, text_;
  char separator_;
  std::size_t pos_ = 0;
  int line_ = 0;
  std::string_view current_;
  std::vector<std::string_view> tokens_;
};

}  // namespace touchstone
