#include "cli/query_file.h"

#include <fmt/format.h>

#include <fstream>
#include <iostream>

#include "core/base/input_error.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::cli {
namespace {

using Json = nlohmann::ordered_json;

bool is_blank(const std::string& line) { return line.find_first_not_of(" \t\r") == line.npos; }

// The next line without its newline. False at the end of the input.
bool next_line(std::istream& in, std::string& line, const std::string& place) {
  line.clear();
  for (int c = in.get(); c != std::istream::traits_type::eof(); c = in.get()) {
    if (c == '\n') return true;
    line.push_back(static_cast<char>(c));
    if (line.size() > longest_query_line)
      throw InputError(place, fmt::format("is longer than {} MiB", longest_query_line >> 20));
  }
  if (in.bad()) throw InputError(place, "cannot be read");
  return !line.empty();
}

void for_each_line(const std::string& path,
                   const std::function<void(const std::string& text, const std::string& place)>& visit) {
  const bool is_stdin = path == "-";
  std::ifstream file;
  if (!is_stdin) {
    require_regular_file(path);
    file.open(path, std::ios::binary);
    if (!file) throw InputError(path, "cannot be opened");
  }
  std::istream& in = is_stdin ? std::cin : file;
  const std::string name = is_stdin ? "stdin" : path;
  std::string line;
  std::uint64_t number = 1, found = 0;
  for (; next_line(in, line, fmt::format("{}:{}", name, number)); ++number) {
    if (is_blank(line)) continue;
    ++found;
    visit(line, fmt::format("{}:{}", name, number));
  }
  if (found == 0) throw InputError(name, "is empty");
}

}  // namespace

bool is_query_file(const std::string& path) { return path == "-" || path.ends_with(".jsonl"); }

void for_each_query(const std::string& path,
                    const std::function<void(const fuzz::QueryLine&, const std::string& place)>& visit) {
  for_each_line(path, [&](const std::string& text, const std::string& place) {
    visit(fuzz::query_line_from_json(parse_json(text, place, {}), place), place);
  });
}

std::vector<fuzz::StatedAnswer> load_stated_answers(const std::string& path) {
  std::vector<fuzz::StatedAnswer> all;
  const auto add = [&](const Json& j, const std::string& place, const std::string& at) {
    all.push_back(fuzz::stated_answer_from_json(JsonReader(j, place, at)));
  };
  if (is_query_file(path)) {
    for_each_line(path, [&](const std::string& text, const std::string& place) {
      add(parse_json(text, place, {}), place, "");
    });
    return all;
  }
  const Json j = load_json(path);
  if (!j.is_array())
    add(j, path, "");
  else
    for (std::size_t i = 0; i < j.size(); ++i) add(j[i], path, fmt::format("[{}]", i));
  return all;
}

}  // namespace touchstone::cli
