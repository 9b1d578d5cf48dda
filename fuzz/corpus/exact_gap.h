// The signed gap of two rounded polytopes (core ⊕ ball, the core a polytope) as a closed form.
#pragma once

#include <optional>

#include "fuzz/corpus/corpus_case.h"

namespace touchstone::fuzz::corpus {

/// Rational arithmetic: apart, the nearest points of the cores; overlapping, the least width over the normals
/// of all possible faces of the Minkowski difference. Empty for other shapes, for cores with many vertices,
/// and if the fractions are long. Throws std::logic_error if the result is not in `bracket`, which the
/// referee has proven.
std::optional<ExactGap> exact_gap(const Placed& a, const Placed& b, const referee::Bracket& bracket);

}  // namespace touchstone::fuzz::corpus
