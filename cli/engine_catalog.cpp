#include "cli/engine_catalog.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <optional>

#include "cli/command.h"
#include "cli/npm_engines.h"
#include "cli/optional_engines.h"
#include "cli/own_engines.h"
#include "core/base/input_error.h"
#include "oracles/core/core_engine.h"
#include "reports/chart/sub_steps.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/name_list.h"

namespace touchstone::cli {
namespace {

// The folders in oracles/ whose plug-ins the build makes. Their cards say the rest.
constexpr std::string_view folders[] = {"fcl", "bullet", "libccd", "ode"};

// The core is part of this program and has no plug-in.
struct CoreRow {
  std::string_view name;
  EngineKind kind;
};
constexpr CoreRow core_rows[] = {
    {"core", EngineKind::pairs},
    {"core-f32", EngineKind::pairs},
    {"core-kept", EngineKind::pairs},
    {"core-extended", EngineKind::settings},
    {"core-speculative@0.25", EngineKind::settings},
    {"core-speculative@0.5", EngineKind::settings},
    {"core-speculative@1", EngineKind::settings},
};

constexpr std::string_view stepped[] = {"core", "fcl-libccd", "bullet-f32-query", "bullet-f64-query",
                                        "libccd-gjk"};

std::filesystem::path program_directory() {
  std::error_code ec;
  const auto exe = std::filesystem::read_symlink("/proc/self/exe", ec);
  return ec ? std::filesystem::current_path() : exe.parent_path();
}

bool is_pipe(const std::string& name) { return name.starts_with("pipe:"); }

bool is_path(const std::string& name) {
  return name.find('/') != std::string::npos || (name.size() > 3 && name.ends_with(".so"));
}

bool is_core_broad_phase(std::string_view name) {
  const auto phases = core_broad_phases();
  return std::find(phases.begin(), phases.end(), name) != phases.end();
}

bool is_core_row(const std::string& name) {
  return std::any_of(std::begin(core_rows), std::end(core_rows),
                     [&](const CoreRow& r) { return r.name == name; });
}

// The folder that an engine's name begins with; empty if there is none.
std::string_view folder_of(const std::string& name) {
  const auto begins = [&](std::string_view folder) {
    return name.starts_with(folder) && (name.size() == folder.size() || name[folder.size()] == '-');
  };
  const auto found = std::find_if(std::begin(folders), std::end(folders), begins);
  return found == std::end(folders) ? std::string_view() : *found;
}

std::vector<std::filesystem::path> plugins_in_folder(std::string_view folder) {
  return plugins_of(plugin_directory(), std::string(folder));
}

std::optional<PluginEngine> named(const std::string& name, const std::vector<PluginEngine>& engines) {
  const auto found = std::find_if(engines.begin(), engines.end(),
                                  [&](const PluginEngine& e) { return e.card.name == name; });
  return found == engines.end() ? std::nullopt : std::optional(*found);
}

// An engine of a plug-in: of the build, or registered by the user.
std::optional<PluginEngine> find_plugin_engine(const std::string& name) {
  if (const std::string_view folder = folder_of(name); !folder.empty())
    if (auto found = named(name, engines_in(plugins_in_folder(folder)))) return found;
  const std::string own = own_name_of(name);
  return own.empty() ? std::nullopt : named(name, engines_of(own_engine(own)));
}

std::vector<std::string> names_about_pairs(const std::vector<PluginEngine>& engines) {
  std::vector<std::string> names;
  for (const PluginEngine& e : engines)
    if (e.kind == EngineKind::pairs) names.push_back(e.card.name);
  return names;
}

// The engines about pairs of a registration or of a library, in this build or from npm.
std::vector<std::string> engines_of_library(const std::string& name) {
  if (own_name_of(name) == name) return names_about_pairs(engines_of(own_engine(name)));
  if (folder_of(name) == name) return names_about_pairs(engines_of_folder(name));
  std::vector<std::string> names;
  for (const NpmRow& row : npm_catalog())
    if (!row.is_broad_phase && row.name.starts_with(name + "-")) names.emplace_back(row.name);
  return names;
}

// What a name stands for: "all" for every engine of this build that answers about pairs, an engine's name for
// it, any other name of a registration or library for its engines that answer about pairs.
std::vector<std::string> expanded(const std::string& name) {
  if (name == "all") return present_engines(EngineKind::pairs);
  if (is_foreign(name) || find_npm_engine(name)) return {name};
  const std::vector<std::string> names = engines_of_library(name);
  const bool is_engine = std::find(names.begin(), names.end(), name) != names.end();
  return is_engine || names.empty() ? std::vector{name} : names;
}

// "./libmine.so:name" names one engine of a plug-in, "./libmine.so" its only one.
RemoteSpec plugin_spec(const std::string& name) {
  const auto colon = name.rfind(".so:");
  if (colon == std::string::npos) return {host_program(), name, "", {}};
  return {host_program(), name.substr(0, colon + 3), name.substr(colon + 4), {}};
}

RemoteSpec spec_of(const PluginEngine& e) {
  RemoteSpec spec{host_program(), e.plugin, e.engine, {}};
  spec.shown_name = e.card.name;
  spec.shown_version = e.card.version;
  return spec;
}

// The words of a command that are paths of existing files: the program or its script.
std::vector<std::filesystem::path> files_named_in(const std::string& command) {
  std::vector<std::filesystem::path> out;
  std::string word;
  char quote = 0;
  const auto end_word = [&] {
    std::error_code error;
    if (std::filesystem::is_regular_file(word, error)) out.emplace_back(word);
    word.clear();
  };
  for (const char c : command) {
    if (quote ? c == quote : c == '\'' || c == '"')
      quote = quote ? char{0} : c;
    else if (!quote && (c == ' ' || c == '\t'))
      end_word();
    else
      word += c;
  }
  end_word();
  return out;
}

[[noreturn]] void refuse_unknown(const std::string& name) {
  const std::string near = did_you_mean(name, catalogued_names());
  throw InputError("engine " + name, "unknown" + (near.empty() ? "; `touchstone engines` lists them" : near));
}

void check_name(const std::string& name) {
  if (is_pipe(name)) {
    if (name == "pipe:") throw InputError(name, "has no command; write pipe:COMMAND");
    return;
  }
  if (const auto stepped = fuzz::sub_steps_name(name)) return check_name(stepped->engine);
  if (is_path(name)) {
    const auto file = plugin_spec(name).plugin;
    if (!std::filesystem::exists(file)) throw InputError(file.string(), "no such plug-in file");
    return require_regular_file(file);  // loading a named pipe would block the worker
  }
  if (const auto npm = find_npm_engine(name)) {
    if (is_installed(*npm)) return;
    throw InputError("engine " + name,
                     fmt::format("is not installed: ./touchstone engines --install {} installs {} {}", name,
                                 npm->row->package, npm->version()));
  }
  if (is_core_broad_phase(name)) return;
  if (is_core_row(name) || find_plugin_engine(name)) return;
  if (const std::string adapter = optional_adapter_of(name); !adapter.empty() && own_name_of(name).empty())
    throw InputError("engine " + name,
                     fmt::format("is not installed: ./touchstone engines --install {} compiles it", adapter));
  const std::string folder(folder_of(name));
  if (folder.empty() || is_present(folder)) refuse_unknown(name);
  throw InputError(
      "engine " + name,
      fmt::format("is not available: oracles/{} was not built because its library was not found", folder));
}

/// Null if the core has no engine of this native name. The instance made here only provides the card.
EnginePtr core_in_worker(const std::string& native, const WorkerLimits& limits,
                         const std::filesystem::path& build = program_directory().parent_path()) {
  const auto here = make_native_core(native);
  if (!here) return nullptr;
  const std::filesystem::path host = build / "bin/touchstone-host",
                              library = build / "lib/libtouchstone_core.so";
  // The worker starts with the first question; a missing file would then look like a failure of the core.
  for (const std::filesystem::path& file : {host, library})
    if (std::error_code none; !std::filesystem::is_regular_file(file, none))
      throw InputError(file.string(), "is missing; the core's engines need it");
  return std::make_unique<RemoteEngine>(RemoteSpec{host, library, native, limits, here->card()});
}

}  // namespace

std::span<const std::string_view> engine_folders() { return folders; }
std::span<const std::string_view> stepped_engines() { return stepped; }

bool is_catalogued_folder(const std::string& name) {
  return name == "core" || std::find(std::begin(folders), std::end(folders), name) != std::end(folders);
}

bool is_present(std::string_view folder) { return !plugins_in_folder(folder).empty(); }

std::vector<PluginEngine> engines_of_folder(std::string_view folder) {
  return engines_in(plugins_in_folder(folder));
}

std::vector<std::string> present_engines(EngineKind kind) {
  std::vector<std::string> names;
  for (const CoreRow& row : core_rows)
    if (row.kind == kind) names.emplace_back(row.name);
  for (const std::string_view folder : folders)
    for (const PluginEngine& e : engines_of_folder(folder))
      if (e.kind == kind) names.push_back(e.card.name);
  return names;
}

void add_case_seconds(CLI::App& app, WorkerLimits& limits) {
  app.add_option(
         "--case-seconds", limits.query_cpu_seconds,
         "CPU seconds an engine may spend on one question; campaigns and their replays stop it after four "
         "times that, and count answers in between as slow")
      ->check(a_positive_number())
      ->capture_default_str();
  add_no_sandbox(app, limits);
}

void add_no_sandbox(CLI::App& app, WorkerLimits& limits) {
  app.add_flag_callback(
      "--no-sandbox", [&limits] { limits.sandbox = false; },
      "let engines write files, use the network and start processes (for debuggers)");
}

std::filesystem::path host_program() { return program_directory() / "touchstone-host"; }

std::filesystem::path plugin_directory() { return program_directory().parent_path() / "lib"; }

std::vector<std::string> engine_names(const std::string& text) {
  std::vector<std::string> names;
  for_each_in_list(text, [&](std::string_view part) {
    const std::string name(part);
    if (name.empty()) throw InputError("engines '" + text + "'", "contains an empty name");
    for (const std::string& each : expanded(name)) {
      check_name(each);
      if (std::find(names.begin(), names.end(), each) == names.end()) names.push_back(each);
    }
  });
  return names;
}

std::string engine_name(const std::string& text) {
  const std::vector<std::string> names = engine_names(text);
  if (names.size() == 1) return names[0];
  throw InputError("engine " + text, fmt::format("names more than one engine: {}", fmt::join(names, ", ")));
}

std::vector<std::string> catalogued_names() {
  std::vector<std::string> names;
  for (const EngineKind kind : {EngineKind::pairs, EngineKind::broad, EngineKind::settings}) {
    const auto present = present_engines(kind);
    names.insert(names.end(), present.begin(), present.end());
  }
  for (const NpmRow& row : npm_catalog()) names.emplace_back(row.name);
  for (const NpmEngine& e : installed_releases()) names.push_back(e.name());
  for (const std::string& own : own_names()) try {
      for (const PluginEngine& e : engines_of(own_engine(own))) names.push_back(e.card.name);
    } catch (const InputError& e) {
      fmt::print(stderr, "touchstone: {} is left out: {}\n", own, e.what());
    }
  return names;
}

bool is_core_engine(const std::string& name) { return is_core_row(name); }

bool is_foreign(const std::string& name) { return is_pipe(name) || is_path(name); }

bool is_catalogued(const std::string& name) {
  return !is_foreign(name) && (find_npm_engine(name) || is_core_row(name) || fuzz::sub_steps_name(name) ||
                               find_plugin_engine(name));
}

std::vector<std::filesystem::path> engine_files(const std::string& name) {
  if (is_pipe(name)) return files_named_in(name.substr(5));
  if (const auto stepped = fuzz::sub_steps_name(name)) return engine_files(stepped->engine);
  if (is_path(name)) return {plugin_spec(name).plugin};
  if (const auto npm = find_npm_engine(name)) return files_of(*npm);
  if (const auto found = find_plugin_engine(name)) return {found->plugin};
  return {};
}

EnginePtr make_core_broad_phase(const std::string& name, BroadBoxes boxes, const WorkerLimits& limits) {
  return core_in_worker(native_name(name, boxes), limits);
}

EnginePtr make_engine(const std::string& name, const WorkerLimits& limits) {
  check_name(name);
  if (EnginePtr core = core_in_worker(name, limits)) return core;
  if (const auto stepped = fuzz::sub_steps_name(name); stepped && !is_pipe(name))
    return fuzz::sub_stepped(make_engine(stepped->engine, limits), stepped->steps);
  const auto npm = find_npm_engine(name);
  RemoteSpec spec = is_pipe(name) || npm ? RemoteSpec{host_program(), npm ? pipe_of(*npm) : name, "", {}}
                    : is_path(name)      ? plugin_spec(name)
                                         : spec_of(find_plugin_engine(name).value());
  spec.limits = limits;
  return std::make_unique<RemoteEngine>(std::move(spec));
}

EnginePtr make_engine_of_build(const std::string& name, const std::filesystem::path& build,
                               const WorkerLimits& limits) {
  if (EnginePtr core = core_in_worker(name, limits, build)) return core;
  const auto found = find_plugin_engine(name);
  if (!found) throw InputError("engine " + name, "is not one that a build has");
  RemoteSpec spec = spec_of(*found);
  spec.host = build / "bin/touchstone-host";
  spec.plugin = build / "lib" / found->plugin.filename();
  spec.limits = limits;
  return std::make_unique<RemoteEngine>(std::move(spec));
}

}  // namespace touchstone::cli
