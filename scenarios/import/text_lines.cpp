#include "scenarios/import/text_lines.h"

#include <charconv>
#include <cmath>
#include <utility>

#include "core/base/exact_text.h"
#include "core/base/input_error.h"
#include "scenarios/codec/scene_codec.h"

namespace touchstone {

TextLines::TextLines(const std::filesystem::path& file, char separator)
    : file_(file.string()), text_(read_file(file)), separator_(separator) {}

TextLines::TextLines(const std::filesystem::path& file, std::string text, char separator)
    : file_(file.string()), text_(std::move(text)), separator_(separator) {}

std::string TextLines::place() const { return file_ + ":" + std::to_string(line_); }

void TextLines::fail(const std::string& reason) const { throw InputError(place(), reason); }

bool TextLines::next() {
  while (pos_ < text_.size()) {
    const std::string_view all = text_;
    const std::size_t end = std::min(all.find('\n', pos_), all.size());
    current_ = all.substr(pos_, end - pos_);
    if (!current_.empty() && current_.back() == '\r') current_.remove_suffix(1);
    pos_ = end + 1;
    ++line_;
    if (current_.empty() || (separator_ == ' ' && current_.front() == '#')) continue;
    tokens_.clear();
    for (std::size_t start = 0; start <= current_.size();) {
      const std::size_t stop = std::min(current_.find(separator_, start), current_.size());
      if (separator_ != ' ' || stop > start) tokens_.push_back(current_.substr(start, stop - start));
      start = stop + 1;
    }
    if (!tokens_.empty()) return true;
  }
  return false;
}

void TextLines::need(std::string_view expected) {
  if (!next()) fail("the file ends here; expected " + std::string(expected));
}

void TextLines::need_tokens(std::size_t n) const {
  if (tokens_.size() != n)
    fail("expected " + std::to_string(n) + " values, found " + std::to_string(tokens_.size()));
}

std::string_view TextLines::token(std::size_t i) const {
  if (i >= tokens_.size()) fail("the line ends after " + std::to_string(tokens_.size()) + " values");
  return tokens_[i];
}

double TextLines::number(std::size_t i) const {
  const auto v = double_from_text(token(i));
  if (!v) fail("\"" + std::string(token(i)) + "\" is not a number");
  if (!std::isfinite(*v)) fail("\"" + std::string(token(i)) + "\" is not finite");
  return *v;
}

int TextLines::integer(std::size_t i) const {
  const std::string_view s = token(i);
  int v = 0;
  const auto r = std::from_chars(s.data(), s.data() + s.size(), v);
  if (r.ec != std::errc{} || r.ptr != s.data() + s.size())
    fail("\"" + std::string(s) + "\" is not a whole number");
  return v;
}

int TextLines::integer(std::size_t i, int lo, int hi) const {
  const int v = integer(i);
  if (v < lo || v > hi)
    fail(std::to_string(v) + " is outside " + std::to_string(lo) + ".." + std::to_string(hi));
  return v;
}

Vec3 TextLines::vec3(std::size_t first) const {
  return {number(first), number(first + 1), number(first + 2)};
}

Quat TextLines::quat(std::size_t first) const {
  const Quat q{number(first), number(first + 1), number(first + 2), number(first + 3)};
  if (q.x == 0 && q.y == 0 && q.z == 0 && q.w == 0) fail("the zero quaternion denotes no rotation");
  return q;
}

void TextLines::need_header(std::string_view columns) {
  need("the header " + std::string(columns));
  if (current_ != columns) fail("expected the header " + std::string(columns));
}

}  // namespace touchstone
