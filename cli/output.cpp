#include "cli/output.h"

#include <fmt/format.h>
#include <unistd.h>
#include <filesystem>

#include "cli/engine_catalog.h"
#include "core/base/input_error.h"
#include "fuzz/campaign/store.h"
#include "reports/text/web_page.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::cli {

std::filesystem::path built_page(std::string_view kind) {
  return plugin_directory().parent_path() / "share/touchstone/web" / fmt::format("{}.html", kind);
}

bool write_page(std::string_view kind, const std::string& json, const std::filesystem::path& out,
                const std::filesystem::path& stored) {
  const auto built = built_page(kind);
  if (!std::filesystem::exists(built)) {
    auto data = stored;
    if (data.empty()) {
      data = out;
      data += ".json";  // not in place of .html: causes.json beside causes.html is a record of its own
      write_file(data, json);
    }
    fmt::print(stderr,
               "touchstone: no page written: the pages of reports/web are not built (./touchstone pages "
               "--install builds them with nodejs and npm); its data is in {}\n",
               data.string());
    return false;
  }
  write_file(out, reports::web_page(read_file(built, std::uintmax_t{1} << 26), json));
  return true;
}

void write_result(const std::string& name, const std::string& out, const std::string& json,
                  const std::string& csv, const std::string& text, bool as_json) {
  const std::string file = fmt::format("{}/{}", out, name);
  write_file(file + ".json", json);
  write_file(file + ".csv", csv);
  if (as_json)
    fmt::print("{}\n", json);
  else
    fmt::print("{}", text);
  const bool page = write_page(name, json, file + ".html", file + ".json");
  fmt::print(as_json ? stderr : stdout, "{0}.json, {0}.csv{1}\n", file,
             page ? fmt::format(", page: {}.html", file) : "");
}

void prepare_output(const std::string& file) {
  if (file.empty()) return;
  if (std::filesystem::is_directory(file)) throw InputError(file, "cannot be written: it is a directory");
  const bool there = std::filesystem::exists(file);
  if (there && !std::filesystem::is_regular_file(file)) return;  // a device or a pipe: written in place
  const auto directory = std::filesystem::absolute(file).parent_path();
  fuzz::make_directory(directory);
  if (access(directory.c_str(), W_OK) != 0) throw InputError(file, "cannot be written: no permission");
}

}  // namespace touchstone::cli
