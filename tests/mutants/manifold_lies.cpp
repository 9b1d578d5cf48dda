// Lies about the points of a contact manifold. Their number is no lie: coverage is charted.
#include <limits>

#include "tests/mutants/pair.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

using Points = std::vector<ManifoldPoint>;

void first_far_off(const Case&, const Query&, Observation& o) {
  if (!o.manifold.empty()) o.manifold[0].position += Vec3::Constant(10);
}
void last_off(const Case&, const Query&, Observation& o) {
  if (o.manifold.size() > 2) o.manifold.back().position += *o.normal * (2 * *o.depth + 1e-10);
}
void lifted(const Case&, const Query&, Observation& o) {
  for (ManifoldPoint& p : o.manifold) p.position += *o.normal * (3 * *o.depth);
}
void local(const Case& c, const Query& q, Observation& o) {
  const Pose& pose = body(c, q.a).pose;
  for (ManifoldPoint& p : o.manifold)
    p.position = rotation_matrix(pose.rotation).transpose() * (p.position - pose.translation);
}
void relative_to_first(const Case& c, const Query& q, Observation& o) {
  for (ManifoldPoint& p : o.manifold) p.position -= body(c, q.a).pose.translation;
}
// Clipping that forgets the incident face: a corner of A's box instead of the common region.
void whole_reference_face(const Case& c, const Query& q, Observation& o) {
  const auto* box = std::get_if<Box>(&c.scene.shape_of(q.a));
  if (!box || o.manifold.empty()) return;
  const Mat3 r = rotation_matrix(body(c, q.a).pose.rotation);
  const Vec3 n = r.transpose() * *o.normal;
  const Vec3 corner = box->half_extents.cwiseProduct((n.array() < 0).select(Vec3(-1, -1, -1), Vec3(1, 1, 1)));
  o.manifold[0].position = r * corner + body(c, q.a).pose.translation;
}
void origin_of_first(const Case& c, const Query& q, Observation& o) {
  if (!o.manifold.empty()) o.manifold[0].position = body(c, q.a).pose.translation;
}
void extrapolated(const Case&, const Query&, Observation& o) {
  if (o.manifold.size() >= 2)
    o.manifold[0].position += (o.manifold[0].position - o.manifold[1].position) * 0.1;
}
void not_a_number(const Case&, const Query&, Observation& o) {
  if (o.manifold.size() >= 4) o.manifold[3].position.setConstant(std::numeric_limits<double>::quiet_NaN());
}

// A point kept from the contact before, of whatever pair that was.
Lie cached() {
  return [last = Points{}](const Case&, const Query& q, Observation& o) mutable {
    if (!asks(q, Question::contact) || o.manifold.empty()) return;
    Points now = o.manifold;
    if (!last.empty()) o.manifold.push_back(last[0]);
    last = std::move(now);
  };
}

}  // namespace

std::vector<Mutant> manifold_lies() {
  return {
      {"point_far_off", "point_off", "shallow", "the first point is 10 off", on_contact(first_far_off)},
      {"point_last_off", "point_off", "lattice",
       "of three points and more the last is off by twice the depth", on_contact(last_off)},
      {"point_lifted", "point_off", "shallow", "all points off along the normal", on_contact(lifted)},
      {"point_local", "point_off", "shallow", "in A's frame", on_contact(local)},
      {"point_relative", "point_off", "far", "relative to A's origin", on_contact(relative_to_first)},
      {"point_not_clipped", "point_off", "shallow", "a corner of A's face, whatever B covers of it",
       on_contact(whole_reference_face)},
      {"point_at_origin", "point_off", "shallow", "the first point is A's origin",
       on_contact(origin_of_first)},
      {"point_extrapolated", "point_off", "shallow", "the first point 10 % too far from the second",
       on_contact(extrapolated)},
      {"point_not_a_number", "point_off", "lattice", "the fourth point is NaN", on_contact(not_a_number)},
      {"point_cached", "point_off", "shallow", "a point of the contact before is kept", cached(), false},
  };
}

}  // namespace touchstone::mutants
