// Convex hull of points: the set is conv(vertices), exactly. Points that are not extreme, duplicates, and
// flat sets (a point, a segment, a polygon) are legitimate. Faces are a convenience for engines that want
// them.
#pragma once

#include <array>
#include <span>
#include <tuple>
#include <vector>

#include "core/math/pose.h"
#include "core/shape/bounds.h"
#include "core/shape/feature.h"
#include "core/shape/field.h"
#include "core/shape/vertex_climb.h"
#include "core/shape/vertex_scan.h"

namespace touchstone::convex {

/// Two vertices each, by index.
using VertexEdges = std::vector<std::array<int, 2>>;

/// The vertices of a hull or a triangle, times `unit`. Refers to them, their edges and the graph.
template <class R>
struct VerticesCore : Polyhedral<R> {
  static constexpr Symmetry symmetry = Symmetry::none;
  static constexpr int support_rounding = 6;
  std::span<const Vec3> vertices;
  const VertexEdges* edges = nullptr;  // of `vertices`; null: all are neighbours
  const HullGraph* graph = nullptr;    // of `vertices`, or null
  R unit = 1;                          // power of two

  explicit VerticesCore(std::span<const Vec3> v, const VertexEdges* e = nullptr, const HullGraph* g = nullptr)
      : vertices(v), edges(e), graph(g && *g ? g : nullptr) {}

  V3<R> support(const V3<R>& d) const {
    if constexpr (is_hardware<R>)
      return vertex(graph ? farthest_vertex(*graph, vertices, d) : farthest_vertex(vertices, d));
    else
      return vertex(farthest_by_scan(d));
  }
  R reach() const {
    if constexpr (is_hardware<R>) {
      return static_cast<R>(graph ? graph->reach : std::sqrt(largest_norm_sq(vertices))) * unit;
    } else {
      R r = 0;
      for (std::size_t i = 0; i < vertices.size(); ++i) r = std::max(r, R(vertex(i).norm()));
      return r;
    }
  }
  R extent() const { return reach(); }
  R reach_off_axis(const V3<R>& axis) const {
    R most = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      most = std::max(most, R(vertex(i).cross(axis).squaredNorm()));
    return sqrt(most);
  }
  int round_axis() const { return -1; }
  void scale(R by) { unit *= by; }

  V3<R> snap(const V3<R>& p) const { return p; }
  /// Decided by the number of distinct corners.
  Feature<R> suggest(const std::array<V3<R>, 3>& q, const V3<R>&, const V3<R>& d, R near) const {
    const DistinctPoints<R> k(q, near);
    if (k.size == 1) return corner_feature<R>(k.p[0]);
    if (k.size == 2) {
      const R length = (k.p[1] - k.p[0]).norm();
      return edge_feature<R>(k.p[0], (k.p[1] - k.p[0]) / length, 0, length);
    }
    V3<R> m = triangle_normal<R>(k.p[0], k.p[1], k.p[2]).normalized();
    if (m.dot(d) < 0) m = -m;
    Feature<R> f = face_feature<R>(k.p[0], m);
    f.corner = k.p;
    return f;
  }
  R face_margin(const Feature<R>& f, const V3<R>& q) const {
    R least = std::numeric_limits<R>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      const V3<R>&x = f.corner[k], &y = f.corner[(k + 1) % 3], &z = f.corner[(k + 2) % 3];
      V3<R> in = f.c.cross(y - x).normalized();
      if (in.dot(z - x) < 0) in = -in;
      least = std::min(least, in.dot(q - x));
    }
    return least;
  }
  template <class Out>
  bool face_corners(const FaceQuery<R>& at, Out&& out) const {
    if constexpr (is_hardware<R>) {
      std::array<std::int32_t, face_capacity> high;
      const R least = at.top - at.limit;
      const std::size_t n = graph ? vertices_above(*graph, vertices, at.d, least, high)
                                  : vertices_above(vertices, at.d, least, high);
      if (n <= high.size()) {
        for (std::size_t i = 0; i < n; ++i)
          out.add_certain(vertex(static_cast<std::size_t>(high[i])), static_cast<std::uint32_t>(high[i]));
        return false;
      }
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) out.add_many(vertex(i), static_cast<std::uint32_t>(i));
    return false;
  }
  template <class Out>
  void edges_within(const FaceQuery<R>& at, Out&& out) const {
    const auto show = [&](std::size_t i, std::size_t k) {
      edge_within<R>(at, vertex(i), static_cast<std::uint32_t>(i), vertex(k), static_cast<std::uint32_t>(k),
                     out);
    };
    if (!edges) {
      for (std::size_t i = 0; i < vertices.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) show(i, k);
      return;
    }
    // Each vertex belongs to several edges.
    constexpr std::size_t most = 128;
    std::array<bool, most> is_within;
    const bool is_noted = vertices.size() <= most;
    for (std::size_t i = 0; is_noted && i < vertices.size(); ++i)
      is_within[i] = at.top - at.d.dot(vertex(i)) <= at.limit;
    for (const auto& edge : *edges) {
      const auto i = static_cast<std::size_t>(edge[0]), k = static_cast<std::size_t>(edge[1]);
      if (!is_noted || is_within[i] || is_within[k]) show(i, k);
    }
  }
  R edge_reach(const FaceQuery<R>&) const { return std::numeric_limits<R>::infinity(); }

 private:
  V3<R> vertex(std::size_t i) const { return vertices[i].template cast<R>() * unit; }
  std::size_t farthest_by_scan(const V3<R>& d) const {
    std::size_t best = 0;
    R most = -std::numeric_limits<R>::infinity();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const V3<R> v = vertices[i].template cast<R>();
      const R dot = d.x() * v.x() + d.y() * v.y() + d.z() * v.z();
      if (dot > most) {
        most = dot;
        best = i;
      }
    }
    return best;
  }
};

}  // namespace touchstone::convex

namespace touchstone {

struct Hull {
  std::vector<Vec3> vertices;  // n×3, n >= 1, body frame
  /// Triangles (vertex indices, counter-clockwise from outside) from qhull; empty when the set is flat or so
  /// thin that qhull finds no full-dimensional simplex. Derived: not compared, not hashed.
  std::vector<std::array<int, 3>> faces;
  /// Affine dimension of the vertices, 0 to 3, decided exactly on the doubles. Derived.
  int dimension = 0;
  /// Where faces meet that are not in one plane; the outline of a hull without faces. Derived.
  convex::VertexEdges edges{};
  static constexpr std::string_view type = "hull";
  static constexpr auto fields() { return std::tuple{Field{"vertices", &Hull::vertices, Domain::any}}; }

  template <class R>
  convex::VerticesCore<R> core(const HullGraph* graph = nullptr) const {
    return convex::VerticesCore<R>(vertices, &edges, graph);
  }
  static constexpr bool has_ball = false;
  double ball_radius() const { return 0; }
  bool is_ball() const { return false; }
  double bounding_radius() const { return farthest(vertices); }
  double extent() const { return largest_half_extent(vertices); }
  template <class T>
  Interval<T> extent_along(const V3<T>& d) const {
    return extent_of<T>(vertices, d);
  }
  Wide coordinate_sum() const { return largest_coordinate_sum(vertices); }
  InnerRadii inner_radii() const;
  bool operator==(const Hull& o) const { return vertices == o.vertices; }
};

/// Computes faces, edges and dimension. Throws InputError when there are no vertices or a coordinate is not
/// finite.
Hull make_hull(std::vector<Vec3> vertices);

inline Vec3 support(const Hull& h, const Vec3& d) {
  const Vec3* best = &h.vertices.front();
  double best_dot = best->dot(d);
  for (const Vec3& v : h.vertices) {
    const double dot = v.dot(d);
    if (dot > best_dot) {
      best_dot = dot;
      best = &v;
    }
  }
  return *best;
}

}  // namespace touchstone
