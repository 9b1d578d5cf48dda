#include "cli/engines_by_card.h"

#include <fmt/format.h>

#include "cli/engine_catalog.h"
#include "cli/judged_by.h"
#include "core/base/input_error.h"

namespace touchstone::cli {

Foreign foreign_engines(const std::vector<std::string>& given, const WorkerLimits& limits) {
  Foreign r;
  for (const std::string& name : given) {
    if (!is_foreign(name)) continue;
    const auto [it, added] = r.try_emplace(make_engine(name, limits)->card().name, name);
    if (!added && it->second != name)
      throw InputError("--engines", fmt::format("{} and {} are both called {}", it->second, name, it->first));
  }
  return r;
}

EnginePtr make_by_card(const std::string& name, const Foreign& foreign, const WorkerLimits& limits,
                       const std::string& error) try {
  const auto given = foreign.find(name);
  if (given == foreign.end() && !is_catalogued(name)) return nullptr;
  return judged_by(make_engine(given == foreign.end() ? name : given->second, limits), error);
} catch (const InputError&) {
  return nullptr;  // not installed: its findings and causes are not asked again
}

const EnginePtr& EnginesByCard::named(const std::string& name) {
  const auto [it, added] = made_.try_emplace(name);
  if (added) it->second = make_by_card(name, foreign_, limits_, error_);
  return it->second;
}

}  // namespace touchstone::cli
