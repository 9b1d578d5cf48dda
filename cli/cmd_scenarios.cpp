#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "core/base/input_error.h"
#include "reports/text/text.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/handmade/scenario.h"

namespace touchstone::cli {

Run declare_scenarios(CLI::App& app) {
  auto name = std::make_shared<std::string>();
  app.add_option("name", *name, "write this scenario as a case file to stdout");
  return [name] {
    const auto all = scenarios::catalog();
    if (name->empty()) {
      std::string folder;
      for (const auto& s : all) {
        if (s.folder != folder) fmt::print("{}\n", folder = s.folder);
        fmt::print("  {}\n", reports::wrapped(fmt::format("{}: {}", s.name, s.line), 78, 6));
      }
      return exit_clean;
    }
    const auto it = std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.name == *name; });
    if (it == all.end())
      throw InputError("scenario " + *name, "unknown; `touchstone scenarios` lists them all");
    fmt::print("{}\n", case_to_json(it->make()).dump(1));
    return exit_clean;
  };
}

}  // namespace touchstone::cli
