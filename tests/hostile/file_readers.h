// What commands do with the files that they are given, up to where an engine would be asked, as functions.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace touchstone::test {

struct FileReader {
  std::string kind;
  std::vector<std::string> files;  // in `directory`; one of them is damaged
  /// Throws InputError naming the damaged file, or takes it.
  void (*read)(const std::filesystem::path& directory);
};
const std::vector<FileReader>& file_readers();

/// Good files of every kind that need no campaign: scenes, a recording, certificates, frames of the protocol,
/// a chart, meshes.
void write_plain_originals(const std::filesystem::path& directory);

}  // namespace touchstone::test
