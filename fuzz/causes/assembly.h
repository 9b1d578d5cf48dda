// A cause made of a group: counts, names, cases, title and id.
#pragma once

#include <string>
#include <vector>

#include "fuzz/causes/classes.h"
#include "fuzz/causes/group.h"
#include "fuzz/causes/representative.h"
#include "reports/record/causes.h"
#include "reports/record/result.h"

namespace touchstone::fuzz {

/// What a campaign's findings were divided into.
struct Parts {
  std::vector<FindingClass> classes;
  std::vector<Representative> all;
  Noise noise;
  std::vector<Group> groups;
};

class Assembly {
 public:
  /// All must outlive the assembly.
  Assembly(const CampaignResult& result, const Parts& p, const EngineKnowledge& knowledge)
      : result_(result), classes_(p.classes), all_(p.all), noise_(p.noise), knowledge_(knowledge) {}

  /// Gives every group its id, and makes those with the same id one. Where the responses of one cause agree
  /// exactly, all of them tell it from others. Elsewhere the id is that of the place: path, route and
  /// symptom; of several groups in one place, the most frequent has this id, and the main reason tells the
  /// others from it.
  std::vector<Group> identified(std::vector<Group> groups) const;
  /// Without certificate and program.
  Cause cause_of(const Group& g) const;

  const Representative& leader(const Group& g) const { return all_[g.members.front()]; }
  const Symptom& symptom(const Group& g) const { return leader(g).symptom; }

 private:
  using Findings = std::vector<const Finding*>;
  Findings findings_of(const Group& g) const;
  void add_lists(Cause& c, const Findings& findings) const;
  void add_consequences(Cause& c, const Group& g) const;
  void add_name(Cause& c, const Group& g, const Findings& findings,
                const std::vector<std::string>& routes) const;
  Responses common_response(const Group& g) const;
  Responses seen_in_leader(const Group& g, Responses of_all) const;
  std::string reason_of(const Group& g, const Responses& of_all) const;
  bool is_exact(const Group& g) const;
  void show_gravest(Group& g) const;
  void share_explained(std::vector<Group>& groups) const;
  std::uint64_t wrong(const Group& g) const;
  template <class KeyOf>
  auto first_frequent(const Group& g, KeyOf&& key_of) const;
  std::string path_word(const Group& g) const;
  std::uint64_t place_hash(const Group& g) const;
  std::uint64_t response_hash(const Group& g, std::uint64_t place) const;

  const CampaignResult& result_;
  const std::vector<FindingClass>& classes_;
  const std::vector<Representative>& all_;
  const Noise& noise_;
  const EngineKnowledge& knowledge_;
};

}  // namespace touchstone::fuzz
