#include "core/shape/solid_mesh.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "core/math/expansion.h"
#include "core/math/roundoff.h"

namespace touchstone {
namespace {

using Corners = std::array<Vec3, 3>;

std::size_t at(int i) { return static_cast<std::size_t>(i); }
std::string in_list(const char* list, std::size_t i) {
  return std::string(list) + "[" + std::to_string(i) + "]";
}
std::string triangle(std::size_t i) { return in_list("triangles", i); }

Corners corners(const TriangleMesh& m, std::size_t i) {
  const auto& t = m.triangles[i];
  return {m.vertices[at(t[0])], m.vertices[at(t[1])], m.vertices[at(t[2])]};
}

// In the two coordinates other than `left_out`.
int side_in_plane(const Vec3& a, const Vec3& b, const Vec3& c, int left_out) {
  const int x = (left_out + 1) % 3, y = (left_out + 2) % 3;
  return orient2d_sign(a[x], a[y], b[x], b[y], c[x], c[y]);
}

// A coordinate without which the triangle still has an area; -1: it has none.
int coordinate_to_leave_out(const Corners& c) {
  for (int k = 0; k < 3; ++k)
    if (side_in_plane(c[0], c[1], c[2], k) != 0) return k;
  return -1;
}

bool is_in_triangle(const Vec3& p, const Corners& t, int left_out) {
  const int s[] = {side_in_plane(t[0], t[1], p, left_out), side_in_plane(t[1], t[2], p, left_out),
                   side_in_plane(t[2], t[0], p, left_out)};
  return *std::min_element(s, s + 3) >= 0 || *std::max_element(s, s + 3) <= 0;
}

// Two segments in one plane, neither without length.
bool segments_cross(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, int left_out) {
  const int c_side = side_in_plane(a, b, c, left_out), d_side = side_in_plane(a, b, d, left_out);
  const int a_side = side_in_plane(c, d, a, left_out), b_side = side_in_plane(c, d, b, left_out);
  return c_side * d_side < 0 && a_side * b_side < 0;
}

// Whether a segment and a triangle with an area, both closed, share a point.
bool segment_meets(const Vec3& p, const Vec3& q, const Corners& t) {
  const int above = orient3d_sign(t[0], t[1], t[2], p), below = orient3d_sign(t[0], t[1], t[2], q);
  if (above * below > 0) return false;
  if (above == 0 && below == 0) {
    const int k = coordinate_to_leave_out(t);
    if (is_in_triangle(p, t, k) || is_in_triangle(q, t, k)) return true;
    // A segment that enters the triangle through a corner meets an edge in its end.
    const auto touches = [&](const Vec3& corner) {
      return side_in_plane(p, q, corner, k) == 0 && (corner - p).dot(q - p) > 0 &&
             (corner - q).dot(p - q) > 0;
    };
    for (std::size_t i = 0; i < 3; ++i)
      if (touches(t[i]) || segments_cross(p, q, t[i], t[(i + 1) % 3], k)) return true;
    return false;
  }
  const int s[] = {orient3d_sign(p, q, t[0], t[1]), orient3d_sign(p, q, t[1], t[2]),
                   orient3d_sign(p, q, t[2], t[0])};
  return *std::min_element(s, s + 3) >= 0 || *std::max_element(s, s + 3) <= 0;
}

using Edge = std::pair<int, int>;

// The surface with equal vertices joined: triangles of vertex numbers, and which triangle has which edge.
class Surface {
 public:
  explicit Surface(const TriangleMesh& m) : mesh_(m) {
    std::map<std::array<double, 3>, int> numbers;
    for (const Vec3& v : m.vertices) {
      // +0 for -0, which is equal.
      const std::array<double, 3> key{v.x() + 0.0, v.y() + 0.0, v.z() + 0.0};
      number_.push_back(numbers.try_emplace(key, static_cast<int>(numbers.size())).first->second);
    }
    for (const auto& t : m.triangles)
      triangles_.push_back({number_[at(t[0])], number_[at(t[1])], number_[at(t[2])]});
  }

  std::optional<SolidFlaw> flaw() {
    for (const auto& check : {&Surface::range_flaw, &Surface::area_flaw, &Surface::edge_flaw,
                              &Surface::crossing_flaw, &Surface::orientation_flaw})
      if (auto f = (this->*check)()) return f;
    return std::nullopt;
  }

  bool is_convex() {
    find_edges();
    find_parts();
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      if (part_[i] != part_[0]) return false;
      const Corners c = corners(mesh_, i);
      for (std::size_t k = 0; k < 3; ++k) {
        const Edge edge = edge_of(i, k);
        const std::size_t next = edges_.at({edge.second, edge.first});
        for (const Vec3& p : corners(mesh_, next))
          if (orient3d_sign(c[0], c[1], c[2], p) > 0) return false;
      }
    }
    return true;
  }

  // The largest triangle of each part that is connected by vertices.
  std::vector<std::size_t> largest_of_parts() const {
    std::vector<int> first(number_.size());
    std::iota(first.begin(), first.end(), 0);
    const auto root = [&](int v) {
      while (first[at(v)] != v) v = first[at(v)] = first[at(first[at(v)])];
      return v;
    };
    for (const auto& t : triangles_)
      for (const int v : {t[1], t[2]}) first[at(root(v))] = root(t[0]);
    const auto area = [&](std::size_t i) {
      const Corners c = corners(mesh_, i);
      return (c[1] - c[0]).cross(c[2] - c[0]).stableNorm();
    };
    std::map<int, std::size_t> largest;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const auto [known, is_new] = largest.try_emplace(root(triangles_[i][0]), i);
      if (!is_new && area(i) > area(known->second)) known->second = i;
    }
    std::vector<std::size_t> r;
    for (const auto& [part, i] : largest) r.push_back(i);
    return r;
  }

 private:
  std::optional<SolidFlaw> range_flaw() {
    // Coordinates other than 0 lie between these: there the predicates are exact (core/math/expansion.h).
    // Tested by: tests/core "what is no surface of a solid is refused, and where".
    constexpr double least = 1e-95, most = 1e95;
    std::vector<bool> used(mesh_.vertices.size(), false);
    for (const auto& t : mesh_.triangles)
      for (int k : t) used[at(k)] = true;
    for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
      for (const double x : mesh_.vertices[i])
        if (x != 0 && !(std::abs(x) >= least && std::abs(x) <= most))
          return SolidFlaw{in_list("vertices", i), "has a coordinate that is not within 1e-95 to 1e+95"};
      if (!used[i]) return SolidFlaw{in_list("vertices", i), "belongs to no triangle of the solid"};
    }
    return std::nullopt;
  }

  std::optional<SolidFlaw> area_flaw() {
    for (std::size_t i = 0; i < triangles_.size(); ++i)
      if (coordinate_to_leave_out(corners(mesh_, i)) < 0)
        return SolidFlaw{triangle(i), "has no area, so it is no face of a solid"};
    return std::nullopt;
  }

  Edge edge_of(std::size_t i, std::size_t k) const { return {triangles_[i][k], triangles_[i][(k + 1) % 3]}; }
  std::string edge_text(std::size_t i, std::size_t k) const {
    const auto& t = mesh_.triangles[i];
    return "the edge from vertex " + std::to_string(t[k]) + " to " + std::to_string(t[(k + 1) % 3]);
  }

  // The second triangle with the same directed edge, if any.
  std::optional<std::pair<std::size_t, std::size_t>> find_edges() {
    edges_.clear();
    for (std::size_t i = 0; i < triangles_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        if (!edges_.try_emplace(edge_of(i, k), i).second) return std::pair{i, k};
    return std::nullopt;
  }

  std::optional<SolidFlaw> edge_flaw() {
    if (const auto twice = find_edges()) {
      const auto [i, k] = *twice;
      return SolidFlaw{triangle(i),
                       "runs along " + edge_text(i, k) + " in the same direction as " +
                           triangle(edges_.at(edge_of(i, k))) +
                           ": their orientations differ, or the edge has more than two triangles"};
    }
    for (std::size_t i = 0; i < triangles_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const Edge e = edge_of(i, k);
        if (!edges_.contains({e.second, e.first}))
          return SolidFlaw{triangle(i), "has no triangle on the other side of " + edge_text(i, k) +
                                            ": the mesh is open there"};
      }
    return std::nullopt;
  }

  // Numbers each triangle by the first of its connected part.
  void find_parts() {
    part_.resize(triangles_.size());
    std::iota(part_.begin(), part_.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
      while (part_[i] != i) i = part_[i] = part_[part_[i]];
      return i;
    };
    for (std::size_t i = 0; i < triangles_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const Edge e = edge_of(i, k);
        const std::size_t x = root(i), y = root(edges_.at({e.second, e.first}));
        part_[std::max(x, y)] = std::min(x, y);
      }
    for (std::size_t i = 0; i < part_.size(); ++i) part_[i] = root(i);
  }

  // Pairs whose boxes meet, found along x.
  std::optional<SolidFlaw> crossing_flaw() {
    struct Box {
      Vec3 lo, hi;
      std::size_t i;
    };
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const Corners c = corners(mesh_, i);
      boxes.push_back({c[0].cwiseMin(c[1]).cwiseMin(c[2]), c[0].cwiseMax(c[1]).cwiseMax(c[2]), i});
    }
    std::sort(boxes.begin(), boxes.end(), [](const Box& x, const Box& y) {
      return x.lo.x() != y.lo.x() ? x.lo.x() < y.lo.x() : x.i < y.i;
    });
    for (std::size_t p = 0; p < boxes.size(); ++p)
      for (std::size_t q = p + 1; q < boxes.size() && boxes[q].lo.x() <= boxes[p].hi.x(); ++q) {
        const Box &x = boxes[p], &y = boxes[q];
        if ((x.lo.array() > y.hi.array()).any() || (y.lo.array() > x.hi.array()).any()) continue;
        if (meet(x.i, y.i))
          return SolidFlaw{triangle(std::max(x.i, y.i)),
                           "meets " + triangle(std::min(x.i, y.i)) +
                               " outside a common edge or vertex: the surface meets itself"};
      }
    return std::nullopt;
  }

  // Whether two triangles share more than a common edge or vertex.
  bool meet(std::size_t i, std::size_t j) const {
    std::vector<std::size_t> own_i, own_j;  // corners that the other triangle lacks
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::ranges::find(triangles_[j], triangles_[i][k]) == triangles_[j].end()) own_i.push_back(k);
      if (std::ranges::find(triangles_[i], triangles_[j][k]) == triangles_[i].end()) own_j.push_back(k);
    }
    const Corners a = corners(mesh_, i), b = corners(mesh_, j);
    if (own_i.empty()) return true;
    if (own_i.size() == 1) return fold_over(a, own_i[0], b[own_j[0]]);
    if (own_i.size() == 2)
      return segment_meets(a[own_i[0]], a[own_i[1]], b) || segment_meets(b[own_j[0]], b[own_j[1]], a);
    for (std::size_t k = 0; k < 3; ++k)
      if (segment_meets(a[k], a[(k + 1) % 3], b) || segment_meets(b[k], b[(k + 1) % 3], a)) return true;
    return false;
  }

  // Two triangles with a common edge, whose other corners are c[k] and p, lie on the same side of it in one
  // plane.
  static bool fold_over(const Corners& c, std::size_t k, const Vec3& p) {
    if (orient3d_sign(c[0], c[1], c[2], p) != 0) return false;
    const int left_out = coordinate_to_leave_out(c);
    const Vec3 &from = c[(k + 1) % 3], &to = c[(k + 2) % 3];
    return side_in_plane(from, to, c[k], left_out) * side_in_plane(from, to, p, left_out) > 0;
  }

  // Parts that do not meet are nested: what is just outside a part must be outside the solid, or inside it
  // where the part bounds a cavity.
  std::optional<SolidFlaw> orientation_flaw() {
    find_parts();
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      if (part_[i] != i) continue;
      TriangleMesh own{mesh_.vertices, {}}, others{mesh_.vertices, {}};
      for (std::size_t j = 0; j < triangles_.size(); ++j)
        (part_[j] == i ? own : others).triangles.push_back(mesh_.triangles[j]);
      if (touches_another_part(i))
        return SolidFlaw{triangle(i), "belongs to a part that touches another part in a vertex"};
      const bool outward = volume_sign(own) > 0;
      const int around = winding_number(others, corners(mesh_, i)[0]);
      if (outward && around == 0) continue;
      if (!outward && around == 1) continue;
      return SolidFlaw{
          triangle(i),
          outward ? "belongs to a part inside another part, which faces outward; a cavity faces inward"
                  : "is clockwise seen from outside: the part that it belongs to faces inward"};
    }
    return std::nullopt;
  }

  bool touches_another_part(std::size_t part) const {
    std::vector<char> seen(number_.size(), 0);
    for (std::size_t j = 0; j < triangles_.size(); ++j)
      for (int v : triangles_[j]) seen[at(v)] |= part_[j] == part ? 1 : 2;
    return std::ranges::find(seen, 3) != seen.end();
  }

  // Of six times the enclosed volume: in doubles if their error allows, else exactly.
  static int volume_sign(const TriangleMesh& m) {
    double sum = 0, sizes = 0;
    const Vec3 from = corners(m, 0)[0];
    for (std::size_t i = 0; i < m.triangles.size(); ++i) {
      const Corners c = corners(m, i);
      const Vec3 u = c[0] - from, v = c[1] - from, w = c[2] - from;
      sum += u.dot(v.cross(w));
      sizes += u.norm() * v.norm() * w.norm();
    }
    // Each term carries a dozen roundings of its size, and the sum one for each term.
    const double error =
        sizes * std::numeric_limits<double>::epsilon() * (16 + static_cast<double>(m.triangles.size()));
    if (std::abs(sum) > error) return sum > 0 ? 1 : -1;
    Expansion exact;
    for (std::size_t i = 0; i < m.triangles.size(); ++i) exact = exact + exact_volume(corners(m, i));
    return exact.sign();
  }

  static Expansion exact_volume(const Corners& c) {
    using X = Expansion;
    const auto minor = [&](int x, int y) { return X(c[1][x]) * X(c[2][y]) - X(c[1][y]) * X(c[2][x]); };
    return X(c[0][0]) * minor(1, 2) + X(c[0][1]) * minor(2, 0) + X(c[0][2]) * minor(0, 1);
  }

  const TriangleMesh& mesh_;
  std::vector<int> number_;
  std::vector<std::array<int, 3>> triangles_;
  std::map<Edge, std::size_t> edges_;  // directed
  std::vector<std::size_t> part_;
};

Vec3 middle(const Corners& c) { return (c[0] + c[1] + c[2]) / 3; }

// How far it is along a line from triangle `start` to the next one, rounded; triangles are taken to be a
// little larger than they are, so that a line through an edge misses neither. The line leaves a closed
// surface somewhere.
double to_surface(const TriangleMesh& m, std::size_t start, const Vec3& from, const Vec3& along) {
  constexpr double larger = 1e-9;  // of the triangle's size
  double nearest = infinity;
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    const Corners c = corners(m, i);
    const Vec3 e = c[1] - c[0], f = c[2] - c[0], across = along.cross(f), to = from - c[0];
    const double det = e.dot(across);
    if (i == start || det == 0) continue;
    const double u = to.dot(across) / det, v = along.dot(to.cross(e)) / det;
    const double t = f.dot(to.cross(e)) / det;
    if (u >= -larger && v >= -larger && u + v <= 1 + larger && t > 0) nearest = std::min(nearest, t);
  }
  return nearest;
}

// The side of p beside the line from a to b, seen along z, with p moved by (e, e²) for an infinitesimal e >
// 0.
int perturbed_side(const Vec3& a, const Vec3& b, const Vec3& p) {
  if (const int s = orient2d_sign(a.x(), a.y(), b.x(), b.y(), p.x(), p.y()); s != 0) return s;
  if (a.y() != b.y()) return a.y() > b.y() ? 1 : -1;
  if (a.x() != b.x()) return b.x() > a.x() ? 1 : -1;
  return 0;
}

}  // namespace

std::optional<SolidFlaw> flaw_of_solid(const TriangleMesh& surface) { return Surface(surface).flaw(); }

bool is_convex_solid(const TriangleMesh& surface) { return Surface(surface).is_convex(); }

std::vector<Vec3> points_of_parts(const TriangleMesh& mesh) {
  std::vector<Vec3> r;
  for (const std::size_t i : Surface(mesh).largest_of_parts()) r.push_back(middle(corners(mesh, i)));
  return r;
}

std::vector<Vec3> inner_points(const TriangleMesh& surface) {
  std::vector<Vec3> r;
  for (const std::size_t i : Surface(surface).largest_of_parts()) {
    const Corners c = corners(surface, i);
    const Vec3 from = middle(c), inward = (c[2] - c[0]).cross(c[1] - c[0]).stableNormalized();
    double t = to_surface(surface, i, from, inward);
    Vec3 inside = c[0];
    for (int halvings = 0; halvings < std::numeric_limits<double>::digits; ++halvings) {
      t /= 2;
      const Vec3 p = from + t * inward;
      if (winding_number(surface, p) == 0) continue;
      inside = p;
      break;
    }
    r.push_back(inside);
  }
  return r;
}

// Counts the triangles above the point, +1 for those that face up. The ray upward is moved aside by an
// infinitesimal amount, the same for all triangles, so that it meets no edge and no vertical triangle.
int winding_number(const TriangleMesh& surface, const Vec3& point) {
  int winding = 0;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const Corners c = corners(surface, i);
    const double x = point.x(), y = point.y();
    if (std::max({c[0].x(), c[1].x(), c[2].x()}) < x || std::min({c[0].x(), c[1].x(), c[2].x()}) > x ||
        std::max({c[0].y(), c[1].y(), c[2].y()}) < y || std::min({c[0].y(), c[1].y(), c[2].y()}) > y ||
        std::max({c[0].z(), c[1].z(), c[2].z()}) < point.z())
      continue;
    const int facing = orient2d_sign(c[0].x(), c[0].y(), c[1].x(), c[1].y(), c[2].x(), c[2].y());
    if (facing == 0) continue;
    if (perturbed_side(c[0], c[1], point) != facing || perturbed_side(c[1], c[2], point) != facing ||
        perturbed_side(c[2], c[0], point) != facing)
      continue;
    // det(c1 - c0, c2 - c0, p - c0) has the sign of `facing` where the point is above an upward triangle.
    if (orient3d_sign(c[0], c[1], c[2], point) * facing < 0) winding += facing;
  }
  return winding;
}

}  // namespace touchstone
