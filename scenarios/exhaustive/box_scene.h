// Scenes of boxes whose corners t ± h are exact in the subject's arithmetic: nothing is rounded, so such a
// box does not depend on who computes it.
#pragma once

#include <optional>

#include "core/math/aabb.h"
#include "core/math/rng.h"
#include "scenarios/value/candidate_pairs.h"
#include "scenarios/value/observation.h"

namespace touchstone::fuzz {

/// The subject's scalar.
enum class Scalar : std::uint8_t { float32, float64 };

/// The next number of the scalar's format in the direction of the sign.
double next_number(double x, int direction, Scalar scalar);
/// Distance from 1 to the next number.
double unit_in_last_place(Scalar scalar);
double nearest(double x, Scalar scalar);

/// Exactly t - h, t + h along every axis; empty when a corner is not representable or not finite.
std::optional<Aabb> exact_corners(const Vec3& t, const Vec3& h, Scalar scalar);

/// Centre and half extents of the box, or of the nearest larger box for which they are representable.
struct Placing {
  Vec3 t, h;
};
std::optional<Placing> placing_of(Aabb box, Scalar scalar);

/// Appends a body with its own shape and returns the body's index.
int add_box(Scene& s, const Placing& p, bool fixed = false);

void insert_all(Scene& s);
inline void step_insert(Scene& s, int body) { s.script.push_back({Step::Op::insert, body, std::nullopt}); }
inline void step_insert(Scene& s, int body, const Pose& p) {
  s.script.push_back({Step::Op::insert, body, p});
}
inline void step_move(Scene& s, int body, const Pose& p) { s.script.push_back({Step::Op::move, body, p}); }
inline void step_remove(Scene& s, int body) { s.script.push_back({Step::Op::remove, body, std::nullopt}); }
inline void step_query(Scene& s) { s.script.push_back({Step::Op::query, -1, std::nullopt}); }

}  // namespace touchstone::fuzz
