// The causes of a campaign's findings, for people: in a terminal, in an issue tracker, on a page.
#pragma once

#include <string>

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

/// The end of what a campaign prints: for each engine path its first `per_engine` causes, each with its
/// command, unless the campaign is stored nowhere (`directory` is empty).
std::string causes_of_engines(const fuzz::Causes& c, std::size_t per_engine, const std::string& directory,
                              const std::string& program);

/// The data of the page `causes`.
fuzz::Json causes_page(const fuzz::Causes& c);

}  // namespace touchstone::reports
