// Releases of engines from npm: which of them exist, and which a command takes. What npm answers is data:
// only text that is a release number is ever used.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/npm_engines.h"

namespace touchstone::cli {

/// Three numbers: "0.29.0". Pre-releases such as "0.8.0-alpha.2" are not releases.
bool is_release(std::string_view text);
/// By number, ascending; without duplicates.
void sort_releases(std::vector<std::string>& releases);

/// The releases that npm has of the package, ascending. Throws InputError when it cannot be asked.
std::vector<std::string> published_releases(std::string_view package);

/// The newest of the releases (ascending) whose first numbers are those of `beginning` ("1", "0.29"); empty:
/// there is none.
std::string newest_matching(std::span<const std::string> releases, std::string_view beginning);

/// `count` from the oldest to the newest, evenly spread: of the newest patch of each minor release, or of all
/// if there are fewer minor releases than that.
std::vector<std::string> spread_releases(std::span<const std::string> releases, std::size_t count);

/// NAME, NAME@0.29.0, or NAME@0.29: the newest that npm has which begins so. The NAME of a library (jolt,
/// physx) stands for its engines: also those whose names begin with it and a dash. Throws InputError for an
/// unknown name or release.
std::vector<NpmEngine> npm_engines_matching(const std::string& name);

/// Throws InputError, about `what`, unless node and npm can be run.
void require_npm(const std::string& what);

}  // namespace touchstone::cli
