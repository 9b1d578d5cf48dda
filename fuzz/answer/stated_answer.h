// Somebody's own numbers about a pair of bodies, and the judge's ruling on them (docs/truth.md §3).
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/scene/scene.h"
#include "scenarios/codec/json_reader.h"
#include "scenarios/value/judgement.h"
#include "scenarios/value/observation.h"

namespace touchstone::fuzz {

/// Nothing that is not stated is judged.
struct StatedAnswer {
  /// overlap, distance (signed; minus the depth of an overlap), normal (A to B), depth, witness, manifold.
  Observation pair;
  bool says_impact = false;  // pair.toi is stated; empty: "no impact in [0,1]"
  bool states_anything() const;
};

/// {"overlap": bool, "distance": x, "lower_bound": x, "upper_bound": x, "witness": [[x,y,z],[x,y,z]],
/// "normal": [x,y,z], "moment": [x,y,z], "unique_gradient": bool, "depth": x,
///  "points": [{"position": [x,y,z], "depth": x}], "time_of_impact": t or null}; any of them. A
/// witness may also be six numbers, and `overlap` null, which states nothing. NaN and
/// infinities, which JSON lacks, are the strings "NaN", "Infinity" and "-Infinity". A depth of an answer that
/// does not state `overlap` means contact when it is 0 or more, and bodies apart by its amount when negative.
/// Throws InputError.
StatedAnswer stated_answer_from_json(const JsonReader& r);

/// Adds what a depth says without saying it (above), for answers that come in another form.
void complete(StatedAnswer& answer);

/// How much error is allowed: τ = 64 · unit roundoff · L (docs/truth.md §3) + the tolerance.
struct StatedPrecision {
  bool single = false;   // computed in floats
  double tolerance = 0;  // a length >= 0, allowed besides
};

/// Judges the answer about bodies 0 and 1. A normal stated for bodies that are apart is judged like one of
/// least depth: the depth is then minus the gap, and the plane across the normal must separate them by it.
/// The outcome is `answered`. Precondition: it states something; the scene is valid and has two bodies.
Judgement judge_stated(const Scene& scene, const StatedAnswer& answer, const StatedPrecision& precision = {});

/// The rulings in words: "right", "wrong: missed, says ...", with every fault.
nlohmann::ordered_json judgement_to_json(const Judgement& j);

}  // namespace touchstone::fuzz
