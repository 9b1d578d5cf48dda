// What differs between two results of the same cases and answers, judged twice.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reports/record/result.h"

namespace touchstone::fuzz {

struct ResultChanges {
  bool none = true;                         // the digests are equal
  std::vector<std::string> appeared, gone;  // keys of findings, sorted
  struct OfFinding {
    std::string key;
    std::uint64_t count_before = 0, count_after = 0;
    bool first_case = false, evidence = false, words = false;  // what else differs
  };
  std::vector<OfFinding> changed;  // findings of both results, by key
  struct OfCount {
    std::string engine, subject;  // subject: a question or a relation
    std::string count;            // "right", "missed", "broken", …
    std::uint64_t before = 0, after = 0;
  };
  std::vector<OfCount> counts;
};

ResultChanges changes_between(const CampaignResult& before, const CampaignResult& after);
Json to_json(const ResultChanges& c);

}  // namespace touchstone::fuzz
