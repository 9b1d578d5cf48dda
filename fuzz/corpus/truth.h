// From a seed to a case of the corpus: the truth about it.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "fuzz/corpus/corpus_case.h"

namespace touchstone::fuzz::corpus {

/// A case, or why the seed cannot be one: the referee cannot decide it. Certificates that are too long for a
/// compact corpus are left out.
std::variant<CorpusCase, std::string> with_truth(const Seed& seed);

/// Of two moving bodies. Empty if the windows cannot be found.
std::optional<MotionFacts> motion_facts(const Scene& scene);

/// Rational arithmetic: apart, the nearest points of the cores; overlapping, the least width over the normals
/// of all possible faces of the Minkowski difference. Empty for other shapes, for cores with many vertices,
/// and if the fractions are long. Throws std::logic_error if the result is not in `bracket`, which the
/// referee has proven.
std::optional<ExactGap> exact_gap(const Placed& a, const Placed& b, const referee::Bracket& bracket);

}  // namespace touchstone::fuzz::corpus
