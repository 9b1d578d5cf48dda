#include "cli/optional_engines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "cli/adapter_build.h"
#include "cli/command.h"
#include "cli/npm_engines.h"
#include "cli/own_engines.h"
#include "core/base/input_error.h"

namespace touchstone::cli {
namespace {

std::filesystem::path packages_file(const std::string& adapter) {
  return kit_folder() / "oracles" / adapter / "optional_packages";
}

bool is_optional(const std::string& adapter) { return std::filesystem::exists(packages_file(adapter)); }

std::vector<std::string> npm_names() {
  std::vector<std::string> names;
  for (const NpmRow& row : npm_catalog()) names.emplace_back(row.name);
  return names;
}

}  // namespace

std::vector<std::string> optional_adapters() {
  std::vector<std::string> names = adapters();
  std::erase_if(names, [](const std::string& name) { return !is_optional(name); });
  return names;
}

std::string optional_adapter_of(const std::string& engine) {
  const std::string adapter = adapter_of(engine);
  return !adapter.empty() && is_optional(adapter) ? adapter : "";
}

std::vector<std::string> debian_packages_of(const std::string& adapter) {
  std::ifstream in(packages_file(adapter));
  if (!in) throw InputError("--install " + adapter, "is not an optional engine");
  return {std::istream_iterator<std::string>(in), {}};
}

int install_optional_engines(const std::vector<std::string>& names) {
  std::set<std::string> wanted;
  for (const std::string& name : names) {
    const std::string adapter = optional_adapter_of(name);
    if (adapter.empty())
      throw InputError("--install " + name,
                       fmt::format("unknown; npm has {}; with Debian's packages {} can be compiled",
                                   fmt::join(npm_names(), ", "), fmt::join(optional_adapters(), ", ")));
    wanted.insert(adapter);
  }
  for (const std::string& adapter : wanted) try {
      build_own_engine({adapter, adapter, "", ""});
    } catch (const InputError&) {
      fmt::print(stderr, "touchstone: {} needs the Debian packages {}\n", adapter,
                 fmt::join(debian_packages_of(adapter), " "));
      throw;
    }
  return exit_clean;
}

}  // namespace touchstone::cli
