// The generators of random cases that have files of their own, for the catalog in family.cpp, and the
// variants in which a case of any family may be presented.
#pragma once

#include "core/math/rng.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

// Meshes from one triangle to hundreds, open, closed, folded and flat; hulls with many vertices.

void meshes(Rng& rng, Case& c);
void many_vertices(Rng& rng, Case& c);
void two_meshes(Rng& rng, Case& c);
void solids(Rng& rng, Case& c);

Shape any_mesh(Rng& rng, double scale);

/// A point of one triangle (in its interior, on its border or at a corner) and its normal, to either side.
struct Spot {
  Vec3 point, normal;  // world
};
/// Precondition: a mesh or a solid mesh.
Spot spot_on(Rng& rng, const Scene& s, int body);

// Pairs whose sizes are unusual: zero (points, segments, discs, plates), or very different; and boxes and
// prisms whose edges are almost parallel.

void zero_sizes(Rng& rng, Case& c);
void unequal_sizes(Rng& rng, Case& c);
void nearly_parallel(Rng& rng, Case& c);

/// Sets one, several or all sizes of the shape to zero. Ellipsoids, half-spaces and meshes are unchanged.
void flatten(Rng& rng, Shape& shape);

/// A gap for a pair of the given size: zero, 2^-40 to 2^-7 of the size with either sign, or comparable to the
/// size.
double any_gap(Rng& rng, double size);

/// Asks for the time of impact of body 1, which flies against n at `least` to 3 lengths a step, aside by up
/// to one, and in four of ten cases turns.
void ask_impact_against(Rng& rng, Case& c, const Vec3& n, double least);

/// Swaps bodies 0 and 1.
void exchange_bodies(Scene& pair);

// Scenes of several bodies with more demanding queries than a crowd: with meshes, half-spaces, groups and
// ignored pairs; with shared shapes; with many queries in a row, which reveals an engine that keeps state it
// must not keep.

void company(Rng& rng, Case& c);
void dialogue(Rng& rng, Case& c);
void endless_dialogue(Rng& rng, Case& c);

// Crowds in which an error of one ulp makes a broad phase fail: many boxes of very different sizes that touch
// exactly or overlap by a rounding error, on both sides of the origin and far from it, and scripts over them.

void tiles(Rng& rng, Case& c);
void throng(Rng& rng, Case& c);
void errands(Rng& rng, Case& c);

// Motions whose time of impact is decided by small differences: overlapping or touching at the start, passing
// each other with a common tangent plane, going through a thin plate within a fraction of the step.

void start_in_contact(Rng& rng, Case& c);
void graze(Rng& rng, Case& c);
void bullet(Rng& rng, Case& c);

void last_moment(Rng& rng, Case& c);
void whirl(Rng& rng, Case& c);
void swarm(Rng& rng, Case& c);

// Convex shapes that came later than common_convex_kinds (random_shape.h), each against another of any kind:
// apart, near, deep, concentric or in motion; some are parallel, and one in four has a thin size or sizes of
// zero. The padded ones by themselves.

void later_shapes(Rng& rng, Case& c);
void padded_shapes(Rng& rng, Case& c);

// Questions about margins, for pairs and crowds, and rays: at the boundary between two answers.

void margins(Rng& rng, Case& c);
void loose_crowd(Rng& rng, Case& c);
void rays(Rng& rng, Case& c);

// Height fields, centred at the origin and with the diagonals of height_surface.h, against convex bodies, and
// groups of convex shapes as the links of a robot are, on a ground or in the air.

void height_fields(Rng& rng, Case& c);
void compounds(Rng& rng, Case& c);

// A smooth motion in 4 to 16 frames (motions.h): candidates in every frame, contacts in the first.

void motions(Rng& rng, Case& c);

// Variants in which a case of any family may be presented: the pair swapped, the queries reordered,
// quaternions of any length, the previous case again with one body moved.

/// Whether a case is a modified copy of the previous one; most are not.
bool is_sequel(Rng& rng);
/// Turns the previous case into a new one: unchanged, or with one body moved by 2^-30 to 1 of its size, or
/// turned.
void move_a_body(Rng& rng, Case& c);

/// Applies each variant with its own probability; most cases stay unchanged.
void apply_forms(Rng& rng, Case& c);

}  // namespace touchstone::fuzz
