// Equivalent forms of a pair, for which the right answer is known to be the same: any change is due to the
// engine.
#pragma once

#include "core/math/rng.h"
#include "fuzz/judge/relation.h"
#include "fuzz/judge/truth.h"

namespace touchstone::fuzz {

enum class FormKind : std::uint8_t { nudged, exchanged, frame, unit };

/// The queries correspond one to one to those of the pair as asked.
struct PairForm : Form {
  FormKind kind = FormKind::nudged;
};

/// `nudged`: moves each coordinate of B to an adjacent double, up or down. `exchanged`: swaps A and B.
/// `frame`: half-turns, permuted axes (unless a shape has its own axis), A moved to the origin (where that is
/// exact). `unit`: scales by powers of two. All except `nudged` are exact. Precondition: two bodies, pair
/// questions.
std::vector<PairForm> other_forms(const Case& c, Rng& rng);

struct FormAnswer {
  const Case& c;
  const CaseObservations& observed;
};
/// True when two answers to one query cannot both be right by the engine's own tolerances: their gap
/// intervals are disjoint (relation.h), only one of them is an answer, or two times differ and the referee
/// finds one of them wrong. A time-out proves nothing.
bool contradicts(const FormAnswer& asked, bool asked_is_wrong, const PairForm& form,
                 const CaseObservations& observed, std::size_t query, const EngineCard& card, Truth& truth);

}  // namespace touchstone::fuzz
