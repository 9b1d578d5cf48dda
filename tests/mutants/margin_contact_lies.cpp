// Lies about the contact of bodies within a margin.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/mutants/pair.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

// Applies `lie` to stated contacts.
Lie on_near(ContactLie lie) {
  return [lie](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::contact_within) && o.overlap.value_or(false) && o.normal && o.depth) lie(c, q, o);
  };
}
// To those of bodies that are apart by more than rounding.
Lie on_apart(ContactLie lie) {
  return [lie](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::contact_within) && o.overlap.value_or(false) && o.normal && o.depth &&
        *o.depth < -1e-9)
      lie(c, q, o);
  };
}

void no_contact(Observation& o) {
  o.overlap = false;
  o.normal.reset();
  o.depth.reset();
  o.manifold.clear();
}

// The verdict for another margin, without normal and depth where there was no contact.
Lie for_margin(double (*other)(double)) {
  return [other](const Case& c, const Query& q, Observation& o) {
    if (!asks(q, Question::contact_within) || !o.overlap) return;
    const bool within = gap(c, q) <= other(c.scene.margin);
    if (!within) return no_contact(o);
    o.overlap = true;
  };
}
double none(double) { return 0; }
double twice(double m) { return 2 * m; }
double short_of(double m) { return m - 1e-9; }
double never_negative(double m) { return std::max(0.0, m); }

void depth_zero(const Case&, const Query&, Observation& o) { o.depth = 0; }
void depth_positive(const Case&, const Query&, Observation& o) { o.depth = -*o.depth; }
void depth_of_grown(const Case& c, const Query&, Observation& o) { *o.depth += c.scene.margin; }
void depth_halved(const Case&, const Query&, Observation& o) { *o.depth /= 2; }
void depth_doubled(const Case&, const Query&, Observation& o) { *o.depth *= 2; }
void depth_not_a_number(const Case&, const Query&, Observation& o) {
  o.depth = std::numeric_limits<double>::quiet_NaN();
}
void normal_flipped(const Case&, const Query&, Observation& o) { *o.normal = -*o.normal; }
void normal_of_margin(const Case& c, const Query&, Observation& o) { *o.normal *= c.scene.margin; }
void normal_of_origins(const Case& c, const Query& q, Observation& o) {
  const Vec3 way = body(c, q.b).pose.translation - body(c, q.a).pose.translation;
  if (way.norm() > 1e-6) o.normal = way.normalized();
}
void points_touch(const Case&, const Query&, Observation& o) {
  for (ManifoldPoint& p : o.manifold) p.depth = 0;
}
void points_of_grown(const Case& c, const Query&, Observation& o) {
  for (ManifoldPoint& p : o.manifold) p.depth += std::abs(c.scene.margin);
}
// On the far side of B.
void points_past(const Case& c, const Query&, Observation& o) {
  for (ManifoldPoint& p : o.manifold) p.position += 2 * std::abs(c.scene.margin) * *o.normal;
}
void points_beside(const Case& c, const Query& q, Observation& o) {
  for (ManifoldPoint& p : o.manifold)
    p.position += 4 * scale_of_pair(c.scene, q.a, q.b) * o.normal->unitOrthogonal();
}

}  // namespace

std::vector<Mutant> margin_contact_lies() {
  return {
      {"near_contact_no_margin", "missed", "margins", "only bodies that overlap have a contact",
       for_margin(none)},
      {"near_contact_twice", "ghost", "margins", "each body gets the margin", for_margin(twice)},
      {"near_contact_short", "missed", "margins", "the last 1e-9 of the margin is beyond",
       for_margin(short_of)},
      {"near_contact_clamped", "ghost", "margins", "a negative margin counts as 0",
       for_margin(never_negative)},
      {"near_contact_depth_zero", "depth_excess", "margins", "bodies that are apart have depth 0",
       on_apart(depth_zero)},
      {"near_contact_depth_positive", "depth_excess", "margins", "a distance is stated as a depth",
       on_apart(depth_positive)},
      {"near_contact_depth_of_grown", "depth_excess", "margins", "the depth of bodies grown by the margin",
       on_apart(depth_of_grown)},
      {"near_contact_depth_halved", "depth_excess", "margins", "half of the distance",
       on_apart(depth_halved)},
      {"near_contact_depth_doubled", "infeasible", "margins", "twice the distance", on_apart(depth_doubled)},
      {"near_contact_depth_nan", "no_number", "margins", "bodies that are apart have no depth",
       on_apart(depth_not_a_number)},
      {"near_contact_normal_flipped", "not_minimal", "margins", "from B to A while they are apart",
       on_apart(normal_flipped)},
      {"near_contact_normal_origins", "not_minimal", "margins", "along the line between the origins",
       on_apart(normal_of_origins)},
      {"near_contact_normal_long", "normal_not_unit", "margins", "the normal is as long as the margin",
       on_near(normal_of_margin)},
      {"near_contact_points_touch", "point_depth", "margins",
       "points between bodies that are apart have depth 0", on_apart(points_touch)},
      {"near_contact_points_of_grown", "point_depth", "margins", "the depths of bodies grown by the margin",
       on_near(points_of_grown)},
      {"near_contact_points_past", "point_off", "margins", "points beyond B", on_apart(points_past)},
      {"near_contact_points_beside", "point_off", "margins", "points beside the bodies",
       on_near(points_beside)},
  };
}

}  // namespace touchstone::mutants
