#include "cli/npm_engines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

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
    {"mujoco", "@mujoco/mujoco", "3.14.0", "npm/mujoco/mujoco.mjs", "",
     "MuJoCo as shipped: native convex collisions, several contacts; WASM"},
    {"mujoco-single", "@mujoco/mujoco", "3.14.0", "npm/mujoco/mujoco.mjs", "single",
     "MuJoCo without multiccd, WASM"},
    {"mujoco-libccd", "@mujoco/mujoco", "3.14.0", "npm/mujoco/mujoco.mjs", "libccd",
     "MuJoCo without nativeccd (libccd's MPR), WASM"},
    {"physx-query", "physx-js-webidl", "2.7.3", "npm/physx/physx.mjs", "query",
     "PhysX, PxGeometryQuery: overlap and sweep; WASM"},
    {"physx-gjk", "physx-js-webidl", "2.7.3", "npm/physx/physx.mjs", "gjk",
     "PhysX, PxGjkQuery: proximity, overlap and sweep; WASM"},
    {"physx-sim", "physx-js-webidl", "2.7.3", "npm/physx/physx.mjs", "sim",
     "PhysX, contact reports of a step; WASM"},
    {"physx-sap", "physx-js-webidl", "2.7.3", "npm/physx/physx.mjs", "sap", "PhysX's broad phase eSAP, WASM"},
    {"physx-mbp", "physx-js-webidl", "2.7.3", "npm/physx/physx.mjs", "mbp", "PhysX's broad phase eMBP, WASM"},
    {"physx-abp", "physx-js-webidl", "2.7.3", "npm/physx/physx.mjs", "abp", "PhysX's broad phase eABP, WASM"},
    {"havok", "@babylonjs/havok", "1.3.14", "npm/havok/havok.mjs", "",
     "Havok, shape proximity and shape casts; WASM"},
    {"havok-sim", "@babylonjs/havok", "1.3.14", "npm/havok/havok.mjs", "sim",
     "Havok, collision events of a step; WASM"},
};

// The rows of an engine, or of a library such as jolt or physx: also those whose names begin with it and a
// dash.
std::vector<const NpmRow*> rows_named(const std::string& name) {
  std::vector<const NpmRow*> out;
  for (const NpmRow& r : npm_rows)
    if (r.name == name || r.name.starts_with(name + "-")) out.push_back(&r);
  if (!out.empty()) return out;
  std::set<std::string_view> known;
  for (const NpmRow& r : npm_rows) known.insert(r.name);
  throw InputError("--install " + name, fmt::format("unknown; npm has {}", fmt::join(known, ", ")));
}

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
  std::vector<fs::path> out{script_folder() / "npm/adapter.mjs"}, programs;
  for (const auto& entry : fs::directory_iterator((script_folder() / row.script).parent_path()))
    programs.push_back(entry.path());
  std::sort(programs.begin(), programs.end());
  out.insert(out.end(), programs.begin(), programs.end());
  if (!is_installed(row)) return out;
  programs.clear();
  for (const auto& entry : fs::recursive_directory_iterator(package_folder(row)))
    if (entry.is_regular_file()) programs.push_back(entry.path());
  std::sort(programs.begin(), programs.end());
  out.insert(out.end(), programs.begin(), programs.end());
  return out;
}

int install_npm_engines(const std::vector<std::string>& names) {
  std::vector<const NpmRow*> rows;
  for (const std::string& name : names)
    for (const NpmRow* row : rows_named(name)) rows.push_back(row);
  std::set<std::string> wanted;
  for (const NpmRow* row : rows)
    if (!is_installed(*row)) wanted.insert(fmt::format("{}@{}", row->package, row->version));
  if (!wanted.empty())
    if (const int code = fetch(wanted); code != exit_clean) return code;
  for (const NpmRow* row : rows) {
    const EngineCard card = make_engine(std::string(row->name), {})->card();
    fmt::print("{}: {} {} is installed; use it with --engines or --subject\n", card.name, card.library,
               card.version);
  }
  return exit_clean;
}

}  // namespace touchstone::cli
