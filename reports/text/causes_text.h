// The causes of a campaign's findings, for people: in a terminal, in an issue tracker, on a page.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "reports/record/causes.h"

namespace touchstone::reports {

/// All causes in 80 columns, one block each; the commands may be longer. `command` is what prints this list:
/// with `--cause ID` it prints one in full.
std::string causes_text(const fuzz::Causes& c, const std::string& command);

/// One cause in full.
std::string cause_text(const fuzz::Cause& c);

/// One cause as Markdown, to paste into an issue tracker. Text from data is escaped; a case, certificate or
/// program that would exceed what trackers accept is left out, and said so.
std::string cause_markdown(const fuzz::Cause& c);

/// The fewest last words of an id that tell it from all others: "1a2b3c" of "fcl-libccd-depth-1a2b3c", or
/// "depth-1a2b3c" if there is also "fcl-libccd-points-1a2b3c".
std::string_view code_of(const fuzz::Cause& c, const fuzz::Causes& all);

/// Whether the code is the cause's id or last words of it.
bool is_named(const fuzz::Cause& c, std::string_view code);

/// Name of the library that an engine path is of: "FCL" for "fcl-libccd".
using LibraryOf = std::function<std::string(const std::string& path)>;

/// The end of what a campaign prints: for each library its first `most` causes, one in a line that begins
/// with its code and the number of wrong answers, and how many there are besides.
std::string causes_of_libraries(const fuzz::Causes& c, std::size_t most, const LibraryOf& library_of);

/// Rows of a table on the page of the campaign in `directory`: {"command": shows all causes, "list": [...]},
/// each with the command that shows it.
fuzz::Json cause_rows(const fuzz::Causes& c, const std::string& directory);

/// The data of the page `causes`.
fuzz::Json causes_page(const fuzz::Causes& c);

}  // namespace touchstone::reports
