// First contact of two bodies of which one or both are meshes that move: the earliest over the pairs of their
// parts, triangles or a whole convex body. Both trees are descended together; a pair of boxes has an entry
// time, before which its parts certainly do not meet, and is skipped if that is never, or later than the
// earliest contact so far.
//
// Entry times by conservative advancement (Mirtich 1996; for trees of boxes Tang, Kim, Manocha 2009): along a
// direction n that is fixed in the world, the separation of two boxes shrinks at most at the rate at which
// their origins approach along n, plus |ω| times the reach of each box about its body's origin. Of bodies
// that do not turn this is exact along each n.
#include <algorithm>
#include <cmath>

#include "core/impact/pair.h"
#include "core/impact/pursue.h"
#include "core/narrow/convex_pair.h"
#include "core/narrow/mesh.h"

namespace touchstone::impact {
namespace {

constexpr double never = 2;
// Of all lengths of the pair: covers the rounding of boxes, their places and the separations along axes.
constexpr double box_rounding = 0x1p-40;

// A box of a body in the body's frame, its axes' columns.
struct PartBox {
  Mat3 axes;
  Vec3 centre, half;
  double reach() const { return centre.norm() + half.norm(); }
};

// A body as a tree over its parts.
class Parts {
 public:
  explicit Parts(const MovingShape& s, const WideFrame& frame) : s_(s), frame_(frame) {
    mesh_ = std::get_if<TriangleMesh>(s.shape);
    if (!mesh_) {
      mover_ = filtered::make_mover(s, frame.rotation, s.motion);
      return;
    }
    tree_ = s.tree();
    if (tree_) return;
    own_ = build_mesh_tree(*mesh_);
    tree_ = &own_;
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  bool is_empty() const { return mesh_ && tree_->nodes.empty(); }
  const MovingShape& shape() const { return s_; }
  double reach() const { return mesh_ ? s_.bounding_radius() : mover_->body.reach + mover_->body.radius; }
  // Not more than the largest coordinate of a point of the body.
  double extent() const {
    if (!mesh_) return mover_->body.extent;
    const MeshTree::Node& root = tree_->nodes[0];
    return std::max(root.lo.cwiseAbs().maxCoeff(), root.hi.cwiseAbs().maxCoeff());
  }

  bool is_leaf(std::int32_t node) const { return !mesh_ || at(node).count > 0; }
  std::int32_t first_child(std::int32_t node) const { return at(node).first; }
  std::int32_t part_count(std::int32_t leaf) const { return mesh_ ? at(leaf).count : 1; }
  std::size_t part(std::int32_t leaf, std::int32_t i) const {
    if (!mesh_) return 0;
    return static_cast<std::size_t>(tree_->order[static_cast<std::size_t>(at(leaf).first + i)]);
  }

  PartBox box(std::int32_t node) const {
    if (!mesh_) return whole();
    const OrientedBox& b = tree_->oriented[static_cast<std::size_t>(node)];
    return {b.axes, b.centre, b.half};
  }
  PartBox part_box(std::size_t part) const {
    if (!mesh_) return whole();
    const auto c = narrow::corners(*mesh_, part);
    const Vec3 lo = c[0].cwiseMin(c[1]).cwiseMin(c[2]), hi = c[0].cwiseMax(c[1]).cwiseMax(c[2]);
    return {Mat3::Identity(), (lo + hi) / 2, (hi - lo) / 2};
  }

  // A part as the searches take it; the corners must outlive both.
  std::array<Vec3, 3> corners(std::size_t part) const {
    return mesh_ ? narrow::corners(*mesh_, part) : std::array<Vec3, 3>{};
  }
  filtered::Mover mover(const std::array<Vec3, 3>& corners) const {
    return mesh_ ? filtered::make_points(corners, frame_.rotation, s_.motion) : *mover_;
  }
  MovingCore core(const std::array<Vec3, 3>& corners) const {
    return moving_core(mesh_ ? narrow::vertices_core(corners, frame_) : narrow::make_core(s_, frame_),
                       s_.motion);
  }

 private:
  const MeshTree::Node& at(std::int32_t node) const { return tree_->nodes[static_cast<std::size_t>(node)]; }
  PartBox whole() const { return {Mat3::Identity(), Vec3::Zero(), Vec3::Constant(reach())}; }

  const MovingShape& s_;
  const WideFrame& frame_;
  const TriangleMesh* mesh_ = nullptr;
  const MeshTree* tree_ = nullptr;
  MeshTree own_;
  std::optional<filtered::Mover> mover_;  // of a convex body
};

class Query {
 public:
  /// Frames are relative to A's start, which witness points are relative to as well.
  Query(const Parts& a, const Parts& b, const WideVec& offset)
      : a_(a), b_(b), offset_wide_(offset), offset_(offset.cast<double>()) {
    const Motion &ma = a.shape().motion, &mb = b.shape().motion;
    velocity_ = mb.linear - ma.linear;
    accuracy_ = accuracy_of(std::max(scale_of(a.shape(), a.extent()), scale_of(b.shape(), b.extent())));
    slack_ = box_rounding * (a.reach() + b.reach() + offset_.norm() + ma.linear.norm() + mb.linear.norm());
    turn_a_ = ma.angular.norm();
    turn_b_ = mb.angular.norm();
    start_a_ = rotation_matrix(a.shape().pose.rotation);
    start_b_ = rotation_matrix(b.shape().pose.rotation);
    best_.clear_until = 1;
  }

  ImpactAnswer run() {
    const double t = entry(a_.box(0), b_.box(0), 0);
    if (t <= end()) descend(0, 0, t);
    return best_;
  }

 private:
  static constexpr int most_advances = 8;          // of one pair of boxes; its children go on from there
  static constexpr double least_advance = 0x1p-8;  // of the step; less is left to the children

  double end() const { return best_.toi.value_or(1); }

  static Mat3 turned(const Motion& m, double speed, const Mat3& start, double t) {
    if (speed == 0 || t == 0) return start;
    return Eigen::AngleAxisd(speed * t, m.angular / speed) * start;
  }

  // From t on, before which they do not meet, the earliest time at which they may; `never` if that is not
  // during the step.
  double entry(const PartBox& a, const PartBox& b, double t) const {
    const double spin = turn_a_ * a.reach() + turn_b_ * b.reach();
    for (int i = 0; i < most_advances; ++i) {
      const double next = t + advance_from(t, a, b, spin);
      if (next > 1) return never;
      const bool is_slow = next - t < least_advance;
      t = next;
      if (is_slow) break;
    }
    return t;
  }

  // How long the separation along the best of some axes lasts.
  double advance_from(double t, const PartBox& a, const PartBox& b, double spin) const {
    const Mat3 ra = turned(a_.shape().motion, turn_a_, start_a_, t),
               rb = turned(b_.shape().motion, turn_b_, start_b_, t);
    const Mat3 xa = ra * a.axes, xb = rb * b.axes;
    const Vec3 d = offset_ + t * velocity_ + rb * b.centre - ra * a.centre;
    double longest = 0;
    const auto try_axis = [&](Vec3 n) {
      if (n.dot(d) < 0) n = -n;
      const double apart = n.dot(d) - (xa.transpose() * n).cwiseAbs().dot(a.half) -
                           (xb.transpose() * n).cwiseAbs().dot(b.half) - slack_;
      if (!(apart > 0)) return;
      const double rate = std::max(0.0, -n.dot(velocity_)) + spin;
      longest = std::max(longest, rate * never > apart ? apart / rate * (1 - box_rounding) : never);
    };
    for (int k = 0; k < 3; ++k) {
      try_axis(xa.col(k));
      try_axis(xb.col(k));
    }
    if (const double length = d.norm(); length > 0) try_axis(d / length);
    return longest;
  }

  void descend(std::int32_t a, std::int32_t b, double t) {
    const bool leaf_a = a_.is_leaf(a), leaf_b = b_.is_leaf(b);
    if (leaf_a && leaf_b) return test_leaves(a, b, t);
    const PartBox box_a = a_.box(a), box_b = b_.box(b);
    const bool splits_a = leaf_b || (!leaf_a && box_a.half.squaredNorm() >= box_b.half.squaredNorm());
    const std::int32_t first = splits_a ? a_.first_child(a) : b_.first_child(b);
    double time[2];
    for (std::int32_t k = 0; k < 2; ++k)
      time[k] = splits_a ? entry(a_.box(first + k), box_b, t) : entry(box_a, b_.box(first + k), t);
    const std::int32_t sooner = time[1] < time[0];
    for (const std::int32_t k : {sooner, 1 - sooner})
      if (!done_ && time[k] <= end()) descend(splits_a ? first + k : a, splits_a ? b : first + k, time[k]);
  }

  void test_leaves(std::int32_t a, std::int32_t b, double t) {
    for (std::int32_t i = 0; i < a_.part_count(a); ++i)
      for (std::int32_t j = 0; j < b_.part_count(b) && !done_; ++j)
        test_parts(a_.part(a, i), b_.part(b, j), t);
  }

  void test_parts(std::size_t a, std::size_t b, double t) {
    const double from = entry(a_.part_box(a), b_.part_box(b), t);
    if (from > end()) return;
    const auto corners_a = a_.corners(a), corners_b = b_.corners(b);
    const filtered::Mover ma = a_.mover(corners_a), mb = b_.mover(corners_b);
    const filtered::Sweep sweep(ma, mb, offset_wide_);
    const auto search_from = [&](double start) { return search(sweep, start, end(), accuracy_, {}); };
    Pursuit p{search_from(from), {}};
    if (!settled(p.search)) {
      const MovingCore ca = a_.core(corners_a), cb = b_.core(corners_b);
      p = pursue(sweep, p.search, search_from, [&](double start, double leave) {
        return advance(ca, cb, start, {end(), accuracy_, leave});
      });
    }
    if (p.search.end == filtered::SearchEnd::clear) {
      best_.steps += p.search.steps;
      return;
    }
    if (!settled(p.search)) return take(p.fine);
    ImpactAnswer r = filtered::answer_of(p.search, a_.shape().motion.linear);
    if (p.search.rough) refine(r, a_.core(corners_a), b_.core(corners_b));
    take(r);
  }

  // The nearest points in extended precision, where double has found the time but no accurate points.
  static void refine(ImpactAnswer& r, const MovingCore& a, const MovingCore& b) {
    const Separation x =
        narrow::separate_convex(at_time(a, *r.toi, WideVec::Zero()), at_time(b, *r.toi, WideVec::Zero()));
    if (x.outcome != Outcome::answered) return;
    r.normal_ab = x.normal.cast<double>();
    r.witness_w = {Vec3(x.a.cast<double>()), Vec3(x.b.cast<double>())};
  }

  void take(ImpactAnswer r) {
    r.steps += best_.steps;
    const bool answered = r.outcome == Outcome::answered;
    if (answered && (!r.toi || (best_.toi && *best_.toi <= *r.toi))) {
      best_.steps = r.steps;
      return;
    }
    best_ = r;
    done_ = !answered || *r.toi == 0;
  }

  const Parts &a_, &b_;
  WideVec offset_wide_;
  Vec3 offset_, velocity_;  // of B's origin from A's
  Mat3 start_a_, start_b_;
  double turn_a_ = 0, turn_b_ = 0, accuracy_ = 0, slack_ = 0;
  ImpactAnswer best_;
  bool done_ = false;
};

// The vertices that belong to a triangle. A half-space meets the mesh where it meets one of them.
std::vector<Vec3> used_vertices(const TriangleMesh& mesh) {
  std::vector<char> is_used(mesh.vertices.size(), 0);
  for (const auto& t : mesh.triangles)
    for (const int v : t) is_used[static_cast<std::size_t>(v)] = 1;
  std::vector<Vec3> used;
  for (std::size_t i = 0; i < is_used.size(); ++i)
    if (is_used[i]) used.push_back(mesh.vertices[i]);
  return used;
}

}  // namespace

ImpactAnswer moving_parts(const MovingShape& a, const MovingShape& b, ImpactDetail detail, const Row&) {
  if (const auto met = contact_at_start(a, b, detail)) return *met;
  const WideVec origin = a.pose.translation.cast<Wide>();
  const WideFrame fa{filtered::rotation_of(a.pose.rotation), WideVec::Zero()};
  const WideFrame fb{filtered::rotation_of(b.pose.rotation), b.pose.translation.cast<Wide>() - origin};
  const Parts parts_a(a, fa), parts_b(b, fb);
  if (parts_a.is_empty() || parts_b.is_empty()) {
    ImpactAnswer nothing;
    nothing.clear_until = 1;
    return nothing;
  }
  return shift_witnesses(Query(parts_a, parts_b, fb.translation).run(), a.pose.translation);
}

ImpactAnswer mesh_half_space(const MovingShape& a, const MovingShape& b, ImpactDetail detail, const Row&) {
  if (const auto met = contact_at_start(a, b, detail)) return *met;
  const std::vector<Vec3> vertices = used_vertices(*std::get_if<TriangleMesh>(a.shape));
  ImpactAnswer nothing;
  nothing.clear_until = 1;
  if (vertices.empty()) return nothing;
  const WideVec origin = a.pose.translation.cast<Wide>();
  const WideFrame fa{filtered::rotation_of(a.pose.rotation), WideVec::Zero()};
  WideFrame fb = wide_frame(b.pose);
  fb.translation -= origin;
  const narrow::WidePlane plane = narrow::place(*std::get_if<HalfSpace>(b.shape), fb);
  const filtered::Mover points = filtered::make_points(vertices, fa.rotation, a.motion);
  filtered::Mover face;  // a point, which the sweep's offset leads to
  face.start_wide.setIdentity();
  face.start.setIdentity();
  const filtered::Sweep sweep(points, face, plane.normal * plane.offset);
  const Vec3 normal = -plane.normal.cast<double>();
  double extent = 0;
  for (const Vec3& v : vertices) extent = std::max(extent, v.cwiseAbs().maxCoeff());
  const double accuracy = accuracy_of(scale_of(a, extent));
  const auto search_from = [&](double t) { return search(sweep, t, 1, accuracy, normal); };
  const MovingCore core = moving_core(narrow::vertices_core(vertices, fa), a.motion);
  const Pursuit p = pursue(sweep, search_from(0), search_from, [&](double t, double leave) {
    return advance(core, plane, t, {1, accuracy, leave});
  });
  return shift_witnesses(settled(p.search) ? filtered::answer_of(p.search, a.motion.linear) : p.fine,
                         a.pose.translation);
}

}  // namespace touchstone::impact
