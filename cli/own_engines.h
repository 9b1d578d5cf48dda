// Engines that the user has compiled against a library of their own and registered under a name. Each is a
// folder below own_engines_folder(): registration.json and the plug-ins. Who can write there can decide what
// is loaded, so a folder or file that others may write is refused.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/plugin_engines.h"

namespace touchstone::cli {

/// $TOUCHSTONE_ENGINES, or touchstone/engines in $XDG_DATA_HOME (by default ~/.local/share).
std::filesystem::path own_engines_folder();

struct OwnEngine {
  std::string name, adapter;
  std::filesystem::path prefix;  // empty: the system's library
  std::filesystem::path folder;
};

/// The names registered, sorted.
std::vector<std::string> own_names();
/// Throws InputError when the folder or its registration is not usable.
OwnEngine own_engine(const std::string& name);

/// The engines of one registration. Names and versions are as shown: the adapter's name at the beginning of
/// an engine's is replaced by the registration's, and the version names the prefix.
std::vector<PluginEngine> engines_of(const OwnEngine& own);

/// The registration that an engine's name belongs to; empty if there is none.
std::string own_name_of(const std::string& engine);

/// The name that this engine has in its adapter ("fcl-libccd" for fcl-head-libccd); the same name if the
/// engine is not the user's own.
std::string name_in_adapter(const std::string& engine);
/// The engine of the same library as `engine` that the adapter calls `in_adapter`.
std::string beside(const std::string& engine, const std::string& in_adapter);

struct OwnBuild {
  std::string adapter, name;     // empty name: the adapter's, or ADAPTER-own if that is taken
  std::filesystem::path prefix;  // empty: the system's library
  std::string command;           // run by the shell before compiling; never stored
};

/// Compile, register and report on standard error. Throw InputError for bad names and a prefix without the
/// library, CommandFailed when the command or the compiler fails; nothing is registered then.
int build_own_engine(OwnBuild build);
/// With the prefix and adapter of the registration.
int rebuild_own_engine(const std::string& name, const std::string& command);
int remove_own_engine(const std::string& name);

}  // namespace touchstone::cli
