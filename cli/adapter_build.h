// Compiles the adapter of one engine (a folder oracles/NAME) by itself, after Touchstone was built. CMake
// does the work: oracles/abi/adapter_project.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace touchstone::cli {

/// The folder that holds oracles/ and the headers that adapters include: share/touchstone/adapters beside the
/// program, or the source tree.
std::filesystem::path kit_folder();

struct AdapterBuild {
  std::string adapter;           // folder of oracles/
  std::filesystem::path prefix;  // where the library is installed; empty: where CMake finds it
  std::filesystem::path
      folder;  // for the build; is kept, so that a second call compiles only what has changed
  std::filesystem::path log;
};

/// Returns the plug-ins, sorted. Throws InputError if there is no such adapter, if CMake or a compiler is
/// missing, if the library was not found, or if the adapter does not compile; the last two name the log.
std::vector<std::filesystem::path> build_adapter(const AdapterBuild& build);

}  // namespace touchstone::cli
