// A pair in other forms, of which the right answers are known to be the same: what changes is the engine's.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "core/math/rng.h"
#include "fuzz/judge/truth.h"
#include "oracles/abi/engine.h"

namespace touchstone::fuzz {

enum class FormKind : std::uint8_t { nudged, exchanged, frame, unit };
inline constexpr auto form_names = std::to_array<std::string_view>({"jitter", "order", "frame", "unit"});

struct Form {
  FormKind kind;
  Case c;            // queries one for one
  double scale = 1;  // lengths here / lengths of the pair as asked
};

/// `nudged`: each coordinate of B to the next double, up or down. `exchanged`: A and B asked as B and A.
/// `frame`: half-turns, axes permuted (no shapes with an axis of their own), A moved to the origin (where
/// that is exact). `unit`: scaled by 2^20 and 2^-12. All but `nudged` without a rounding. Precondition: two
/// bodies, pair questions.
std::vector<Form> other_forms(const Case& c, Rng& rng);

/// The number that an answer is about: distance, depth, time; NaN when it states none.
double number_of(const Query& q, const Observation& o);

/// True when the two answers to one query cannot both be right, by the engine's own tolerances: their gaps
/// exclude each other (fuzz/judge/relation.h), one of them is no answer, or, of times, they differ and the
/// referee finds one of them wrong. A time-out says nothing.
struct FormAnswer {
  const Case& c;
  const CaseObservations& observed;
};
bool contradicts(const FormAnswer& asked, bool asked_is_wrong, const Form& form,
                 const CaseObservations& observed, std::size_t query, const EngineCard& card, Truth& truth);

}  // namespace touchstone::fuzz
