// A convex body against the triangles of a mesh, each a hull of three vertices, in the arithmetic R.
// Definition as in core/narrow/mesh.h: the nearest triangle, or the deepest of those that are hit. Boxes that
// the body's ball cannot reach are skipped safely: the ball is enlarged by more than the rounding of its
// centre. A single triangle that R cannot resolve makes the answer unsure.
#include <array>

#include "core/narrow/filtered/separate.h"
#include "core/narrow/mesh.h"
#include "core/narrow/mesh_tree.h"

namespace touchstone::narrow::filtered {
namespace {

template <class R>
class MeshQuery {
 public:
  MeshQuery(const PlacedShape& a, const PlacedShape& b, Asked asked, Answer<R>& best, PairScene<R>& s)
      : mesh_(*std::get_if<TriangleMesh>(b.shape)),
        asked_(asked),
        a_(rounded_pose<R>(a.pose)),
        b_(rounded_pose<R>(b.pose)),
        best_(best),
        s_(s) {
    s.a = a.body<R>();
    s.at = relative(a_, b_);
    s.contact = ContactForm::point;
    const Vec3 d = a.pose.translation - b.pose.translation;
    centre_ = matrix(rounded_pose<double>(b.pose)).transpose() * d;
    const double ball = static_cast<double>(s.a.reach) + static_cast<double>(s.a.radius);
    ball_ = ball + 256 * static_cast<double>(u<R>) * (ball + d.norm() + a.pose.translation.norm());
    best_.found = Found::apart;
    best_.gap = std::numeric_limits<R>::infinity();
    best_.bound = 0;
  }

  void run(const MeshTree* tree) {
    if (tree) {
      if (!tree->nodes.empty()) descend(*tree, 0);
    } else {
      for (std::size_t i = 0; i < mesh_.triangles.size() && !done_; ++i) test_triangle(i);
    }
    best_.bound = std::max(best_.bound, bound_);
    const bool nothing = asked_ == Asked::distance && !(best_.gap < std::numeric_limits<R>::infinity());
    if (uncertain_ || nothing) best_.found = Found::unsure;
  }

 private:
  bool out_of_reach(const Vec3& lo, const Vec3& hi) const {
    const double gap = asked_ == Asked::distance ? std::max(0.0, static_cast<double>(best_.gap)) : 0;
    const double far =
        (ball_ + gap) * (1 + tolerance::box_rounding) + tolerance::box_rounding * centre_.norm();
    return box_distance_sq(centre_, lo, hi) > far * far;
  }

  // Visits the nearer child first.
  void descend(const MeshTree& tree, std::int32_t node) {
    const MeshTree::Node& n = tree.nodes[static_cast<std::size_t>(node)];
    if (done_ || out_of_reach(n.lo, n.hi)) return;
    if (n.count > 0) {
      for (std::int32_t i = n.first; i < n.first + n.count && !done_; ++i)
        test_triangle(static_cast<std::size_t>(tree.order[static_cast<std::size_t>(i)]));
      return;
    }
    const auto far = [&](std::int32_t child) {
      const MeshTree::Node& c = tree.nodes[static_cast<std::size_t>(child)];
      return box_distance_sq(centre_, c.lo, c.hi);
    };
    const bool second = far(n.first + 1) < far(n.first);
    descend(tree, n.first + second);
    descend(tree, n.first + !second);
  }

  void test_triangle(std::size_t triangle) {
    corner_ = corners(mesh_, triangle);
    if (out_of_reach(corner_[0].cwiseMin(corner_[1]).cwiseMin(corner_[2]),
                     corner_[0].cwiseMax(corner_[1]).cwiseMax(corner_[2])))
      return;
    s_.b = body_of_vertices<R>(corner_);
    Answer<R> r;
    s_.guess.setZero();
    separate_cores(a_, b_, asked_, best_.gap, r, s_);
    take(r);
  }

  void take(const Answer<R>& r) {
    if (asked_ == Asked::overlap) {
      uncertain_ |= r.found == Found::unsure || r.found == Found::touching;
      bound_ = std::max(bound_, r.bound);
      if (r.found != Found::meeting) return;
      best_ = r;
      uncertain_ = false;
      done_ = true;
      return;
    }
    if (r.found == Found::unsure) {
      uncertain_ = done_ = true;
      return;
    }
    // Apart without a value: farther than the best, or irrelevant to contacts.
    const bool valued = r.found != Found::apart || (asked_ == Asked::distance && r.valued);
    if (!valued) return;
    bound_ = std::max(bound_, r.bound);
    if (r.gap < best_.gap) best_ = r;
  }

  const TriangleMesh& mesh_;
  Asked asked_;
  RoundedPose<R> a_, b_;
  Answer<R>& best_;
  PairScene<R>& s_;
  Vec3 centre_;  // of the body, in the mesh's frame
  double ball_;
  R bound_ = 0;
  std::array<Vec3, 3> corner_;
  bool uncertain_ = false, done_ = false;
};

}  // namespace

template <class R>
void convex_mesh(const PlacedShape& a, const PlacedShape& b, Asked asked, Answer<R>& r, PairScene<R>& s) {
  s.features = nullptr;  // they would be those of the last triangle
  MeshQuery<R>(a, b, asked, r, s).run(b.tree());
  // The triangle's corners no longer exist.
  s.b = {};
}

template void convex_mesh(const PlacedShape&, const PlacedShape&, Asked, Answer<double>&, PairScene<double>&);

}  // namespace touchstone::narrow::filtered
