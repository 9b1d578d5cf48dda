// The product's source files as the scanners of this folder read them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone::arch {

/// A letter, a digit or an underscore.
bool is_of_name(char c);

struct SourceFile {
  std::string path;  // from the root of the repository
  std::string text;
  /// `text` with every comment, string, character literal and preprocessor line overwritten by spaces; line
  /// breaks are kept, so that both have the same places.
  std::string code;

  std::size_t line_at(std::size_t place) const;  // counted from 1
  /// The text of a line, without its line break; empty beyond the file.
  std::string_view line(std::size_t number) const;
};

SourceFile as_source(std::string path, std::string text);

/// All .h, .cpp and .c files of the named folders, sorted by path.
std::vector<SourceFile> sources(const std::vector<std::string>& folders);

/// The rooms of the product: everything but tests.
const std::vector<SourceFile>& product_sources();

}  // namespace touchstone::arch
