#include "cli/plugin_engines.h"

#include <algorithm>
#include <map>
#include <mutex>

#include "cli/engine_catalog.h"
#include "oracles/client/remote_engine.h"

namespace touchstone::cli {
namespace {

namespace fs = std::filesystem;

EngineKind kind_of(const fs::path& plugin) {
  const std::string name = plugin.stem();
  const auto has = [&](const char* part) {
    const auto at = name.find(part);
    return at != std::string::npos &&
           (at + std::string(part).size() == name.size() || name[at + std::string(part).size()] == '_');
  };
  return has("_broad") ? EngineKind::broad : has("_sweep") ? EngineKind::settings : EngineKind::pairs;
}

}  // namespace

std::vector<fs::path> plugins_of(const fs::path& folder, const std::string& name) {
  const std::string stem = "libtouchstone_" + name;
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    const std::string file = entry.path().filename();
    if (file == stem + ".so" || (file.starts_with(stem + "_") && file.ends_with(".so")))
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

const std::vector<PluginEngine>& engines_in(const fs::path& plugin) {
  static std::mutex one_at_a_time;  // a campaign's jobs make their engines in threads of their own
  static std::map<fs::path, std::vector<PluginEngine>> read;
  const std::lock_guard lock(one_at_a_time);
  const auto found = read.find(plugin);
  if (found != read.end()) return found->second;
  std::vector<PluginEngine> engines;
  for (const EngineCard& card : list_plugin_engines(host_program(), plugin))
    engines.push_back({plugin, card.name, kind_of(plugin), card});
  return read.emplace(plugin, std::move(engines)).first->second;
}

std::vector<PluginEngine> engines_in(const std::vector<fs::path>& plugins) {
  std::vector<PluginEngine> all;
  for (const fs::path& plugin : plugins) {
    const auto& engines = engines_in(plugin);
    all.insert(all.end(), engines.begin(), engines.end());
  }
  return all;
}

}  // namespace touchstone::cli
