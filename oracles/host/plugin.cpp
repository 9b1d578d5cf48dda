#include "oracles/host/plugin.h"

#include <dlfcn.h>

#include <cstddef>
#include <cstring>
#include <stdexcept>

#include "oracles/abi/engine.h"
#include "oracles/abi/source_id.h"
#include "scenarios/codec/value_codec.h"

namespace touchstone::host {
namespace {

/// A larger count means that the table is not valid.
constexpr std::uint32_t max_engines = 4096;

/// A table of version 1 ends before ask_many. A process loads one plug-in.
const ts_plugin& widened(const ts_plugin& of_version_1) {
  static ts_plugin table{};
  std::memcpy(&table, &of_version_1, offsetof(ts_plugin, ask_many));
  return table;
}

}  // namespace

void require_same_sources(void* library) {
  using SourceId = const char*();
  const auto theirs = reinterpret_cast<SourceId*>(dlsym(library, source_id_symbol));
  if (!theirs) return;
  const std::string id = theirs();
  if (id != source_id())
    throw std::runtime_error("was built from other sources (" + id + ") than touchstone-host (" +
                             source_id() + "): build both again");
}

const ts_plugin& load_plugin(const std::string& file) {
  if (file.starts_with(pipe_prefix)) return load_pipe(file.substr(std::string(pipe_prefix).size()));
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) throw std::runtime_error(dlerror());
  using Entry = const ts_plugin* (*)();
  const auto entry = reinterpret_cast<Entry>(dlsym(library, "touchstone_plugin_v1"));
  if (!entry) throw std::runtime_error("exports no touchstone_plugin_v1: it is not a Touchstone plug-in");
  require_same_sources(library);
  using TellMinor = void (*)(std::uint32_t);
  if (const auto tell = reinterpret_cast<TellMinor>(dlsym(library, "touchstone_host_v1"))) tell(TS_ABI_MINOR);
  const ts_plugin* const plugin = entry();
  if (!plugin) throw std::runtime_error("touchstone_plugin_v1 returned a null pointer");
  if (plugin->abi_version < 1 || plugin->abi_version > TS_ABI_VERSION)
    throw std::runtime_error("uses ABI version " + std::to_string(plugin->abi_version) +
                             "; this host loads 1 to " + std::to_string(TS_ABI_VERSION));
  const bool complete =
      plugin->card && plugin->create && plugin->destroy && plugin->load && plugin->unload && plugin->ask;
  if (!complete) throw std::runtime_error("its function table has null entries");
  if (plugin->engine_count == 0 || plugin->engine_count > max_engines)
    throw std::runtime_error("lists " + std::to_string(plugin->engine_count) + " engines");
  return plugin->abi_version == 1 ? widened(*plugin) : *plugin;
}

std::vector<std::string> cards_of(const ts_plugin& plugin) {
  std::vector<std::string> cards;
  for (std::uint32_t i = 0; i < plugin.engine_count; ++i) {
    const char* const card = plugin.card(i);
    if (!card) throw std::runtime_error("has no card for engine " + std::to_string(i));
    cards.emplace_back(card);
  }
  return cards;
}

int choose_engine(const std::vector<std::string>& cards, const std::string& name) {
  std::string offered;
  for (std::size_t i = 0; i < cards.size(); ++i) {
    const std::string offer = card_from_json(cards[i]).name;
    if (name.empty() ? cards.size() == 1 : offer == name) return static_cast<int>(i);
    offered += (i ? ", " : "") + offer;
  }
  throw std::runtime_error(
      (name.empty() ? "offers several engines; name one of: " : "offers no engine '" + name + "', only: ") +
      offered);
}

}  // namespace touchstone::host
