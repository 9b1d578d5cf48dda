#include "core/narrow/mesh_tree.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace touchstone {
namespace {

constexpr std::int32_t leaf_size = 4;

using Triangle = std::array<Vec3, 3>;

struct Builder {
  const TriangleMesh& mesh;
  MeshTree& tree;
  std::vector<Vec3> lo, hi;

  explicit Builder(const TriangleMesh& m, MeshTree& t) : mesh(m), tree(t) {
    for (const auto& k : m.triangles) {
      const auto corner = [&](std::size_t i) -> const Vec3& {
        return m.vertices[static_cast<std::size_t>(k[i])];
      };
      lo.push_back(corner(0).cwiseMin(corner(1)).cwiseMin(corner(2)));
      hi.push_back(corner(0).cwiseMax(corner(1)).cwiseMax(corner(2)));
    }
  }

  // Halves each term first, so that no sum overflows.
  Vec3 centre(std::int32_t t) const {
    const auto i = static_cast<std::size_t>(t);
    return lo[i] / 2 + hi[i] / 2;
  }

  Triangle corners_of(std::int32_t t) const {
    const auto& k = mesh.triangles[static_cast<std::size_t>(t)];
    return {mesh.vertices[static_cast<std::size_t>(k[0])], mesh.vertices[static_cast<std::size_t>(k[1])],
            mesh.vertices[static_cast<std::size_t>(k[2])]};
  }

  // The axes of least and greatest spread of the triangles' corners (Gottschalk, Lin, Manocha 1996), which
  // count once for each triangle; any axes would do.
  Mat3 axes_of(std::span<const std::int32_t> triangles, const Vec3& origin, double unit) const {
    Vec3 sum = Vec3::Zero();
    Mat3 squares = Mat3::Zero();
    for (const std::int32_t t : triangles)
      for (const Vec3& v : corners_of(t)) {
        const Vec3 p = (v - origin) / unit;
        sum += p;
        squares += p * p.transpose();
      }
    const double n = 3 * static_cast<double>(triangles.size());
    Eigen::SelfAdjointEigenSolver<Mat3> solver;
    solver.compute(Mat3(squares / n - (sum / n) * (sum / n).transpose()));
    return solver.info() == Eigen::Success ? Mat3(solver.eigenvectors()) : Mat3(Mat3::Identity());
  }

  OrientedBox oriented_box(std::span<const std::int32_t> triangles) const {
    const Vec3 origin = centre(triangles.front());
    double unit = 0;
    for (const std::int32_t t : triangles)
      for (const Vec3& v : corners_of(t)) unit = std::max(unit, (v - origin).cwiseAbs().maxCoeff());
    OrientedBox box{Mat3::Identity(), Vec3::Zero(), Vec3::Zero()};
    if (unit > 0 && std::isfinite(unit)) box.axes = axes_of(triangles, origin, unit);
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const std::int32_t t : triangles)
      for (const Vec3& v : corners_of(t)) {
        const Vec3 p = box.axes.transpose() * (v - origin);
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    box.half = (high - low) / 2;
    box.centre = origin + box.axes * ((low + high) / 2);
    return box;
  }

  void fill(std::size_t node, std::int32_t first, std::int32_t count) {
    const auto begin = tree.order.begin() + first, end = begin + count;
    const auto front = static_cast<std::size_t>(*begin);
    Vec3 low = lo[front], high = hi[front], c_low = centre(*begin), c_high = c_low;
    for (auto i = begin; i != end; ++i) {
      const auto t = static_cast<std::size_t>(*i);
      low = low.cwiseMin(lo[t]);
      high = high.cwiseMax(hi[t]);
      c_low = c_low.cwiseMin(centre(*i));
      c_high = c_high.cwiseMax(centre(*i));
    }
    tree.nodes[node] = {low, high, first, count};
    if (tree.oriented.size() <= node) tree.oriented.resize(tree.nodes.size());
    tree.oriented[node] = oriented_box(
        std::span(tree.order).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count)));
    if (count <= leaf_size) return;
    int axis = 0;
    (c_high - c_low).maxCoeff(&axis);
    const std::int32_t half = count / 2;
    std::nth_element(begin, begin + half, end, [&](std::int32_t x, std::int32_t y) {
      const double cx = centre(x)[axis], cy = centre(y)[axis];
      return cx != cy ? cx < cy : x < y;
    });
    const auto children = static_cast<std::int32_t>(tree.nodes.size());
    tree.nodes.resize(tree.nodes.size() + 2);
    tree.nodes[node].first = children;
    tree.nodes[node].count = 0;
    fill(static_cast<std::size_t>(children), first, half);
    fill(static_cast<std::size_t>(children) + 1, first + half, count - half);
  }
};

}  // namespace

MeshTree build_mesh_tree(const TriangleMesh& mesh) {
  MeshTree tree;
  tree.order.resize(mesh.triangles.size());
  std::iota(tree.order.begin(), tree.order.end(), 0);
  if (tree.order.empty()) return tree;
  tree.nodes.resize(1);
  Builder(mesh, tree).fill(0, 0, static_cast<std::int32_t>(tree.order.size()));
  return tree;
}

}  // namespace touchstone
