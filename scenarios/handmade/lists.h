// One list per file; catalog.cpp joins them.
#pragma once

#include <vector>

#include "scenarios/handmade/scenario.h"

namespace touchstone::scenarios {

using List = std::vector<Scenario>;

List touching_polytopes();
List touching_round_shapes();
List thin_plates_and_rods();
List far_offsets();
List far_size_ratios();
List deep_centred();
List deep_off_centre();
List degenerate_aligned();
List degenerate_flat();
List degenerate_written_oddly();
List motion_tunnelling();
List motion_boundaries();
List motion_rotation();
List motion_frames();
List crowd_lattices();
List crowd_piles();
List lifecycle_scripts();

}  // namespace touchstone::scenarios
