// Lies that show only in a regime: the order of the bodies, sizes of zero, quaternions of other lengths,
// meshes and hulls of other sizes, unequal bodies, nearly parallel edges, filters, shared shapes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "scenarios/random/numbers.h"
#include "tests/mutants/pair.h"
#include "tests/mutants/replay.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

using Where = bool (*)(const Case&, const Query&);
using What = void (*)(const Case&, const Query&, Observation&);

Lie when(Question question, Where where, What what) {
  return [=](const Case& c, const Query& q, Observation& o) {
    if (asks(q, question) && o.outcome == Outcome::answered && where(c, q)) what(c, q, o);
  };
}

// ---- the wrong answer

void apart(const Case&, const Query&, Observation& o) {
  o = Observation{};
  o.outcome = Outcome::answered;
  o.overlap = false;
}
void overlapping(const Case&, const Query&, Observation& o) { o.overlap = true; }
void no_impact(const Case&, const Query&, Observation& o) { o.toi.reset(); }
void farther(const Case& c, const Query& q, Observation& o) {
  if (o.distance)
    *o.distance += 1e-6 * std::max(extent(c.scene.shape_of(q.a)), extent(c.scene.shape_of(q.b)));
}
void loose(const Case&, const Query&, Observation& o) {
  if (o.distance) o.distance = *o.distance * (1 + 1e-7);
}
void distance_zero(const Case&, const Query&, Observation& o) { o.distance = 0; }
void touching_only(const Case&, const Query&, Observation& o) {
  if (o.depth) o.depth = 0;
}
void other_way(const Case&, const Query&, Observation& o) {
  if (o.normal) *o.normal = -*o.normal;
}
void normal_not_a_number(const Case&, const Query&, Observation& o) {
  if (o.normal) o.normal->setConstant(std::numeric_limits<double>::quiet_NaN());
}
void normal_long(const Case&, const Query&, Observation& o) {
  if (o.normal) *o.normal *= 1 + 1e-6;
}
void points_exchanged(const Case&, const Query&, Observation& o) {
  if (o.witness) std::swap((*o.witness)[0], (*o.witness)[1]);
}
void between_origins(const Case& c, const Query& q, Observation& o) {
  const Vec3 line = body(c, q.b).pose.translation - body(c, q.a).pose.translation;
  if (!o.normal || line.norm() == 0) return;
  o.normal = line.normalized();
  o.depth = width(c, q, *o.normal);
}

// The answers for other shapes or poses than the given ones.
using Another = PlacedShape (*)(const Case&, int body, Shape& room);
Lie of_other(Question question, Where where, Another another) {
  return [=](const Case& c, const Query& q, Observation& o) {
    if (!asks(q, question) || o.outcome != Outcome::answered || !where(c, q)) return;
    Shape room_a, room_b;
    const PlacedShape a = another(c, q.a, room_a), b = another(c, q.b, room_b);
    if (question == Question::overlap) {
      o.overlap = overlap(a, b).overlap;
    } else if (question == Question::distance) {
      const DistanceAnswer r = distance(a, b);
      o.distance = r.distance;
      o.witness = r.witness;
    } else if (const ContactAnswer r = contact(a, b); r.overlap) {
      o.normal = r.normal;
      o.depth = r.depth;
    }
  };
}
PlacedShape unturned(const Case& c, int i, Shape&) {
  return {&c.scene.shape_of(i), Pose{body(c, i).pose.translation, {}}};
}
template <std::size_t most>
PlacedShape first_vertices(const Case& c, int i, Shape& room) {
  room = c.scene.shape_of(i);
  if (auto* h = std::get_if<Hull>(&room); h && h->vertices.size() > most)
    room = make_hull({h->vertices.begin(), h->vertices.begin() + most});
  return {&room, body(c, i).pose};
}
template <std::size_t most>
PlacedShape first_triangles(const Case& c, int i, Shape& room) {
  room = c.scene.shape_of(i);
  if (auto* m = std::get_if<TriangleMesh>(&room); m && m->triangles.size() > most)
    m->triangles.erase(m->triangles.begin() + static_cast<std::ptrdiff_t>(most), m->triangles.end());
  return {&room, body(c, i).pose};
}

// ---- the regime

bool second_first(const Case&, const Query& q) { return q.a > q.b; }

template <class S>
const S* find(const Case& c, const Query& q) {
  for (const int i : {q.a, q.b})
    if (const auto* s = std::get_if<S>(&c.scene.shape_of(i))) return s;
  return nullptr;
}

bool zero_sphere(const Case& c, const Query& q) {
  const auto* s = find<Sphere>(c, q);
  return s && s->radius == 0;
}
bool zero_box(const Case& c, const Query& q) {
  const auto* s = find<Box>(c, q);
  return s && s->half_extents.minCoeff() == 0;
}
bool zero_capsule(const Case& c, const Query& q) {
  const auto* s = find<Capsule>(c, q);
  return s && s->radius == 0;
}
bool short_capsule(const Case& c, const Query& q) {
  const auto* s = find<Capsule>(c, q);
  return s && s->half_height == 0;
}
bool flat_cylinder(const Case& c, const Query& q) {
  const auto* s = find<Cylinder>(c, q);
  return s && s->half_height == 0;
}
bool flat_cone(const Case& c, const Query& q) {
  const auto* s = find<Cone>(c, q);
  return s && (s->half_height == 0 || s->radius == 0);
}
bool straight_hull(const Case& c, const Query& q) {
  const auto* s = find<Hull>(c, q);
  return s && s->dimension < 2;
}
bool point(const Case& c, const Query& q) {
  return (extent(c.scene.shape_of(q.a)) == 0 && kind(c, q.a) < ShapeKind::ellipsoid) ||
         (extent(c.scene.shape_of(q.b)) == 0 && kind(c, q.b) < ShapeKind::ellipsoid);
}
bool some_size_zero(const Case& c, const Query& q) {
  for (const int i : {q.a, q.b}) {
    Shape s = c.scene.shape_of(i);
    if (kind_of(s) >= ShapeKind::ellipsoid) continue;
    const auto sizes = fuzz::numbers(s);
    if (std::any_of(sizes.begin(), sizes.end(), [](const double* x) { return *x == 0; })) return true;
  }
  return false;
}

double length(const Quat& q) { return std::hypot(std::hypot(q.x, q.y), std::hypot(q.z, q.w)); }
double longest(const Case& c, const Query& q) {
  return std::max(length(body(c, q.a).pose.rotation), length(body(c, q.b).pose.rotation));
}
double shortest(const Case& c, const Query& q) {
  return std::min(length(body(c, q.a).pose.rotation), length(body(c, q.b).pose.rotation));
}
bool long_quaternion(const Case& c, const Query& q) { return longest(c, q) > 100; }
bool short_quaternion(const Case& c, const Query& q) { return shortest(c, q) < 0.01; }
bool square_below_epsilon(const Case& c, const Query& q) { return shortest(c, q) < 1e-6; }
bool beyond_float(const Case& c, const Query& q) { return longest(c, q) > 1e19; }

const TriangleMesh* mesh(const Case& c, const Query& q) { return find<TriangleMesh>(c, q); }
bool any_mesh(const Case& c, const Query& q) { return mesh(c, q); }
bool one_triangle(const Case& c, const Query& q) { return mesh(c, q) && mesh(c, q)->triangles.size() == 1; }
bool two_triangles(const Case& c, const Query& q) { return mesh(c, q) && mesh(c, q)->triangles.size() == 2; }
bool large_mesh(const Case& c, const Query& q) { return mesh(c, q) && mesh(c, q)->triangles.size() >= 100; }
bool flat_mesh(const Case& c, const Query& q) {
  const auto* m = mesh(c, q);
  return m && m->triangles.size() > 1 &&
         std::all_of(m->vertices.begin(), m->vertices.end(), [](const Vec3& v) { return v.z() == 0; });
}
bool mesh_second(const Case& c, const Query& q) { return kind(c, q.b) == ShapeKind::mesh; }
// Inside a closed mesh, at less than 0.3 of the way out.
bool within_closed_mesh(const Case& c, const Query& q) {
  const auto* m = mesh(c, q);
  if (!m || (m->triangles.size() != 8 && m->triangles.size() != 32 && m->triangles.size() != 128))
    return false;
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& v : m->vertices) least = std::min(least, v.norm());
  return (body(c, q.a).pose.translation - body(c, q.b).pose.translation).norm() < 0.5 * least;
}

template <std::size_t least>
bool hull_of(const Case& c, const Query& q) {
  for (const int i : {q.a, q.b})
    if (const auto* h = std::get_if<Hull>(&c.scene.shape_of(i)); h && h->vertices.size() >= least)
      return true;
  return false;
}

double ratio(const Case& c, const Query& q) {
  const double a = extent(c.scene.shape_of(q.a)), b = extent(c.scene.shape_of(q.b));
  return a > 0 && b > 0 ? std::max(a, b) / std::min(a, b) : 1;
}
bool unequal(const Case& c, const Query& q) { return ratio(c, q) > 150; }
bool very_unequal(const Case& c, const Query& q) { return ratio(c, q) > 1e4; }

bool parallel_edges(const Case& c, const Query& q) {
  if (!are(c, q, ShapeKind::box, ShapeKind::box)) return false;
  const Mat3 a = rotation_matrix(body(c, q.a).pose.rotation), b = rotation_matrix(body(c, q.b).pose.rotation);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      const double sine = a.col(i).cross(b.col(k)).norm();
      if (sine > 1e-15 && sine < 1e-3) return true;
    }
  return false;
}

bool shape_in_common(const Case& c, const Query& q) { return body(c, q.a).shape == body(c, q.b).shape; }

// ---- of scenes

bool in_some_group(const Scene& s, const QueryState&, int a, int b) {
  const auto group = [&](int i) { return s.bodies[static_cast<std::size_t>(i)].group; };
  return group(a) < 0 || group(b) < 0;
}
bool never_ignored(const Scene& s, const QueryState&, int a, int b) {
  return std::none_of(s.ignored.begin(), s.ignored.end(), [&](const BodyPair& p) {
    return p.first == a || p.second == a || p.first == b || p.second == b;
  });
}
bool no_mesh(const Scene& s, const QueryState&, int a, int b) {
  return kind_of(s.shape_of(a)) != ShapeKind::mesh && kind_of(s.shape_of(b)) != ShapeKind::mesh;
}
bool own_shapes(const Scene& s, const QueryState&, int a, int b) {
  return s.bodies[static_cast<std::size_t>(a)].shape != s.bodies[static_cast<std::size_t>(b)].shape;
}
void contacts_of_groups_dropped(const Case& c, const Query& q, Observation& o) {
  if (!asks(q, Question::scene_contacts)) return;
  std::erase_if(o.contacts,
                [&](const SceneContact& k) { return body(c, k.a).group >= 0 && body(c, k.b).group >= 0; });
}
void contacts_with_mesh_dropped(const Case& c, const Query& q, Observation& o) {
  if (!asks(q, Question::scene_contacts)) return;
  std::erase_if(o.contacts, [&](const SceneContact& k) {
    return kind(c, k.a) == ShapeKind::mesh || kind(c, k.b) == ShapeKind::mesh;
  });
}

constexpr auto over = Question::overlap, dist = Question::distance, cont = Question::contact,
               impact = Question::time_of_impact;

}  // namespace

std::vector<Mutant> regime_lies() {
  return {
      {"order_apart", "missed", "shallow", "apart when the second id is the lower one",
       when(over, second_first, apart)},
      {"order_farther", "distance_off", "separate", "1e-6 farther when the second id is the lower one",
       when(dist, second_first, farther)},
      {"order_points", "witness_off", "separate", "the points in the order of the ids",
       when(dist, second_first, points_exchanged)},
      {"order_normal", "infeasible", "shallow", "the normal from the lower id to the higher one",
       when(cont, second_first, other_way)},
      {"order_no_impact", "missed", "translate", "no impact when the second id is the lower one",
       when(impact, second_first, no_impact)},
      {"zero_sphere_apart", "missed", "zero", "a sphere of radius 0 overlaps nothing",
       when(over, zero_sphere, apart)},
      {"zero_box_normal", "normal_not_unit", "zero", "a normal of NaN for a flat box",
       when(cont, zero_box, normal_not_a_number)},
      {"zero_capsule_farther", "distance_off", "zero", "1e-6 too far from a segment",
       when(dist, zero_capsule, farther)},
      {"zero_capsule_short", "missed", "zero", "a capsule without height overlaps nothing",
       when(over, short_capsule, apart)},
      {"zero_cylinder_depth", "infeasible", "zero", "depth 0 in a disc",
       when(cont, flat_cylinder, touching_only)},
      {"zero_cone_loose", "distance_off", "zero", "relative error 1e-7 from a disc or segment",
       when(dist, flat_cone, loose)},
      {"zero_hull_first_point", "distance_off", "zero",
       "for a straight hull, the distance of its first vertex",
       of_other(dist, straight_hull, first_vertices<1>)},
      {"zero_point_ghost", "ghost", "zero", "a point overlaps everything", when(over, point, overlapping)},
      {"zero_depth", "infeasible", "zero", "depth 0 where a size is 0",
       when(cont, some_size_zero, touching_only)},
      {"zero_no_impact", "missed", "zero", "nothing hits what has a size of 0",
       when(impact, some_size_zero, no_impact)},
      {"quaternion_long_unturned", "distance_off", "separate", "not turned when |q| > 100",
       of_other(dist, long_quaternion, unturned)},
      {"quaternion_short_unturned", "distance_off", "separate", "not turned when |q| < 0.01",
       of_other(dist, short_quaternion, unturned)},
      {"quaternion_square_lost", "normal_not_unit", "shallow", "a normal of NaN when |q|^2 < 1e-12",
       when(cont, square_below_epsilon, normal_not_a_number)},
      {"quaternion_beyond_float", "missed", "deep", "apart when |q|^2 is too large for a float",
       when(over, beyond_float, apart)},
      {"mesh_eight_triangles", "distance_off", "mesh", "only the first 8 triangles count",
       of_other(dist, any_mesh, first_triangles<8>)},
      {"mesh_triangle_apart", "missed", "mesh", "a mesh of one triangle overlaps nothing",
       when(over, one_triangle, apart)},
      {"mesh_second_triangle", "distance_off", "mesh", "only the first of two triangles",
       of_other(dist, two_triangles, first_triangles<1>)},
      {"mesh_large_farther", "distance_off", "mesh", "1e-6 too far from meshes of 100 or more triangles",
       when(dist, large_mesh, farther)},
      {"mesh_flat_apart", "missed", "mesh", "a mesh in one plane overlaps nothing",
       when(over, flat_mesh, apart)},
      {"mesh_solid", "ghost", "mesh", "a closed mesh is solid", when(over, within_closed_mesh, overlapping)},
      {"mesh_second_points", "witness_off", "mesh", "with a mesh as B the points are exchanged",
       when(dist, mesh_second, points_exchanged)},
      {"hull_64", "distance_off", "vertices", "the first 64 vertices of a hull",
       of_other(dist, hull_of<65>, first_vertices<64>)},
      {"hull_255", "infeasible", "vertices", "the first 255 vertices of a hull",
       of_other(cont, hull_of<256>, first_vertices<255>)},
      {"hull_128_ghost", "ghost", "vertices", "hulls of 128 or more vertices overlap everything",
       when(over, hull_of<128>, overlapping)},
      {"unequal_loose", "distance_off", "unequal",
       "off by 1e-6 of the larger body when that is 150 times larger", when(dist, unequal, farther)},
      {"unequal_apart", "missed", "unequal", "apart when one body is 1e4 times larger",
       when(over, very_unequal, apart)},
      {"unequal_normal", "not_minimal", "unequal",
       "along the line of origins when one body is 150 times larger", when(cont, unequal, between_origins)},
      {"parallel_origins", "not_minimal", "parallel",
       "along the line of origins when edges are nearly parallel",
       when(cont, parallel_edges, between_origins)},
      {"parallel_normal_long", "normal_not_unit", "parallel",
       "a normal longer than 1 by 1e-6 when edges are nearly parallel",
       when(cont, parallel_edges, normal_long)},
      {"parallel_loose", "distance_off", "parallel", "relative error 1e-7 when edges are nearly parallel",
       when(dist, parallel_edges, loose)},
      {"parallel_ghost", "ghost", "parallel", "boxes with nearly parallel edges overlap",
       when(over, parallel_edges, overlapping)},
      {"shared_shape_zero", "distance_off", "dialogue", "0 between bodies of one shape",
       when(dist, shape_in_common, distance_zero)},
      {"shared_shape_lost", "missed", "company", "bodies of one shape are no candidates",
       keep_pairs(own_shapes)},
      {"group_lost", "missed", "company", "bodies of different groups are no candidates",
       keep_pairs(in_some_group)},
      {"ignored_lost", "missed", "company", "a body of an ignored pair is no candidate with any other",
       keep_pairs(never_ignored)},
      {"mesh_lost", "missed", "company", "meshes are no candidates", keep_pairs(no_mesh)},
      {"group_contact_lost", "missed", "company", "no contacts between bodies of different groups",
       contacts_of_groups_dropped},
      {"mesh_contact_lost", "missed", "company", "no contacts with a mesh in a scene",
       contacts_with_mesh_dropped},
  };
}

}  // namespace touchstone::mutants
