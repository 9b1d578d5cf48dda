#include "scenarios/random/family.h"

#include <algorithm>
#include <cmath>

#include "scenarios/random/numbers.h"

namespace touchstone::fuzz {
namespace {

template <class Shown>
bool any_question(const Case& c, Shown shown) {
  return std::any_of(c.queries.begin(), c.queries.end(),
                     [&](const Query& q) { return is_pair_question(q.question) && shown(q); });
}

template <class S, class Shown>
bool any_shape(const Case& c, Shown shown) {
  return std::any_of(c.scene.shapes.begin(), c.scene.shapes.end(), [&](const Shape& shape) {
    const auto* s = std::get_if<S>(&shape);
    return s && shown(*s);
  });
}

bool reversed(const Case& c, const Case&) {
  return any_question(c, [](const Query& q) { return q.a > q.b; });
}

bool distance_after_contact(const Case& c, const Case&) {
  for (std::size_t i = 1; i < c.queries.size(); ++i)
    if (c.queries[i - 1].question == Question::contact && c.queries[i].question == Question::distance)
      return true;
  return false;
}

bool asked_twice(const Case& c, const Case&) {
  return any_question(c,
                      [&](const Query& q) { return std::count(c.queries.begin(), c.queries.end(), q) > 1; });
}

bool another_pair_between(const Case& c, const Case&) {
  for (std::size_t i = 2; i < c.queries.size(); ++i)
    for (std::size_t k = 0; k + 1 < i; ++k)
      if (c.queries[k] == c.queries[i] && c.queries[i - 1].a != c.queries[i].a &&
          c.queries[i - 1].b != c.queries[i].b)
        return true;
  return false;
}

bool same_shapes_as_before(const Case& c, const Case& before) {
  return c.scene.shapes == before.scene.shapes;
}

bool shape_in_common(const Case& c, const Case&) { return c.scene.shapes.size() < c.scene.bodies.size(); }

bool filtered(const Case& c, const Case&) {
  const int n = static_cast<int>(c.scene.bodies.size());
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b)
      if (is_filtered(c.scene, a, b)) return true;
  return false;
}

template <class Shown>
bool any_quaternion(const Case& c, Shown shown) {
  return std::any_of(c.scene.bodies.begin(), c.scene.bodies.end(), [&](const Body& b) {
    const Quat& q = b.pose.rotation;
    return shown(std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z), std::abs(q.w)}));
  });
}
// Largest component of a quaternion; a unit quaternion's is between 1/2 and 1.
constexpr double least_usual = 0.1, most_usual = 10, least_moderate = 1e-6, most_moderate = 1e6;

bool quaternion_not_unit(const Case& c, const Case&) {
  return any_quaternion(c, [](double q) { return q < least_usual || q > most_usual; });
}
bool quaternion_extreme(const Case& c, const Case&) {
  return any_quaternion(c, [](double q) { return q < least_moderate || q > most_moderate; });
}

// The number of zero sizes of the flattest primitive, and its number of sizes.
bool has_zero_sizes(const Case& c, std::size_t least, bool all) {
  return std::any_of(c.scene.shapes.begin(), c.scene.shapes.end(), [&](Shape s) {
    const auto list = sizes_of(s);
    const auto zero = static_cast<std::size_t>(
        std::count_if(list.begin(), list.end(), [](const double* x) { return *x == 0; }));
    return zero >= least && (!all || zero == list.size());
  });
}
bool size_zero(const Case& c, const Case&) { return has_zero_sizes(c, 1, false); }
bool point(const Case& c, const Case&) { return has_zero_sizes(c, 1, true); }
bool flat_box(const Case& c, const Case&) {
  return any_shape<Box>(c, [](const Box& b) { return b.half_extents.minCoeff() == 0; });
}
bool flat_hull(const Case& c, const Case&) {
  return any_shape<Hull>(c, [](const Hull& h) { return h.dimension < 3; });
}

double ratio_of_sizes(const Case& c) {
  double ratio = 1;
  any_question(c, [&](const Query& q) {
    const double a = extent(c.scene.shape_of(q.a)), b = extent(c.scene.shape_of(q.b));
    if (std::min(a, b) > 0) ratio = std::max(ratio, std::max(a, b) / std::min(a, b));
    return false;
  });
  return ratio;
}
// Ratio of the extents of a pair; beyond a hundred thousand, float has few digits left.
constexpr double huge_ratio = 1e5;

bool unequal(const Case& c, const Case&) { return ratio_of_sizes(c) > 120; }
bool very_unequal(const Case& c, const Case&) { return ratio_of_sizes(c) > huge_ratio; }

bool one_triangle(const Case& c, const Case&) {
  return any_shape<TriangleMesh>(c, [](const TriangleMesh& m) { return m.triangles.size() == 1; });
}
bool two_triangles(const Case& c, const Case&) {
  return any_shape<TriangleMesh>(c, [](const TriangleMesh& m) { return m.triangles.size() == 2; });
}
bool hundreds_of_triangles(const Case& c, const Case&) {
  return any_shape<TriangleMesh>(c, [](const TriangleMesh& m) { return m.triangles.size() >= 100; });
}
// Every edge belongs to two triangles that use it in opposite directions.
bool is_closed(const TriangleMesh& m) {
  std::vector<std::pair<int, int>> edges;
  for (const auto& [a, b, c] : m.triangles) edges.insert(edges.end(), {{a, b}, {b, c}, {c, a}});
  std::sort(edges.begin(), edges.end());
  return std::all_of(edges.begin(), edges.end(), [&](const auto& e) {
    return std::binary_search(edges.begin(), edges.end(), std::pair{e.second, e.first});
  });
}
bool closed_mesh(const Case& c, const Case&) { return any_shape<TriangleMesh>(c, is_closed); }
bool coplanar(const Case& c, const Case&) {
  return any_shape<TriangleMesh>(c, [](const TriangleMesh& m) {
    return m.triangles.size() > 1 &&
           std::all_of(m.vertices.begin(), m.vertices.end(), [](const Vec3& v) { return v.z() == 0; });
  });
}
bool mesh_in_company(const Case& c, const Case&) {
  return c.scene.bodies.size() > 2 && any_shape<TriangleMesh>(c, [](const TriangleMesh&) { return true; });
}
bool mesh_and_mesh(const Case& c, const Case&) {
  return any_question(c, [&](const Query& q) {
    return kind_of(c.scene.shape_of(q.a)) == ShapeKind::mesh &&
           kind_of(c.scene.shape_of(q.b)) == ShapeKind::mesh;
  });
}
bool mesh_second(const Case& c, const Case&) {
  return any_question(c, [&](const Query& q) { return kind_of(c.scene.shape_of(q.b)) == ShapeKind::mesh; });
}

template <std::size_t least>
bool hull_of(const Case& c, const Case&) {
  return any_shape<Hull>(c, [](const Hull& h) { return h.vertices.size() >= least; });
}

// Sines of the angle between edges that count as nearly parallel: more than rounding, less than a
// milliradian.
constexpr double least_edge_sine = 1e-15, most_edge_sine = 1e-3;

// Some edge of one is nearly parallel to some edge of the other.
bool nearly_parallel_boxes(const Case& c, const Case&) {
  return any_question(c, [&](const Query& q) {
    for (const int i : {q.a, q.b})
      if (kind_of(c.scene.shape_of(i)) != ShapeKind::box) return false;
    const Mat3 a = rotation_matrix(c.scene.bodies[static_cast<std::size_t>(q.a)].pose.rotation),
               b = rotation_matrix(c.scene.bodies[static_cast<std::size_t>(q.b)].pose.rotation);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        const double sine = a.col(i).cross(b.col(k)).norm();
        if (sine > least_edge_sine && sine < most_edge_sine) return true;
      }
    return false;
  });
}

bool about_margin(const Case& c, const Case&) {
  return std::any_of(c.queries.begin(), c.queries.end(),
                     [](const Query& q) { return is_margin_question(q.question); });
}
bool about_negative_margin(const Case& c, const Case& before) {
  return c.scene.margin < 0 && about_margin(c, before);
}
bool any_ray(const Case& c, const Case&) {
  return any_question(c, [](const Query& q) { return q.question == Question::ray; });
}

constexpr Regime rows[] = {
    {"reversed", "a query about bodies a > b", 12, reversed},
    {"distance-last", "a distance query right after a contact query", 32, distance_after_contact},
    {"twice", "the same query about the same pair again", 32, asked_twice},
    {"between", "the same, with a query about another pair between", 100, another_pair_between},
    {"sequel", "the shapes of the previous case, with at most one body moved", 32, same_shapes_as_before},
    {"shared", "several bodies sharing one shape", 32, shape_in_common},
    {"filtered", "bodies in one group, or ignored pairs", 128, filtered},
    {"quaternion", "a quaternion shorter than 0.1 or longer than 10", 16, quaternion_not_unit},
    {"quaternion-far", "a quaternion shorter than 1e-6 or longer than 1e6", 64, quaternion_extreme},
    {"zero", "a shape with a size of zero, e.g. a sphere of radius zero", 32, size_zero},
    {"point", "one of these with all sizes zero", 64, point},
    {"plate", "a box that is a rectangle, a segment or a point", 128, flat_box},
    {"flat-hull", "a hull that is a polygon, a segment or a point", 64, flat_hull},
    {"unequal", "a pair with sizes that differ by a factor of more than 120", 60, unequal},
    {"unequal-far", "a pair with sizes that differ by a factor of more than 1e5", 200, very_unequal},
    {"triangle", "a mesh of one triangle", 100, one_triangle},
    {"two-triangles", "a mesh of two triangles", 100, two_triangles},
    {"closed-mesh", "a mesh that is the surface of a solid", 100, closed_mesh},
    {"large-mesh", "a mesh of 100 or more triangles", 100, hundreds_of_triangles},
    {"coplanar", "a mesh whose triangles lie in one plane", 128, coplanar},
    {"mesh-second", "a query whose second body is a mesh", 64, mesh_second},
    {"two-meshes", "a query about two meshes", 64, mesh_and_mesh},
    {"mesh-company", "a mesh among three or more bodies", 64, mesh_in_company},
    {"hull-64", "a hull of 64 or more vertices", 64, hull_of<64>},
    {"hull-256", "a hull of 256 or more vertices", 128, hull_of<256>},
    {"margin", "a question about a margin", 64, about_margin},
    {"penetration", "a question about a negative margin", 200, about_negative_margin},
    {"ray", "a ray", 120, any_ray},
    {"parallel", "two boxes with edges less than a milliradian from parallel", 80, nearly_parallel_boxes},
};

}  // namespace

std::span<const Regime> regimes() { return rows; }

}  // namespace touchstone::fuzz
