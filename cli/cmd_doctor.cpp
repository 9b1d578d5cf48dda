// touchstone doctor: what is installed, what is missing and what for, and which command installs it. Changes
// nothing. The launcher answers it from the same file while the program is not built.
#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "cli/command.h"
#include "cli/engine_catalog.h"
#include "cli/installed.h"
#include "cli/npm_engines.h"
#include "cli/optional_engines.h"
#include "cli/output.h"
#include "cli/own_engines.h"
#include "core/base/input_error.h"
#include "reports/text/text.h"

namespace touchstone::cli {
namespace {

namespace fs = std::filesystem;

struct Tool {
  const char *program, *package, *purpose;
};
constexpr Tool tools[] = {
    {"git", "git", "versions and bisect commit"},
    {"node", "nodejs", "pages, and engines from npm"},
    {"npm", "npm", "pages, and engines from npm"},
    {"python3", "python3", "engines in Python, libtouchstone in Python, the corpus's runner"},
    {"valgrind", "valgrind", "certify --memcheck"},
    {"clang++", "clang", "./touchstone test --all"},
    {"ccache", "ccache", "faster builds"},
};

class Examination {
 public:
  void section(const std::string& title) { fmt::print("{}\n", title); }
  void row(bool is_there, const std::string& name, const std::string& purpose,
           const char* otherwise = "missing") {
    const std::string text = fmt::format("  {:<8}{:<20}{}", is_there ? "ok" : otherwise, name, purpose);
    fmt::print("{}\n", reports::wrapped(text, 79, 30));
  }
  void install_package(const std::string& package) { packages_.insert(package); }
  void run(const std::string& command) { commands_.insert(command); }
  void require(const std::string& name) { required_.push_back(name); }

  int finish() const {
    std::string apt;
    for (const std::string& p : packages_) apt += " " + p;
    if (packages_.empty() && commands_.empty()) {
      fmt::print("Nothing is missing.\n");
      return exit_clean;
    }
    fmt::print("To install what is missing\n");
    if (!apt.empty()) fmt::print("  {}\n", reports::wrapped("sudo apt-get install" + apt, 76, 4));
    for (const std::string& c : commands_) fmt::print("  {}\n", c);
    if (required_.empty()) {
      fmt::print("None of it is needed to build and run the program.\n");
      return exit_clean;
    }
    std::string names;
    for (const std::string& r : required_) names += (names.empty() ? "" : ", ") + r;
    fmt::print("Needed by the program: {}\n", names);
    return exit_failed;
  }

 private:
  std::set<std::string> packages_, commands_;
  std::vector<std::string> required_;
};

void examine_build(Examination& e) {
  e.section("To build the program");
  const fs::path file = TOUCHSTONE_SOURCE "/cmake/debian_packages";
  if (!fs::exists(file)) return e.row(true, "program", "it is installed without its sources");
  if (!has_dpkg()) return e.row(true, "program", "not a Debian system: its packages are not checked");
  for (const DebianPackage& p : packages_in(file)) {
    const bool there = is_installed(p.name);
    e.row(there, p.name, p.purpose);
    if (there) continue;
    e.install_package(p.name);
    e.require(p.name);
  }
}

std::string names_of_packages(const std::vector<DebianPackage>& packages) {
  std::string names;
  for (const DebianPackage& p : packages) names += (names.empty() ? "" : " ") + p.name;
  return names;
}

// Of this build. An engine whose package was not there is left out of it.
void examine_engines(Examination& e) {
  e.section("Engines of this build");
  for (const std::string_view folder : engine_folders()) {
    const fs::path file = fs::path(TOUCHSTONE_SOURCE "/oracles") / folder / "debian_packages";
    const bool there = is_present(folder);
    if (!fs::exists(file)) {  // installed without its sources
      if (there) e.row(true, std::string(folder), "");
      continue;
    }
    const auto packages = packages_in(file);
    e.row(there, std::string(folder), names_of_packages(packages));
    if (there) continue;
    for (const DebianPackage& p : packages) e.install_package(p.name);
    e.run(program_name() + " build");
  }
}

void examine_further_engines(Examination& e) {
  e.section("Engines on request");
  const auto own = own_names();
  const std::set<std::string> registered(own.begin(), own.end());
  for (const std::string& adapter : optional_adapters()) {
    const bool there = registered.count(adapter) > 0;
    std::string packages;
    for (const std::string& p : debian_packages_of(adapter)) packages += (packages.empty() ? "" : " ") + p;
    e.row(there, adapter, packages, "absent");
    if (!there) e.run(program_name() + " engines --install " + adapter);
  }
}

void examine_tools(Examination& e) {
  e.section("Programs that some commands run");
  for (const Tool& t : tools) {
    const bool there = !program_on_path(t.program).empty();
    e.row(there, t.program, t.purpose);
    if (!there) e.install_package(t.package);
  }
  const bool pages = fs::exists(built_page("case"));
  e.row(pages, "pages", "view, causes --page and report --page");
  if (!pages) e.run(program_name() + " pages --install");
}

// Starts one.
void examine_workers(Examination& e) {
  e.section("Workers");
  try {
    const EnginePtr core = make_engine("core", {});
    e.row(true, "core", core->card().library + " " + core->card().version + " starts and answers");
  } catch (const std::exception& error) {
    e.row(false, "core", std::string("does not start: ") + error.what());
    e.require("a worker that starts");
  }
}

int examine_all() {
  Examination e;
  examine_build(e);
  examine_engines(e);
  examine_further_engines(e);
  examine_tools(e);
  examine_workers(e);
  return e.finish();
}

}  // namespace

Run declare_doctor(CLI::App& app) {
  app.footer("Changes nothing. Exit codes: 0 all that the program needs is there, 3 not.");
  return [] { return examine_all(); };
}

}  // namespace touchstone::cli
