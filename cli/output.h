// Files that commands write, and the pages among them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace touchstone::cli {

// Checks of output files: one that cannot be written is refused before the work, not after it.

/// Makes the missing directories above the file. Throws InputError if the file cannot be written. An empty
/// name means no file.
void prepare_output(const std::string& file);

// Writes pages. The built pages of reports/web are installed beside the program (share/touchstone/web), if
// Node was available to build them.

/// The path of the built page `kind`.html.
std::filesystem::path built_page(std::string_view kind);

/// Writes the page with `json` in it to `out`. If the page is not built, it writes the JSON to `out`.json,
/// as in page.html.json (unless the file `stored` already holds it), reports this on stderr and returns
/// false.
bool write_page(std::string_view kind, const std::string& json, const std::filesystem::path& out,
                const std::filesystem::path& stored = {});

/// Writes the result of a measurement: `name`.json, .csv and .html in the directory `out`. Prints the text,
/// or with `as_json` the JSON, on stdout; then the files' names (on stderr with `as_json`).
void write_result(const std::string& name, const std::string& out, const std::string& json,
                  const std::string& csv, const std::string& text, bool as_json);

}  // namespace touchstone::cli
