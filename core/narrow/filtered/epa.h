// Penetration depth of two convex cores in the arithmetic R: the expanding polytope of extended/epa.h in
// fixed storage, with facets by index, and support points computed only when a facet is the nearest. Same
// bounds: every direction tried is an upper bound. The surface is closed and consists of points of B − A, and
// each facet lies beyond the least height of its corners along its own normal, whatever the rounding of that
// normal, so the least of these heights is a lower bound. Full storage and a horizon that cannot be repaired
// are reported.
#pragma once

#include "core/narrow/filtered/gjk.h"
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
  int vertices = 0;
};

template <class R>
class Expander {
 public:
  static constexpr int vertex_capacity = 160, facet_capacity = 4 * vertex_capacity;
  /// From this many vertices on, three tolerances are enough: curved pairs close within about 50 vertices, or
  /// stagnate in rounding.
  static constexpr int patience = 64;

  Expander(const Difference<R>& d, R size, R tolerance)
      : d_(d),
        size_(size),
        tolerance_(tolerance),
        level_(4 * u<R> * size),
        thin_(64 * u<R> * size),
        next_try_(is_curved(d.a) || is_curved(d.b) ? 4 : vertex_capacity + 1) {}

  Depth<R> run(const Simplex<R>& start, bool encloses) {
    for (int i = 0; i < start.size; ++i) set_vertex(i, start.p[static_cast<std::size_t>(i)]);
    vertices_ = start.size;
    if (!complete(encloses)) {
      result_.end = ExpandEnd::flat;
      return result_;
    }
    if (!build()) return result_;
    for (;;) {
      int f = nearest();
      if (f >= 0 && vertices_ >= next_try_) {
        next_try_ += try_step_;
        try_step_ *= settled_.found ? 2 : 1;
        if (settle(f)) f = nearest();
      }
      if (settled_.found && (f < 0 || rank_[f] >= settled_.lower)) return finish_settled();
      if (f < 0) return finish(ExpandEnd::broken, -1);
      result_.lower = rank_[f];
      if (result_.upper - result_.lower <= tolerance_) return finish(ExpandEnd::closed, f);
      const Vertex<R> s = probe(facet_[f].n);
      const R height = facet_[f].n.dot(s.w);
      if (result_.upper - result_.lower <= tolerance_) return finish(ExpandEnd::closed, f);
      if (!(height - key_[f] > level_)) return finish(ExpandEnd::broken, f);
      if (vertices_ + 1 > vertex_capacity ||
          (vertices_ > patience && result_.upper - result_.lower <= 3 * tolerance_))
        return finish(ExpandEnd::full, f);
      if (!insert(f, s)) return finish(ExpandEnd::broken, f);
    }
  }

 private:
  static constexpr R infinite = std::numeric_limits<R>::infinity();
  struct Facet {
    V3<R> n;
    std::array<short, 3> v, adjacent;  // adjacent[i] lies across v[i], v[i+1]
    int stamp;
  };
  struct Edge {
    short from, to, behind;
    V3<R> n;  // of the triangle that it will make with the new point
    R key;
  };

  Vertex<R> probe(const V3<R>& n) {
    const Vertex<R> s = d_.support(n);
    if (const R h = n.dot(s.w); h < result_.upper) {
      result_.upper = h;
      result_.outward = n;
    }
    return s;
  }

  const V3<R>& w(int i) const { return w_[i]; }
  void set_vertex(int i, const Vertex<R>& v) {
    w_[i] = v.w;
    a_[i] = v.a;
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
    std::array<Vertex<R>, 3> facet;
    std::array<R, 3> weight{};
    for (std::size_t k = 0; k < 3; ++k) {
      const short v = facet_[f].v[k];
      facet[k] = {w_[v], a_[v]};
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(foot.size); ++k)
      weight[static_cast<std::size_t>(foot.corner[k])] = foot.weight[k];
    LocalMinimum<R> at(d_, size_);
    const LocalDepth<R> found = at.find(facet, weight, facet_[f].n) ? at.certify() : LocalDepth<R>{};
    if (!found.found || !(found.tangent > 0) || !(found.upper <= result_.upper + level_) ||
        !(found.upper - found.lower <= tolerance_))
      return false;
    if (settled_.found && !(found.tangent > settled_.tangent || found.upper < settled_.lower)) return false;
    settled_ = found;
    cap_cosine_ = found.global ? R(-1) : 1 / std::sqrt(1 + found.tangent * found.tangent);
    for (int i = 0; i < facets_; ++i) rank_[i] = rank(facet_[i].n, key_[i]);
    return true;
  }

  R rank(const V3<R>& n, R key) const {
    const bool in_cap =
        settled_.found && n.dot(settled_.outward) >= cap_cosine_ && key >= settled_.lower * cap_cosine_;
    return in_cap ? infinite : key;
  }

  Depth<R> finish_settled() {
    result_.end = ExpandEnd::closed;
    result_.vertices = vertices_;
    result_.upper = settled_.upper;
    result_.lower = settled_.lower;
    result_.outward = settled_.outward;
    result_.a = settled_.a;
    result_.w = settled_.w;
    return result_;
  }

  // ---- start: a non-degenerate tetrahedron

  bool complete(bool encloses) {
    if (encloses && vertices_ == 4) {
      const V3<R> n = triangle_normal(w(0), w(1), w(2));
      if (std::abs(n.dot(w(3) - w(0))) > thin_ * n.norm()) return true;
    }
    drop_repeats();
    if (vertices_ == 4) vertices_ = 3;
    if (vertices_ == 3) {
      const R area = triangle_normal(w(0), w(1), w(2)).norm();
      const R longest = std::sqrt(std::max(
          (w(1) - w(0)).squaredNorm(), std::max((w(2) - w(1)).squaredNorm(), (w(0) - w(2)).squaredNorm())));
      if (!(area > thin_ * longest)) vertices_ = 2;
    }
    return grow_to_tetrahedron<R>(
        vertices_, thin_, [&](int i) -> const V3<R>& { return w(i); },
        [&](const V3<R>& n) { return probe(n); }, [&](const Vertex<R>& v) { set_vertex(vertices_++, v); });
  }

  void drop_repeats() {
    int kept = 0;
    for (int i = 0; i < vertices_; ++i) {
      bool repeat = false;
      for (int k = 0; k < kept; ++k) repeat |= (w(i) - w(k)).norm() <= thin_;
      if (!repeat) {
        w_[kept] = w_[i];
        a_[kept++] = a_[i];
      }
    }
    vertices_ = kept;
  }

  bool build() {
    const V3<R> n = (w(1) - w(0)).cross(w(2) - w(0));
    if (n.dot(w(3) - w(0)) > 0) {
      std::swap(w_[1], w_[2]);
      std::swap(a_[1], a_[2]);
    }
    return add({0, 1, 2}, {3, 1, 2}) && add({1, 3, 2}, {3, 2, 0}) && add({0, 2, 3}, {0, 1, 3}) &&
           add({0, 3, 1}, {2, 1, 0});
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

  bool add(std::array<short, 3> v, std::array<short, 3> adjacent) {
    Facet& f = facet_[facets_];
    f.v = v;
    f.adjacent = adjacent;
    f.stamp = 0;
    R stretch;
    const bool good = measure(w(v[0]), w(v[1]), w(v[2]), f.n, key_[facets_], stretch);
    rank_[facets_] = key_[facets_];
    ++facets_;
    return good;
  }

  int nearest() {
    int best = -1;
    R least = infinite;
    floor_ = infinite;
    for (int i = 0; i < facets_; ++i) {
      floor_ = std::min(floor_, key_[i]);
      if (rank_[i] < least) {
        least = rank_[i];
        best = i;
      }
    }
    return best;
  }

  bool visible(int f, const V3<R>& p) const { return facet_[f].n.dot(p) - key_[f] > level_; }

  // ---- expansion

  void take(int f) {
    facet_[f].stamp = stamp_;
    region_[regions_++] = static_cast<short>(f);
  }

  void flood(int from, const V3<R>& p) {
    for (int i = from; i < regions_; ++i)
      for (const short n : std::array<short, 3>(facet_[region_[i]].adjacent))
        if (facet_[n].stamp != stamp_ && visible(n, p)) take(n);
  }

  void add_edge(short from, short to, short behind) {
    Edge& e = edge_[edges_++];
    e.from = from;
    e.to = to;
    e.behind = behind;
  }

  void collect() {
    edges_ = 0;
    for (int i = 0; i < regions_; ++i) {
      const Facet& f = facet_[region_[i]];
      for (std::size_t k = 0; k < 3; ++k)
        if (facet_[f.adjacent[k]].stamp != stamp_) add_edge(f.v[k], f.v[(k + 1) % 3], f.adjacent[k]);
    }
  }

  // A sliver, or a triangle that folds the surface towards the origin: the polytope grows, so no facet may be
  // nearer than the nearest facet was. A normal is accurate only to level_/height, which costs
  // level_·longest/height.
  bool is_bad(Edge& e, const V3<R>& p) const {
    R stretch;
    return !measure(w(e.from), w(e.to), p, e.n, e.key, stretch) ||
           e.key < floor_ - level_ * (4 + 4 * stretch);
  }

  // Orders the edges into one loop; false if the horizon is pinched or has several loops.
  bool order() {
    for (int i = 0; i < edges_; ++i) {
      for (int k = i + 1; k < edges_; ++k)
        if (edge_[k].from == edge_[i].to) {
          std::swap(edge_[i + 1], edge_[k]);
          break;
        }
      if (edge_[(i + 1) % edges_].from != edge_[i].to) return false;
      for (int k = 0; k < i; ++k)
        if (edge_[k].from == edge_[i].from) return false;
    }
    return true;
  }

  // False: the horizon could not be repaired.
  bool insert(int f, const Vertex<R>& s) {
    ++stamp_;
    regions_ = 0;
    take(f);
    flood(0, s.w);
    for (;;) {
      collect();
      if (edges_ < 3) return false;
      const int before = regions_;
      for (int i = 0; i < edges_; ++i)
        if (is_bad(edge_[i], s.w) && facet_[edge_[i].behind].stamp != stamp_) take(edge_[i].behind);
      if (regions_ == before) break;
      flood(before, s.w);
    }
    if (!order()) return false;
    fan(s);
    return true;
  }

  void fan(const Vertex<R>& s) {
    // Storage of dead facets is reused.
    for (int i = 0; i < regions_; ++i) {
      key_[region_[i]] = rank_[region_[i]] = infinite;
      free_[free_count_++] = region_[i];
    }
    const short apex = static_cast<short>(vertices_);
    set_vertex(vertices_++, s);
    for (int i = 0; i < edges_; ++i) slot_[i] = free_count_ > 0 ? free_[--free_count_] : fresh();
    for (int i = 0; i < edges_; ++i) {
      const Edge& e = edge_[i];
      Facet& f = facet_[slot_[i]];
      f.v = {e.from, e.to, apex};
      f.stamp = 0;
      f.n = e.n;
      key_[slot_[i]] = e.key;
      rank_[slot_[i]] = rank(e.n, e.key);
      f.adjacent = {e.behind, slot_[(i + 1) % edges_], slot_[(i + edges_ - 1) % edges_]};
      Facet& behind = facet_[e.behind];
      for (std::size_t k = 0; k < 3; ++k)
        if (behind.v[k] == e.to && behind.v[(k + 1) % 3] == e.from) behind.adjacent[k] = slot_[i];
    }
  }

  // The surface is closed and of one piece: of V vertices, it has 2V − 4 facets, which are fewer than 4V.
  short fresh() { return static_cast<short>(facets_++); }

  // ---- end

  Foot<R> foot_of(int f) const {
    Simplex<R> s;
    for (std::size_t k = 0; k < 3; ++k) s.p[k].w = w_[facet_[f].v[k]];
    s.size = 3;
    Foot<R> foot;
    narrow::detail::take_triangle<false>(s, 0, 1, 2, foot);
    return foot;
  }

  Depth<R> finish(ExpandEnd end, int f) {
    result_.end = end;
    result_.vertices = vertices_;
    if (f < 0) return result_;
    // Where several facets share the plane, the origin may project outside the current one.
    Foot<R> best = foot_of(f);
    int where = f;
    const R enough = result_.upper + tolerance_;
    for (int i = 0; i < facets_ && !(best.dist_sq <= enough * enough); ++i)
      if (key_[i] <= enough)
        if (const Foot<R> foot = foot_of(i); foot.dist_sq < best.dist_sq) {
          best = foot;
          where = i;
        }
    result_.w.setZero();
    result_.a.setZero();
    for (int k = 0; k < best.size; ++k) {
      const auto c = static_cast<std::size_t>(k);
      const short v = facet_[where].v[static_cast<std::size_t>(best.corner[c])];
      result_.w += best.weight[c] * w_[v];
      result_.a += best.weight[c] * a_[v];
    }
    return result_;
  }

  const Difference<R>& d_;
  R size_, tolerance_, level_, thin_, floor_ = 0;
  int next_try_, try_step_ = 2;
  LocalDepth<R> settled_;
  R cap_cosine_ = 1;
  Depth<R> result_;
  int vertices_ = 0, facets_ = 0, regions_ = 0, edges_ = 0, free_count_ = 0, stamp_ = 0;
  V3<R> w_[vertex_capacity + 1], a_[vertex_capacity + 1];
  Facet facet_[facet_capacity];
  R key_[facet_capacity], rank_[facet_capacity];  // rank: key, or infinite inside the proven cap
  short region_[facet_capacity], free_[facet_capacity], slot_[3 * facet_capacity];
  Edge edge_[3 * facet_capacity];
};

}  // namespace touchstone::narrow::filtered
