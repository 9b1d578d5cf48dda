// What is installed: Debian packages, and the programs that the user names as in a shell.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace touchstone::cli {

struct DebianPackage {
  std::string name, purpose;
};

/// The lines of a file: a name, a space and a purpose, which may be absent. Throws InputError, also for what
/// is no package's name.
std::vector<DebianPackage> packages_in(const std::filesystem::path& file);

/// False on systems without dpkg.
bool has_dpkg();
/// Precondition: has_dpkg().
bool is_installed(const std::string& package);

/// The first executable file of that name in the directories of $PATH; empty: there is none.
std::string program_on_path(const std::string& name);

}  // namespace touchstone::cli
