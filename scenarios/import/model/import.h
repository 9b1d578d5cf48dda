// Robots, worlds and meshes as scenes: what `touchstone import` does, and every command that is given such a
// file.
#pragma once

#include <filesystem>
#include <vector>

#include "scenarios/import/import_context.h"
#include "scenarios/import/model/model.h"

namespace touchstone {

struct ImportedModel {
  std::string file;
  Model model;
  std::vector<Configuration> configurations;  // at least one; several: the rows of a trajectory
  std::vector<ImportNote> notes;              // what --lenient left out
  std::size_t adjacent_filters = 0;           // pairs filtered because no file says which pairs to check
};

/// Whether the file's ending is one of those that import_model reads.
bool is_importable(const std::filesystem::path& file);

/// "urdf, xml (MJCF), …", for help and messages.
std::string importable_endings();

/// Reads a file by its ending and applies the options. Limits: 4,096 links, 8,192 shapes, two million moves
/// of a trajectory. Throws InputError with file, line and reason.
ImportedModel import_model(const std::filesystem::path& file, const ImportOptions& options);

/// The scene of an imported model; validated. Errors name the file.
Scene scene_of(const ImportedModel& imported);

/// The rows of a CSV file whose header names joint variables; the columns time, t and stamp are skipped.
/// Joints without a column keep their values in `standard`. A `text` that is not empty takes the place of the
/// file's.
std::vector<Configuration> read_trajectory(const Model& model, const Configuration& standard,
                                           const std::filesystem::path& file, const std::string& text = "");

/// The links of `other` are added as they are, with their names; no pair of its links is asked, nor of it and
/// anchored links.
void add_world(ImportedModel& robot, const ImportedModel& other);

}  // namespace touchstone
