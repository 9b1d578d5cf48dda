#include "cli/debian_engines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>

#include "cli/adapter_build.h"
#include "cli/command.h"
#include "cli/engine_catalog.h"
#include "core/base/input_error.h"

namespace touchstone::cli {
namespace {

namespace fs = std::filesystem;

constexpr DebianRow debian_rows[] = {
    {"dart", "dart", "DART's own detector: spheres and boxes"},
    {"dart-fcl", "dart", "DART with FCL, its shapes as they are"},
    {"dart-fcl-mesh", "dart", "DART with FCL as it is created: meshes in place of shapes"},
    {"dart-bullet", "dart", "DART with Bullet"},
    {"dart-ode", "dart", "DART with ODE"},
    {"mujoco-2.2", "mujoco2", "MuJoCo 2.2, mj_collision"},
    {"embree", "embree", "Embree, rtcCollide of a scene with itself; a broad phase"},
    {"embree-dynamic", "embree", "Embree, rtcCollide of a dynamic scene; a broad phase"},
    {"boost-rtree", "boost_rtree", "Boost.Geometry, R*-tree; a broad phase"},
    {"boost-rtree-quadratic", "boost_rtree", "Boost.Geometry, R-tree with quadratic splits; a broad phase"},
    {"boost-rtree-linear", "boost_rtree", "Boost.Geometry, R-tree with linear splits; a broad phase"},
};

const DebianRow& row_of(const std::string& name) {
  if (const DebianRow* row = find_debian_row(name)) return *row;
  throw InputError("--install " + name, "unknown");
}

}  // namespace

std::span<const DebianRow> debian_catalog() { return debian_rows; }

const DebianRow* find_debian_row(const std::string& name) {
  const auto row = std::ranges::find(debian_rows, name, &DebianRow::name);
  return row == std::end(debian_rows) ? nullptr : row;
}

fs::path adapters_folder() {
  const char* chosen = std::getenv("TOUCHSTONE_ADAPTERS");
  return chosen && *chosen ? fs::absolute(chosen) : plugin_directory().parent_path() / "adapters";
}

fs::path plugin_of(const DebianRow& row) {
  return adapters_folder() / row.folder / "lib" / fmt::format("libtouchstone_{}.so", row.folder);
}

bool is_installed(const DebianRow& row) {
  std::error_code none;
  return fs::is_regular_file(plugin_of(row), none);
}

std::vector<std::string> debian_packages_of(const std::vector<std::string>& names) {
  std::vector<std::string> packages;
  for (const std::string& name : names) {
    std::ifstream in(kit_folder() / "oracles" / row_of(name).folder / "optional_packages");
    for (std::string word; in >> word;)
      if (std::ranges::find(packages, word) == packages.end()) packages.push_back(word);
  }
  return packages;
}

int install_debian_engines(const std::vector<std::string>& names) {
  std::set<std::string_view> folders;
  for (const std::string& name : names) folders.insert(row_of(name).folder);
  for (const std::string_view folder : folders) {
    const fs::path build = adapters_folder() / folder;
    fmt::print(stderr, "compiling oracles/{} in {}\n", folder, build.string());
    try {
      build_adapter({std::string(folder), "", build, build / "build.log"});
    } catch (const InputError&) {
      fmt::print(stderr, "it needs the Debian packages {}\n", fmt::join(debian_packages_of(names), " "));
      throw;
    }
  }
  for (const std::string& name : names) {
    const EngineCard card = make_engine(name, {})->card();
    fmt::print("{}: {} {} is installed; use it with --engines or --subject\n", card.name, card.library,
               card.version);
  }
  return exit_clean;
}

}  // namespace touchstone::cli
