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

const EnginePtr& EnginesByCard::named(const std::string& name) {
  const auto [it, added] = made_.try_emplace(name);
  if (added) it->second = made(name);
  if (added && it->second) it->second = judged_by(std::move(it->second), error_);
  return it->second;
}

EnginePtr EnginesByCard::made(const std::string& name) const try {
  const auto foreign = foreign_.find(name);
  if (foreign != foreign_.end()) return make_engine(foreign->second, limits_);
  return is_catalogued(name) ? make_engine(name, limits_) : nullptr;
} catch (const InputError&) {
  return nullptr;  // not installed: its causes are reported as "not asked"
}

}  // namespace touchstone::cli
