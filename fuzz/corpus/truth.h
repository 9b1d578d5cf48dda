// From a seed to a case of the corpus.
#pragma once

#include <string>
#include <variant>

#include "fuzz/corpus/corpus_case.h"

namespace touchstone::fuzz::corpus {

/// A case, or why the seed cannot be one: the referee cannot decide it. Certificates that are too long for a
/// compact corpus are left out.
std::variant<CorpusCase, std::string> with_truth(const Seed& seed);

/// Of two moving bodies. Empty if the windows cannot be found.
std::optional<MotionFacts> motion_facts(const Scene& scene);

}  // namespace touchstone::fuzz::corpus
