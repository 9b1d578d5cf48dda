// Sort and sweep (Baraff 1992, §"bounding boxes"), rebuilt for each query. The boxes are sorted by their
// lower end on the axis on which their centres are spread most (least pruning left to do by the other two);
// each box is compared with those that begin before it ends, ties included; all three axes are tested.
#pragma once

#include "core/broad/broad_phase.h"

namespace touchstone::broad {

BroadPhasePtr make_sort_and_sweep();

}  // namespace touchstone::broad
