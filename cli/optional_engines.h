// Engines that the build leaves out, because their libraries are not among those that Touchstone needs: an
// adapter in oracles/NAME with a file optional_packages, which lists the Debian packages that it is compiled
// against. They are compiled on request, and registered as the user's own engines are (own_engines.h).
#pragma once

#include <string>
#include <vector>

namespace touchstone::cli {

/// The names of the adapters, sorted.
std::vector<std::string> optional_adapters();
/// The adapter whose engines have names like this one; empty if there is none.
std::string optional_adapter_of(const std::string& engine);
/// Throws InputError if the adapter is not optional.
std::vector<std::string> debian_packages_of(const std::string& adapter);

/// Compiles the adapters of these engines against the system's libraries and registers them. Throws
/// InputError for an unknown name, or as build_own_engine; says then which packages are needed.
int install_optional_engines(const std::vector<std::string>& names);

}  // namespace touchstone::cli
