#include "scenarios/handmade/scenario.h"

#include "scenarios/handmade/lists.h"

namespace touchstone::scenarios {

std::vector<Scenario> catalog() {
  std::vector<Scenario> all;
  for (List (*list)() : {touching_polytopes, touching_round_shapes, thin_plates_and_rods, far_offsets,
                         far_size_ratios, deep_centred, deep_off_centre, degenerate_aligned, degenerate_flat,
                         degenerate_written_oddly, motion_tunnelling, motion_boundaries, motion_rotation, motion_frames,
                         crowd_lattices, crowd_piles, lifecycle_scripts})
    for (Scenario& s : list()) all.push_back(std::move(s));
  return all;
}

}  // namespace touchstone::scenarios
