// The one place that names concrete engines: the core, the folders in oracles/ whose plug-ins the build
// makes, and what the user installed or registered. What an engine is called, and what it claims, its
// plug-in's cards say. Every engine, our own core included, runs in a worker process; all others sit behind
// the C ABI, like a user's plug-in.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/plugin_engines.h"
#include "oracles/client/remote_engine.h"
#include "oracles/core/core_engine.h"

namespace touchstone::cli {

/// The folders, in the order of "all".
std::span<const std::string_view> engine_folders();
/// True for a folder in the catalogue, and for the core.
bool is_catalogued_folder(const std::string& name);
/// True if the build made a plug-in of the folder.
bool is_present(std::string_view folder);
/// The engines of all its plug-ins.
std::vector<PluginEngine> engines_of_folder(std::string_view folder);

/// The names of the engines of one kind that this build has, the core's first. Broad phases of the core are
/// not among them (core_broad_phases()).
std::vector<std::string> present_engines(EngineKind kind);

/// Names of `text` ("a,b", "all,jolt", "./libmine.so", "./libmine.so:name", "core-steps@16", a broad phase of
/// the core or of an oracle, a release of an engine from npm "jolt@0.29.0", an engine that the user
/// registered). "all" is every engine of this build that answers more than candidates; a library ("bullet",
/// "physx") or registration that has no engine of its name stands for such engines of its own. Throws
/// InputError for a name that is unknown or absent.
std::vector<std::string> engine_names(const std::string& text);
/// The engine that `text` names. Throws InputError if there are several.
std::string engine_name(const std::string& text);

/// True for an engine of Touchstone's core.
bool is_core_engine(const std::string& name);
/// True for a plug-in's path or a pipe's command.
bool is_foreign(const std::string& name);
/// True for an engine of this build, of npm (installed or not), or of the user's registrations.
bool is_catalogued(const std::string& name);
/// All such names.
std::vector<std::string> catalogued_names();

/// Throws InputError when the plug-in is missing or does not offer the engine.
EnginePtr make_engine(const std::string& name, const WorkerLimits& limits);
/// An engine of the catalogue from another build of this program, in that build's directory. Throws
/// InputError when the build does not have it, or it is an engine from npm or one given by a path.
EnginePtr make_engine_of_build(const std::string& name, const std::filesystem::path& build,
                               const WorkerLimits& limits);
/// A broad phase of the core, with these boxes.
EnginePtr make_core_broad_phase(const std::string& name, BroadBoxes boxes, const WorkerLimits& limits);

/// The files that make up an engine: its plug-in, or the files named in a pipe's command. Empty for the core,
/// which is part of this program.
std::vector<std::filesystem::path> engine_files(const std::string& name);

/// The options of every command that queries engines: --case-seconds and --no-sandbox.
void add_case_seconds(CLI::App& app, WorkerLimits& limits);
void add_no_sandbox(CLI::App& app, WorkerLimits& limits);

std::filesystem::path host_program();
std::filesystem::path plugin_directory();

/// Engines whose overlap test `chart` runs at k samples of a motion (`name-steps@k`), beside those that
/// sweep.
std::span<const std::string_view> stepped_engines();
inline constexpr int step_counts[] = {1, 4, 16, 64, 256};

}  // namespace touchstone::cli
