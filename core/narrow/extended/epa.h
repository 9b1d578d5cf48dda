// Penetration depth of two convex cores that touch or overlap: the boundary point of D = B − A nearest to the
// origin. Expanding polytope (van den Bergen 2001), with these departures:
//
// * Termination by bounds. Every direction m ever tried gives an upper bound h_D(m). Lower bound: the surface
//   is closed and consists of triangles of points of D, so every ray from the origin leaves through one of
//   them, and the ball whose radius is the least distance of a triangle lies in D. This does not require the
//   surface to be convex, so a facet distorted by rounding does no harm. The run is `closed` when the bounds
//   meet to `tolerance`.
// * A horizon that is pinched or has several loops is filled (core/narrow/polytope.h).
// * When the minima form a curve (coaxial cylinders) or a surface (concentric spheroids), no number of facets
//   closes the lower bound. The run then ends `explored`, with the best direction seen; descend.h takes it to
//   a local minimum.
#pragma once

#include <queue>
#include <utility>
#include <vector>

#include "core/narrow/extended/gjk.h"
#include "core/narrow/polytope.h"
#include "core/narrow/rounding.h"
#include "core/narrow/start_tetrahedron.h"

namespace touchstone::narrow::extended {

enum class EpaStatus {
  closed,    // upper − lower <= tolerance
  flat,      // D has no interior within rounding: the depth is upper, 0 up to rounding
  explored,  // budget spent: upper and lower are valid but have not met
  broken     // the surface could not be repaired in this arithmetic
};

template <class R>
struct EpaResult {
  EpaStatus status = EpaStatus::broken;
  R upper = std::numeric_limits<R>::infinity();  // h_D(-normal); valid for every status
  R lower = 0;
  V3<R> normal = V3<R>::UnitX();  // unit, A to B: minus the outward normal of D
  V3<R> a = V3<R>::Zero(), b = V3<R>::Zero();
  int iterations = 0;
};

template <class S>
struct EpaTypes {
  using R = S;
  using Index = int;
  struct Facet : PolytopeFacet<R, Index> {
    R plane = 0, key = std::numeric_limits<R>::infinity(), upper = key;
    Vertex<R> support;
    bool alive = true, sliver = false;
  };
  using Edge = PolytopeEdge<Index>;
  static constexpr int vertex_capacity = 0;  // storage grows
  template <class T, int>
  using List = GrowingList<T>;
};

template <class R>
class Epa : Polytope<Epa<R>, EpaTypes<R>> {
 public:
  /// `size` bounds the coordinates of D; tolerances scale with it.
  Epa(const ConvexCore<R>& a, const ConvexCore<R>& b, R size, R tolerance)
      : d_{a, b},
        tolerance_(tolerance),
        thin_(rounding::wide_sliver_height * eps * size),
        level_(rounding::wide_height * eps * size) {}

  EpaResult<R> run(const Distance<R>& g, int budget) {
    result_.a = g.a;
    result_.b = g.b;
    outside_ = g.status == GjkStatus::enclosed ? 0 : 2 * g.upper;
    for (int i = 0; i < g.simplex.size; ++i) this->add_vertex(g.simplex.p[static_cast<std::size_t>(i)]);
    drop_degenerate();
    if (!grow()) {
      result_.status = EpaStatus::flat;
      return result_;
    }
    this->build();
    for (int i = 0; i < budget; ++i) {
      const int f = least_key();
      if (f < 0) return finish(EpaStatus::broken, -1);
      result_.lower = facet(f).key;
      if (result_.upper - result_.lower <= tolerance_) return finish(EpaStatus::closed, f);
      const Vertex<R> s = facet(f).support;
      if (!(facet(f).upper - facet(f).plane > level_) || !this->expand(f, s))
        return finish(EpaStatus::broken, f);
    }
    return finish(EpaStatus::explored, least_key());
  }

 private:
  using Surface = Polytope<Epa<R>, EpaTypes<R>>;
  friend Surface;
  using Surface::facet;
  using Surface::facet_count;
  using Surface::horizon;
  using Surface::horizon_size;
  using Surface::on_a;
  using Surface::vertex_count;
  using Surface::w;
  using typename Surface::Edge;
  using typename Surface::Facet;
  static constexpr R eps = std::numeric_limits<R>::epsilon();
  static constexpr R infinite = std::numeric_limits<R>::infinity();

  Vertex<R> probe(const V3<R>& m, R& value) {
    const Vertex<R> s = d_.support(m);
    value = m.dot(s.w);
    if (value < result_.upper) {
      result_.upper = value;
      result_.normal = -m;
    }
    return s;
  }
  Vertex<R> probe(const V3<R>& m) {
    R ignored;
    return probe(m, ignored);
  }

  // A simplex that encloses the origin may be flat within rounding; its largest face then contains the origin
  // just as well.
  void drop_degenerate() {
    if (vertex_count() == 4) {
      R best = -1;
      int apex = 3;
      for (int k = 0; k < 4; ++k) {
        const auto [i, j, l] = others(k);
        const R area = (w(j) - w(i)).cross(w(l) - w(i)).norm();
        if (area > best) {
          best = area;
          apex = k;
        }
      }
      const auto [i, j, l] = others(apex);
      const V3<R> n = (w(j) - w(i)).cross(w(l) - w(i));
      if (!(abs(n.dot(w(apex) - w(i))) > thin_ * best)) this->remove_vertex(apex);
    }
    if (vertex_count() == 3 && height(w(0), w(1), w(2)) <= thin_) {
      const R e0 = (w(1) - w(2)).squaredNorm(), e1 = (w(0) - w(2)).squaredNorm(),
              e2 = (w(0) - w(1)).squaredNorm();
      this->remove_vertex(e0 >= e1 && e0 >= e2 ? 0 : (e1 >= e2 ? 1 : 2));
    }
    if (vertex_count() == 2 && (w(0) - w(1)).norm() <= thin_) this->keep_vertices(1);
  }
  static std::array<int, 3> others(int k) { return {k == 0 ? 1 : 0, k <= 1 ? 2 : 1, k <= 2 ? 3 : 2}; }

  // Height above the longest edge.
  static R height(const V3<R>& a, const V3<R>& b, const V3<R>& c) {
    const R longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    return longest > 0 ? upright_normal<R>(a, b, c).norm() / sqrt(longest) : R(0);
  }

  // Extends the simplex to a tetrahedron; false when D is flat.
  bool grow() {
    return grow_to_tetrahedron<R>(
        vertex_count(), thin_, [&](int i) -> const V3<R>& { return w(i); },
        [&](const V3<R>& n) { return probe(n); }, [&](const Vertex<R>& v) { this->add_vertex(v); });
  }

  int new_facet() { return this->append_facet(); }
  bool measure_start(int i) {
    measure(facet(i));
    push(i);
    return true;
  }
  void measure(int i, const Edge&) { measure_start(i); }
  void retire(int i) { facet(i).alive = false; }

  void measure(Facet& f) {
    const V3<R>&a = w(f.v[0]), &b = w(f.v[1]), &c = w(f.v[2]);
    f.n = upright_normal<R>(a, b, c);
    // A sliver's distance is that of its longest edge up to thin_; the facet across that edge accounts for
    // it.
    f.sliver = height(a, b, c) <= thin_;
    if (f.sliver) return;
    f.n.normalize();
    const R aa = a.squaredNorm(), bb = b.squaredNorm(), cc = c.squaredNorm();
    f.plane = f.n.dot(aa <= bb && aa <= cc ? a : (bb <= cc ? b : c));
    const auto near = nearest(f);
    const bool inside = near.size == 3;  // the origin projects into the triangle
    const R dist = sqrt(near.dist_sq);
    // Negative when the origin is beyond the plane: the surface does not (yet) enclose it.
    f.key = inside || f.plane < 0 ? f.plane : std::max(f.plane, dist);
    f.support = probe(f.n, f.upper);
  }

  Foot<R> nearest(const Facet& f) const {
    Simplex<R> s;
    for (std::size_t k = 0; k < 3; ++k) s.p[k].w = w(f.v[k]);
    Foot<R> foot;
    narrow::detail::take_triangle<true>(s, 0, 1, 2, foot);
    return foot;
  }

  void push(int i) {
    if (!facet(i).sliver) heap_.emplace(facet(i).key, i);
  }

  int least_key() {
    while (!heap_.empty() && !facet(heap_.top().second).alive) heap_.pop();
    return heap_.empty() ? -1 : heap_.top().second;
  }

  void set_witness(const Facet& x) {
    Foot<R> near = nearest(x);
    if (near.size == 3) refine_weights<R>(w(x.v[0]), w(x.v[1]), w(x.v[2]), near.point, near.weight.data());
    result_.a.setZero();
    result_.b.setZero();
    for (std::size_t i = 0; i < static_cast<std::size_t>(near.size); ++i) {
      const int corner = x.v[static_cast<std::size_t>(near.corner[i])];
      result_.a += near.weight[i] * on_a(corner);
      result_.b += near.weight[i] * (on_a(corner) + w(corner));
    }
  }

  // The ball of radius `lower` lies in the surface, and `upper` bounds it along the outward direction: the
  // ray of that direction leaves it through a facet whose foot is its end up to the root of tolerance ·
  // length. Other facets may be as near: those of another direction of the same depth, and of the same plane
  // beside it. Facet `first` is tried first.
  int facet_of_ray(int first) const {
    const V3<R> end = -result_.upper * result_.normal;
    const auto apart = [&](int i) { return R((nearest(facet(i)).point - end).squaredNorm()); };
    int best = first;
    R least = apart(first);
    for (int i = 0; i < facet_count() && !(least <= 2 * tolerance_ * (result_.upper + tolerance_)); ++i) {
      if (!facet(i).alive) continue;
      if (const R d = apart(i); d < least) {
        least = d;
        best = i;
      }
    }
    return best;
  }

  EpaResult<R> finish(EpaStatus status, int f) {
    if (const int k = least_key(); k >= 0) result_.lower = facet(k).key;
    if (f >= 0) {
      const Facet& x = facet(f);
      if (x.upper - result_.upper <= tolerance_) {
        result_.upper = x.upper;
        result_.normal = -x.n;
      }
      set_witness(facet(facet_of_ray(f)));
    }
    result_.status = status;
    result_.iterations = vertex_count();
    return result_;
  }

  bool visible(int i, const V3<R>& p) const {
    const Facet& f = facet(i);
    return f.sliver || f.n.dot(p) - f.plane > level_;
  }

  bool is_bad(const Edge& e, const V3<R>& p) const {
    const V3<R>&a = w(e.from), &b = w(e.to);
    const R h = height(a, b, p);
    if (h <= thin_) return true;
    const V3<R> n = upright_normal<R>(a, b, p).normalized();
    // The normal of a triangle of height h is accurate to about level_/h.
    const R longest = sqrt(std::max({(b - a).squaredNorm(), (p - b).squaredNorm(), (a - p).squaredNorm()}));
    return n.dot(a) < -level_ * (4 + longest / h) - tolerance_ - outside_;
  }

  // Takes the facet behind a pinch, or those behind all loops but the longest.
  bool fill_horizon() {
    if (const int i = this->pinched(); i >= 0) {
      this->take(horizon(i).behind);
      return true;
    }
    std::vector<std::vector<int>> loops;
    std::vector<bool> seen(static_cast<std::size_t>(horizon_size()), false);
    for (int i = 0; i < horizon_size(); ++i) {
      if (seen[static_cast<std::size_t>(i)]) continue;
      loops.emplace_back();
      for (int k = i; !seen[static_cast<std::size_t>(k)]; k = this->next_on_horizon(k)) {
        seen[static_cast<std::size_t>(k)] = true;
        loops.back().push_back(k);
      }
    }
    const auto longest = std::max_element(loops.begin(), loops.end(),
                                          [](const auto& x, const auto& y) { return x.size() < y.size(); });
    for (auto loop = loops.begin(); loop != loops.end(); ++loop)
      if (loop != longest)
        for (const int k : *loop)
          if (!this->in_region(horizon(k).behind)) this->take(horizon(k).behind);
    return true;
  }

  using HeapItem = std::pair<R, int>;
  Difference<R> d_;
  R tolerance_, thin_, level_;
  R outside_ = 0;  // the origin may lie this far outside D
  EpaResult<R> result_;
  std::priority_queue<HeapItem, std::vector<HeapItem>, std::greater<>> heap_;
};

}  // namespace touchstone::narrow::extended
