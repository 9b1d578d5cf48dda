// Optional engines whose libraries are Debian packages: C++ adapters (oracles/dart, embree, boost_rtree,
// mujoco2) that only `engines --install` compiles.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone::cli {

struct DebianRow {
  std::string_view name;
  std::string_view folder;  // of `oracles`; its file optional_packages lists the Debian packages
  std::string_view line;    // description
};
std::span<const DebianRow> debian_catalog();
const DebianRow* find_debian_row(const std::string& name);

/// $TOUCHSTONE_ADAPTERS, or `adapters` beside the program's own folder: a build folder for each adapter.
std::filesystem::path adapters_folder();
/// The plug-in that offers the engine, once it is installed.
std::filesystem::path plugin_of(const DebianRow& row);
bool is_installed(const DebianRow& row);

/// The names of the Debian packages that these engines need, one each, in order.
std::vector<std::string> debian_packages_of(const std::vector<std::string>& names);

/// Compiles the adapters of these engines, and reports what it does. Throws InputError for an unknown name,
/// or as build_adapter.
int install_debian_engines(const std::vector<std::string>& names);

}  // namespace touchstone::cli
