#include "cli/program_for.h"

#include <fmt/format.h>

#include <filesystem>

#include "cli/engine_catalog.h"
#include "cli/npm_engines.h"
#include "cli/own_engines.h"
#include "fuzz/reproduce/reproducer.h"
#include "scenarios/text/printable.h"

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

// In the line that compiles a program; what follows it are the program's libraries.
constexpr const char* output_option = "-o reproduce ";

std::string options_for(const std::string& prefix) {
  const std::string lib = prefix + "/lib";
  return fmt::format("-I {} -L {} -Wl,-rpath,{} ", shell_word(prefix + "/include"), shell_word(lib),
                     shell_word(lib));
}

// The program of the adapter's own engine, compiled against the registration's prefix.
std::string own_program(const fuzz::Finding& finding, const EngineCard& card, const OwnEngine& own) {
  fuzz::Finding in_adapter = finding;
  in_adapter.engine = name_in_adapter(finding.engine);
  std::string text = fuzz::reproducer(in_adapter, card);
  const std::string prefix = own.prefix.string();
  const auto at = text.find(output_option);
  if (!prefix.empty() && at != std::string::npos)
    text.insert(at + std::string(output_option).size(), options_for(prefix));
  return text;
}

std::string plugin_program(const fuzz::Finding& finding, const EngineCard& card, const std::string& name) {
  const fs::path library = fs::absolute(engine_files(name).at(0));
  return fuzz::plugin_reproducer(finding, card, {library.string(), card.name, include_directory()});
}

}  // namespace

bool has_program(const std::string& name) { return fuzz::has_reproducer(name_in_adapter(name)); }

std::string program_for(const fuzz::Finding& finding, const EngineCard& card, const std::string& name) {
  if (const std::string own = own_name_of(finding.engine); !own.empty())
    return own_program(finding, card, own_engine(own));
  const bool has_writer = fuzz::has_reproducer(finding.engine) && !is_foreign(name);
  if (name.starts_with("pipe:") || (find_npm_engine(name) && !has_writer))
    return fuzz::pipe_reproducer(finding, card);
  return is_foreign(name) ? plugin_program(finding, card, name) : fuzz::reproducer(finding, card);
}

}  // namespace touchstone::cli
