// Penetration depth of two convex cores that touch or overlap: the boundary point of D = B − A nearest to the
// origin. Expanding polytope (van den Bergen 2001), with these departures:
//
// * Termination by bounds. Every direction m ever tried gives an upper bound h_D(m). Lower bound: the surface
//   is closed and consists of triangles of points of D, so every ray from the origin leaves through one of
//   them, and the ball whose radius is the least distance of a triangle lies in D. This does not require the
//   surface to be convex, so a facet distorted by rounding does no harm. The run is `closed` when the bounds
//   meet to `tolerance`.
// * The horizon is repaired: where the new point is nearly collinear with a horizon edge, or would fold the
//   surface over the origin, the facet behind that edge is removed as well; horizons that are pinched or have
//   several loops are filled.
// * When the minima form a curve (coaxial cylinders) or a surface (concentric spheroids), no number of facets
//   closes the lower bound. The run then ends `explored`, with the best direction seen; descend.h takes it to
//   a local minimum.
#pragma once

#include <array>
#include <queue>
#include <utility>
#include <vector>

#include "core/narrow/extended/gjk.h"
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

template <class R>
class Epa {
 public:
  /// `size` bounds the coordinates of D; tolerances scale with it.
  Epa(const ConvexCore<R>& a, const ConvexCore<R>& b, R size, R tolerance)
      : d_{a, b}, tolerance_(tolerance), thin_(128 * eps * size), level_(8 * eps * size) {}

  EpaResult<R> run(const Distance<R>& g, int budget) {
    result_.a = g.a;
    result_.b = g.b;
    outside_ = g.status == GjkStatus::enclosed ? 0 : 2 * g.upper;
    std::vector<Vertex<R>> start(g.simplex.p.begin(), g.simplex.p.begin() + g.simplex.size);
    drop_degenerate(start);
    if (!grow(start)) {
      result_.status = EpaStatus::flat;
      return result_;
    }
    build_tetrahedron(start);
    for (int i = 0; i < budget; ++i) {
      const int f = least_key();
      if (f < 0) return finish(EpaStatus::broken, -1);
      result_.lower = facet(f).key;
      if (result_.upper - result_.lower <= tolerance_) return finish(EpaStatus::closed, f);
      if (!expand(f)) return finish(EpaStatus::broken, f);
    }
    return finish(EpaStatus::explored, least_key());
  }

 private:
  static constexpr R eps = std::numeric_limits<R>::epsilon();
  static constexpr R infinite = std::numeric_limits<R>::infinity();

  struct Facet {
    std::array<int, 3> v{}, adjacent{};  // adjacent[i] lies across v[i], v[i+1]
    V3<R> normal;                        // outward
    R plane = 0, key = infinite, upper = infinite;
    Vertex<R> support;
    bool alive = true, sliver = false,
         inside = false;  // inside: the origin projects into the triangle
  };
  struct Edge {
    int from, to, behind;
  };

  Facet& facet(int i) { return facets_[static_cast<std::size_t>(i)]; }
  const V3<R>& point(int i) const { return vertices_[static_cast<std::size_t>(i)].w; }

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
  void drop_degenerate(std::vector<Vertex<R>>& s) const {
    const auto w = [&](std::size_t i) -> const V3<R>& { return s[i].w; };
    if (s.size() == 4) {
      R best = -1;
      std::size_t apex = 3;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto [i, j, l] = others(k);
        const R area = (w(j) - w(i)).cross(w(l) - w(i)).norm();
        if (area > best) {
          best = area;
          apex = k;
        }
      }
      const auto [i, j, l] = others(apex);
      const V3<R> n = (w(j) - w(i)).cross(w(l) - w(i));
      if (!(abs(n.dot(w(apex) - w(i))) > thin_ * best)) s.erase(s.begin() + static_cast<long>(apex));
    }
    if (s.size() == 3 && height(w(0), w(1), w(2)) <= thin_) {
      const R e0 = (w(1) - w(2)).squaredNorm(), e1 = (w(0) - w(2)).squaredNorm(),
              e2 = (w(0) - w(1)).squaredNorm();
      s.erase(s.begin() + (e0 >= e1 && e0 >= e2 ? 0 : (e1 >= e2 ? 1 : 2)));
    }
    if (s.size() == 2 && (w(0) - w(1)).norm() <= thin_) s.pop_back();
  }
  static std::array<std::size_t, 3> others(std::size_t k) {
    return {k == 0 ? 1u : 0u, k <= 1 ? 2u : 1u, k <= 2 ? 3u : 2u};
  }

  // Height above the longest edge.
  static R height(const V3<R>& a, const V3<R>& b, const V3<R>& c) {
    const R longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    return longest > 0 ? upright_normal<R>(a, b, c).norm() / sqrt(longest) : R(0);
  }

  // Extends the simplex to a tetrahedron; false when D is flat.
  bool grow(std::vector<Vertex<R>>& s) {
    return grow_to_tetrahedron<R>(
        static_cast<int>(s.size()), thin_,
        [&](int i) -> const V3<R>& { return s[static_cast<std::size_t>(i)].w; },
        [&](const V3<R>& n) { return probe(n); }, [&](const Vertex<R>& v) { s.push_back(v); });
  }

  void build_tetrahedron(const std::vector<Vertex<R>>& s) {
    vertices_.assign(s.begin(), s.end());
    const V3<R> n = (point(1) - point(0)).cross(point(2) - point(0));
    if (n.dot(point(3) - point(0)) > 0) std::swap(vertices_[1], vertices_[2]);
    // Counter-clockwise from outside, once vertex 3 is below triangle 0 1 2.
    add_facet({0, 1, 2}, {3, 1, 2});
    add_facet({1, 3, 2}, {3, 2, 0});
    add_facet({0, 2, 3}, {0, 1, 3});
    add_facet({0, 3, 1}, {2, 1, 0});
    for (int i = 0; i < 4; ++i) push(i);
  }

  int add_facet(std::array<int, 3> v, std::array<int, 3> adjacent) {
    Facet f;
    f.v = v;
    f.adjacent = adjacent;
    measure(f);
    facets_.push_back(f);
    return static_cast<int>(facets_.size()) - 1;
  }

  void measure(Facet& f) {
    const V3<R>&a = point(f.v[0]), &b = point(f.v[1]), &c = point(f.v[2]);
    f.normal = upright_normal<R>(a, b, c);
    // A sliver's distance is that of its longest edge up to thin_; the facet across that edge accounts for
    // it.
    f.sliver = height(a, b, c) <= thin_;
    if (f.sliver) return;
    f.normal.normalize();
    const R aa = a.squaredNorm(), bb = b.squaredNorm(), cc = c.squaredNorm();
    f.plane = f.normal.dot(aa <= bb && aa <= cc ? a : (bb <= cc ? b : c));
    const auto near = nearest(f);
    f.inside = near.size == 3;
    const R dist = sqrt(near.dist_sq);
    // Negative when the origin is beyond the plane: the surface does not (yet) enclose it.
    f.key = f.inside || f.plane < 0 ? f.plane : std::max(f.plane, dist);

    f.support = probe(f.normal, f.upper);
  }

  Foot<R> nearest(const Facet& f) const {
    Simplex<R> s;
    for (std::size_t k = 0; k < 3; ++k) s.p[k].w = point(f.v[k]);
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

  static R square(R x) { return x * x; }

  void set_witness(const Facet& x) {
    Foot<R> near = nearest(x);
    if (near.size == 3)
      refine_weights<R>(point(x.v[0]), point(x.v[1]), point(x.v[2]), near.point, near.weight.data());
    result_.a.setZero();
    result_.b.setZero();
    for (std::size_t i = 0; i < static_cast<std::size_t>(near.size); ++i) {
      const int corner = x.v[static_cast<std::size_t>(near.corner[i])];
      const Vertex<R>& v = vertices_[static_cast<std::size_t>(corner)];
      result_.a += near.weight[i] * v.a;
      result_.b += near.weight[i] * (v.a + v.w);
    }
  }

  // Where several facets share the nearest plane, the origin may project outside the current one.
  int nearest_facet() const {
    int best = 0;
    R least = infinite;
    for (int i = 0; i < static_cast<int>(facets_.size()); ++i) {
      if (!facets_[static_cast<std::size_t>(i)].alive) continue;
      if (const R d = nearest(facets_[static_cast<std::size_t>(i)]).dist_sq; d < least) {
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
        result_.normal = -x.normal;
      }
      set_witness(nearest(x).dist_sq <= square(abs(x.plane) + tolerance_) ? x : facet(nearest_facet()));
    }
    result_.status = status;
    result_.iterations = static_cast<int>(vertices_.size());
    return result_;
  }

  bool visible(const Facet& f, const V3<R>& p) const {
    return f.sliver || f.normal.dot(p) - f.plane > level_;
  }

  bool in_region(int f) const { return mark_[static_cast<std::size_t>(f)] == stamp_; }
  void take(int f) {
    mark_[static_cast<std::size_t>(f)] = stamp_;
    region_.push_back(f);
  }

  void flood(std::size_t from, const V3<R>& p) {
    for (std::size_t i = from; i < region_.size(); ++i)
      for (int n : std::array<int, 3>(facet(region_[i]).adjacent))
        if (!in_region(n) && visible(facet(n), p)) take(n);
  }

  void collect_horizon() {
    horizon_.clear();
    for (int f : region_)
      for (std::size_t i = 0; i < 3; ++i)
        if (const int n = facet(f).adjacent[i]; !in_region(n))
          horizon_.push_back({facet(f).v[i], facet(f).v[(i + 1) % 3], n});
  }

  bool bad_triangle(const Edge& e, const V3<R>& p) const {
    const V3<R>&a = point(e.from), &b = point(e.to);
    const R h = height(a, b, p);
    if (h <= thin_) return true;
    const V3<R> n = upright_normal<R>(a, b, p).normalized();
    // The normal of a triangle of height h is accurate to about level_/h.
    const R longest = sqrt(std::max({(b - a).squaredNorm(), (p - b).squaredNorm(), (a - p).squaredNorm()}));
    return n.dot(a) < -level_ * (4 + longest / h) - tolerance_ - outside_;
  }

  // Orders the horizon into one loop. Returns the facets to absorb if it is pinched or has several loops.
  std::vector<int> order_horizon() {
    next_.assign(vertices_.size(), -1);
    for (int i = 0; i < static_cast<int>(horizon_.size()); ++i) {
      int& slot = next_[static_cast<std::size_t>(horizon_[static_cast<std::size_t>(i)].from)];
      if (slot >= 0) return {horizon_[static_cast<std::size_t>(i)].behind};
      slot = i;
    }
    std::vector<std::vector<Edge>> loops;
    std::vector<bool> seen(horizon_.size(), false);
    for (std::size_t i = 0; i < horizon_.size(); ++i) {
      if (seen[i]) continue;
      loops.emplace_back();
      for (std::size_t k = i; !seen[k];
           k = static_cast<std::size_t>(next_[static_cast<std::size_t>(horizon_[k].to)])) {
        seen[k] = true;
        loops.back().push_back(horizon_[k]);
      }
    }
    std::size_t longest = 0;
    for (std::size_t i = 1; i < loops.size(); ++i)
      if (loops[i].size() > loops[longest].size()) longest = i;
    std::vector<int> absorb;
    for (std::size_t i = 0; i < loops.size(); ++i)
      if (i != longest)
        for (const Edge& e : loops[i]) absorb.push_back(e.behind);
    if (absorb.empty() && !loops.empty()) horizon_ = loops[longest];
    return absorb;
  }

  bool find_region(int f, const V3<R>& p) {
    ++stamp_;
    mark_.resize(facets_.size(), 0);
    region_.clear();
    take(f);
    flood(0, p);
    for (;;) {
      collect_horizon();
      if (horizon_.size() < 3) return false;
      const std::size_t before = region_.size();
      for (const Edge& e : horizon_)
        if (!in_region(e.behind) && bad_triangle(e, p)) take(e.behind);
      if (region_.size() == before)
        for (int n : order_horizon())
          if (!in_region(n)) take(n);
      if (region_.size() == before) return true;
      flood(before, p);
    }
  }

  bool expand(int f) {
    const Vertex<R> s = facet(f).support;
    if (!(facet(f).upper - facet(f).plane > level_) || !find_region(f, s.w)) return false;
    const int w = static_cast<int>(vertices_.size());
    vertices_.push_back(s);
    for (int r : region_) facet(r).alive = false;
    const int first = static_cast<int>(facets_.size()), count = static_cast<int>(horizon_.size());
    for (int i = 0; i < count; ++i) {
      const Edge e = horizon_[static_cast<std::size_t>(i)];
      const int created =
          add_facet({e.from, e.to, w}, {e.behind, first + (i + 1) % count, first + (i + count - 1) % count});
      Facet& behind = facet(e.behind);
      for (std::size_t k = 0; k < 3; ++k)
        if (behind.v[k] == e.to && behind.v[(k + 1) % 3] == e.from) behind.adjacent[k] = created;
      push(created);
    }
    return true;
  }

  using HeapItem = std::pair<R, int>;
  Difference<R> d_;
  R tolerance_, thin_, level_;
  R outside_ = 0;  // the origin may lie this far outside D
  EpaResult<R> result_;
  std::vector<Vertex<R>> vertices_;
  std::vector<Facet> facets_;
  std::priority_queue<HeapItem, std::vector<HeapItem>, std::greater<>> heap_;
  std::vector<int> region_, mark_, next_;
  std::vector<Edge> horizon_;
  int stamp_ = 0;
};

}  // namespace touchstone::narrow::extended
