#include "core/narrow/mesh_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/math/roundoff.h"
#include "core/narrow/filtered/query.h"
#include "core/narrow/mesh.h"
#include "core/tolerance.h"

namespace touchstone::narrow {
namespace {

// Lengths, in the scene's unit: the fourth power of one and its rounding are normal numbers in between.
constexpr double least_length = 0x1p-200, greatest_length = 0x1p+200;

// A box of B in A's frame.
OrientedBox moved(const OrientedBox& b, const MeshScene& s) {
  return {s.rotation * b.axes, s.rotation * b.centre + s.offset, b.half};
}

// Two boxes along the axes of either.
struct BoxPair {
  const OrientedBox &a, &b;
  Mat3 b_to_a, magnitude;
  Vec3 apart;  // of the centres, along the axes of A
  BoxPair(const OrientedBox& x, const OrientedBox& y)
      : a(x), b(y), b_to_a(x.axes.transpose() * y.axes), magnitude(b_to_a.cwiseAbs()) {
    apart = x.axes.transpose() * (y.centre - x.centre);
  }

  // A lower bound of the squared distance.
  double distance_sq() const {
    const Vec3 by_a = (apart.cwiseAbs() - a.half - magnitude * b.half).cwiseMax(0);
    const Vec3 by_b =
        ((b_to_a.transpose() * apart).cwiseAbs() - b.half - magnitude.transpose() * a.half).cwiseMax(0);
    return std::max(by_a.squaredNorm(), by_b.squaredNorm());
  }

  // More than `far` apart along a product of their axes, whose length is at most 1.
  bool crossed_axes_separate(double far) const {
    for (int i = 0; i < 3; ++i) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
      for (int j = 0; j < 3; ++j) {
        const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
        const double reach = a.half[i1] * magnitude(i2, j) + a.half[i2] * magnitude(i1, j) +
                             b.half[j1] * magnitude(i, j2) + b.half[j2] * magnitude(i, j1);
        if (std::abs(apart[i2] * b_to_a(i1, j) - apart[i1] * b_to_a(i2, j)) > reach + far) return true;
      }
    }
    return false;
  }
};

class Descent {
 public:
  Descent(const MeshScene& scene, PairsWanted wanted, double keep, TrianglePairs& out)
      : s_(scene), wanted_(wanted), keep_(keep), out_(out) {
    box_slack_ = tolerance::box_rounding * scene.size();
    least_ = wanted == PairsWanted::nearest ? infinity : 0;
  }

  void run() {
    if (!s_.tree_a->nodes.empty() && !s_.tree_b->nodes.empty()) descend(0, 0, box_b(0));
    finish();
  }

 private:
  // Pairs with a gap above this do not matter.
  double enough() const { return wanted_ == PairsWanted::nearest ? std::max(least_, 0.0) + keep_ : keep_; }

  const OrientedBox& box_a(std::int32_t node) const {
    return s_.tree_a->oriented[static_cast<std::size_t>(node)];
  }
  OrientedBox box_b(std::int32_t node) const {
    return moved(s_.tree_b->oriented[static_cast<std::size_t>(node)], s_);
  }

  bool out_of_reach(double box_sq) const {
    const double far = enough() * (1 + tolerance::box_rounding) + box_slack_;
    return box_sq > (far > 0 ? far * far : 0);
  }

  bool is_apart(const OrientedBox& a, const OrientedBox& b, double& sq) const {
    const BoxPair p(a, b);
    sq = p.distance_sq();
    return out_of_reach(sq) || (sq == 0 && p.crossed_axes_separate(std::max(enough(), 0.0) + box_slack_));
  }

  // The nearer child first. `box`: of B's node, in A's frame.
  void descend(std::int32_t a, std::int32_t b, const OrientedBox& box) {
    const MeshTree::Node& x = s_.tree_a->nodes[static_cast<std::size_t>(a)];
    const MeshTree::Node& y = s_.tree_b->nodes[static_cast<std::size_t>(b)];
    if (x.count > 0 && y.count > 0) return test_leaves(x, y);
    if (y.count > 0 || (x.count == 0 && box_a(a).half.squaredNorm() >= box.half.squaredNorm()))
      split_a(x.first, b, box);
    else
      split_b(a, y.first);
  }

  void split_a(std::int32_t first, std::int32_t b, const OrientedBox& box) {
    double sq[2];
    const bool apart[2] = {is_apart(box_a(first), box, sq[0]), is_apart(box_a(first + 1), box, sq[1])};
    const bool second =
        sq[1] < sq[0] || (sq[1] == sq[0] && centres_sq(first + 1, box) < centres_sq(first, box));
    for (const bool k : {second, !second})
      if (!apart[k] && !is_done() && !out_of_reach(sq[k])) descend(first + k, b, box);
  }

  void split_b(std::int32_t a, std::int32_t first) {
    const OrientedBox box[2] = {box_b(first), box_b(first + 1)};
    double sq[2];
    const bool apart[2] = {is_apart(box_a(a), box[0], sq[0]), is_apart(box_a(a), box[1], sq[1])};
    const bool second = sq[1] < sq[0] || (sq[1] == sq[0] && centres_sq(a, box[1]) < centres_sq(a, box[0]));
    for (const bool k : {second, !second})
      if (!apart[k] && !is_done() && !out_of_reach(sq[k])) descend(a, first + k, box[k]);
  }

  double centres_sq(std::int32_t a, const OrientedBox& b) const {
    return (box_a(a).centre - b.centre).squaredNorm();
  }
  bool is_done() const { return out_.certainly_meet && wanted_ == PairsWanted::verdict; }

  static constexpr std::size_t most = 8;  // triangles of a leaf, or more

  struct Leaf {
    std::array<Triangle, most> corner;
    std::array<double, most> lo, hi;  // along the direction tried first
    std::array<Vec3, most> low, high;
    std::size_t size = 0;
  };

  void add(Leaf& leaf, const Triangle& t) const {
    const std::size_t i = leaf.size++;
    const double x = hint_.dot(t[0]), y = hint_.dot(t[1]), z = hint_.dot(t[2]);
    leaf.corner[i] = t;
    leaf.lo[i] = std::min(std::min(x, y), z);
    leaf.hi[i] = std::max(std::max(x, y), z);
    leaf.low[i] = t[0].cwiseMin(t[1]).cwiseMin(t[2]);
    leaf.high[i] = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
  }

  void test_leaves(const MeshTree::Node& x, const MeshTree::Node& y) {
    for (std::int32_t i0 = 0; i0 < x.count; i0 += static_cast<std::int32_t>(most))
      for (std::int32_t j0 = 0; j0 < y.count; j0 += static_cast<std::int32_t>(most)) {
        Leaf a, b;
        for (std::int32_t i = i0; i < x.count && a.size < most; ++i)
          add(a, triangle_of_a(s_, at(*s_.tree_a, x, i)));
        for (std::int32_t j = j0; j < y.count && b.size < most; ++j)
          add(b, triangle_of_b(s_, at(*s_.tree_b, y, j)));
        for (std::size_t i = 0; i < a.size; ++i)
          for (std::size_t j = 0; j < b.size; ++j) {
            if (is_done()) return;
            if (are_far(a, i, b, j)) continue;
            test(at(*s_.tree_a, x, i0 + static_cast<std::int32_t>(i)), a.corner[i],
                 at(*s_.tree_b, y, j0 + static_cast<std::int32_t>(j)), b.corner[j]);
          }
      }
  }

  static std::int32_t at(const MeshTree& tree, const MeshTree::Node& leaf, std::int32_t i) {
    return tree.order[static_cast<std::size_t>(leaf.first + i)];
  }

  // The direction that separated the last pair separates most others.
  bool are_far(const Leaf& a, std::size_t i, const Leaf& b, std::size_t j) const {
    const double far = std::max(enough(), 0.0) + box_slack_;
    if (b.lo[j] - a.hi[i] > far) return true;
    const Vec3 apart = (b.low[j] - a.high[i]).cwiseMax(a.low[i] - b.high[j]).cwiseMax(0);
    return apart.squaredNorm() > far * far;
  }

  void test(std::int32_t i, const Triangle& a, std::int32_t j, const Triangle& b) {
    if (wanted_ == PairsWanted::nearest) return test_distance(i, a, j, b);
    const AxisGap g = gap_by_axes(a, b, enough());
    if (g.lo > enough()) {
      hint_ = g.normal;
      return;
    }
    if (wanted_ == PairsWanted::verdict && cross_certainly(a, b, s_.displacement)) {
      out_.certainly_meet = true;
      return;
    }
    out_.pairs.push_back({g.lo, infinity, i, j, a[0], b[0], Vec3::Zero()});
  }

  void test_distance(std::int32_t i, const Triangle& a, std::int32_t j, const Triangle& b) {
    const double limit = enough(), quick = gap_by_faces(a, b);
    if (quick > limit) return;
    if (least_ <= 0) return keep_deep(i, a, j, b);
    const TriangleGap g = triangle_gap(a, b, limit);
    if (g.lo > limit) {
      hint_ = g.normal;
      return;
    }
    out_.pairs.push_back({g.lo, g.hi, i, j, g.a, g.b, g.normal});
    if (g.lo <= 0 && cross_certainly(a, b, s_.displacement)) least_ = 0;
    if (g.hi >= least_) return;
    least_ = g.hi;
    if (g.lo > 0) hint_ = g.normal;
  }

  // Once triangles are known to meet, only the depth of others that do counts.
  void keep_deep(std::int32_t i, const Triangle& a, std::int32_t j, const Triangle& b) {
    const double lo = gap_by_axes(a, b, enough()).lo;
    if (lo <= enough()) out_.pairs.push_back({lo, infinity, i, j, a[0], b[0], Vec3::Zero()});
  }

  void finish() {
    std::vector<TrianglePair>& p = out_.pairs;
    const double limit = enough();
    std::erase_if(p, [&](const TrianglePair& x) { return x.lo > limit && x.hi > least_; });
    std::sort(p.begin(), p.end(), [](const TrianglePair& x, const TrianglePair& y) {
      return std::tie(x.lo, x.a, x.b) < std::tie(y.lo, y.a, y.b);
    });
    out_.lo = p.empty() ? limit : std::min(limit, p.front().lo);
  }

  const MeshScene& s_;
  PairsWanted wanted_;
  double keep_;
  TrianglePairs& out_;
  Vec3 hint_ = Vec3::Zero();  // a direction of length 1 that separated triangles, or zero
  double box_slack_ = 0;
  double least_ = 0;  // an upper bound of the least gap
};

}  // namespace

Triangle triangle_of_a(const MeshScene& s, std::int32_t triangle) {
  return corners(s.a, static_cast<std::size_t>(triangle));
}

Triangle triangle_of_b(const MeshScene& s, std::int32_t triangle) {
  Triangle t = corners(s.b, static_cast<std::size_t>(triangle));
  for (Vec3& p : t) p = Vec3(s.rotation * p + s.offset);
  return t;
}

TrianglePairs triangle_pairs(const MeshScene& scene, PairsWanted wanted, double keep) {
  TrianglePairs r;
  Descent(scene, wanted, keep, r).run();
  return r;
}

MeshScene::MeshScene(const ShapeRef& mesh_a, const ShapeRef& mesh_b, const Mat3& b_to_a, const Vec3& of_b)
    : tree_a(mesh_a),
      tree_b(mesh_b),
      a(*std::get_if<TriangleMesh>(mesh_a.shape)),
      b(*std::get_if<TriangleMesh>(mesh_b.shape)),
      rotation(b_to_a),
      offset(of_b),
      reach_a(mesh_a.bounding_radius()),
      reach_b(mesh_b.bounding_radius()),
      displacement(filtered::displacement_of(reach_a, reach_b, offset.norm())) {}

double MeshScene::largest_length() const {
  const double most = std::max({reach_a, reach_b, offset.cwiseAbs().sum()});
  return std::isfinite(reach_a + reach_b + offset.sum()) ? most : std::numeric_limits<double>::max();
}

bool MeshScene::in_range() const {
  return largest_length() > least_length && largest_length() < greatest_length;
}

TreeOf::TreeOf(const ShapeRef& mesh) : tree_(mesh.tree()) {
  if (tree_) return;
  own_ = build_mesh_tree(*std::get_if<TriangleMesh>(mesh.shape));
  tree_ = &own_;
}

}  // namespace touchstone::narrow
