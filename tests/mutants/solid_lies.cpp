// Lies about solid meshes.
#include "core/shape/solid_mesh.h"
#include "tests/mutants/pair.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

using Seen = Shape (*)(const Shape&);

Shape as_surface(const Shape& s) {
  const TriangleMesh* m = triangles_if(s);
  return m ? Shape(*m) : s;
}

Shape as_hull(const Shape& s) {
  return kind_of(s) == ShapeKind::solid_mesh ? Shape(make_hull(triangles_if(s)->vertices)) : s;
}

// Without the parts of its surface after the first.
Shape without_cavity(const Shape& s) {
  const auto* solid = std::get_if<SolidMesh>(&s);
  if (!solid || points_of_parts(*solid).size() != 2) return s;
  TriangleMesh outer{solid->vertices, solid->triangles};
  const std::size_t corners = solid->vertices.size() / 2, faces = solid->triangles.size() / 2;
  outer.vertices.resize(corners);
  outer.triangles.resize(faces);
  return SolidMesh(std::move(outer));
}

bool has_solid(const Case& c, const Query& q) {
  return is_pair_question(q.question) &&
         (kind(c, q.a) == ShapeKind::solid_mesh || kind(c, q.b) == ShapeKind::solid_mesh);
}

Lie overlap_of(Seen see) {
  return [see](const Case& c, const Query& q, Observation& o) {
    if (!asks(q, Question::overlap) || !o.overlap || !has_solid(c, q)) return;
    const SeenPair p(c, q, see);
    o.overlap = overlap(p.first(), p.second()).overlap;
  };
}

void distance_of_surfaces(const Case& c, const Query& q, Observation& o) {
  if (!asks(q, Question::distance) || !o.distance || !has_solid(c, q)) return;
  const SeenPair p(c, q, as_surface);
  const DistanceAnswer d = distance(p.first(), p.second());
  if (d.distance > 0) o.distance = d.distance;
}

Lie contact_of(Seen see) {
  return [see](const Case& c, const Query& q, Observation& o) {
    if (!asks(q, Question::contact) || !o.depth || !has_solid(c, q)) return;
    const SeenPair p(c, q, see);
    const ContactAnswer r = contact(p.first(), p.second());
    if (r.outcome != Outcome::answered || !r.overlap) return;
    o.normal = r.normal;
    o.depth = r.depth;
    o.manifold.clear();
  };
}

void twice_as_deep(const Case& c, const Query& q, Observation& o) {
  if (asks(q, Question::contact) && o.depth && has_solid(c, q)) *o.depth *= 2;
}

void impact_of_surfaces(const Case& c, const Query& q, Observation& o) {
  if (q.question != Question::time_of_impact || !o.toi || !has_solid(c, q)) return;
  const SeenPair p(c, q, as_surface);
  const ImpactAnswer r = impact_of(p, c, q);
  if (r.outcome == Outcome::answered) o.toi = r.toi;
}

}  // namespace

std::vector<Mutant> solid_lies() {
  return {
      {"solid_is_its_surface", "missed", "solids", "a body inside a solid is apart from it",
       overlap_of(as_surface)},
      {"solid_is_its_hull", "ghost", "solids", "a solid overlaps what its hull overlaps",
       overlap_of(as_hull)},
      {"solid_cavity_filled", "ghost", "solids", "a cavity belongs to the solid", overlap_of(without_cavity)},
      {"solid_distance_of_surface", "missed", "solids",
       "the distance of a body inside a solid is that to its surface", distance_of_surfaces},
      {"solid_depth_of_triangle", "infeasible", "solids",
       "the depth in a solid is that in its deepest triangle", contact_of(as_surface)},
      {"solid_depth_of_hull", "not_minimal", "solids", "a body leaves a solid as it would leave the hull",
       contact_of(as_hull)},
      {"solid_twice_as_deep", "depth_excess", "solids", "depths in a solid are doubled", twice_as_deep},
      {"solid_impact_of_surface", "late", "solids",
       "a body that begins inside a solid meets it when it leaves", impact_of_surfaces},
  };
}

}  // namespace touchstone::mutants
