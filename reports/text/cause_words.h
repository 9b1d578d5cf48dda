// The words that describe a cause in every form: text, Markdown, page.
#pragma once

#include <string>
#include <vector>

#include "reports/record/causes.h"

namespace touchstone::reports {

/// One line: printable, with spaces in place of line breaks.
std::string one_line(std::string_view words);

/// The same as Markdown: it does not become markup, mention a user or end a table's cell.
std::string markdown_prose(std::string_view words);

/// A share for people: "<0.1 %", "3.1 %", "64 %". Only 0 is "0 %", only all is "100 %".
std::string share_text(double share);

/// "1,204 of 3,880 wrong (31 %): systematic".
std::string rate_text(const fuzz::Cause& c);

/// "a, b, c and 4 more": as many items as fit in `width` characters, at least one.
std::string listed(const std::vector<std::string>& items, std::size_t width);

/// "2 bodies, 3 steps, 41 bits".
std::string size_text(const CaseSize& s);

/// The right behaviour, in one sentence.
std::string_view expected_of(fuzz::Severity s);

/// The interventions that apply, those first that make the fault vanish.
std::vector<fuzz::Responded> telling_responses(const fuzz::Cause& c);

/// What an answer of this kind means, for the response table: "the fault is gone".
std::string_view words_of(fuzz::Response r);

/// The command that prints one cause in full; `command` runs `causes` on the directory.
std::string command_of(const fuzz::Cause& c, const std::string& command);

}  // namespace touchstone::reports
