// Lies about the points of a contact manifold: their positions, depths and extent.
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

// A point kept from the previous contact, whatever its pair.
Lie cached() {
  return [last = Points{}](const Case&, const Query& q, Observation& o) mutable {
    if (!asks(q, Question::contact) || o.manifold.empty()) return;
    Points now = o.manifold;
    if (!last.empty()) o.manifold.push_back(last[0]);
    last = std::move(now);
  };
}

// The remaining points of a face.
void every_second(const Case&, const Query&, Observation& o) {
  Points kept;
  for (std::size_t i = 0; i < o.manifold.size(); i += 2) kept.push_back(o.manifold[i]);
  o.manifold = std::move(kept);
}
void last_dropped(const Case&, const Query&, Observation& o) {
  if (o.manifold.size() > 3) o.manifold.pop_back();
}
void first_three(const Case&, const Query&, Observation& o) {
  if (o.manifold.size() > 3) o.manifold.resize(3);
}
void first_repeated(const Case&, const Query&, Observation& o) {
  if (o.manifold.size() > 3) o.manifold[2] = o.manifold[0];
}
Vec3 centre(const Points& points) {
  Vec3 sum = Vec3::Zero();
  for (const ManifoldPoint& p : points) sum += p.position;
  return sum / static_cast<double>(points.size());
}
void drawn_together(const Case&, const Query&, Observation& o) {
  if (o.manifold.size() < 3) return;
  const Vec3 c = centre(o.manifold);
  for (ManifoldPoint& p : o.manifold) p.position += 0.2 * (c - p.position);
}
void centre_alone(const Case&, const Query&, Observation& o) {
  if (o.manifold.size() > 2) o.manifold = {{centre(o.manifold), *o.depth}};
}
void one_side_forgotten(const Case&, const Query&, Observation& o) {
  if (o.manifold.size() < 3) return;
  const double x = centre(o.manifold).x();
  std::erase_if(o.manifold, [&](const ManifoldPoint& p) { return p.position.x() > x; });
}

void each_twice_as_deep(const Case&, const Query&, Observation& o) {
  for (ManifoldPoint& p : o.manifold) p.depth *= 2;
}
void last_deeper(const Case&, const Query&, Observation& o) {
  if (!o.manifold.empty()) o.manifold.back().depth += 1e-9;
}
void infinitely_deep(const Case&, const Query&, Observation& o) {
  if (o.manifold.size() > 3) o.manifold[0].depth = std::numeric_limits<double>::infinity();
}
// A corner in a face has its depth only at the corner.
void as_deep_beside(const Case&, const Query&, Observation& o) {
  if (o.manifold.size() == 1)
    o.manifold.push_back({o.manifold[0].position + 0.4 * *o.depth * o.normal->unitOrthogonal(), *o.depth});
}

void corner_of_first_mesh(const Case& c, const Query& q, Observation& o) {
  if (!two_meshes(c, q) || o.manifold.empty()) return;
  const Vec3& corner = std::get<TriangleMesh>(c.scene.shape_of(q.a)).vertices.front();
  o.manifold[0].position =
      rotation_matrix(body(c, q.a).pose.rotation) * corner + body(c, q.a).pose.translation;
}

}  // namespace

std::vector<Mutant> manifold_lies() {
  return {
      {"point_far_off", "point_off", "shallow", "the first point is 10 off", on_contact(first_far_off)},
      {"point_last_off", "point_off", "lattice", "the last of three or more points is off by twice the depth",
       on_contact(last_off)},
      {"point_lifted", "point_off", "shallow", "all points are shifted along the normal", on_contact(lifted)},
      {"point_local", "point_off", "shallow", "in A's frame", on_contact(local)},
      {"point_relative", "point_off", "far", "relative to A's origin", on_contact(relative_to_first)},
      {"point_not_clipped", "point_off", "shallow", "a corner of A's face, whether B covers it or not",
       on_contact(whole_reference_face)},
      {"point_at_origin", "point_off", "shallow", "the first point is A's origin",
       on_contact(origin_of_first)},
      {"point_at_corner", "point_off", "surfaces", "of two meshes, a vertex of the first",
       on_contact(corner_of_first_mesh)},
      {"point_extrapolated", "point_off", "shallow", "the first point is 10 % too far from the second",
       on_contact(extrapolated)},
      {"point_not_a_number", "point_off", "lattice", "the fourth point is NaN", on_contact(not_a_number)},
      {"manifold_every_second", "incomplete", "lattice", "every second point is left out",
       on_contact(every_second)},
      {"manifold_last_dropped", "incomplete", "lattice", "the last of four or more points is left out",
       on_contact(last_dropped)},
      {"manifold_three", "incomplete", "lattice", "the first three points", on_contact(first_three)},
      {"manifold_repeated", "incomplete", "lattice", "the first point again in place of the third",
       on_contact(first_repeated)},
      {"manifold_drawn_together", "incomplete", "lattice", "all points are a fifth nearer to their centre",
       on_contact(drawn_together)},
      {"manifold_centre", "incomplete", "lattice", "only the centre of three or more points",
       on_contact(centre_alone)},
      {"manifold_one_side", "incomplete", "lattice", "only the points on one side of the centre",
       on_contact(one_side_forgotten)},
      {"point_twice_as_deep", "point_depth", "shallow", "each point twice as deep",
       on_contact(each_twice_as_deep)},
      {"point_deeper", "point_depth", "shallow", "the last point deeper by 1e-9", on_contact(last_deeper)},
      {"point_infinitely_deep", "no_number", "lattice", "the first of four points infinitely deep",
       on_contact(infinitely_deep)},
      {"point_deep_beside", "point_depth", "shallow", "a second point beside a corner, as deep",
       on_contact(as_deep_beside)},
      {"point_cached", "point_off", "shallow", "a point of the previous contact is kept", cached(), false},
  };
}

}  // namespace touchstone::mutants
