#include "reports/record/changes.h"

#include <map>
#include <tuple>

namespace touchstone::fuzz {
namespace {

struct TallyCount {
  const char* name;
  std::uint64_t Tally::*member;
};
constexpr auto tally_counts = std::to_array<TallyCount>({{"right", &Tally::right},
                                                         {"wrong", &Tally::wrong},
                                                         {"missed", &Tally::missed},
                                                         {"ghost", &Tally::ghost},
                                                         {"representation", &Tally::representation},
                                                         {"undecided", &Tally::undecided},
                                                         {"not_judged", &Tally::not_judged},
                                                         {"by_definition", &Tally::by_definition},
                                                         {"within_wide_claim", &Tally::within_wide_claim}});

// By engine, question or relation, and name of the count, in the order of the tables.
struct BeforeAfter {
  std::uint64_t before = 0, after = 0;
};
using Counts = std::map<std::tuple<std::string, std::size_t, std::string, std::size_t>, BeforeAfter>;

void add_counts(const CampaignResult& r, std::uint64_t BeforeAfter::*side, Counts& to) {
  for (const auto& [engine, questions] : r.tallies)
    for (const auto& [q, t] : questions)
      for (std::size_t i = 0; i < tally_counts.size(); ++i)
        to[{engine, static_cast<std::size_t>(q), std::string(to_string(q)), i}].*side =
            t.*tally_counts[i].member;
  for (const auto& [engine, of_engine] : r.relations)
    for (const auto& [name, n] : of_engine)
      to[{engine, question_names.size(), name, tally_counts.size()}].*side = n.broken;
}

void compare_findings(const CampaignResult& before, const CampaignResult& after, ResultChanges& to) {
  for (const auto& [key, f] : before.findings)
    if (!after.findings.contains(key)) to.gone.push_back(key);
  for (const auto& [key, f] : after.findings) {
    const auto it = before.findings.find(key);
    if (it == before.findings.end()) {
      to.appeared.push_back(key);
      continue;
    }
    const Finding& was = it->second;
    const ResultChanges::OfFinding c{key,
                                     was.count,
                                     f.count,
                                     was.first_index != f.first_index,
                                     was.evidence_json != f.evidence_json,
                                     was.words != f.words};
    if (was.count != f.count || c.first_case || c.evidence || c.words) to.changed.push_back(c);
  }
}

}  // namespace

ResultChanges changes_between(const CampaignResult& before, const CampaignResult& after) {
  ResultChanges c;
  c.none = digest(before) == digest(after);
  if (c.none) return c;
  compare_findings(before, after, c);
  Counts counts;
  add_counts(before, &BeforeAfter::before, counts);
  add_counts(after, &BeforeAfter::after, counts);
  for (const auto& [of, n] : counts) {
    const auto& [engine, question, subject, count] = of;
    if (n.before == n.after) continue;
    c.counts.push_back({engine, subject, count < tally_counts.size() ? tally_counts[count].name : "broken",
                        n.before, n.after});
  }
  return c;
}

Json to_json(const ResultChanges& c) {
  Json j = {{"none", c.none}, {"appeared", c.appeared}, {"gone", c.gone}};
  j["changed"] = Json::array();
  for (const auto& f : c.changed)
    j["changed"].push_back({{"key", f.key},
                            {"count", {f.count_before, f.count_after}},
                            {"first_case", f.first_case},
                            {"evidence", f.evidence},
                            {"words", f.words}});
  j["counts"] = Json::array();
  for (const auto& n : c.counts)
    j["counts"].push_back({{"engine", n.engine},
                           {"of", n.subject},
                           {"count", n.count},
                           {"before", n.before},
                           {"after", n.after}});
  return j;
}

}  // namespace touchstone::fuzz
