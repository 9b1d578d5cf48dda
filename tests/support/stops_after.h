// An engine that ends its campaign.
#pragma once

#include <atomic>
#include <span>
#include <vector>

#include "oracles/core/core_engine.h"

namespace touchstone::test {

/// The core, which requests the end of the campaign after a number of batches.
class StopsAfter final : public Engine {
 public:
  StopsAfter(int batches, std::atomic<bool>& stop) : left_(batches), stop_(stop) {}
  const EngineCard& card() const override { return core_.card(); }
  std::vector<CaseObservations> run(std::span<const Case> cases) override {
    if (--left_ == 0) stop_ = true;
    return core_.run(cases);
  }

 private:
  CoreEngine core_;
  int left_;
  std::atomic<bool>& stop_;
};

}  // namespace touchstone::test
