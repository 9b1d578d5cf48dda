#include "cli/adapter_build.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "cli/command.h"
#include "cli/engine_catalog.h"
#include "cli/logged_command.h"
#include "core/base/input_error.h"
#include "scenarios/text/name_list.h"

namespace touchstone::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* user_mark = "touchstone: ";  // of the lines that adapter_project writes for the user

// The core's plug-in is compiled with the core, not against a library.
bool is_adapter(const fs::path& folder) {
  if (folder.filename() == "core") return false;
  std::ifstream in(folder / "CMakeLists.txt");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return text.find("ts_add_plugin(") != std::string::npos;
}

std::vector<fs::path> plugins_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (entry.path().extension() == ".so") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

fs::path kit_folder() {
  const fs::path installed = plugin_directory().parent_path() / "share/touchstone/adapters";
  std::error_code none;
  return fs::is_directory(installed, none) ? installed : fs::path(TOUCHSTONE_SOURCE);
}

std::vector<std::string> adapters() {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(kit_folder() / "oracles", none))
    if (entry.is_directory() && is_adapter(entry.path())) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

void require_adapter(const std::string& name) {
  const auto all = adapters();
  if (std::find(all.begin(), all.end(), name) != all.end()) return;
  throw InputError("adapter " + name,
                   fmt::format("unknown{}; there are {}", did_you_mean(name, all),
                               all.empty() ? "none" : fmt::format("{}", fmt::join(all, ", "))));
}

std::string adapter_of(const std::string& engine) {
  std::string found;
  for (const std::string& name : adapters())
    if ((engine == name || engine.starts_with(name + "-")) && name.size() > found.size()) found = name;
  return found;
}

std::vector<fs::path> build_adapter(const AdapterBuild& build) {
  require_adapter(build.adapter);
  require_program("cmake", "to compile adapters (Debian: cmake)");
  Words configure{"cmake",
                  "-S",
                  (kit_folder() / "oracles/abi/adapter_project").string(),
                  "-B",
                  build.folder.string(),
                  "-DTOUCHSTONE_ADAPTER=" + build.adapter};
  if (!build.prefix.empty()) {
    std::error_code none;
    if (!fs::is_directory(build.prefix, none))
      throw InputError("--prefix " + build.prefix.string(), "is not a folder");
    configure.push_back("-DTOUCHSTONE_PREFIX=" + fs::absolute(build.prefix).string());
  }
  if (!run_logged(configure, build.log))
    throw InputError("adapter " + build.adapter,
                     fmt::format("{}full log: {}", reasons_in(build.log, user_mark), build.log.string()));
  if (!run_logged(
          {"cmake", "--build", build.folder.string(), "--parallel", std::to_string(processor_count())},
          build.log))
    throw CommandFailed(fmt::format("the adapter {} does not compile against this library:\n{}full log: {}",
                                    build.adapter, reasons_in(build.log, user_mark), build.log.string()));
  return plugins_in(build.folder / "lib");
}

}  // namespace touchstone::cli
