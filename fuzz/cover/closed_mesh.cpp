#include "fuzz/cover/closed_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace touchstone::fuzz {
namespace {

constexpr int leaf_size = 4;

const Vec3& corner(const TriangleMesh& m, int triangle, std::size_t k) {
  return m.vertices[static_cast<std::size_t>(m.triangles[static_cast<std::size_t>(triangle)][k])];
}

double distance_from(const Aabb& b, const Vec3& p) {
  return (b.lo - p).cwiseMax(p - b.hi).cwiseMax(Vec3::Zero()).norm();
}

Vec3 nearest_in_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double length = d.squaredNorm();
  if (!(length > 0)) return a;
  return a + std::clamp((p - a).dot(d) / length, 0.0, 1.0) * d;
}

struct Interval {
  double lo = std::numeric_limits<double>::infinity(), hi = -std::numeric_limits<double>::infinity();
};

template <std::size_t N>
Interval along(const Vec3& n, const std::array<Vec3, N>& points) {
  Interval i;
  for (const Vec3& p : points) {
    i.lo = std::min(i.lo, n.dot(p));
    i.hi = std::max(i.hi, n.dot(p));
  }
  return i;
}

// The normals of both and the products of their edges: enough to separate two convex polyhedra that can be
// separated (Gottschalk, Lin and Manocha 1996).
std::vector<Vec3> axes_of(const std::array<Vec3, 4>& t, const std::array<Vec3, 3>& f) {
  const std::array<Vec3, 3> of_face{f[1] - f[0], f[2] - f[1], f[0] - f[2]};
  const std::array<Vec3, 6> of_tetrahedron{t[1] - t[0], t[2] - t[0], t[3] - t[0],
                                           t[2] - t[1], t[3] - t[1], t[3] - t[2]};
  std::vector<Vec3> axes{of_face[0].cross(of_face[1]), of_tetrahedron[0].cross(of_tetrahedron[1]),
                         of_tetrahedron[1].cross(of_tetrahedron[2]),
                         of_tetrahedron[2].cross(of_tetrahedron[0]),
                         of_tetrahedron[3].cross(of_tetrahedron[4])};
  for (const Vec3& a : of_tetrahedron)
    for (const Vec3& b : of_face) axes.push_back(a.cross(b));
  return axes;
}

// The width of the tetrahedron along an axis on which the triangle reaches into it by at most `slack`; 0 if
// there is no such axis.
double separated_width(const std::array<Vec3, 4>& t, const std::array<Vec3, 3>& f, double slack) {
  double widest = 0;
  for (const Vec3& axis : axes_of(t, f)) {
    const double length = axis.norm();
    if (!(length > 0)) continue;
    const Interval a = along(Vec3(axis / length), t), b = along(Vec3(axis / length), f);
    if (std::min(a.hi, b.hi) - std::max(a.lo, b.lo) <= slack) widest = std::max(widest, a.hi - a.lo);
  }
  return widest;
}

}  // namespace

Vec3 nearest_in_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a);
  const double area = n.squaredNorm();
  if (area > 0) {
    // Barycentric coordinates of the foot of p.
    const double u = (c - b).cross(p - b).dot(n), v = (a - c).cross(p - c).dot(n),
                 w = (b - a).cross(p - a).dot(n);
    if (u >= 0 && v >= 0 && w >= 0) return (u * a + v * b + w * c) / (u + v + w);
  }
  Vec3 best = nearest_in_segment(p, a, b);
  for (const Vec3& x : {nearest_in_segment(p, b, c), nearest_in_segment(p, c, a)})
    if ((x - p).squaredNorm() < (best - p).squaredNorm()) best = x;
  return best;
}

ClosedMesh::ClosedMesh(const TriangleMesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  build(0, static_cast<int>(order_.size()));
}

int ClosedMesh::build(int first, int last) {
  const int number = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Aabb box;
  for (int i = first; i < last; ++i)
    for (std::size_t k = 0; k < 3; ++k) box.extend(corner(mesh_, order_[static_cast<std::size_t>(i)], k));
  Node node{box, -1, -1, first, last};
  if (last - first > leaf_size) {
    Eigen::Index axis = 0;
    (box.hi - box.lo).maxCoeff(&axis);
    const auto centre = [&](int t) {
      return corner(mesh_, t, 0)[axis] + corner(mesh_, t, 1)[axis] + corner(mesh_, t, 2)[axis];
    };
    const int middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](int x, int y) { return centre(x) < centre(y); });
    node.left = build(first, middle);
    node.right = build(middle, last);
  }
  nodes_[static_cast<std::size_t>(number)] = node;
  return number;
}

double ClosedMesh::distance(const Vec3& p, int t) const {
  return (p - nearest_in_triangle(p, corner(mesh_, t, 0), corner(mesh_, t, 1), corner(mesh_, t, 2))).norm();
}

void ClosedMesh::search(int number, const Vec3& p, Nearest& best) const {
  const Node& node = nodes_[static_cast<std::size_t>(number)];
  if (distance_from(node.box, p) >= best.distance) return;
  if (node.left < 0) {
    for (int i = node.first; i < node.last; ++i) {
      const int t = order_[static_cast<std::size_t>(i)];
      const double d = distance(p, t);
      if (d < best.distance) best = {d, t};
    }
    return;
  }
  int near = node.left, far = node.right;
  if (distance_from(nodes_[static_cast<std::size_t>(far)].box, p) <
      distance_from(nodes_[static_cast<std::size_t>(near)].box, p))
    std::swap(near, far);
  search(near, p, best);
  search(far, p, best);
}

ClosedMesh::Nearest ClosedMesh::nearest(const Vec3& p) const {
  Nearest best{std::numeric_limits<double>::infinity(), 0};
  search(0, p, best);
  return best;
}

std::optional<double> ClosedMesh::clearance(const std::array<Vec3, 4>& t, double slack) const {
  Aabb box;
  for (const Vec3& v : t) box.extend(v);
  double width = std::numeric_limits<double>::infinity();
  return clears(0, box, t, slack, width) ? std::optional(width) : std::nullopt;
}

bool ClosedMesh::clears(int number, const Aabb& box, const std::array<Vec3, 4>& t, double slack,
                        double& width) const {
  const Node& node = nodes_[static_cast<std::size_t>(number)];
  if (!overlaps(node.box, box)) return true;
  if (node.left >= 0)
    return clears(node.left, box, t, slack, width) && clears(node.right, box, t, slack, width);
  for (int i = node.first; i < node.last; ++i) {
    const int f = order_[static_cast<std::size_t>(i)];
    const double w =
        separated_width(t, {corner(mesh_, f, 0), corner(mesh_, f, 1), corner(mesh_, f, 2)}, slack);
    if (w <= 0) return false;
    width = std::min(width, w);
  }
  return true;
}

bool ClosedMesh::is_inside(const Vec3& p) const {
  double half_angle = 0;
  for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) {
    const Vec3 a = corner(mesh_, t, 0) - p, b = corner(mesh_, t, 1) - p, c = corner(mesh_, t, 2) - p;
    const double x = a.norm(), y = b.norm(), z = c.norm();
    half_angle += std::atan2(a.dot(b.cross(c)), x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y);
  }
  const double winding = half_angle / (2 * std::numbers::pi);
  return std::abs(winding) > 0.5;
}

}  // namespace touchstone::fuzz
