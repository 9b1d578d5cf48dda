// Inserts data into a page of reports/web: the built page has a placeholder for the JSON.
#pragma once

#include <string>
#include <string_view>

namespace touchstone::reports {

/// `built`: one page as built by Vite. JSON of `compressed_from` bytes or more is inserted as
/// {"deflate": base64 of its zlib stream}. Throws InputError if the placeholder is missing.
std::string web_page(std::string built, std::string_view json);

/// Shorter data stays readable in the page itself.
inline constexpr std::size_t compressed_from = 200'000;

/// JSON that is safe inside a script element: '<' is escaped, so that nothing looks like the end tag.
std::string json_for_script(std::string_view json);

/// {"deflate": "…"}: the JSON as a zlib stream (RFC 1950) in base64.
std::string deflated(std::string_view json);

}  // namespace touchstone::reports
