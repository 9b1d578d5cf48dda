// What commands do with their input files, up to the first engine query, as functions.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace touchstone::test {

struct FileReader {
  std::string kind;
  std::vector<std::string> files;  // in `directory`; one of them is damaged
  /// Accepts the damaged file, or throws an InputError that names it.
  void (*read)(const std::filesystem::path& directory);
};
const std::vector<FileReader>& file_readers();

/// Good files of every kind that need no campaign: scenes, a recording, certificates, frames of the protocol,
/// a chart, meshes.
void write_plain_originals(const std::filesystem::path& directory);

}  // namespace touchstone::test
