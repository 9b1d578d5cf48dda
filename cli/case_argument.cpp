#include "cli/case_argument.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "cli/engine_catalog.h"
#include "cli/import_options.h"
#include "core/base/input_error.h"
#include "scenarios/handmade/scenario.h"
#include "scenarios/text/name_list.h"

namespace touchstone::cli {
namespace {

namespace fs = std::filesystem;

// The installed corpus, or the one in the source tree.
fs::path corpus_directory() {
  const fs::path installed = plugin_directory().parent_path() / "share/touchstone/corpus";
  std::error_code ec;
  return fs::is_directory(installed, ec) ? installed : fs::path(TOUCHSTONE_CORPUS);
}

// Strips "corpus/", with which ids begin, and ".json".
std::string corpus_name(std::string text) {
  if (text.starts_with("corpus/")) text.erase(0, 7);
  if (text.ends_with(".json")) text.erase(text.size() - 5);
  return text;
}

[[noreturn]] void refuse_unknown(const std::string& text) {
  std::vector<std::string> known;
  for (const auto& s : scenarios::catalog()) known.push_back(s.name);
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(corpus_directory(), ec))
    known.push_back(entry.path().stem());
  throw InputError(text, "no such file, scenario or corpus case" + did_you_mean(corpus_name(text), known));
}

}  // namespace

StoredCase case_argument(const std::string& text, const ImportOptions& import) {
  require_importable(text, import);
  std::error_code ec;
  const fs::file_status status = fs::status(text, ec);
  if (fs::is_directory(status)) return load_stored_case(fs::path(text) / "case.json");
  if (status.type() != fs::file_type::not_found)
    return is_importable(text) ? imported_case(text, import) : load_stored_case(text);
  for (const auto& s : scenarios::catalog())
    if (s.name == text) return {s.make(), s.line, "scenario " + s.name, s.expect};
  const std::string name = corpus_name(text);
  if (name.find('/') == std::string::npos)
    if (const fs::path file = corpus_directory() / (name + ".json"); fs::exists(file, ec))
      return load_stored_case(file);
  refuse_unknown(text);
}

bool is_recording(const std::string& text) {
  std::error_code ec;
  return fs::exists(fs::path(text) / "scene.txt", ec);
}

}  // namespace touchstone::cli
