#include <optional>
#include <set>

#include "fuzz/campaign/campaign.h"
#include "fuzz/judge/relation.h"
#include "scenarios/random/family.h"
#include "tests/mutants/lying_engine.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

// The number of cases of the mutant's family that it takes to find its fault; nothing when `most` do not.
std::optional<std::uint64_t> cases_to_kill(const mutants::Mutant& m, std::uint64_t most) {
  std::vector<EnginePtr> engines;
  engines.push_back(mutants::make_lying_engine(m));
  for (std::uint64_t i = 0; i < most; ++i) {
    const Case c = fuzz::make_case(1, i, m.family);
    fuzz::CampaignResult r;
    fuzz::ask_and_judge(r, {&c, 1}, i, engines);
    for (const auto& [key, f] : r.findings)
      if (f.fault == m.fault) return i + 1;
  }
  return std::nullopt;
}

}  // namespace

TEST_CASE("every lying engine is found, by the fault that its lie is", "[mutants]") {
  std::size_t found = 0;
  for (const mutants::Mutant& m : mutants::mutants()) {
    INFO(m.name << " should be found as " << m.fault << " in family " << m.family);
    const auto cases = cases_to_kill(m, 1500);
    CHECK(cases);
    found += cases.has_value();
  }
  CHECK(found >= 180);
}

TEST_CASE("no two mutants share a name, and their faults cover all that the judge knows", "[mutants]") {
  std::set<std::string_view> names, faults;
  for (const mutants::Mutant& m : mutants::mutants()) {
    names.insert(m.name);
    faults.insert(m.fault);
  }
  CHECK(names.size() == mutants::mutants().size());
  for (const std::string_view fault : fault_names)
    if (fault != "failed") CHECK(faults.contains(fault));
  for (const fuzz::Relation& r : fuzz::relations()) CHECK(faults.contains(r.name));
  // `failed` goes by the outcome's name.
  for (const char* outcome : {"not_converged", "invalid_input", "threw"}) CHECK(faults.contains(outcome));
}
