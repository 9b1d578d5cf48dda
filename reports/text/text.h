// Results as text in 80 columns.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/record/result.h"

namespace touchstone::reports {

/// One row an engine, one column a question: the share of wrong and failed answers. An engine and the same
/// engine with tuned settings ("NAME-tuned") share a row.
std::string campaign_table(const fuzz::CampaignResult& r);

/// One row an engine and question: answered, right, wrong, missed, ghost, failed, worst error in L, ns per
/// query (median, p99).
std::string full_campaign_table(const fuzz::CampaignResult& r);

/// Findings grouped by engine, question and fault, the most frequent `per_engine` groups of each engine.
std::string findings_summary(const fuzz::CampaignResult& r, std::size_t per_engine);

/// Whether the cases prove anything; if `full`, also where the time went.
std::string campaign_footer(const fuzz::CampaignResult& r, bool full = true);

/// "1,234,567".
std::string grouped(std::uint64_t n);
/// "1 body", "1,200 bodies".
std::string counted(std::uint64_t n, std::string_view one, std::string_view many);
/// Seconds as "1:02:03" or "2:03".
std::string clock_text(double seconds);
/// "0", or two digits and exponent: "3.1e-16".
std::string small(double x);
/// Nanoseconds in at most 6 characters: "830", "12.3k", "1.20M".
std::string nanoseconds(double ns);
/// Nanoseconds as a time with its unit: "830 ns", "12.3 µs", "6.1 ms", "1.2 s".
std::string duration(double ns);
/// Breaks `text` at spaces to `width` columns; further lines are indented.
std::string wrapped(const std::string& text, std::size_t width, std::size_t indent);
/// A line of a terminal: "  label  words", whose further lines begin below the words.
std::string labelled(const std::string& label, std::size_t label_width, const std::string& words);

}  // namespace touchstone::reports
