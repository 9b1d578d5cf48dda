// Lies about height fields and about bodies that are several shapes.
#include <algorithm>
#include <cmath>
#include <map>

#include "oracles/abi/height_field.h"
#include "tests/mutants/pair.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

std::optional<kit::HeightField> field_of(const Shape& s) {
  const auto* m = std::get_if<TriangleMesh>(&s);
  return m ? kit::height_field_of(*m) : std::nullopt;
}

// ---- a height field as an engine might hold it; `f` describes m

using Held = void (*)(const kit::HeightField& f, TriangleMesh& m);

void other_diagonals(const kit::HeightField&, TriangleMesh& m) {
  for (std::size_t i = 0; i < m.triangles.size(); i += 2) {
    const auto [corner, right, beyond] = m.triangles[i];
    const int above = m.triangles[i + 1][2];
    m.triangles[i] = {corner, right, above};
    m.triangles[i + 1] = {right, beyond, above};
  }
}
void without_last_row(const kit::HeightField& f, TriangleMesh& m) {
  if (f.rows > 2) m.triangles.resize(m.triangles.size() - 2 * (f.columns - 1));
}
void without_last_triangle(const kit::HeightField&, TriangleMesh& m) { m.triangles.pop_back(); }
void cells_halved(const kit::HeightField&, TriangleMesh& m) {
  std::vector<std::array<int, 3>> kept;
  for (std::size_t i = 0; i < m.triangles.size(); i += 2) kept.push_back(m.triangles[i]);
  m.triangles = std::move(kept);
}
void rows_and_columns_exchanged(const kit::HeightField& f, TriangleMesh& m) {
  if (f.rows != f.columns) return;
  const std::vector<Vec3> before = m.vertices;
  for (std::size_t r = 0; r < f.rows; ++r)
    for (std::size_t c = 0; c < f.columns; ++c)
      m.vertices[r * f.columns + c].z() = before[c * f.columns + r].z();
}
std::pair<double, double> heights_of(const TriangleMesh& m) {
  const auto [lo, hi] = std::ranges::minmax(m.vertices, {}, [](const Vec3& v) { return v.z(); });
  return {lo.z(), hi.z()};
}
void heights_of_eight_bits(const kit::HeightField&, TriangleMesh& m) {
  constexpr double steps = 255;
  const auto [lo, hi] = heights_of(m);
  if (!(hi > lo)) return;
  for (Vec3& v : m.vertices) v.z() = lo + std::round((v.z() - lo) / (hi - lo) * steps) / steps * (hi - lo);
}
void lifted_to_centre(const kit::HeightField&, TriangleMesh& m) {
  const auto [lo, hi] = heights_of(m);
  for (Vec3& v : m.vertices) v.z() -= (lo + hi) / 2;
}

bool has_field(const Case& c, const Query& q) {
  return field_of(c.scene.shape_of(q.a)) || field_of(c.scene.shape_of(q.b));
}
SeenPair held_pair(const Case& c, const Query& q, Held held) {
  return SeenPair(c, q, [&](Shape s) {
    if (const auto f = field_of(s)) held(*f, std::get<TriangleMesh>(s));
    return s;
  });
}

Lie overlap_with(Held held) {
  return [held](const Case& c, const Query& q, Observation& o) {
    if (!asks(q, Question::overlap) || !o.overlap || !has_field(c, q)) return;
    const SeenPair p = held_pair(c, q, held);
    o.overlap = overlap(p.first(), p.second()).overlap;
  };
}
Lie distance_with(Held held) {
  return [held](const Case& c, const Query& q, Observation& o) {
    if (!asks(q, Question::distance) || !o.distance || !has_field(c, q)) return;
    const SeenPair p = held_pair(c, q, held);
    const DistanceAnswer d = distance(p.first(), p.second());
    o.distance = d.distance;
    o.witness = d.witness;
  };
}
Lie impact_with(Held held) {
  return [held](const Case& c, const Query& q, Observation& o) {
    if (q.question != Question::time_of_impact || !has_field(c, q)) return;
    const ImpactAnswer r = impact_of(held_pair(c, q, held), c, q);
    if (r.outcome == Outcome::answered) o.toi = r.toi;
  };
}

// The ground below a height field, as deep as the field is wide: the other body's origin is in it.
void solid_below(const Case& c, const Query& q, Observation& o) {
  if (!asks(q, Question::overlap) || !o.overlap) return;
  for (const auto& [ground, other] : {std::pair(q.a, q.b), std::pair(q.b, q.a)}) {
    const auto f = field_of(c.scene.shape_of(ground));
    if (!f) continue;
    const auto* m = triangles_if(c.scene.shape_of(ground));
    const Pose& pose = body(c, ground).pose;
    const Vec3 at =
        rotation_matrix(pose.rotation).transpose() * (body(c, other).pose.translation - pose.translation);
    const Vec3 corner = m->vertices.back();
    const auto is_above = [&](const Vec3& v) { return v.z() > at.z(); };
    if (std::abs(at.x()) < corner.x() && std::abs(at.y()) < corner.y() &&
        std::ranges::all_of(m->vertices, is_above))
      o.overlap = true;
  }
}

// ---- bodies of several shapes

using Contacts = std::vector<SceneContact>;
int group_of(const Case& c, int i) { return body(c, i).group; }
// The number of a body among those of its group.
int part_of(const Case& c, int i) {
  int part = 0;
  for (int k = 0; k < i; ++k) part += group_of(c, i) >= 0 && group_of(c, k) == group_of(c, i);
  return part;
}
int first_of_group(const Case& c, int i) {
  for (int k = 0; k < i; ++k)
    if (group_of(c, i) >= 0 && group_of(c, k) == group_of(c, i)) return k;
  return i;
}

void named_by_first_part(const Case& c, Contacts& x) {
  for (SceneContact& k : x) {
    k.a = first_of_group(c, k.a);
    k.b = first_of_group(c, k.b);
  }
}
void deepest_of_groups(const Case& c, Contacts& x) {
  std::map<std::pair<int, int>, double> deepest;
  const auto groups = [&](const SceneContact& k) { return std::pair(group_of(c, k.a), group_of(c, k.b)); };
  for (const SceneContact& k : x) {
    const auto [at, is_new] = deepest.try_emplace(groups(k), k.depth);
    if (!is_new) at->second = std::max(at->second, k.depth);
  }
  std::erase_if(x, [&](const SceneContact& k) {
    return group_of(c, k.a) >= 0 && group_of(c, k.b) >= 0 && k.depth < deepest[groups(k)];
  });
}
void fourth_part_lost(const Case& c, Contacts& x) {
  constexpr int most = 3;
  std::erase_if(x, [&](const SceneContact& k) { return part_of(c, k.a) >= most || part_of(c, k.b) >= most; });
}
void normals_of_groups_turned(const Case& c, Contacts& x) {
  for (SceneContact& k : x)
    if (part_of(c, k.a) > part_of(c, k.b) && group_of(c, k.b) >= 0) k.normal = -k.normal;
}
// The first part of the other group that the part meets, and no other.
void first_partner_only(const Case& c, Contacts& x) {
  std::map<std::pair<int, int>, int> met;
  std::erase_if(x, [&](const SceneContact& k) {
    return group_of(c, k.b) >= 0 && !met.try_emplace({k.a, group_of(c, k.b)}, k.b).second;
  });
}

}  // namespace

std::vector<Mutant> ground_lies() {
  return {
      {"field_other_diagonal", "distance_off", "fields", "cells are divided by their other diagonal",
       distance_with(other_diagonals)},
      {"field_without_last_row", "missed", "fields", "nothing overlaps the cells of the last row",
       overlap_with(without_last_row)},
      {"field_last_triangle", "distance_off", "fields", "the last triangle is lost",
       distance_with(without_last_triangle)},
      {"field_half_cells", "missed", "fields", "only one triangle of each cell is hit",
       impact_with(cells_halved)},
      {"field_transposed", "distance_off", "fields", "rows and columns of a square grid are exchanged",
       distance_with(rows_and_columns_exchanged)},
      {"field_eight_bits", "distance_off", "fields", "heights are kept in eight bits",
       distance_with(heights_of_eight_bits)},
      {"field_centred", "missed", "fields", "the middle of the heights is put at the origin",
       overlap_with(lifted_to_centre)},
      {"field_solid_below", "ghost", "fields", "a body below the ground overlaps it", solid_below},
      {"compound_first_part", "missed", "compounds", "contacts name the first part of a group",
       on_scene(named_by_first_part)},
      {"compound_one_contact", "missed", "compounds", "two groups have one contact, the deepest",
       on_scene(deepest_of_groups)},
      {"compound_three_parts", "missed", "compounds", "parts after the third are lost",
       on_scene(fourth_part_lost)},
      {"compound_normal_turned", "infeasible", "compounds",
       "the normal is reversed if A is a later part of its group than B", on_scene(normals_of_groups_turned)},
      {"compound_first_partner", "missed", "compounds", "a part meets one part of another group only",
       on_scene(first_partner_only)},
  };
}

}  // namespace touchstone::mutants
