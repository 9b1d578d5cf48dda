// Lies about the verdict.
#include <algorithm>

#include "tests/mutants/pair.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

using Doubt = bool (*)(const Case&, const Query&);

Lie denied_where(Doubt doubt) {
  return [doubt](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::overlap) && o.overlap.value_or(false) && doubt(c, q)) o.overlap = false;
  };
}
Lie claimed_where(Doubt doubt) {
  return [doubt](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::overlap) && !o.overlap.value_or(true) && doubt(c, q)) o.overlap = true;
  };
}

double far_from_origin(const Case& c, const Query& q) {
  return std::max(body(c, q.a).pose.translation.norm(), body(c, q.b).pose.translation.norm());
}

bool always(const Case&, const Query&) { return true; }
bool shallow(const Case& c, const Query& q) { return gap(c, q) > -1e-9; }
bool near(const Case& c, const Query& q) { return gap(c, q) < 1e-9; }
bool far(const Case& c, const Query& q) { return far_from_origin(c, q) > 1e5; }
bool tiny(const Case& c, const Query& q) { return small_size(c, q) < 0.0005; }
bool deep(const Case& c, const Query& q) { return gap(c, q) < -0.8 * small_size(c, q); }
bool capsule_cone(const Case& c, const Query& q) { return are(c, q, ShapeKind::capsule, ShapeKind::cone); }
bool mesh(const Case& c, const Query& q) { return kind(c, q.a) == ShapeKind::mesh; }
// Two meshes whose hulls, but not whose surfaces, overlap.
bool hulls_overlap(const Case& c, const Query& q) {
  if (!two_meshes(c, q)) return false;
  const auto hull = [&](int i) {
    return Shape(make_hull(std::get<TriangleMesh>(c.scene.shape_of(i)).vertices));
  };
  const Shape x = hull(q.a), y = hull(q.b);
  return overlap({&x, body(c, q.a).pose}, {&y, body(c, q.b).pose}).overlap;
}
bool second_kind_lower(const Case& c, const Query& q) { return kind(c, q.b) < kind(c, q.a); }
bool same_rotation(const Case& c, const Query& q) {
  return body(c, q.a).pose.rotation == body(c, q.b).pose.rotation;
}
bool same_origin(const Case& c, const Query& q) {
  return body(c, q.a).pose.translation == body(c, q.b).pose.translation;
}
bool flat_hull(const Case& c, const Query& q) {
  const auto* h = std::get_if<Hull>(&c.scene.shape_of(q.b));
  return h && h->dimension == 2;
}
bool centres_within_unit_spheres(const Case& c, const Query& q) {
  const double apart = (body(c, q.a).pose.translation - body(c, q.b).pose.translation).norm();
  return apart < bounding_radius(c.scene.shape_of(q.a)) + bounding_radius(c.scene.shape_of(q.b));
}

void float_verdict(const Case& c, const Query& q, Observation& o) {
  if (!asks(q, Question::overlap)) return;
  const OverlapAnswer r = overlap(placed(c, q.a), placed(c, q.b), Arithmetic::float32);
  if (r.outcome == Outcome::answered) o.overlap = r.overlap;
}
void contact_denied_shallow(const Case&, const Query& q, Observation& o) {
  if (!asks(q, Question::contact) || !o.overlap.value_or(false) || o.depth.value_or(1) > 0.01) return;
  o = Observation{};
  o.outcome = Outcome::answered;
  o.overlap = false;
}

}  // namespace

std::vector<Mutant> overlap_lies() {
  return {
      {"overlap_always", "ghost", "separate", "everything overlaps", claimed_where(always)},
      {"overlap_spheres", "ghost", "separate", "overlap of the bounding spheres",
       claimed_where(centres_within_unit_spheres)},
      {"overlap_margin", "ghost", "near", "a margin of 1e-9 that is not claimed", claimed_where(near)},
      {"overlap_touching_denied", "missed", "near", "overlaps of less than 1e-9 are apart",
       denied_where(shallow)},
      {"overlap_contained_denied", "missed", "contained", "a body within the box of the other is apart",
       denied_where(contained)},
      {"overlap_concentric_denied", "missed", "contained", "bodies with equal origins are apart",
       denied_where(same_origin)},
      {"overlap_deep_denied", "missed", "deep", "overlaps of more than 0.8 of the smaller body are apart",
       denied_where(deep)},
      {"overlap_far_denied", "missed", "far", "beyond 1e5 from the origin everything is apart",
       denied_where(far)},
      {"overlap_tiny_denied", "missed", "tiny", "bodies smaller than half a millimetre are apart",
       denied_where(tiny)},
      {"overlap_one_pair_denied", "missed", "shallow", "a capsule and a cone never overlap",
       denied_where(capsule_cone)},
      {"overlap_mesh_denied", "missed", "deep", "a mesh overlaps nothing", denied_where(mesh)},
      {"overlap_two_meshes_denied", "missed", "surfaces", "two meshes never overlap",
       denied_where(two_meshes)},
      {"overlap_of_hulls", "ghost", "surfaces", "two meshes overlap where their hulls do",
       claimed_where(hulls_overlap)},
      {"overlap_flat_hull_denied", "missed", "zero", "a flat hull as the second body overlaps nothing",
       denied_where(flat_hull)},
      {"overlap_one_order_denied", "missed", "shallow", "apart when B's kind of shape is the lower one",
       denied_where(second_kind_lower)},
      {"overlap_parallel_denied", "missed", "lattice", "bodies of equal rotation are apart",
       denied_where(same_rotation)},
      {"overlap_in_float", "missed", "near", "the verdict is computed in single precision", float_verdict},
      {"contact_shallow_denied", "missed", "shallow", "no contact for overlaps of less than 0.01",
       contact_denied_shallow},
  };
}

}  // namespace touchstone::mutants
