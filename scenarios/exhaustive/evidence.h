// The evidence behind a certificate: a table whose rows are finite or endless lists of cases. A case is a
// pure function of (evidence, seed, index, scalar), so any case can be regenerated on its own.
#pragma once

#include <span>

#include "scenarios/exhaustive/box_scene.h"
#include "scenarios/value/certificate.h"

namespace touchstone::fuzz {

enum class Scope : std::uint8_t { quick, full };

struct Draw {
  std::uint64_t seed = 1;
  Scalar scalar = Scalar::float64;
  Scope scope = Scope::quick;
};

struct EvidenceRow {
  std::string_view name;
  SuiteKind kind;
  BroadLevel level;
  std::string_view line;  // summary for display
  std::uint64_t quick, full;
  /// The number of cases of an exhaustive list; null: endless.
  std::uint64_t (*population)(const Draw&);
  void (*make)(const Draw&, std::uint64_t index, Case& out);
  /// Some boxes are not closed boxes: they need not be paired, but must not make other boxes lose pairs.
  bool invalid = false;
  /// Bodies move within the step: only for subjects that sweep.
  bool sweeps = false;
  std::uint64_t chunk = 256;  // cases per job
};

std::span<const EvidenceRow> all_evidence();

/// The number of cases in this scope, at most the size of the list.
std::uint64_t planned_cases(const EvidenceRow& e, const Draw& d);

/// Case `i` of `planned`. Exhaustive lists that are sampled are sampled evenly.
Case evidence_case(const EvidenceRow& e, const Draw& d, std::uint64_t i, std::uint64_t planned);

}  // namespace touchstone::fuzz
