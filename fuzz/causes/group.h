// Representatives that have one cause. Two responses of one cause differ by chance: cases lie closer to a
// boundary or farther from it. How much is measured, on two examples of one finding; more than that is
// another cause.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "fuzz/causes/engine_pool.h"
#include "fuzz/causes/representative.h"

namespace touchstone::fuzz {

/// How unlike two examined findings are: the share of interventions after which one fault vanishes and the
/// other stays. The number of bodies, the steps of the script, the kinds of shapes that the fault needs, the
/// part of the answer that is wrong and the law of its errors count as five more. 0 when nothing was asked.
///
/// Both cases are reduced, so a change that does not apply, because its object was reduced away (there is no
/// script, no box), counts as one that the fault survives.
double difference(const Representative& x, const Representative& y);
double difference(const Examined& x, const Examined& y);

/// True when the fault vanishes under at least two thirds of the interventions that apply: its case is a
/// borderline one and says nothing about its cause.
bool is_fragile(const Responses& r);

struct Group {
  std::vector<std::size_t> members;       // indices of representatives; the first is the clearest
  std::vector<std::size_t> consequences;  // representatives whose faults follow from this one's
  std::vector<const Finding*> explained;  // contradictions; set by Assembly
  std::string documented;                 // as in EngineKnowledge; of all members
  std::string shown_only_by;              // engines, if others were told apart by them; set by told_apart
  std::string id;                         // of its cause; set by Assembly
};

/// By path: the difference that three of four pairs of examples of one finding do not exceed; at least that
/// of all paths together. Empty with fewer than four pairs: any difference tells causes apart.
using Noise = std::map<std::string, double>;
Noise noise_of(std::span<const FindingClass> classes, std::span<const Representative> all);

/// True when the responses of one cause are equal as a rule, as those of engines that are wrong by a simple
/// condition: then any difference tells causes apart.
inline bool is_exact(double noise) {
  constexpr double one_response = 0.01;  // of the hundred that are compared
  return noise < one_response;
}

struct GroupInput {
  std::span<const FindingClass> classes;
  std::span<const Representative> representatives;
  std::span<const double> rates;  // of each class: wrong answers / answers
  const EngineKnowledge& knowledge;
  const Noise& noise;
};

/// Every representative is in exactly one group, as a member or as a consequence. Deterministic.
std::vector<Group> grouped(const GroupInput& in);

/// Asks engines of one path about each other's cases, and divides groups whose engines do not show the fault
/// there, with about the same error: two findings with equal responses may still have two causes, if two
/// engines show them. Of findings of one engine this says nothing, because it shows both. Only where the
/// responses of one cause are equal as a rule (is_exact): elsewhere a case near a boundary shows a fault in
/// one engine and not in another by chance. Members whose own case shows nothing stay with the first part.
std::vector<Group> told_apart(std::vector<Group> groups, const GroupInput& in, EnginePool& pool);

}  // namespace touchstone::fuzz
