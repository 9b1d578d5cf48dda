#include <atomic>

#include "fuzz/campaign/campaign.h"
#include "tests/mutants/lying_engine.h"
#include "tests/support/catch.h"

using namespace touchstone;

TEST_CASE("every lying engine is found, by the fault that its lie is", "[mutants]") {
  std::size_t found = 0;
  for (const mutants::Mutant& m : mutants::mutants()) {
    fuzz::CampaignConfig config;
    config.engines = {std::string(m.name)};
    config.family = std::string(m.family);
    config.cases = 64;
    const auto make = [&] {
      std::vector<EnginePtr> engines;
      engines.push_back(mutants::make_lying_engine(m));
      return engines;
    };
    const auto result = fuzz::run_campaign(config, make, {}, std::atomic<bool>{false});
    bool hit = false;
    for (const auto& [key, f] : result.findings) hit |= f.fault == m.fault;
    INFO(m.name << " should be found as " << m.fault);
    CHECK(hit);
    found += hit;
  }
  CHECK(found >= 20);
}
