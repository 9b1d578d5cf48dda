// What a certificate rests on: a table of evidence, each a finite or endless list of cases. A case is a pure
// function of (evidence, seed, index, scalar), so that any one can be made again alone.
#pragma once

#include <span>

#include "scenarios/exhaustive/box_scene.h"
#include "scenarios/value/evidence_kind.h"

namespace touchstone::fuzz {

enum class Scope : std::uint8_t { quick, full };

struct Draw {
  std::uint64_t seed = 1;
  Scalar scalar = Scalar::float64;
  Scope scope = Scope::quick;
};

struct EvidenceRow {
  std::string_view name;
  EvidenceKind kind;
  BroadLevel level;
  std::string_view line;  // what it is, for people
  std::uint64_t quick, full;
  /// Exhaustive: how many there are; null: endless.
  std::uint64_t (*population)(const Draw&);
  void (*make)(const Draw&, std::uint64_t index, Case& out);
  /// Numbers that are no closed box: they need not be paired, and may not cost another pair.
  bool invalid = false;
  /// Bodies move within the step: for subjects that sweep.
  bool sweeps = false;
  std::uint64_t chunk = 256;  // cases that one job takes at once
};

std::span<const EvidenceRow> all_evidence();

/// Cases asked in this scope: all there are when that is fewer.
std::uint64_t planned_cases(const EvidenceRow& e, const Draw& d);

/// Case `i` of `planned`: exhaustive lists that are sampled are sampled evenly.
Case evidence_case(const EvidenceRow& e, const Draw& d, std::uint64_t i, std::uint64_t planned);

}  // namespace touchstone::fuzz
