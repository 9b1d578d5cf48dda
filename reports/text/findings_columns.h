// Findings as columns: repeated values are stored once, so a page of 1e5 kinds stays small and opens quickly.
#pragma once

#include "reports/record/observation_json.h"

namespace touchstone::reports {

/// `findings`: those of a stored campaign (summary.json), an object by key. Returns
/// {"count": n,
///  "coded": {column: {"values": […], "codes": […]}},   the parts of the key, sorted values
///  "answers": […],                                      how many answers each finding counts
///  "worst_in_l": […],                                   three digits, or the text that JSON has for inf, nan
///  "words": {"templates": […], "codes": […], "numbers": "…"}}
/// No text is lost: each number_mark in a template stands for the next of `numbers`, separated by spaces.
fuzz::Json findings_columns(const fuzz::Json& findings);

inline constexpr char number_mark = '\x01';

/// `words` with number_mark in place of each number, and the numbers as they stand, appended to `numbers`.
std::string template_of(const std::string& words, std::string& numbers);

}  // namespace touchstone::reports
