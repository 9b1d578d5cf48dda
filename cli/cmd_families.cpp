#include <fmt/format.h>

#include "cli/command.h"
#include "reports/record/observation_json.h"
#include "scenarios/random/family.h"

namespace touchstone::cli {

namespace {

void print_text() {
  for (const fuzz::Family& f : fuzz::families()) fmt::print("{:<15} {}\n", f.name, f.line);
  fmt::print("\nFeatures of the default mix, each in at least one case out of N:\n");
  for (const fuzz::Regime& r : fuzz::regimes()) fmt::print("{:<15} {:>4} {}\n", r.name, r.one_in, r.line);
}

void print_json() {
  fuzz::Json families = fuzz::Json::array(), regimes = fuzz::Json::array();
  for (const fuzz::Family& f : fuzz::families())
    families.push_back({{"name", f.name}, {"line", f.line}, {"weight", f.weight}});
  for (const fuzz::Regime& r : fuzz::regimes())
    regimes.push_back({{"name", r.name}, {"line", r.line}, {"one_in", r.one_in}});
  fmt::print("{}\n", fuzz::Json{{"families", families}, {"regimes", regimes}}.dump(1));
}

}  // namespace

Run declare_families(CLI::App& app) {
  auto json = std::make_shared<bool>(false);
  app.add_flag("--json", *json, "one JSON document");
  return [json] {
    *json ? print_json() : print_text();
    return exit_clean;
  };
}

}  // namespace touchstone::cli
