// Two meshes in double. The trees leave the pairs of triangles that can decide the query, with proven bounds;
// what those bounds leave open is asked of each pair as a pair of hulls. Definition as in core/narrow/mesh.h.
#include <algorithm>

#include "core/narrow/filtered/separate.h"
#include "core/narrow/mesh.h"
#include "core/narrow/mesh_pairs.h"

namespace touchstone::narrow::filtered {
namespace {

// Pairs of triangles that would improve the distance by at most this, in u of the size, are not followed:
// about the rounding of the computed corners.
constexpr double tie = 8;

double largest_coordinate(const MeshTree& t) {
  if (t.nodes.empty()) return 0;
  return std::max(t.nodes.front().lo.cwiseAbs().maxCoeff(), t.nodes.front().hi.cwiseAbs().maxCoeff());
}

class MeshesQuery {
 public:
  MeshesQuery(const PlacedShape& a, const PlacedShape& b, Answer<double>& best, PairScene<double>& s)
      : a_(rounded_pose<double>(a.pose)),
        b_(rounded_pose<double>(b.pose)),
        best_(best),
        s_(s),
        m_(a, b, (s.at = relative(a_, b_)).b_to_a, s.at.offset) {
    s.contact = ContactForm::point;
    scale_ = std::max({largest_coordinate(*m_.tree_a), largest_coordinate(*m_.tree_b),
                       a_.t.cwiseAbs().maxCoeff(), b_.t.cwiseAbs().maxCoeff()});
  }

  void run(Asked asked) {
    if (!m_.in_range()) return;
    if (m_.tree_a->nodes.empty() || m_.tree_b->nodes.empty()) return;
    if (asked == Asked::overlap) return verdict();
    if (asked == Asked::contact)
      return deepest(triangle_pairs(m_, PairsWanted::meeting, m_.displacement), asked);
    const double slack = tie * u<double> * m_.size();
    const TrianglePairs found = triangle_pairs(m_, PairsWanted::nearest, -slack);
    if (!take_nearest(found)) deepest(found, asked);
    best_.bound += slack;
  }

 private:
  void verdict() {
    const TrianglePairs found = triangle_pairs(m_, PairsWanted::verdict, m_.displacement);
    best_.bound = m_.displacement;
    best_.found = found.certainly_meet ? Found::meeting : Found::apart;
    if (found.certainly_meet) return;
    for (const TrianglePair& p : found.pairs) {
      const Answer<double> r = ask(p, Asked::overlap, 0);
      best_.bound = std::max(best_.bound, r.bound);
      if (r.found == Found::meeting) {
        best_.found = Found::meeting;
        return;
      }
      if (r.found != Found::apart) best_.found = Found::unsure;
    }
  }

  // The nearest pair by the bounds that came with it, if they are narrow enough and the meshes are apart.
  bool take_nearest(const TrianglePairs& found) {
    const auto p = std::min_element(found.pairs.begin(), found.pairs.end(),
                                    [](const TrianglePair& x, const TrianglePair& y) { return x.hi < y.hi; });
    if (p == found.pairs.end() || !std::isfinite(p->hi)) return false;
    const double bound = m_.displacement + (p->hi - found.lo);
    if (!(found.lo > m_.displacement) || !accepted(bound, scale_)) return false;
    best_.found = Found::apart;
    best_.gap = (p->hi + found.lo) / 2;
    best_.bound = bound;
    best_.normal = s_.at.a_to_world * p->normal;
    best_.a = s_.at.a_to_world * p->point_a;
    best_.b = s_.at.a_to_world * p->point_b;
    return true;
  }

  // Of the pairs that meet the deepest, else the nearest.
  void deepest(const TrianglePairs& found, Asked asked) {
    best_.found = asked == Asked::contact ? Found::apart : Found::unsure;
    best_.gap = std::numeric_limits<double>::infinity();
    best_.bound = m_.displacement;
    double bound = m_.displacement;
    for (const TrianglePair& p : found.pairs) {
      if (p.lo - m_.displacement > best_.gap) break;
      const Answer<double> r = ask(p, asked, best_.gap);
      if (r.found == Found::unsure) {
        best_.found = Found::unsure;
        return;
      }
      // Apart without a value: farther than the best, or irrelevant to contacts.
      if (r.found == Found::apart && !(asked == Asked::distance && r.valued)) continue;
      bound = std::max(bound, r.bound);
      if (r.gap < best_.gap) best_ = r;
    }
    best_.bound = std::max(best_.bound, bound);
  }

  Answer<double> ask(const TrianglePair& p, Asked asked, double enough) {
    corner_a_ = corners(m_.a, static_cast<std::size_t>(p.a));
    corner_b_ = corners(m_.b, static_cast<std::size_t>(p.b));
    s_.a = body_of_vertices<double>(corner_a_);
    s_.b = body_of_vertices<double>(corner_b_);
    s_.guess.setZero();
    Answer<double> r;
    separate_cores(a_, b_, asked, enough, r, s_);
    return r;
  }

  RoundedPose<double> a_, b_;
  Answer<double>& best_;
  PairScene<double>& s_;
  MeshScene m_;
  double scale_ = 0;
  Triangle corner_a_, corner_b_;
};

}  // namespace

template <class R>
void mesh_mesh(const PlacedShape& a, const PlacedShape& b, Asked asked, Answer<R>& r, PairScene<R>& s) {
  s.features = nullptr;  // they would be those of the last pair of triangles
  MeshesQuery(a, b, r, s).run(asked);
  // The triangles' corners no longer exist.
  s.a = s.b = {};
}

template void mesh_mesh(const PlacedShape&, const PlacedShape&, Asked, Answer<double>&, PairScene<double>&);

}  // namespace touchstone::narrow::filtered
