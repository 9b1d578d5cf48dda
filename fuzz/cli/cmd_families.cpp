#include <fmt/format.h>

#include "fuzz/cli/command.h"
#include "fuzz/generate/family.h"
#include "fuzz/record/observation_json.h"

namespace touchstone::cli {

Run declare_families(CLI::App& app) {
  auto json = std::make_shared<bool>(false);
  app.add_flag("--json", *json, "one JSON document");
  return [json] {
    fuzz::Json j = fuzz::Json::array();
    for (const fuzz::Family& f : fuzz::families()) {
      if (*json)
        j.push_back({{"name", f.name}, {"line", f.line}, {"weight", f.weight}});
      else
        fmt::print("{:<10} {}\n", f.name, f.line);
    }
    if (*json) fmt::print("{}\n", j.dump(1));
    return exit_clean;
  };
}

}  // namespace touchstone::cli
