// First contact of a moving convex body and a mesh at rest: the earliest over its triangles. The tree's boxes
// are tested against the ball about the body's origin that contains it at any rotation; boxes that the ball
// enters never, or later than the earliest contact so far, are skipped.
#include <cmath>

#include "core/impact/pair.h"
#include "core/impact/pursue.h"
#include "core/narrow/mesh.h"

namespace touchstone::impact {
namespace {

constexpr double never = 2;
// In units of the coordinates; covers the rounding of the ball's path and of a box's slabs.
constexpr double slab_rounding = 0x1p-40;

class Query {
 public:
  /// `frame`: the mesh's pose relative to A's start, which witness points are relative to as well.
  Query(const MovingShape& a, const TriangleMesh& mesh, const WideFrame& frame, double accuracy)
      : shape_(a), mesh_(mesh), frame_(frame), accuracy_(accuracy) {
    const WideMat rotation = filtered::rotation_of(a.pose.rotation);
    mover_ = filtered::make_mover(a, rotation, a.motion);
    const Mat3 to_mesh = frame.rotation.cast<double>().transpose();
    from_ = -(to_mesh * frame.translation.cast<double>());
    path_ = to_mesh * a.motion.linear;
    const double ball = mover_.body.reach + mover_.body.radius;
    ball_ = ball + slab_rounding * (ball + from_.norm() + path_.norm());
    best_.clear_until = 1;
  }

  ImpactAnswer run(const MeshTree* tree) {
    if (tree) {
      if (!tree->nodes.empty()) descend(*tree, 0);
    } else {
      for (std::size_t i = 0; i < mesh_.triangles.size() && !done_; ++i) test_triangle(i);
    }
    return best_;
  }

 private:
  // Earliest time at which the ball may touch the box; `never` if it does not during the step.
  double entry(const Vec3& lo, const Vec3& hi) const {
    double in = 0, out = 1;
    const double wide = ball_ + slab_rounding * std::max(lo.cwiseAbs().maxCoeff(), hi.cwiseAbs().maxCoeff());
    for (int k = 0; k < 3; ++k) {
      const double below = lo[k] - wide - from_[k], above = hi[k] + wide - from_[k], v = path_[k];
      if (v == 0) {
        if (below > 0 || above < 0) return never;
        continue;
      }
      const double first = below / v, last = above / v;
      in = std::max(in, std::min(first, last));
      out = std::min(out, std::max(first, last));
    }
    return in > out + slab_rounding ? never : std::max(0.0, in - slab_rounding);
  }

  double end() const { return best_.toi.value_or(1); }

  void descend(const MeshTree& tree, std::int32_t node) {
    const MeshTree::Node& n = tree.nodes[static_cast<std::size_t>(node)];
    if (n.count > 0) {
      for (std::int32_t i = n.first; i < n.first + n.count && !done_; ++i)
        test_triangle(static_cast<std::size_t>(tree.order[static_cast<std::size_t>(i)]));
      return;
    }
    const auto time = [&](std::int32_t child) {
      const MeshTree::Node& c = tree.nodes[static_cast<std::size_t>(child)];
      return entry(c.lo, c.hi);
    };
    const double t[2] = {time(n.first), time(n.first + 1)};
    const int second = t[1] < t[0];
    for (const int k : {second, 1 - second})
      if (!done_ && t[k] <= end()) descend(tree, n.first + k);
  }

  void test_triangle(std::size_t triangle) {
    const auto corners = narrow::corners(mesh_, triangle);
    const Vec3 lo = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
    const Vec3 hi = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
    if (entry(lo, hi) > end()) return;
    const filtered::Mover face = filtered::make_points(corners, frame_.rotation);
    const filtered::Sweep sweep(mover_, face, frame_.translation);
    const auto search_from = [&](double t) { return search(sweep, t, end(), accuracy_, {}); };
    Pursuit p{search_from(0), {}};
    if (!settled(p.search)) {
      const MovingCore still = moving_core(narrow::vertices_core(corners, frame_), {});
      p = pursue(sweep, p.search, search_from, [&](double t, double leave) {
        return advance(core(), still, t, {end(), accuracy_, leave});
      });
    }
    if (p.search.end == filtered::SearchEnd::clear) return count(p.search.steps);
    take(settled(p.search) ? filtered::answer_of(p.search, shape_.motion.linear) : p.fine);
  }

  const MovingCore& core() {
    if (!core_)
      core_ = moving_core(narrow::make_core(shape_, {mover_.start_wide, WideVec::Zero()}), shape_.motion);
    return *core_;
  }

  void count(int steps) { best_.steps += steps; }

  void take(ImpactAnswer r) {
    r.steps += best_.steps;
    if (r.outcome != Outcome::answered) {
      best_ = r;
      done_ = true;
      return;
    }
    if (!r.toi || (best_.toi && *best_.toi <= *r.toi)) return count(r.steps - best_.steps);
    best_ = r;
    done_ = *r.toi == 0;
  }

  const MovingShape& shape_;
  const TriangleMesh& mesh_;
  const WideFrame& frame_;
  double accuracy_, ball_ = 0;
  filtered::Mover mover_;
  std::optional<MovingCore> core_;
  Vec3 from_, path_;  // start and displacement of A's origin, mesh frame
  ImpactAnswer best_;
  bool done_ = false;
};

}  // namespace

ImpactAnswer convex_mesh(const MovingShape& a, const MovingShape& b, ImpactDetail, const Row&) {
  WideFrame frame = wide_frame(b.pose);  // relative to A's start
  frame.translation -= a.pose.translation.cast<Wide>();
  const double accuracy = accuracy_of(std::max(scale_of(a, 0), scale_of(b, 0)));
  const ImpactAnswer r = Query(a, std::get<TriangleMesh>(*b.shape), frame, accuracy).run(b.tree());
  return shift_witnesses(r, a.pose.translation);
}

}  // namespace touchstone::impact
