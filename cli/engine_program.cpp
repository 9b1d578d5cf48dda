#include "cli/engine_program.h"

#include <fmt/format.h>

#include "cli/own_engines.h"
#include "fuzz/reproduce/reproducer.h"
#include "scenarios/text/shell_word.h"

namespace touchstone::cli {
namespace {

constexpr const char* output_option = "-o reproduce ";

std::string options_for(const std::string& prefix) {
  const std::string lib = prefix + "/lib";
  return fmt::format("-I {} -L {} -Wl,-rpath,{} ", shell_word(prefix + "/include"), shell_word(lib),
                     shell_word(lib));
}

}  // namespace

bool has_program(const std::string& name) { return fuzz::has_reproducer(name_in_adapter(name)); }

std::string engine_program(const fuzz::Finding& finding, const EngineCard& card) {
  const std::string own = own_name_of(finding.engine);
  if (own.empty()) return fuzz::reproducer(finding, card);
  fuzz::Finding in_adapter = finding;
  in_adapter.engine = name_in_adapter(finding.engine);
  std::string text = fuzz::reproducer(in_adapter, card);
  const std::string prefix = own_engine(own).prefix.string();
  const auto at = text.find(output_option);
  if (!prefix.empty() && at != std::string::npos)
    text.insert(at + std::string(output_option).size(), options_for(prefix));
  return text;
}

}  // namespace touchstone::cli
