// The README's comparison of the core with the engines as shipped: an excerpt of a chart, and its block of
// Markdown.
#pragma once

#include <string>

#include "reports/record/chart.h"

namespace touchstone::reports {

/// The rows that the block needs and the engines that they name. Idempotent.
fuzz::Chart chart_excerpt(const fuzz::Chart& c);

/// A table of the excerpt and a description of the measurement, to stand between the markers below.
std::string chart_markdown(const fuzz::Chart& excerpt);

/// `text` with everything between the markers replaced by `block`. Throws InputError, naming `file`, if the
/// markers are missing or out of order.
std::string with_chart_block(const std::string& text, const std::string& block, const std::string& file);

inline constexpr const char* chart_begin = "<!-- chart: generated -->\n";
inline constexpr const char* chart_end = "<!-- chart: end -->\n";

}  // namespace touchstone::reports
