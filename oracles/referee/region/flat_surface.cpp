#include "oracles/referee/region/contact_region.h"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "oracles/referee/exact/rational.h"
#include "oracles/referee/work.h"

namespace touchstone::referee {
namespace {

using Corners = std::array<Vec3, 3>;

// What a plane through three corners in doubles may be off by at a distance d of a corner: this · d / s,
// where s is the sine of the angle between the two edges that span it. About ten roundings of 2^-53, with
// some to spare.
constexpr double plane_rounding = 0x1p-48;

bool meet(const Aabb& a, const Aabb& b) {
  return (a.lo.array() <= b.hi.array()).all() && (b.lo.array() <= a.hi.array()).all();
}

Aabb grown(const Aabb& box, double by) {
  Aabb r = box;
  for (int k = 0; k < 3; ++k) {
    r.lo[k] = std::nextafter(box.lo[k] - by, -std::numeric_limits<double>::infinity());
    r.hi[k] = std::nextafter(box.hi[k] + by, std::numeric_limits<double>::infinity());
  }
  return r;
}

// The triangles of the mesh in the plane of one of them.
class Plane {
 public:
  explicit Plane(const Corners& c) : corner_(exact(c[0])), normal_(cross_of(c)) {}

  bool contains(const Vec3& p) const { return dot(normal_, exact(p) - corner_) == 0; }
  bool contains(const Corners& c) const {
    return std::all_of(c.begin(), c.end(), [&](const Vec3& p) { return contains(p); });
  }
  // 1 or -1: the side of the line through p and q on which r lies; 0: on the line.
  int side(const Vec3& p, const Vec3& q, const Vec3& r) const {
    const Rational d = dot(cross(exact(q) - exact(p), exact(r) - exact(p)), normal_);
    return d > 0 ? 1 : d < 0 ? -1 : 0;
  }
  static bool has_area(const Corners& c) { return !is_zero(cross_of(c)); }

 private:
  static Rational3 cross_of(const Corners& c) {
    return cross(exact(c[1]) - exact(c[0]), exact(c[2]) - exact(c[0]));
  }
  Rational3 corner_, normal_;
};

// On which sides of an edge triangles lie.
struct Sides {
  bool left = false, right = false;
};
struct EdgeOrder {
  bool operator()(const std::pair<Vec3, Vec3>& a, const std::pair<Vec3, Vec3>& b) const {
    for (int k = 0; k < 3; ++k)
      if (a.first[k] != b.first[k]) return a.first[k] < b.first[k];
    for (int k = 0; k < 3; ++k)
      if (a.second[k] != b.second[k]) return a.second[k] < b.second[k];
    return false;
  }
};
using Edges = std::map<std::pair<Vec3, Vec3>, Sides, EdgeOrder>;

void add_edges(const Plane& plane, const Corners& c, Edges& edges) {
  for (std::size_t k = 0; k < 3; ++k) {
    std::pair<Vec3, Vec3> edge{c[k], c[(k + 1) % 3]};
    if (EdgeOrder{}({edge.second, edge.first}, edge)) std::swap(edge.first, edge.second);
    Sides& sides = edges[edge];
    (plane.side(edge.first, edge.second, c[(k + 2) % 3]) > 0 ? sides.left : sides.right) = true;
  }
}

class Search {
 public:
  Search(const Placed& mesh, const Placed& body)
      : mesh_(mesh), body_(body), triangles_(std::get<TriangleMesh>(*mesh.shape)), box_(outer_box(body)) {}

  std::optional<FlatSurface> run() {
    const std::optional<Corners> first = touched_triangle();
    if (!first) return std::nullopt;
    const std::optional<FlatSurface> r = through_plane_of(*first);
    if (!r || !is_plane_within(2 * r->reach.hi, *first)) return std::nullopt;
    return r;
  }

 private:
  Corners corners(std::size_t i) const {
    const auto at = [&](int k) { return triangles_.vertices[static_cast<std::size_t>(k)]; };
    const auto& [a, b, c] = triangles_.triangles[i];
    return {at(a), at(b), at(c)};
  }
  Shape hull_of(std::vector<Vec3> points) const { return make_hull(std::move(points)); }
  Aabb box_of(const Shape& hull) const {
    spend(500);
    return outer_box(Placed{&hull, mesh_.pose});
  }
  bool is_farther(const Shape& hull, double reach) const {
    return judge_pair({&hull, mesh_.pose}, body_).gap.lo > reach;
  }

  std::optional<Corners> touched_triangle() const {
    for (std::size_t i = 0; i < triangles_.triangles.size(); ++i) {
      const Corners c = corners(i);
      const Shape hull = hull_of({c[0], c[1], c[2]});
      if (!meet(box_of(hull), box_) || !Plane::has_area(c)) continue;
      if (judge_pair({&hull, mesh_.pose}, body_).verdict == Verdict::overlap) return c;
    }
    return std::nullopt;
  }

  // How far the body reaches through the plane, which doubles state up to a rounding that is added.
  std::optional<FlatSurface> through_plane_of(const Corners& c) const {
    const Vec3 along = c[1] - c[0], across = c[2] - c[0], n = along.cross(across);
    const double sine = n.norm() / (along.norm() * across.norm());
    if (!(n.squaredNorm() > std::numeric_limits<double>::min()) || !(sine > 0)) return std::nullopt;
    const Shape below = HalfSpace{n, n.dot(c[0])}, above = HalfSpace{-n, -n.dot(c[0])};
    const Bracket up = depth_in(below), down = depth_in(above);
    const Aabb corner = box_of(hull_of({c[0]}));
    const double off = plane_rounding / sine * reach_of(corner);
    FlatSurface r;
    r.reach = {std::max(0.0, std::min(up.lo, down.lo) - off), std::min(up.hi, down.hi) + off};
    r.normal = judge_pair({&below, mesh_.pose}, body_).normal;
    if (!std::isfinite(r.reach.hi)) return std::nullopt;
    return r;
  }
  Bracket depth_in(const Shape& half_space) const {
    const Bracket gap = judge_pair({&half_space, mesh_.pose}, body_).gap;
    return {-gap.hi, -gap.lo};
  }
  // More than the distance of any point of the body from the corner, and than the coordinates of both.
  double reach_of(const Aabb& corner) const {
    double most = 0;
    for (const Vec3& p : {corner.lo, corner.hi, box_.lo, box_.hi}) most = std::max(most, p.lpNorm<1>());
    for (const Vec3& v : triangles_.vertices) most = std::max(most, v.lpNorm<1>());
    return 2 * most;
  }

  bool is_plane_within(double reach, const Corners& first) const {
    const Aabb region = grown(box_, reach);
    const Plane plane(first);
    Edges edges;
    for (std::size_t i = 0; i < triangles_.triangles.size(); ++i) {
      const Corners c = corners(i);
      const Shape hull = hull_of({c[0], c[1], c[2]});
      if (!meet(box_of(hull), region)) continue;
      if (Plane::has_area(c) && plane.contains(c))
        add_edges(plane, c, edges);
      else if (!is_farther(hull, reach))
        return false;
    }
    return std::all_of(edges.begin(), edges.end(), [&](const auto& entry) {
      const auto& [edge, sides] = entry;
      if (sides.left && sides.right) return true;
      const Shape hull = hull_of({edge.first, edge.second});
      return !meet(box_of(hull), region) || is_farther(hull, reach);
    });
  }

  const Placed &mesh_, &body_;
  const TriangleMesh& triangles_;
  Aabb box_;
};

}  // namespace

std::optional<FlatSurface> flat_surface(const Placed& mesh, const Placed& body) {
  if (std::holds_alternative<HalfSpace>(*body.shape) || is_mesh(*body.shape)) return std::nullopt;
  return within_limit(std::optional<FlatSurface>{}, [&] { return Search(mesh, body).run(); });
}

}  // namespace touchstone::referee
