// The engines of one job, created on first use. An engine that is missing is null.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>

#include "oracles/abi/engine.h"

namespace touchstone::fuzz {

/// Creates an engine by its name; null when it is not available.
using MakeEngine = std::function<EnginePtr(const std::string& name)>;

class EnginePool {
 public:
  explicit EnginePool(MakeEngine make) : make_(std::move(make)) {}
  const EnginePtr& named(const std::string& name) {
    const auto [at, added] = engines_.try_emplace(name);
    if (added) at->second = make_(name);
    return at->second;
  }
  /// One that has answered nothing yet.
  EnginePtr fresh(const std::string& name) const { return make_(name); }

 private:
  MakeEngine make_;
  std::map<std::string, EnginePtr> engines_;
};

}  // namespace touchstone::fuzz
