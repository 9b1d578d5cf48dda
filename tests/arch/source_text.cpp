#include "tests/arch/source_text.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace touchstone::arch {
namespace {

namespace fs = std::filesystem;

/// Overwrites what is no code, from the start to the end of a file.
class Blanking {
 public:
  explicit Blanking(const std::string& text) : text_(text), code_(text) {}

  std::string run() {
    while (at_ < text_.size()) {
      if (starts("//")) {
        blank_to(end_of_line(at_));
      } else if (starts("/*")) {
        blank_to(after("*/", at_ + 2));
      } else if (starts("R\"") && !follows_name()) {
        const std::size_t open = text_.find('(', at_);
        blank_to(after(")" + text_.substr(at_ + 2, open - at_ - 2) + "\"", open));
      } else if (text_[at_] == '"') {
        blank_to(after_quotes('"'));
      } else if (text_[at_] == '\'' && !follows_name()) {  // within a number it separates digits
        blank_to(after_quotes('\''));
      } else if (text_[at_] == '#' && begins_line()) {
        blank_to(end_of_directive());
      } else {
        ++at_;
      }
    }
    return code_;
  }

 private:
  bool starts(std::string_view s) const { return std::string_view(text_).substr(at_).starts_with(s); }
  bool follows_name() const { return at_ > 0 && is_of_name(text_[at_ - 1]); }
  bool begins_line() const {
    const std::size_t last = at_ == 0 ? std::string::npos : text_.find_last_not_of(" \t", at_ - 1);
    return last == std::string::npos || text_[last] == '\n';
  }
  std::size_t end_of_line(std::size_t from) const { return std::min(text_.find('\n', from), text_.size()); }
  std::size_t end_of_directive() const {
    std::size_t end = end_of_line(at_);
    while (end < text_.size() && text_[end - 1] == '\\') end = end_of_line(end + 1);
    return std::min(end, std::min(text_.find("//", at_), text_.find("/*", at_)));
  }
  std::size_t after(std::string_view s, std::size_t from) const {
    const std::size_t found = text_.find(s, from);
    return found == std::string::npos ? text_.size() : found + s.size();
  }
  std::size_t after_quotes(char quote) const {
    std::size_t i = at_ + 1;
    while (i < text_.size() && text_[i] != quote) i += text_[i] == '\\' ? 2 : 1;
    return std::min(i + 1, text_.size());
  }
  void blank_to(std::size_t end) {
    for (; at_ < end; ++at_)
      if (text_[at_] != '\n') code_[at_] = ' ';
  }

  const std::string& text_;
  std::string code_;
  std::size_t at_ = 0;
};

}  // namespace

bool is_of_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

std::size_t SourceFile::line_at(std::size_t place) const {
  return 1 +
         static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<long>(place), '\n'));
}

std::string_view SourceFile::line(std::size_t number) const {
  std::string_view rest = text;
  for (; number > 1 && !rest.empty(); --number)
    rest.remove_prefix(
        std::min(rest.size(), rest.find('\n') == rest.npos ? rest.size() : rest.find('\n') + 1));
  return rest.substr(0, rest.find('\n'));
}

SourceFile as_source(std::string path, std::string text) {
  SourceFile f{std::move(path), std::move(text), {}};
  f.code = Blanking(f.text).run();
  return f;
}

std::vector<SourceFile> sources(const std::vector<std::string>& folders) {
  std::vector<SourceFile> all;
  for (const std::string& folder : folders)
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(TS_SOURCE_DIR) / folder)) {
      const auto extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp" && extension != ".c") continue;
      std::ifstream in(entry.path(), std::ios::binary);
      all.push_back(as_source(fs::relative(entry.path(), TS_SOURCE_DIR).generic_string(),
                              {std::istreambuf_iterator<char>(in), {}}));
    }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return all;
}

const std::vector<SourceFile>& product_sources() {
  static const auto all = sources({"core", "scenarios", "oracles", "fuzz", "reports", "library", "cli"});
  return all;
}

}  // namespace touchstone::arch
