// What a case made the engines do, in classes: a guided campaign keeps the cases that show a class for the
// first time and derives new cases from them. It never inspects an engine's code, so it works with unknown
// engines too.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/math/rng.h"
#include "oracles/abi/engine.h"
#include "scenarios/value/judgement.h"

namespace touchstone::fuzz {

/// Class hashes of one engine's answer to one query: shape pair, outcome, faults and their magnitude, order
/// of the error and of the gap, which features touch (points of the manifold; whether the normal is along an
/// axis of A or B), degeneracy.
void add_features(const Case& c, const Query& q, const EngineCard& card, const Observation& o,
                  const Judgement& j, std::vector<std::uint64_t>& out);
/// Class hash of all engines' answers to one query: which report overlap, which apart, which failed.
void add_pattern(const Case& c, std::size_t query, std::span<const CaseObservations> observations,
                 std::vector<std::uint64_t>& out);

/// The cases kept. Depends only on the order of the campaign: the same seed keeps the same cases.
struct Pool {
  std::vector<Case> cases;
  std::set<std::uint64_t> features;  // seen, by any case
  std::size_t published = 0;         // number of cases, from the first, that may be drawn

  /// Keeps c when a feature is new.
  void note(const Case& c, std::span<const std::uint64_t> shown);
  /// All cases kept so far may be drawn from now on.
  void publish() { published = cases.size(); }
  bool empty() const { return published == 0; }
  /// A published case with one to four changes, the first valid one of a few tries; an empty id when none is
  /// valid.
  Case draw(Rng& rng) const;
  std::size_t size() const { return cases.size(); }

  static constexpr std::size_t max_cases = 8192;  // of a few kilobytes each
};

}  // namespace touchstone::fuzz
