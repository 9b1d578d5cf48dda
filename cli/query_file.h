// Questions in JSON lines: from a file, or from standard input as they arrive.
#pragma once

#include <functional>
#include <string>

#include "fuzz/answer/query_line.h"

namespace touchstone::cli {

/// Longest line in bytes, and most lines of a file.
inline constexpr std::size_t longest_query_line = std::size_t{16} << 20;

/// "-", or a file whose name ends in .jsonl.
bool is_query_file(const std::string& path);

/// Calls `visit(line, place)` for each line that is not blank, in order, before the next one is read; place
/// is "FILE:LINE", "stdin:LINE" for "-". Throws InputError for a line that cannot be read, and for a file
/// without any.
void for_each_query(const std::string& path,
                    const std::function<void(const fuzz::QueryLine&, const std::string& place)>& visit);

/// The stated answers of a file: one JSON object, an array of them, or one a line. Throws InputError.
std::vector<fuzz::StatedAnswer> load_stated_answers(const std::string& path);

}  // namespace touchstone::cli
