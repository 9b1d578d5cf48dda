#include "cli/shell.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <vector>

namespace touchstone::cli {

std::string shell_word(const std::filesystem::path& path) {
  std::string out = "'";
  for (const char c : path.string())
    if (c == '\'')
      out += "'\\''";
    else
      out += c;
  return out + "'";
}

std::string end_of_log(const std::filesystem::path& file, std::size_t most) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  std::string out;
  for (std::size_t i = lines.size() - std::min(most, lines.size()); i < lines.size(); ++i)
    out += lines[i] + "\n";
  return out;
}

bool has_program(const char* name) {
  return std::system(fmt::format("command -v {} >/dev/null 2>&1", name).c_str()) == 0;
}

}  // namespace touchstone::cli
