// Writes pages: the built ones of reports/web lie beside the program (share/touchstone/web), if Node was
// there to build them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace touchstone::cli {

/// What `kind`.html of reports/web is looked for as.
std::filesystem::path built_page(std::string_view kind);

/// Writes the page with `json` in it to `out`. Without a built page the JSON goes to `out` with the extension
/// .json, if it is not in the file `stored` anyway, and one line on stderr says what is missing; then false.
bool write_page(std::string_view kind, const std::string& json, const std::filesystem::path& out,
                const std::filesystem::path& stored = {});

/// What a command of measurements leaves: `name`.json, .csv and .html in the directory `out`, and on stdout
/// the text, or with `as_json` the JSON; last the files' names (then on stderr).
void write_result(const std::string& name, const std::string& out, const std::string& json,
                  const std::string& csv, const std::string& text, bool as_json);

}  // namespace touchstone::cli
