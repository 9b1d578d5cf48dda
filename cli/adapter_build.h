// Compiling the adapter of one engine (a folder oracles/NAME) against a library of the user's, from the
// checkout or from an installed Touchstone. CMake does the work: oracles/abi/adapter_project.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace touchstone::cli {

/// The folder that holds oracles/ and the headers that adapters include: share/touchstone/adapters beside the
/// program, or the source tree.
std::filesystem::path kit_folder();

/// The names of all adapters, sorted.
std::vector<std::string> adapters();

/// Throws InputError with suggestions.
void require_adapter(const std::string& name);

/// The adapter whose engines have names like this one: the longest that is `engine` or its beginning up to a
/// hyphen; empty if there is none.
std::string adapter_of(const std::string& engine);

struct AdapterBuild {
  std::string adapter;
  std::filesystem::path prefix;  // where the library is installed; empty: where CMake finds it
  std::filesystem::path folder;  // for the build; it need not exist
  std::filesystem::path log;
};

/// Returns the plug-ins, sorted. Throws InputError when the prefix does not hold the library, CommandFailed
/// when the adapter does not compile; both name the log.
std::vector<std::filesystem::path> build_adapter(const AdapterBuild& build);

}  // namespace touchstone::cli
