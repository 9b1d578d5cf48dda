// Causes as `touchstone causes` finds them, for tests of what is made of them. The cases are from the corpus.
#pragma once

#include <cstddef>

#include "reports/record/causes.h"

namespace touchstone::test {

/// Five causes of four paths in the order of the record: missed with motion, infeasible with an answer to
/// every intervention, not minimal with consequences, distance without a program, and a documented one.
fuzz::Causes sample_causes();

/// As many as a long campaign has, each with other numbers and its own program.
fuzz::Causes many_causes(std::size_t count);

/// What a hostile results file may hold in every text: markup, control characters, commands, no spaces.
fuzz::Causes hostile_causes();

}  // namespace touchstone::test
