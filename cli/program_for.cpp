#include "cli/program_for.h"

#include <filesystem>

#include "cli/engine_catalog.h"
#include "cli/npm_engines.h"
#include "fuzz/reproduce/reproducer.h"

namespace touchstone::cli {
namespace {

namespace fs = std::filesystem;

/// The directory to include: that of the installation, or of the checkout around the build.
std::string include_directory() {
  const fs::path header = "oracles/abi/touchstone_engine.h";
  std::error_code none;
  for (fs::path at = plugin_directory().parent_path(); at.has_relative_path(); at = at.parent_path()) {
    if (fs::exists(at / "include" / header, none)) return (at / "include").string();
    if (fs::exists(at / header, none)) return at.string();
  }
  return "PREFIX/include";
}

}  // namespace

std::string program_for(const fuzz::Finding& finding, const EngineCard& card, const std::string& name) {
  if (!is_foreign(name) && !find_npm_row(name)) return fuzz::reproducer(finding, card);
  const bool is_command = name.starts_with("pipe:") || find_npm_row(name);
  if (is_command) return fuzz::pipe_reproducer(finding, card);
  const auto files = engine_files(name);
  return fuzz::plugin_reproducer(finding, card,
                                 {fs::absolute(files.at(0)).string(), card.name, include_directory()});
}

}  // namespace touchstone::cli
