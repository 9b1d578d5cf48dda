// Inserts data into a page of reports/web: the built page has a placeholder for the JSON.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "reports/record/broad_view.h"
#include "reports/record/observation_json.h"

namespace touchstone::reports {

/// `built`: one page as built by Vite. JSON of `compressed_from` bytes or more is inserted as
/// {"deflate": base64 of its zlib stream}. Throws InputError if the placeholder is missing.
std::string web_page(std::string built, std::string_view json);

/// The data in a page that web_page made: the JSON as it was given. nullopt if it is not such a page. Throws
/// InputError naming `place` if the data is damaged, or longer than `most` bytes.
std::optional<std::string> data_of_page(std::string_view page, const std::string& place,
                                        std::size_t most = std::size_t{256} << 20);

/// Shorter data stays readable in the page itself.
inline constexpr std::size_t compressed_from = 200'000;

/// JSON that is safe inside a script element: '<' is escaped, so that nothing looks like the end tag.
std::string json_for_script(std::string_view json);

/// {"deflate": "…"}: the JSON as a zlib stream (RFC 1950) in base64.
std::string deflated(std::string_view json);

// Findings as columns: repeated values are stored once, so a page of 1e5 kinds stays small and opens quickly.

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

/// The data of the page `broad`. Boxes are rounded to 1e-5 of the picture's size; counts and pairs are those
/// of the unrounded boxes.
nlohmann::json packed_broad_view(const fuzz::BroadView& view);

}  // namespace touchstone::reports
