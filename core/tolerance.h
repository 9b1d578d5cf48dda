// The core's own constants: unit, scale law, reason, and the test that fails when one is wrong. A
// comparison divides by a stated scale; nothing here is an absolute length.
#pragma once

namespace touchstone::tolerance {

/// Relative forward error bound of a 3×3 determinant of differences in double, below which its sign is
/// computed exactly: about ten times the bound of Shewchuk 1997 (7.8e-16), so that the rounded differences
/// are covered too. Tested by: tests/core "orientation is exact where rounding would lie".
inline constexpr double orientation_filter = 0x1p-46;

/// τ of our own core, in units of (unit roundoff 2⁻⁵³ · L): an answer is wrong beyond 128·2⁻⁵³·L = 64·ε·L
/// (issue: 64·ε·L in double). About 30 roundings lie between a pose and a depth; the factor leaves a margin
/// of 4. Tested by: tests/fuzz "our core is right on random cases".
inline constexpr double core_tau_factor = 128;

// ---- core/narrow, core/impact, core/broad. `size` is the reach of both bodies plus their separation, at
// most about 6·L.

/// GJK and EPA stop when upper and lower bound of the distance or depth are this close, in units of size:
/// 2⁻⁵² · size is 1/20 of τ. Tested by: tests/core "distance, feasibility and
/// witnesses hold within tau".
inline constexpr double narrow_gap_factor = 0x1p-52;

/// Cores nearer than this · size are treated as touching: their distance is below the resolution of their
/// witness points, so the normal comes from the boundary (EPA). Tested by: tests/core "ladder of the gap".
inline constexpr double narrow_touching_factor = 0x1p-54;

/// A gap of at most this · size counts as touching, hence as overlap (truth.md §1): 64 units of the 64-bit
/// arithmetic in which a pair that touches exactly is computed. Tested by: tests/core "exactly touching pairs
/// overlap".
inline constexpr double narrow_contact_factor = 0x1p-58;

/// A lower bound of the distance is lowered by this · (reaches, coordinates and offset of both bodies): about
/// 60 roundings of double, four times what lies between the poses and the bound. Tested by: tests/core "a
/// lower bound of the distance is below it".
inline constexpr double narrow_bound_factor = 0x1p-47;

/// Slack larger than this · size is not_converged: 6·2⁻⁵⁰·L is 3/8 of τ. Tested by: tests/core "distance,
/// feasibility and witnesses hold within tau".
inline constexpr double narrow_accept_factor = 0x1p-50;

/// Vertices within this · size of a support plane belong to its face: about 64 roundings of the shape's own
/// doubles, so that faces written in double are found whole; a manifold point is then off by at most 1/4 of
/// τ. Tested by: tests/core "manifold points lie on both bodies".
inline constexpr double manifold_face_factor = 0x1p-50;

/// Faces and edges of which all corners are within this · size of the support planes, and within half the
/// depth each, belong to the contact, each point with its own depth: the tilts, about 1e-3, at which a stack
/// comes to rest. With less, the contact jumps from corner to corner as the stack rocks.
/// Tested by: tests/core "nearly parallel faces and edges have a whole contact".
inline constexpr double manifold_region_factor = 0x1p-10;

/// Points of nearly parallel features that are nearer to each other than this · size are one.
/// Tested by: tests/core "a contact of nearly parallel features has no point twice".
inline constexpr double manifold_same_factor = 0x1p-14;

/// Rounded edges that are within this · size of each other across the contact count as parallel: about what
/// the rounding of a pose to float moves them.
/// Tested by: tests/core "nearly parallel faces and edges have a whole contact".
inline constexpr double manifold_beside_factor = 0x1p-20;

/// Squared sine of an angle below which two segments, edges or axes count as parallel: a direction computed
/// from both loses up to half of its digits there, so it is found in another way. A pure number. Tested by:
/// tests/core "ladder of the angle from parallel".
inline constexpr double parallel_sine_sq = 1e-6;

/// A box or ball that bounds part of a mesh is skipped only if it is out of reach by this · (the lengths
/// involved): far more than a dozen roundings of either arithmetic, and far less than it costs to test one
/// triangle more. Tested by: tests/core "a body against a mesh: the same with a tree, and in agreement with
/// the referee".
inline constexpr double box_rounding = 0x1p-40;

/// Conservative advancement stops at this gap, in units of size: at most 3/8 of τ. Tested by:
/// tests/core "impact: translations are exact to tau".
inline constexpr double impact_gap_factor = 0x1p-50;

/// World AABBs are widened by this · (size of the body + |translation|) before they are rounded outward; the
/// bound that it covers is derived in core/broad/body_box.cpp. Tested by: tests/core "boxes contain the exact
/// body".
inline constexpr double box_error_factor = 0x1p-58;

// ---- core/broad: tuning for speed only; any value reports the same pairs
// (tests/core/broad_catalog_test.cpp). Tested by: tests/bench.

/// Width of grid columns, in units of the median box. If they are narrower, a box meets too many.
inline constexpr double grid_cell_factor = 2;
/// Boxes that a box should meet in the cells that it reaches (a count): one comparison of 16 lanes.
inline constexpr double grid_window = 8;
/// Length of the cells along a column, in units of the median box.
inline constexpr double grid_cut = 0.3;
/// A level of fewer boxes than this is swept without cells (a count).
inline constexpr unsigned grid_min_boxes = 64;
/// A box in a neighbour list is widened by `neighbour_margin_steps` times its last step, or not at all when
/// that exceeds `neighbour_max_margin` times its largest side. The list is rebuilt when more than one box in
/// `neighbour_loose_share` has left its widened box (a count).
inline constexpr double neighbour_margin_steps = 5, neighbour_max_margin = 0.3;
inline constexpr unsigned neighbour_loose_share = 16;
/// Insertion sort may spend this many moves per box before the order is sorted from scratch: about the cost
/// of a radix sort.
inline constexpr unsigned sweep_moves_per_box = 8;
/// Changed boxes are searched one by one when fewer than one in this many has changed.
inline constexpr unsigned sweep_local_share = 8;
/// The automatic choice: all pairs are tested up to `brute_force_max` boxes; no cells are built up to
/// `sweep_max_reach` boxes in the reach of a sweep (counts).
inline constexpr unsigned brute_force_max = 160;
inline constexpr double sweep_max_reach = 40;
/// A refitted tree is rebuilt when its lowest nodes have grown by this factor: a build costs about twice as
/// much as a refit, and overlap of nodes grows with the cube of their reach.
inline constexpr double tree_decay = 1.15;
/// The same limit for changes made box by box. A rebuild would undo many of them at once: split nodes are
/// three quarters full, and a search costs about that much more.
inline constexpr double tree_local_decay = 1.6;
/// A tree is rebuilt when more than one in this many of its boxes is inserted or removed at once (a count).
inline constexpr unsigned tree_change_share = 8;

}  // namespace touchstone::tolerance
