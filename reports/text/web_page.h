// A page of reports/web with its data in it: the built page holds a placeholder where the JSON belongs.
#pragma once

#include <string>
#include <string_view>

namespace touchstone::reports {

/// `built`: what Vite made of one page kind. JSON longer than `compressed_from` goes in as
/// {"deflate": base64 of its zlib stream}. Throws InputError when the placeholder is missing.
std::string web_page(std::string built, std::string_view json);

/// Below, a page's data stays readable in the page itself.
inline constexpr std::size_t compressed_from = 200'000;

/// JSON as it may stand inside a script element: '<' as an escape, so that nothing looks like its end.
std::string json_for_script(std::string_view json);

/// {"deflate": "…"}: the JSON as a zlib stream (RFC 1950) in base64.
std::string deflated(std::string_view json);

}  // namespace touchstone::reports
