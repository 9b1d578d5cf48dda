#include "core/narrow/flat_mesh.h"

#include <algorithm>
#include <map>

#include "core/math/expansion.h"
#include "core/math/roundoff.h"
#include "core/narrow/mesh.h"
#include "core/tolerance.h"

namespace touchstone::narrow {
namespace {

using Corners = std::array<Vec3, 3>;

Vec3 area_normal(const Corners& c) { return (c[1] - c[0]).cross(c[2] - c[0]); }

bool is_in_plane_of(const Corners& plane, const Corners& c) {
  return std::all_of(c.begin(), c.end(),
                     [&](const Vec3& p) { return orient3d_sign(plane[0], plane[1], plane[2], p) == 0; });
}

// The edges of coplanar triangles, each with the sides on which triangles lie. A side is the sign of the area
// in the two coordinates in which the plane is seen most fully.
class Edges {
 public:
  explicit Edges(const Vec3& normal) { normal.cwiseAbs().maxCoeff(&left_out_); }

  void add(const Corners& c) {
    for (std::size_t k = 0; k < 3; ++k) {
      Key key{at(c[k]), at(c[(k + 1) % 3])};
      std::pair<Vec3, Vec3> ends{c[k], c[(k + 1) % 3]};
      if (key.second < key.first) {
        std::swap(key.first, key.second);
        std::swap(ends.first, ends.second);
      }
      Entry& e = entries_[key];
      e.ends = ends;
      (side(key, at(c[(k + 2) % 3])) > 0 ? e.left : e.right) = true;
    }
  }

  /// Calls f with the ends of each edge that has triangles on one side only; stops when f is false.
  template <class F>
  bool every_open(const F& f) const {
    return std::all_of(entries_.begin(), entries_.end(), [&](const auto& entry) {
      const Entry& e = entry.second;
      return (e.left && e.right) || f(e.ends);
    });
  }

 private:
  using Flat = std::pair<double, double>;
  using Key = std::pair<Flat, Flat>;
  struct Entry {
    std::pair<Vec3, Vec3> ends;
    bool left = false, right = false;
  };
  Flat at(const Vec3& p) const { return {p[(left_out_ + 1) % 3], p[(left_out_ + 2) % 3]}; }
  static int side(const Key& k, const Flat& p) {
    return orient2d_sign(k.first.first, k.first.second, k.second.first, k.second.second, p.first, p.second);
  }

  Eigen::Index left_out_ = 0;
  std::map<Key, Entry> entries_;
};

class Patch {
 public:
  Patch(const PlacedShape& mesh, const PlacedShape& body)
      : mesh_(mesh),
        body_(body),
        triangles_(std::get<TriangleMesh>(*mesh.shape)),
        centre_(rotation_matrix(mesh.pose.rotation).transpose() *
                (body.pose.translation - mesh.pose.translation)),
        radius_(body.bounding_radius()) {}

  /// The first triangle that the body touches, unless one that it touches has the given normal.
  std::optional<Corners> touched_unless_along(const Vec3& normal) const {
    const Vec3 local = rotation_matrix(mesh_.pose.rotation).transpose() * normal;
    std::optional<Corners> touched;
    const bool is_edge = every_near(0, [&](const Corners& c) {
      const Vec3 n = area_normal(c);
      if (!(n.norm() > 0)) return true;
      constexpr double roundings = 64;
      const bool is_its_normal = std::abs(n.dot(local)) >= (1 - roundings * double_roundoff) * n.norm();
      if (touched && !is_its_normal) return true;
      if (!overlap(body_, placed(make_hull({c[0], c[1], c[2]}))).overlap) return true;
      touched = c;
      return !is_its_normal;
    });
    return is_edge ? touched : std::nullopt;
  }

  bool is_plane_within(double reach, const Corners& plane) const {
    Edges edges(area_normal(plane));
    const bool is_flat = every_near(reach, [&](const Corners& c) {
      if (area_normal(c).norm() > 0 && is_in_plane_of(plane, c)) {
        edges.add(c);
        return true;
      }
      return is_farther(make_hull({c[0], c[1], c[2]}), reach);
    });
    return is_flat && edges.every_open([&](const std::pair<Vec3, Vec3>& ends) {
      return is_farther(make_hull({ends.first, ends.second}), reach);
    });
  }

 private:
  PlacedShape placed(Shape&& hull) const {
    hull_ = std::move(hull);
    return {&hull_, mesh_.pose};
  }
  bool is_farther(Shape&& hull, double reach) const {
    const DistanceAnswer d = distance(body_, placed(std::move(hull)));
    return d.outcome == Outcome::answered && d.distance > reach;
  }

  bool is_near(const Vec3& lo, const Vec3& hi, double reach) const {
    const double far =
        (radius_ + reach + centre_.norm() * tolerance::box_rounding) * (1 + tolerance::box_rounding);
    return box_distance_sq(centre_, lo, hi) <= far * far;
  }
  template <class F>
  bool every_near(double reach, const F& f) const {
    if (const MeshTree* tree = mesh_.tree()) return tree->nodes.empty() || every_below(*tree, 0, reach, f);
    for (std::size_t i = 0; i < triangles_.triangles.size(); ++i)
      if (!holds_if_near(i, reach, f)) return false;
    return true;
  }
  template <class F>
  bool every_below(const MeshTree& tree, std::int32_t node, double reach, const F& f) const {
    const MeshTree::Node& n = tree.nodes[static_cast<std::size_t>(node)];
    if (!is_near(n.lo, n.hi, reach)) return true;
    if (n.count == 0) return every_below(tree, n.first, reach, f) && every_below(tree, n.first + 1, reach, f);
    for (std::int32_t i = n.first; i < n.first + n.count; ++i)
      if (!holds_if_near(static_cast<std::size_t>(tree.order[static_cast<std::size_t>(i)]), reach, f))
        return false;
    return true;
  }
  template <class F>
  bool holds_if_near(std::size_t triangle, double reach, const F& f) const {
    const Corners c = corners(triangles_, triangle);
    if (!is_near(c[0].cwiseMin(c[1]).cwiseMin(c[2]), c[0].cwiseMax(c[1]).cwiseMax(c[2]), reach)) return true;
    return f(c);
  }

  const PlacedShape &mesh_, &body_;
  const TriangleMesh& triangles_;
  Vec3 centre_;  // of the body, in the mesh's frame
  double radius_;
  mutable Shape hull_;
};

bool is_mesh(const PlacedShape& p) { return std::holds_alternative<TriangleMesh>(*p.shape); }

// The lesser depth of the body in the half-spaces on both sides of the plane, in the order of the query.
ContactAnswer with_plane(const PlacedShape& mesh, const PlacedShape& body, const Corners& c,
                         bool is_mesh_first) {
  const Vec3 n = area_normal(c);
  ContactAnswer best;
  best.outcome = Outcome::not_converged;
  for (const double side : {1.0, -1.0}) {
    const Shape half_space = HalfSpace{side * n, side * n.dot(c[0])};
    const PlacedShape plane{&half_space, mesh.pose};
    const ContactAnswer r = is_mesh_first ? contact(plane, body) : contact(body, plane);
    if (r.outcome != Outcome::answered || !r.overlap) continue;
    if (best.outcome != Outcome::answered || r.depth < best.depth) best = r;
  }
  return best;
}

// Of a plane through three corners in doubles: ten roundings of the lengths involved, more where its edges
// are nearly parallel.
double plane_error(const PlacedShape& mesh, const PlacedShape& body, const Corners& c) {
  const Vec3 u = c[1] - c[0], v = c[2] - c[0];
  const double sine = area_normal(c).norm() / (u.norm() * v.norm());
  const double length = body.bounding_radius() + (body.pose.translation - mesh.pose.translation).norm() +
                        c[0].norm() + body.pose.translation.norm();
  constexpr double roundings = 10;
  return roundings * double_roundoff * length / sine;
}

}  // namespace

bool may_be_flat(const PlacedShape& a, const PlacedShape& b) {
  return is_mesh(a) != is_mesh(b) && is_convex(kind_of(*(is_mesh(a) ? b : a).shape));
}

std::optional<ContactAnswer> contact_with_plane_of(const PlacedShape& a, const PlacedShape& b,
                                                   const ContactAnswer& of_triangle) {
  const bool first = is_mesh(a);
  const PlacedShape &mesh = first ? a : b, &body = first ? b : a;
  const Patch patch(mesh, body);
  const std::optional<Corners> touched = patch.touched_unless_along(of_triangle.normal);
  if (!touched) return std::nullopt;
  ContactAnswer r = with_plane(mesh, body, *touched, first);
  if (r.outcome != Outcome::answered || !patch.is_plane_within(2 * r.depth, *touched)) return std::nullopt;
  const double error = plane_error(mesh, body, *touched);
  r.error_bound += error;
  r.regret_bound += error;
  return r;
}

}  // namespace touchstone::narrow
