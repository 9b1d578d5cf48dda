#include "cli/npm_engines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/command.h"
#include "cli/engine_catalog.h"
#include "core/base/input_error.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::cli {
namespace {

namespace fs = std::filesystem;

// The versions that the adapters were written against.
constexpr NpmRow npm_rows[] = {
    {"jolt", "jolt-physics", "1.1.0", "npm/jolt/jolt.mjs", "", "Jolt Physics as shipped, WASM"},
    {"jolt-tuned", "jolt-physics", "1.1.0", "npm/jolt/jolt.mjs", "tuned",
     "Jolt Physics, convex radius 0, tolerances 1e-7, WASM"},
    {"rapier", "@dimforge/rapier3d-compat", "0.21.0", "npm/rapier/rapier.mjs", "", "Rapier, WASM"},
};

fs::path script_folder() { return plugin_directory().parent_path() / "share/touchstone/engines"; }
fs::path package_folder(const NpmRow& r) { return npm_folder() / "node_modules" / r.package; }

std::string quoted(const fs::path& p) {
  std::string out = "'";
  for (const char c : p.string())
    if (c == '\'')
      out += "'\\''";
    else
      out += c;
  return out + "'";
}

void require_command(const char* name) {
  if (std::system(fmt::format("command -v {} >/dev/null 2>&1", name).c_str()) == 0) return;
  throw InputError("engines --install",
                   fmt::format("{} is missing; it is in Debian's packages nodejs and npm, "
                               "which ./touchstone engines --install installs",
                               name));
}

std::string last_lines(const fs::path& file, std::size_t most) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  std::string out;
  for (std::size_t i = lines.size() - std::min(most, lines.size()); i < lines.size(); ++i)
    out += lines[i] + "\n";
  return out;
}

int fetch(const std::set<std::string>& packages) {
  require_command("node");
  require_command("npm");
  const fs::path folder = npm_folder(), log = folder / "install.log";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder.string(), "cannot be created: " + error.message());
  std::string list;
  for (const std::string& p : packages) list += " " + p;
  fmt::print(stderr, "installing{} from npm into {}\n", list, folder.string());
  const std::string command = fmt::format(
      "npm install --prefix {} --no-audit --no-fund --ignore-scripts --save-exact --loglevel=error{} >{} "
      "2>&1 </dev/null",
      quoted(folder), list, quoted(log));
  if (std::system(command.c_str()) == 0) return exit_clean;
  fmt::print(stderr, "{}npm could not install them; full log: {}\n", last_lines(log, 8), log.string());
  return exit_failed;
}

}  // namespace

std::span<const NpmRow> npm_catalog() { return npm_rows; }

const NpmRow* find_npm_row(const std::string& name) {
  const auto row =
      std::find_if(std::begin(npm_rows), std::end(npm_rows), [&](const NpmRow& r) { return r.name == name; });
  return row == std::end(npm_rows) ? nullptr : row;
}

fs::path npm_folder() {
  const char* chosen = std::getenv("TOUCHSTONE_NPM");
  return chosen && *chosen ? fs::absolute(chosen) : plugin_directory().parent_path() / "npm";
}

bool is_installed(const NpmRow& row) try {
  const fs::path file = package_folder(row) / "package.json";
  const auto package = load_json(file);
  return JsonReader(package, file.string())["version"].string() == row.version;
} catch (const InputError&) {
  return false;  // missing or damaged; installing it again fixes both
}

std::string pipe_of(const NpmRow& row) {
  return fmt::format("pipe:node {} {}{}{}", quoted(script_folder() / row.script), quoted(npm_folder()),
                     row.argument.empty() ? "" : " ", row.argument);
}

std::vector<fs::path> files_of(const NpmRow& row) {
  std::vector<fs::path> out{script_folder() / row.script, script_folder() / "npm/adapter.mjs"}, programs;
  if (!is_installed(row)) return out;
  for (const auto& entry : fs::recursive_directory_iterator(package_folder(row)))
    if (entry.is_regular_file()) programs.push_back(entry.path());
  std::sort(programs.begin(), programs.end());
  out.insert(out.end(), programs.begin(), programs.end());
  return out;
}

int install_npm_engines(const std::vector<std::string>& names) {
  std::set<std::string> wanted;
  for (const std::string& name : names) {
    const NpmRow* row = find_npm_row(name);
    if (!row) throw InputError("--install " + name, "unknown; npm has jolt, jolt-tuned and rapier");
    if (!is_installed(*row)) wanted.insert(fmt::format("{}@{}", row->package, row->version));
  }
  if (!wanted.empty())
    if (const int code = fetch(wanted); code != exit_clean) return code;
  for (const std::string& name : names) {
    const EngineCard card = make_engine(name, {})->card();
    fmt::print("{}: {} {} is installed; use it with --engines or --subject\n", card.name, card.library,
               card.version);
  }
  return exit_clean;
}

}  // namespace touchstone::cli
