// A page of reports/web with its data in it: the built page holds a placeholder where the JSON belongs.
#pragma once

#include <string>
#include <string_view>

namespace touchstone::reports {

/// `built`: what Vite made of one page kind. Throws InputError when the placeholder is missing.
std::string web_page(std::string built, std::string_view json);

/// JSON as it may stand inside a script element: '<' as an escape, so that nothing looks like its end.
std::string json_for_script(std::string_view json);

}  // namespace touchstone::reports
