// What the lies about a pair need to know about it.
#pragma once

#include <utility>
#include <vector>

#include "core/impact/impact.h"
#include "core/narrow/narrow_phase.h"
#include "tests/mutants/mutant.h"

namespace touchstone::mutants {

inline bool asks(const Query& q, Question question) { return q.question == question; }

inline const Body& body(const Case& c, int i) { return c.scene.bodies[static_cast<std::size_t>(i)]; }
inline PlacedShape placed(const Case& c, int i) { return {&c.scene.shape_of(i), body(c, i).pose}; }
inline ShapeKind kind(const Case& c, int i) { return kind_of(c.scene.shape_of(i)); }
inline bool are(const Case& c, const Query& q, ShapeKind x, ShapeKind y) {
  return (kind(c, q.a) == x && kind(c, q.b) == y) || (kind(c, q.a) == y && kind(c, q.b) == x);
}
inline bool two_meshes(const Case& c, const Query& q) { return are(c, q, ShapeKind::mesh, ShapeKind::mesh); }
inline bool smooth(ShapeKind k) {
  return k == ShapeKind::cylinder || k == ShapeKind::cone || k == ShapeKind::ellipsoid;
}

/// The pair with its shapes as an engine sees them.
struct SeenPair {
  Shape a, b;
  Pose at_a, at_b;
  template <class See>
  SeenPair(const Case& c, const Query& q, const See& see)
      : a(see(c.scene.shape_of(q.a))),
        b(see(c.scene.shape_of(q.b))),
        at_a(body(c, q.a).pose),
        at_b(body(c, q.b).pose) {}
  PlacedShape first() const { return {&a, at_a}; }
  PlacedShape second() const { return {&b, at_b}; }
};
/// The core's answer to `time_of_impact` about it.
ImpactAnswer impact_of(const SeenPair& p, const Case& c, const Query& q);

/// Largest extent of the smaller body that has one.
double small_size(const Case& c, const Query& q);

/// How far B must move along the unit vector n to separate, in plain arithmetic.
double width(const Case& c, const Query& q, const Vec3& n);

/// Signed distance by the core.
double gap(const Case& c, const Query& q);

/// True when the box of one body is strictly inside that of the other.
bool contained(const Case& c, const Query& q);

/// Applies `lie` to answers to `scene_contacts`.
using SceneLie = void (*)(const Case&, std::vector<SceneContact>&);
Lie on_scene(SceneLie lie);

/// Applies `lie` to answers to `contact` that report a contact.
using ContactLie = void (*)(const Case&, const Query&, Observation&);
Lie on_contact(ContactLie lie);

}  // namespace touchstone::mutants
