// Placing a pair so that the gap is known: along a chosen direction, or by construction.
#pragma once

#include <cmath>

#include "core/math/rng.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// A scene of two bodies (0 and 1) of the given kinds with random rotations, the first one at `origin`.
Scene random_pair(Rng& rng, ShapeKind a, ShapeKind b, double scale, const Vec3& origin);

/// Moves body 1 so that along the unit direction n (world, from 0 to 1) the support planes are `gap` apart
/// (negative: the bodies overlap by that much along n). `sideways` shifts it perpendicular to n by that
/// fraction of its size.
void place_along(Rng& rng, Scene& pair, const Vec3& n, double gap, double sideways);

/// The direction for placing: random, or the outward normal when body 0 is a half-space.
Vec3 placement_direction(Rng& rng, const Scene& pair);

/// The point of a convex body farthest along n (world), relative to the body's origin; zero for a half-space
/// or mesh.
Vec3 farthest_point(const Scene& s, int body, const Vec3& n);

double mean_extent(const Scene& pair);

/// The nearest multiple of 1/8.
inline double to_eighths(double x) { return std::round(x * 8) / 8; }

/// Body 1, of shape 1, becomes a ray, a point that moves by `way` in the step and is at `aim` after `part` of
/// it.
void make_ray(Scene& pair, const Vec3& aim, const Vec3& way, double part);

/// Asks for overlap, distance and contact of bodies 0 and 1.
void ask_pair(Case& c);

/// Two kinds of which at least one is bounded and convex: never mesh with mesh (family `surfaces`),
/// half-space with half-space, or mesh with half-space. The unbounded or static kind comes first.
std::pair<ShapeKind, ShapeKind> random_kinds(Rng& rng);

/// Places body 1 so that the point of A farthest along a random direction n (the normal of a half-space) and
/// the point of B farthest along −n are `gap` · (size of the pair) apart along n. When gap > 0 this is the
/// distance, because a plane between the bodies proves that it is no less; when gap < 0 it bounds the depth
/// from above. For a mesh only the support planes are that far apart.
Scene at_gap(Rng& rng, Scene pair, double gap);

}  // namespace touchstone::fuzz
