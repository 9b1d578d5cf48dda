#include "cli/adapter_build.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "cli/engine_catalog.h"
#include "cli/shell.h"
#include "core/base/input_error.h"

namespace touchstone::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t shown_lines = 8;

void require_tools() {
  for (const char* name : {"cmake", "c++"})
    if (!has_program(name))
      throw InputError(
          "adapter", fmt::format("{} is missing; Debian's packages are cmake, g++ and libeigen3-dev", name));
}

std::vector<fs::path> plugins_in(const fs::path& folder) {
  std::vector<fs::path> all;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (entry.path().extension() == ".so") all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  return all;
}

void run_logged(const std::string& command, const fs::path& log, const std::string& what) {
  const std::string logged = fmt::format("{} >>{} 2>&1 </dev/null", command, shell_word(log));
  if (std::system(logged.c_str()) == 0) return;
  fmt::print(stderr, "{}", end_of_log(log, shown_lines));
  throw InputError(what, "failed; the whole log is " + log.string());
}

}  // namespace

fs::path kit_folder() {
  const fs::path installed = plugin_directory().parent_path() / "share/touchstone/adapters";
  std::error_code none;
  return fs::is_directory(installed, none) ? installed : fs::path(TOUCHSTONE_SOURCE);
}

std::vector<fs::path> build_adapter(const AdapterBuild& build) {
  const fs::path oracles = kit_folder() / "oracles";
  if (!fs::exists(oracles / build.adapter / "CMakeLists.txt"))
    throw InputError((oracles / build.adapter).string(), "holds no adapter");
  require_tools();
  std::error_code error;
  fs::create_directories(build.folder, error);
  if (error) throw InputError(build.folder.string(), "cannot be created: " + error.message());
  fs::remove(build.log, error);
  run_logged(fmt::format("cmake{} -S {} -B {} -DTOUCHSTONE_ADAPTER={} -DTOUCHSTONE_PREFIX={}",
                         has_program("ninja") ? " -G Ninja" : "", shell_word(oracles / "abi/adapter_project"),
                         shell_word(build.folder), shell_word(build.adapter), shell_word(build.prefix)),
             build.log, "configuring the adapter " + build.adapter);
  run_logged(fmt::format("cmake --build {}", shell_word(build.folder)), build.log,
             "compiling the adapter " + build.adapter);
  return plugins_in(build.folder / "lib");
}

}  // namespace touchstone::cli
