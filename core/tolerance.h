// The core's own constants: unit, scale law, reason, and the test that bites when it is wrong. A
// comparison divides by a stated scale; nothing here is an absolute length.
#pragma once

namespace touchstone::tolerance {

/// Relative forward error bound of a 3×3 determinant of differences in double, below which its sign is worked
/// out exactly: about ten times the bound of Shewchuk 1997 (7.8e-16), so that the rounded differences are
/// covered too. Bites: tests/core "orientation is exact where rounding would lie".
inline constexpr double orientation_filter = 0x1p-46;

/// τ of our own core, in units of (unit roundoff 2⁻⁵³ · L): wrong beyond 128·2⁻⁵³·L = 64·ε·L (issue: 64·ε·L
/// in double). About 30 roundings lie between a pose and a depth; the factor leaves a margin of 4. Bites:
/// fuzz with the core as subject.
inline constexpr double core_tau_factor = 128;

// ---- core/narrow, core/impact, core/broad. `size` is the reach of both bodies plus their separation, at
// most about 6·L.

/// GJK and EPA stop when upper and lower bound of the distance or depth are this close, in units of size:
/// 2⁻⁵² · size is 1/20 of τ. Bites: tests/core duality gap; tests/core/stress.
inline constexpr double narrow_gap_factor = 0x1p-52;

/// Cores nearer than this · size are treated as touching: their distance is below what their witness points
/// resolve, so the normal comes from the boundary (EPA). Bites: tests/core "touching at every kind of
/// feature".
inline constexpr double narrow_touching_factor = 0x1p-54;

/// A gap of at most this · size counts as touching, hence as overlap (truth.md §1): 64 units of the 64-bit
/// arithmetic, in which a pair that touches exactly is computed. Bites: tests/core "exactly touching pairs
/// overlap".
inline constexpr double narrow_contact_factor = 0x1p-58;

/// A slack worse than this · size is not_converged: 6·2⁻⁵⁰·L is 3/8 of τ. Bites: tests/core/stress.
inline constexpr double narrow_accept_factor = 0x1p-50;

/// Vertices within this · size of a support plane belong to its face: about 64 roundings of the shape's own
/// doubles, so that faces written in double are found whole; a manifold point is then off by at most 1/4 of
/// τ. Bites: tests/core "manifold points lie on both bodies".
inline constexpr double manifold_face_factor = 0x1p-50;

/// Conservative advancement stops at this gap, in units of size: at most 3/8 of τ. Bites:
/// tests/core "impact".
inline constexpr double impact_gap_factor = 0x1p-50;

/// World boxes are widened by this · (size of the body + |translation|) before they are rounded outward; the
/// bound that it covers is derived in core/broad/body_box.cpp. Bites: tests/core "boxes contain the exact
/// body".
inline constexpr double box_error_factor = 0x1p-58;

// ---- core/broad: choices of speed alone; any value reports the same pairs
// (tests/core/broad_catalog_test.cpp). Bites: tests/bench.

/// Columns of a grid, in units of the median box: narrower, a box meets too many.
inline constexpr double grid_cell_factor = 2;
/// Boxes that a box should find to compare with in the cells that it reaches (a count): one comparison of 16 lanes.
inline constexpr double grid_window = 8;
/// Cells along a column, in units of the median box.
inline constexpr double grid_cut = 0.3;
/// Below this many boxes a level is swept without cells (a count).
inline constexpr unsigned grid_least_boxes = 64;
/// A box in a neighbour list is widened by so many of its last steps; when that is more than this share of its largest
/// side, by nothing. The list is made anew when more than one box in so many has left its widened box (a count).
inline constexpr double neighbour_margin_steps = 5, neighbour_margin_most = 0.3;
inline constexpr unsigned neighbour_loose_share = 16;
/// Insertion sort may spend this many moves a box before the order is sorted anew: about the cost of a radix
/// sort.
inline constexpr unsigned sweep_moves_a_box = 8;
/// Changed boxes are searched one by one when they are less than one in this many.
inline constexpr unsigned sweep_local_share = 8;
/// The automatic choice: up to this many boxes all pairs are tested; up to this many boxes in the reach of a sweep no
/// cells are built (counts).
inline constexpr unsigned brute_force_most = 160;
inline constexpr double sweep_reach_most = 40;
/// A refitted tree is built anew when its lowest nodes have grown by this factor: a build costs about twice a
/// refit, overlap of nodes grows with the cube of their reach.
inline constexpr double tree_decay = 1.15;
/// The same for changes box by box, of which a rebuild would undo many at once: split nodes are three quarters full
/// and cost a search about that much more, once.
inline constexpr double tree_rot = 1.6;
/// A tree is built anew when more than one in so many of its boxes comes or goes at once (a count).
inline constexpr unsigned tree_change_share = 8;

}  // namespace touchstone::tolerance
