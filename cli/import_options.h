// Robots, worlds and meshes given to a command in place of a scene.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "scenarios/codec/case_codec.h"
#include "scenarios/import/model/import.h"

namespace touchstone::cli {

/// --srdf, --joint, --state, --trajectory, --package-path, --lenient, --convex, --padding.
void add_import_options(CLI::App& app, ImportOptions& to);

/// Throws InputError when an import option was given and the argument is no file that is imported.
void require_importable(const std::string& text, const ImportOptions& options);

/// Prints what --lenient left out to stderr: the number of things, then each with its place.
void print_import_notes(const std::string& file, const ImportedModel& imported);

/// The scene as a case with its usual queries. Prints the notes.
StoredCase imported_case(const std::string& file, const ImportOptions& options);

}  // namespace touchstone::cli
