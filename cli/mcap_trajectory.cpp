#include "cli/mcap_trajectory.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>

#include "cli/engine_catalog.h"
#include "cli/logged_command.h"
#include "cli/npm_engines.h"
#include "core/base/input_error.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {
namespace {

namespace fs = std::filesystem;

struct Package {
  const char *name, *release;
};
constexpr std::array packages{Package{"@mcap/core", "2.2.2"}, Package{"@mcap/support", "1.1.0"}};
// Of the process that reads.
constexpr const char *seconds = "300", *memory = "--max-old-space-size=2048";

void require_packages(const std::string& file) {
  require_program("node", "to read " + printable(file));
  std::string missing;
  for (const Package& p : packages)
    if (std::error_code none; !fs::exists(npm_folder() / "node_modules" / p.name / "package.json", none))
      missing += fmt::format(" {}@{}", p.name, p.release);
  if (missing.empty()) return;
  throw InputError(file,
                   fmt::format("is read by packages of npm that are not installed: npm install --prefix "
                               "{} --ignore-scripts{}",
                               shell_command({npm_folder().string()}), missing));
}

}  // namespace

ImportOptions with_trajectory_text(ImportOptions options) {
  const fs::path file = options.trajectory;
  if (file.extension() != ".mcap") return options;
  std::error_code none;
  if (!fs::is_regular_file(file, none)) throw InputError(file.string(), "no such file");
  require_packages(file.string());
  const fs::path script = plugin_directory().parent_path() / "share/touchstone/mcap.mjs";
  // What is wrong with the file is said on standard output.
  const Captured read = run_captured(
      {"timeout", seconds, "node", memory, script, npm_folder(), fs::absolute(file)}, "/dev/null");
  if (!read.succeeded)
    throw InputError(file.string(),
                     "cannot be read: node failed, or took more than " + std::string(seconds) + " seconds");
  if (read.out.starts_with('!')) throw InputError(file.string(), printable(read.out.substr(1)));
  options.trajectory_text = read.out;
  return options;
}

}  // namespace touchstone::cli
