// Line-oriented text: blank-separated tokens or CSV, with errors of the form "file:line: reason".
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/pose.h"

namespace touchstone {

/// Iterates over the lines of a file and the tokens of a line.
class TextLines {
 public:
  TextLines(const std::filesystem::path& file, char separator);
  /// Of that text, which errors name as the file.
  TextLines(const std::filesystem::path& file, std::string text, char separator);

  /// Advances to the next line that is not empty and, in blank-separated text, not a `#` comment. False at
  /// the end.
  bool next();
  /// The same, but the end of the file is an error; `expected` describes what is missing.
  void need(std::string_view expected);
  [[noreturn]] void fail(const std::string& reason) const;
  std::string place() const;

  std::size_t token_count() const { return tokens_.size(); }
  void need_tokens(std::size_t n) const;
  std::string_view token(std::size_t i) const;  // fails when the line has fewer tokens
  double number(std::size_t i) const;           // finite
  int integer(std::size_t i) const;
  int integer(std::size_t i, int lo, int hi) const;
  Vec3 vec3(std::size_t first) const;
  Quat quat(std::size_t first) const;  // x y z w
  /// The first line must consist of exactly these column names.
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
