#include "scenarios/value/judgement.h"

#include <algorithm>

namespace touchstone {

Ruling Judgement::ruling() const {
  if (outcome == Outcome::unsupported) return Ruling::unsupported;
  if (outcome != Outcome::answered) return faults.empty() ? Ruling::refused : Ruling::failed;
  if (!faults.empty()) return Ruling::wrong;
  if (undecided) return Ruling::undecided;
  return unjudged.empty() ? Ruling::right : Ruling::not_judged;
}

bool Judgement::unjudged_by_definition() const {
  return std::all_of(unjudged.begin(), unjudged.end(), [](const Unjudged& u) { return u.by_definition; });
}

}  // namespace touchstone
