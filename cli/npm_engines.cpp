#include "cli/npm_engines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/command.h"
#include "cli/engine_catalog.h"
#include "cli/logged_command.h"
#include "cli/npm_releases.h"
#include "core/base/input_error.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/printable.h"

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
    {"physx-sap", "physx-js-webidl", "2.7.3", "npm/physx/physx.mjs", "sap", "PhysX's broad phase eSAP, WASM",
     true},
    {"physx-mbp", "physx-js-webidl", "2.7.3", "npm/physx/physx.mjs", "mbp", "PhysX's broad phase eMBP, WASM",
     true},
    {"physx-abp", "physx-js-webidl", "2.7.3", "npm/physx/physx.mjs", "abp", "PhysX's broad phase eABP, WASM",
     true},
    {"havok", "@babylonjs/havok", "1.3.14", "npm/havok/havok.mjs", "",
     "Havok, shape proximity and shape casts; WASM"},
    {"havok-sim", "@babylonjs/havok", "1.3.14", "npm/havok/havok.mjs", "sim",
     "Havok, collision events of a step; WASM"},
    {"cannon", "cannon-es", "0.20.0", "npm/cannon/cannon.mjs", "",
     "cannon-es as shipped: contacts of balls, boxes, hulls and planes; bounding spheres"},
    {"cannon-sap", "cannon-es", "0.20.0", "npm/cannon/cannon.mjs", "sap", "cannon-es's SAPBroadphase", true},
};

fs::path script_folder() { return plugin_directory().parent_path() / "share/touchstone/engines"; }

// The release that an adapter was written against lies in the folder itself, any other in one of its own.
fs::path folder_of(const NpmEngine& e) {
  if (e.release.empty()) return npm_folder();
  std::string package(e.row->package);
  std::replace(package.begin(), package.end(), '/', '+');
  return npm_folder() / "releases" / fmt::format("{}@{}", package, e.release);
}
fs::path package_folder(const NpmEngine& e) { return folder_of(e) / "node_modules" / e.row->package; }

int fetch(const fs::path& folder, const std::set<std::string>& packages) {
  const fs::path log = folder / "install.log";
  create_folder(folder);
  fs::remove(log);
  fmt::print(stderr, "installing {} from npm into {}\n", fmt::join(packages, " "), folder.string());
  // In its own folder: npm would take a folder here that is called NAME@RELEASE for the package.
  Words words{"env",          "-C",
              folder,         "npm",
              "install",      "--prefix",
              folder,         "--no-audit",
              "--no-fund",    "--ignore-scripts",
              "--save-exact", "--loglevel=error"};
  words.insert(words.end(), packages.begin(), packages.end());
  if (run_logged(words, log)) return exit_clean;
  fmt::print(stderr, "{}npm could not install them; full log: {}\n", reasons_in(log, "npm ERR! "),
             log.string());
  return exit_failed;
}

}  // namespace

std::span<const NpmRow> npm_catalog() { return npm_rows; }

bool is_of_npm(const std::string& name) {
  const std::string base = name.substr(0, name.find('@'));
  return std::ranges::any_of(
      npm_rows, [&](const NpmRow& row) { return row.name == base || row.name.starts_with(base + "-"); });
}

std::optional<NpmEngine> find_npm_engine(const std::string& name) {
  const auto at = name.find('@');
  for (const NpmRow& row : npm_rows) {
    if (row.name != std::string_view(name).substr(0, at)) continue;
    if (at == std::string::npos) return NpmEngine{&row, ""};
    if (is_release(name.substr(at + 1))) return NpmEngine{&row, name.substr(at + 1)};
  }
  return std::nullopt;
}

std::vector<NpmEngine> installed_releases() {
  std::set<std::string> folders;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(npm_folder() / "releases", none))
    folders.insert(entry.path().filename());
  std::vector<NpmEngine> all;
  for (const NpmRow& row : npm_rows) {
    std::vector<std::string> releases;
    for (const std::string& folder : folders)
      if (const std::string release = folder.substr(folder.rfind('@') + 1); is_release(release))
        if (const NpmEngine e{&row, release}; folder_of(e).filename() == folder && is_installed(e))
          releases.push_back(release);
    sort_releases(releases);
    for (std::string& release : releases) all.push_back({&row, std::move(release)});
  }
  return all;
}

fs::path npm_folder() {
  const char* chosen = std::getenv("TOUCHSTONE_NPM");
  return chosen && *chosen ? fs::absolute(chosen) : plugin_directory().parent_path() / "npm";
}

bool is_installed(const NpmEngine& e) try {
  const fs::path file = package_folder(e) / "package.json";
  const auto package = load_json(file);
  return JsonReader(package, file.string())["version"].string() == e.version();
} catch (const InputError&) {
  return false;  // missing or damaged; installing it again fixes both
}

std::string pipe_of(const NpmEngine& e) {
  return fmt::format("pipe:{}node {} {}{}{}",
                     e.release.empty() ? "" : fmt::format("env TOUCHSTONE_ENGINE={} ", e.name()),
                     shell_word((script_folder() / e.row->script).string()),
                     shell_word(folder_of(e).string()), e.row->argument.empty() ? "" : " ", e.row->argument);
}

std::vector<fs::path> files_of(const NpmEngine& e) {
  std::vector<fs::path> files;
  const auto add_all = [&](auto entries) {
    const auto first = static_cast<std::ptrdiff_t>(files.size());
    for (const auto& entry : entries)
      if (entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin() + first, files.end());
  };
  add_all(fs::directory_iterator(script_folder() / "npm"));
  add_all(fs::directory_iterator((script_folder() / e.row->script).parent_path()));
  if (is_installed(e)) add_all(fs::recursive_directory_iterator(package_folder(e)));
  return files;
}

int fetch_npm_engines(const std::vector<NpmEngine>& engines) {
  std::map<fs::path, std::set<std::string>> wanted;
  for (const NpmEngine& e : engines)
    if (!is_installed(e)) wanted[folder_of(e)].insert(fmt::format("{}@{}", e.row->package, e.version()));
  if (wanted.empty()) return exit_clean;
  require_npm("engines --install");
  for (const auto& [folder, packages] : wanted)
    if (const int code = fetch(folder, packages); code != exit_clean) return code;
  return exit_clean;
}

int install_npm_engines(const std::vector<std::string>& names) {
  std::vector<NpmEngine> engines;
  for (const std::string& name : names)
    for (const NpmEngine& e : npm_engines_matching(name))
      if (std::ranges::find(engines, e.name(), &NpmEngine::name) == engines.end()) engines.push_back(e);
  if (const int code = fetch_npm_engines(engines); code != exit_clean) return code;
  for (const NpmEngine& e : engines) {
    const EngineCard card = make_engine(e.name(), {})->card();
    fmt::print("{}: {} {} is installed; use it with --engines or --subject\n", card.name, card.library,
               card.version);
  }
  return exit_clean;
}

}  // namespace touchstone::cli
