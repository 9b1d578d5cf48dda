// The core beside the engines as shipped, as the README shows it: a small part of a chart, and its block of
// Markdown.
#pragma once

#include <string>

#include "reports/record/chart.h"

namespace touchstone::reports {

/// The rows that the block needs, and the engines that they name. The excerpt of an excerpt is itself.
fuzz::Chart chart_excerpt(const fuzz::Chart& c);

/// A table of the excerpt with what it was measured on, between the markers below.
std::string chart_markdown(const fuzz::Chart& excerpt);

/// `text` with everything between the markers replaced by `block`. Throws InputError, which names `file`,
/// when it does not have one marker of each kind, in order.
std::string with_chart_block(const std::string& text, const std::string& block, const std::string& file);

inline constexpr const char* chart_begin = "<!-- chart: generated -->\n";
inline constexpr const char* chart_end = "<!-- chart: end -->\n";

}  // namespace touchstone::reports
