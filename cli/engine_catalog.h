// The one place that names concrete engines: catalogue name -> plug-in file. Every engine, our own core
// included, runs in a worker process; all others sit behind the C ABI, like a user's plug-in.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "oracles/client/remote_engine.h"
#include "oracles/core/core_engine.h"

namespace touchstone::cli {

struct EngineRow {
  std::string_view name;
  std::string_view library;  // file in the plug-in directory; empty for the core
  std::string_view line;     // description
};
std::span<const EngineRow> engine_catalog();
/// Broad phases of the oracles. They answer only `candidates` and must be requested by name.
std::span<const EngineRow> broad_catalog();

/// True if the engine's plug-in file exists.
bool is_present(const EngineRow& row);

/// Names of `text` ("a,b", "all", "./libmine.so", "./libmine.so:name", "core-steps@16", a broad phase of the
/// core or of an oracle); "all" is every engine present that answers more than candidates. Throws InputError
/// for a name that is unknown or absent.
std::vector<std::string> engine_names(const std::string& text);

/// True for a plug-in's path or a pipe's command.
bool is_foreign(const std::string& name);
/// True for a name in a catalogue, whether or not its library exists.
bool is_catalogued(const std::string& name);
/// The names in all catalogues, in order.
std::vector<std::string> catalogued_names();

/// Throws InputError when the plug-in is missing or does not offer the engine.
EnginePtr make_engine(const std::string& name, const WorkerLimits& limits);
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

// Engines of the catalogue with other tolerances. They are used by name, and by `chart`, which draws a method
// as a curve.

std::span<const EngineRow> sweep_catalog();

/// Engines whose overlap test `chart` runs at k samples of a motion (`name-steps@k`), beside those that
/// sweep.
std::span<const std::string_view> stepped_engines();
inline constexpr int step_counts[] = {1, 4, 16, 64, 256};

}  // namespace touchstone::cli
