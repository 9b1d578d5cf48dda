#include <map>
#include <optional>
#include <set>

#include "fuzz/campaign/campaign.h"
#include "fuzz/judge/relation.h"
#include "scenarios/random/family.h"
#include "tests/mutants/lying_engine.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

// The number of cases of the mutant's family needed to find its fault; nothing if `most` are not enough.
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

TEST_CASE("every lying engine is found by the fault of its lie", "[mutants]") {
  std::size_t found = 0;
  for (const mutants::Mutant& m : mutants::mutants()) {
    INFO(m.name << " should be found as " << m.fault << " in family " << m.family);
    const auto cases = cases_to_kill(m, 1500);
    CHECK(cases);
    found += cases.has_value();
  }
  CHECK(found >= 250);
}

TEST_CASE("no two mutants share a name, and they cover every fault that the judge knows", "[mutants]") {
  std::set<std::string_view> names, faults;
  for (const mutants::Mutant& m : mutants::mutants()) {
    names.insert(m.name);
    faults.insert(m.fault);
  }
  CHECK(names.size() == mutants::mutants().size());
  for (const std::string_view fault : fault_names)
    if (fault != "failed") CHECK(faults.contains(fault));
  for (const fuzz::Relation& r : fuzz::relations()) CHECK(faults.contains(r.name));
  // `failed` is named after the outcome.
  for (const char* outcome : {"not_converged", "invalid_input", "threw"}) CHECK(faults.contains(outcome));
}

TEST_CASE("enough mutants share a symptom with another one", "[mutants]") {
  std::map<std::string_view, std::size_t> sharing;
  for (const mutants::Mutant& m : mutants::mutants())
    if (!m.symptom.empty()) ++sharing[m.symptom];
  std::size_t lies = 0;
  for (const auto& [symptom, count] : sharing) {
    INFO(symptom);
    CHECK(count >= 2);
    lies += count;
  }
  CHECK(lies >= 40);
}
