// Every pair of boxes is tested: n(n−1)/2 tests, the reference for every other algorithm.
#pragma once

#include "core/broad/broad_phase.h"

namespace touchstone::broad {

BroadPhasePtr make_brute_force();

}  // namespace touchstone::broad
