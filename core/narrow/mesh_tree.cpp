#include "core/narrow/mesh_tree.h"

#include <algorithm>
#include <numeric>

namespace touchstone {
namespace {

constexpr std::int32_t leaf_size = 4;

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
