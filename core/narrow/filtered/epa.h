// Penetration depth of two convex cores in the arithmetic R: the expanding polytope of core/narrow/polytope.h
// in fixed storage, with support points computed only when a facet is the nearest. Bounds: every direction
// tried is an upper bound. The surface is closed and consists of points of B − A, and each facet lies beyond
// the least height of its corners along its own normal, whatever the rounding of that normal, so the least of
// these heights is a lower bound. Full storage and a horizon that cannot be repaired are reported.
#pragma once

#include "core/narrow/filtered/gjk.h"
#include "core/narrow/polytope.h"
#include "core/narrow/start_tetrahedron.h"

namespace touchstone::narrow::filtered {

enum class ExpandEnd {
  closed,  // upper − lower <= tolerance
  flat,    // B − A has no interior within rounding
  full,    // storage exhausted: bounds valid but have not met
  broken   // the surface could not be repaired
};

template <class R>
struct Depth {
  ExpandEnd end = ExpandEnd::broken;
  R upper = std::numeric_limits<R>::infinity(), lower = 0;
  V3<R> outward = V3<R>::UnitX();              // unit; A to B is its opposite
  V3<R> a = V3<R>::Zero(), w = V3<R>::Zero();  // foot w of the origin, and its point of A
  bool on_facet = false;                       // `corner` is set:
  std::array<Vertex<R>, 3> corner;             // of the facet that contains the foot
  int vertices = 0;
};

template <class S>
struct ExpanderTypes {
  using R = S;
  using Index = short;
  using Facet = PolytopeFacet<R, Index>;
  struct Edge : PolytopeEdge<Index> {
    V3<R> n;  // of the triangle that it will make with the new point
    R key;
  };
  static constexpr int vertex_capacity = 160;
  template <class T, int n>
  using List = FixedList<T, n>;
};

template <class R>
class Expander : Polytope<Expander<R>, ExpanderTypes<R>> {
 public:
  static constexpr int vertex_capacity = ExpanderTypes<R>::vertex_capacity,
                       facet_capacity = 4 * vertex_capacity;
  /// From this many vertices on, three tolerances are enough: curved pairs close within about 50 vertices, or
  /// stagnate in rounding.
  static constexpr int patience = 64;

  Expander(const Difference<R>& d, R size, R tolerance)
      : d_(d),
        size_(size),
        tolerance_(tolerance),
        level_(rounding::height * u<R> * size),
        thin_(rounding::sliver_height * u<R> * size),
        next_try_(is_curved(d.a) || is_curved(d.b) ? 4 : vertex_capacity + 1) {}

  Depth<R> run(const Simplex<R>& start, bool encloses) {
    for (int i = 0; i < start.size; ++i) this->add_vertex(start.p[static_cast<std::size_t>(i)]);
    if (!complete(encloses)) {
      result_.end = ExpandEnd::flat;
      return result_;
    }
    if (!this->build()) return result_;
    for (;;) {
      int f = nearest();
      if (f >= 0 && vertex_count() >= next_try_) {
        next_try_ += try_step_;
        try_step_ *= settled_.found ? 2 : 1;
        if (settle(f)) f = nearest();
      }
      if (settled_.found && (f < 0 || rank_[f] >= settled_.lower)) return finish_settled();
      if (f < 0) return finish(ExpandEnd::broken, -1);
      result_.lower = rank_[f];
      if (result_.upper - result_.lower <= tolerance_) return finish(ExpandEnd::closed, f);
      const V3<R>& n = facet(f).n;
      const Vertex<R> s = probe(n);
      const R height = n.dot(s.w);
      if (result_.upper - result_.lower <= tolerance_) return finish(ExpandEnd::closed, f);
      if (!(height - key_[f] > level_)) return finish(ExpandEnd::broken, f);
      if (vertex_count() + 1 > vertex_capacity ||
          (vertex_count() > patience && result_.upper - result_.lower <= 3 * tolerance_))
        return finish(ExpandEnd::full, f);
      if (!this->expand(f, s)) return finish(ExpandEnd::broken, f);
    }
  }

 private:
  using Surface = Polytope<Expander<R>, ExpanderTypes<R>>;
  friend Surface;
  using Surface::facet;
  using Surface::facet_count;
  using Surface::on_a;
  using Surface::vertex_count;
  using Surface::w;
  using typename Surface::Edge;
  using typename Surface::Facet;
  static constexpr R infinite = std::numeric_limits<R>::infinity();

  Vertex<R> probe(const V3<R>& n) {
    const Vertex<R> s = d_.support(n);
    if (const R h = n.dot(s.w); h < result_.upper) {
      result_.upper = h;
      result_.outward = n;
    }
    return s;
  }

  // ---- a local minimum, and the cap of directions in which it is proven to be the least.
  //
  // The polytope need not prove anything inside the cap. By duality: the polar of the polytope, with vertices
  // n/key, must not leave the ball of radius 1/L outside the cap. A point of the polar that does leave it
  // lies between the ball and the hull of the vertices that do; if these are within half the cap's angle θ of
  // its axis and no farther out than 1/(L cos(θ/2)), the point is within θ of the axis.

  // Returns true if the ranks have changed.
  bool settle(int f) {
    const Foot<R> foot = foot_of(f);
    std::array<Vertex<R>, 3> corner;
    std::array<R, 3> weight{};
    for (std::size_t k = 0; k < 3; ++k) {
      const short v = facet(f).v[k];
      corner[k] = {w(v), on_a(v)};
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(foot.size); ++k)
      weight[static_cast<std::size_t>(foot.corner[k])] = foot.weight[k];
    LocalMinimum<R> at(d_, size_);
    const LocalDepth<R> found = at.find(corner, weight, facet(f).n) ? at.certify() : LocalDepth<R>{};
    if (!found.found || !(found.tangent > 0) || !(found.upper <= result_.upper + level_) ||
        !(found.upper - found.lower <= tolerance_))
      return false;
    if (settled_.found && !(found.tangent > settled_.tangent || found.upper < settled_.lower)) return false;
    settled_ = found;
    cap_cosine_ = found.global ? R(-1) : 1 / std::sqrt(1 + found.tangent * found.tangent);
    for (int i = 0; i < facet_count(); ++i) rank_[i] = rank(facet(i).n, key_[i]);
    return true;
  }

  R rank(const V3<R>& n, R key) const {
    const bool in_cap =
        settled_.found && n.dot(settled_.outward) >= cap_cosine_ && key >= settled_.lower * cap_cosine_;
    return in_cap ? infinite : key;
  }

  Depth<R> finish_settled() {
    result_.end = ExpandEnd::closed;
    result_.vertices = vertex_count();
    result_.upper = settled_.upper;
    result_.lower = settled_.lower;
    result_.outward = settled_.outward;
    result_.a = settled_.a;
    result_.w = settled_.w;
    return result_;
  }

  // ---- start: a non-degenerate tetrahedron

  bool complete(bool encloses) {
    if (encloses && vertex_count() == 4) {
      const V3<R> n = triangle_normal(w(0), w(1), w(2));
      if (std::abs(n.dot(w(3) - w(0))) > thin_ * n.norm()) return true;
    }
    drop_repeats();
    if (vertex_count() == 4) this->keep_vertices(3);
    if (vertex_count() == 3) {
      const R area = triangle_normal(w(0), w(1), w(2)).norm();
      const R longest = std::sqrt(std::max(
          (w(1) - w(0)).squaredNorm(), std::max((w(2) - w(1)).squaredNorm(), (w(0) - w(2)).squaredNorm())));
      if (!(area > thin_ * longest)) this->keep_vertices(2);
    }
    return grow_to_tetrahedron<R>(
        vertex_count(), thin_, [&](int i) -> const V3<R>& { return w(i); },
        [&](const V3<R>& n) { return probe(n); }, [&](const Vertex<R>& v) { this->add_vertex(v); });
  }

  void drop_repeats() {
    for (int i = 0; i < vertex_count();) {
      bool repeat = false;
      for (int k = 0; k < i; ++k) repeat |= (w(i) - w(k)).norm() <= thin_;
      if (repeat)
        this->remove_vertex(i);
      else
        ++i;
    }
  }

  // ---- facets

  // Unit normal of a triangle and the least height of its corners along it; false for a sliver.
  bool measure(const V3<R>& a, const V3<R>& b, const V3<R>& c, V3<R>& n, R& key, R& stretch) const {
    const R lab = (b - a).squaredNorm(), lbc = (c - b).squaredNorm(), lca = (a - c).squaredNorm();
    const R longest = std::max(lab, std::max(lbc, lca));
    n = lab == longest ? (c - b).cross(a - c)
                       : (lbc == longest ? (a - c).cross(b - a) : (b - a).cross(c - b));
    const R nn = n.squaredNorm();
    if (!(nn > thin_ * thin_ * longest)) return false;
    const R inverse = 1 / std::sqrt(nn);
    n *= inverse;
    stretch = longest * inverse;  // longest edge over height
    key = std::min(std::min(n.dot(a), n.dot(b)), n.dot(c));
    return true;
  }

  bool measure_start(int i) {
    Facet& f = facet(i);
    R stretch;
    const bool good = measure(w(f.v[0]), w(f.v[1]), w(f.v[2]), f.n, key_[i], stretch);
    rank_[i] = key_[i];
    return good;
  }
  void measure(int i, const Edge& e) {
    facet(i).n = e.n;
    key_[i] = e.key;
    rank_[i] = rank(e.n, e.key);
  }

  int nearest() {
    int best = -1;
    R least = infinite;
    floor_ = infinite;
    for (int i = 0; i < facet_count(); ++i) {
      floor_ = std::min(floor_, key_[i]);
      if (rank_[i] < least) {
        least = rank_[i];
        best = i;
      }
    }
    return best;
  }

  bool visible(int f, const V3<R>& p) const { return facet(f).n.dot(p) - key_[f] > level_; }

  // A sliver, or a triangle that folds the surface towards the origin: the polytope grows, so no facet may be
  // nearer than the nearest facet was. A normal is accurate only to level_/height, which costs
  // level_·longest/height.
  bool is_bad(Edge& e, const V3<R>& p) const {
    R stretch;
    return !measure(w(e.from), w(e.to), p, e.n, e.key, stretch) ||
           e.key < floor_ - level_ * (4 + 4 * stretch);
  }

  bool fill_horizon() const { return false; }

  // Storage of retired facets is reused.
  void retire(int f) {
    key_[f] = rank_[f] = infinite;
    free_.push_back(static_cast<short>(f));
  }
  short new_facet() { return free_.size() > 0 ? free_.pop_back() : this->append_facet(); }

  // ---- end

  Foot<R> foot_of(int f) const {
    Simplex<R> s;
    for (std::size_t k = 0; k < 3; ++k) s.p[k].w = w(facet(f).v[k]);
    s.size = 3;
    Foot<R> foot;
    narrow::detail::take_triangle<false>(s, 0, 1, 2, foot);
    return foot;
  }

  Depth<R> finish(ExpandEnd end, int f) {
    result_.end = end;
    result_.vertices = vertex_count();
    if (f < 0) return result_;
    // The ball of radius `lower` lies in the surface, and `upper` bounds it along `outward`: the ray of that
    // direction leaves it through a facet whose foot is its end up to the root of tolerance · length. Other
    // facets may be as near: those of another direction of the same depth, and of the same plane beside it.
    const V3<R> end_of_ray = result_.upper * result_.outward;
    const R enough = result_.upper + tolerance_;
    Foot<R> best = foot_of(f);
    R apart = (best.point - end_of_ray).squaredNorm();
    int where = f;
    for (int i = 0; i < facet_count() && !(apart <= 2 * tolerance_ * enough); ++i)
      if (key_[i] <= enough)
        if (const Foot<R> foot = foot_of(i); (foot.point - end_of_ray).squaredNorm() < apart) {
          best = foot;
          apart = (foot.point - end_of_ray).squaredNorm();
          where = i;
        }
    result_.w.setZero();
    result_.a.setZero();
    for (int k = 0; k < best.size; ++k) {
      const auto c = static_cast<std::size_t>(k);
      const short v = facet(where).v[static_cast<std::size_t>(best.corner[c])];
      result_.w += best.weight[c] * w(v);
      result_.a += best.weight[c] * on_a(v);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const short v = facet(where).v[k];
      result_.corner[k] = {w(v), on_a(v)};
    }
    result_.on_facet = true;
    return result_;
  }

  const Difference<R>& d_;
  R size_, tolerance_, level_, thin_, floor_ = 0;
  int next_try_, try_step_ = 2;
  LocalDepth<R> settled_;
  R cap_cosine_ = 1;
  Depth<R> result_;
  R key_[facet_capacity], rank_[facet_capacity];  // rank: key, or infinite inside the proven cap
  FixedList<short, facet_capacity> free_;
};

}  // namespace touchstone::narrow::filtered
