#include "oracles/referee/filter/inner_polytope.h"

#include <algorithm>
#include <functional>
#include <optional>

#include "oracles/referee/filter/real3.h"
#include "oracles/referee/work.h"

namespace touchstone::referee {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

template <class T>
Triple<T> nearest_on_segment(const Triple<T>& p, const Triple<T>& q) {
  const Triple<T> d = q - p;
  const T dd = dot(d, d), t = -dot(p, d);
  if (!(t > 0)) return p;
  return t >= dd ? q : p + (t / dd) * d;
}

template <class T>
Triple<T> nearest_on_border(const Triple<T>& p, const Triple<T>& q, const Triple<T>& r) {
  const Triple<T> a = nearest_on_segment(p, q), b = nearest_on_segment(q, r), c = nearest_on_segment(r, p);
  const T aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
  return cc < aa && cc < bb ? c : bb < aa ? b : a;
}

/// Lower bound of n·x/|n| over the triangle, up to rounding.
template <class T>
T least_along(const Triple<T>& n, const Triple<T>& p, const Triple<T>& q, const Triple<T>& r) {
  const T length_sq = dot(n, n);
  if (!(length_sq > least_square<T>)) return -std::numeric_limits<T>::infinity();
  return std::min(dot(n, p), std::min(dot(n, q), dot(n, r))) / std::sqrt(length_sq);
}

template <class T>
struct Reach {
  T value;  // least_along(direction)
  Triple<T> direction;
  T det = 0;  // det(p, q, r), rounded
};

// Lower bound of the triangle's distance from the origin: along its plane's normal or, where the foot of the
// origin is outside the triangle or the normal belongs to a sliver and cannot be trusted, along the nearest
// point of its border. A triangle that clearly has the origin behind it is measured only along its normal,
// with a negative result, so that it is the first to grow.
constexpr double behind = -0x1p-40;  // threshold for det/(|p||q||r|); far above its rounding, 2^-58
// How far inside the triangle the foot must be, and how wide its angle, for the normal to be the best
// direction.
constexpr double foot_margin = 0x1p-20, sliver = 0x1p-40;

template <class T>
Reach<T> reach_of(const Triple<T>& p, const Triple<T>& q, const Triple<T>& r) {
  const Triple<T> n = triangle_normal(p, q, r);
  Reach<T> best{-std::numeric_limits<T>::infinity(), n};
  if (largest(n) > 0) {
    best.value = least_along(n, p, q, r);
    const Triple<T> pq = cross(p, q);
    const T det = best.det = dot(pq, r);
    if (det < 0 && det < behind * norm(p) * norm(q) * norm(r)) return best;
    // The foot of the origin is well inside a triangle that is not a sliver: no direction does better than
    // the normal.
    const T nn = dot(n, n), inside = T(foot_margin) * nn;
    if (det > 0 && dot(pq, n) > inside && dot(cross(q, r), n) > inside && dot(cross(r, p), n) > inside &&
        nn > T(sliver) * dot(q - p, q - p) * dot(r - p, r - p))
      return best;
  }
  const Triple<T> c = nearest_on_border(p, q, r);
  if (!(largest(c) > 0)) return best;
  const T along = least_along(c, p, q, r);
  return along > best.value ? Reach<T>{along, c, best.det} : best;
}

template <class T>
struct Facet {
  std::array<int, 3> v;
  std::array<int, 3> neighbour{-1, -1, -1};  // across edge v[i], v[i+1]
  Triple<T> normal;                          // unit; zero for a triangle without area
  T offset = 0;
  Reach<T> reach;
  bool live = true, settled = false;
};

struct HorizonEdge {
  int from, to, neighbour, neighbour_edge;
};

template <class T>
struct Storage {
  using Entry = std::pair<T, int>;
  std::vector<Facet<T>> facets;
  std::vector<Entry> queue;  // a heap, nearest facet first
  std::vector<int> visible, mark, first;
  std::vector<HorizonEdge> horizon;
};

template <class T>
class Epa {
 public:
  using Exit = typename BasicEpaResult<T>::Exit;

  Epa(const BasicDifference<T>& d, T target, int facet_cap, Orientation orientation)
      : d_(d), target_(target), cap_(facet_cap), orientation_(orientation) {}

  BasicEpaResult<T> run(const BasicSimplex<T>& seed) {
    if (const auto t = tetrahedron(seed)) {
      start(*t);
      r_.exit = grow();
      finish();
    } else {
      r_.exit = Exit::flat;
      r_.nearest = seed;
    }
    return std::move(r_);
  }

  // Like run(), but a facet that D's support shows to lie in D's boundary is recorded and set aside, and the
  // search continues with the next one. A local minimum of D at p = h·n has p on the ray through some facet
  // of the inner polytope that is not farther than h; so once the nearest remaining facet is farther than h,
  // that facet has been recorded.
  Minima minima(const BasicSimplex<T>& seed, T least_known, T slack) {
    Minima m;
    const auto t = tetrahedron(seed);
    if (!t) {
      m.flat = true;
      return m;
    }
    start(*t);
    T limit = least_known + slack;
    bool sure = true;
    for (;;) {
      while (!queue_.empty() && !facets_[at(queue_.front().second)].live) pop();
      if (queue_.empty()) {
        m.complete = sure;
        return m;
      }
      const auto [reach, f] = queue_.front();
      if (!m.found.empty() && m.found.back().value > limit && reach > m.found.back().value) {
        m.complete = sure;
        return m;
      }
      if (static_cast<int>(facets_.size()) > cap_) return m;
      const Facet<T> facet = facets_[at(f)];
      const BasicVertex<T> p = support_along(facet.normal);
      if (largest(facet.normal) > 0 && dot(facet.normal, p.w) - facet.offset > target_) {
        if (insert(f, p)) continue;
        sure = false;
      }
      pop();
      // The foot lies in the facet when no other direction shows the facet to be farther away.
      if (!(largest(facet.normal) > 0) || reach - facet.offset > 1024 * target_) continue;
      note(m, facet.normal, facet.offset, limit);
      limit = std::max(limit, std::min(least_known, m.found.front().value) + slack);
    }
  }

 private:
  static void note(Minima& m, const Triple<T>& normal, T value, T limit) {
    constexpr double same_direction = 1e-9;  // distance of unit normals; far above their rounding
    for (const auto& known : m.found)
      if (norm(known.normal - normal) < same_direction) return;
    // Beyond the limit only the least one is kept.
    const bool has_second = !m.found.empty() && m.found.back().value > limit;
    if (value > limit && has_second && value >= m.found.back().value) return;
    if (value > limit && has_second) m.found.pop_back();
    m.found.push_back({normal, value});
    std::sort(m.found.begin(), m.found.end(), [](const auto& x, const auto& y) { return x.value < y.value; });
  }

  void pop() {
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<Entry>());
    queue_.pop_back();
  }

  BasicVertex<T> support_along(const Triple<T>& n) {
    const BasicVertex<T> v = d_.support(n);
    r_.gap.raise(-d_.width_above(v, n), n);
    return v;
  }

  /// Four support points that span a volume; nullopt when D is flat up to rounding; `gap` has then been
  /// raised along the normals of the flat, which proves it.
  std::optional<std::array<BasicVertex<T>, 4>> tetrahedron(const BasicSimplex<T>& seed) {
    const T tiny = chain_rounding_of<T> * d_.extent;
    if (seed.size == 4) {
      const std::array<BasicVertex<T>, 4> t = seed.vertex;
      const Triple<T> n = cross(t[1].w - t[0].w, t[2].w - t[0].w);
      if (largest(n) > 0 && std::abs(dot(normalized(n), t[3].w - t[0].w)) > tiny) return t;
    }
    std::vector<BasicVertex<T>> found(seed.vertex.begin(), seed.vertex.begin() + seed.size);
    for (int k = 0; k < 3; ++k) {
      const Triple<T> axis{k == 0 ? T(1) : T(0), k == 1 ? T(1) : T(0), k == 2 ? T(1) : T(0)};
      found.push_back(support_along(axis));
      found.push_back(support_along(-axis));
    }
    std::array<BasicVertex<T>, 4> t;
    t[0] = found[0];
    const auto farthest = [&](auto&& measure) {
      return *std::max_element(
          found.begin(), found.end(),
          [&](const BasicVertex<T>& x, const BasicVertex<T>& y) { return measure(x) < measure(y); });
    };
    t[1] = farthest([&](const BasicVertex<T>& x) { return norm(x.w - t[0].w); });
    const Triple<T> axis = t[1].w - t[0].w;
    if (norm(axis) <= tiny) return std::nullopt;
    const Triple<T> u = normalized(axis), e = normalized(perpendicular(u)), f = cross(u, e);
    for (const Triple<T>& n : {e, -e, f, -f}) found.push_back(support_along(n));
    t[2] = farthest([&](const BasicVertex<T>& x) { return norm(cross(u, x.w - t[0].w)); });
    const Triple<T> n = cross(u, t[2].w - t[0].w);
    if (norm(n) <= tiny) {
      raise_around(u, e, f);
      return std::nullopt;
    }
    const Triple<T> m = normalized(n);
    found.push_back(support_along(m));
    found.push_back(support_along(-m));
    t[3] = farthest([&](const BasicVertex<T>& x) { return std::abs(dot(m, x.w - t[0].w)); });
    if (std::abs(dot(m, t[3].w - t[0].w)) <= tiny) return std::nullopt;
    return t;
  }

  // D is a segment along u, or a point: raises the gap along the perpendicular direction in which the origin
  // lies off it.
  void raise_around(const Triple<T>& u, const Triple<T>& e, const Triple<T>& f) {
    const BasicVertex<T> v = support_along(u);
    const Triple<T> off = v.w - dot(u, v.w) * u;
    for (const Triple<T>& n : {-off, e, f})
      if (largest(n) > 0) support_along(n);
  }

  int add(std::array<int, 3> v) {
    Facet<T> f;
    f.v = v;
    const Triple<T>&p = w(v[0]), &q = w(v[1]), &r = w(v[2]);
    f.normal = normalized(triangle_normal(p, q, r));
    f.offset = dot(f.normal, p);
    f.reach = reach_of(p, q, r);
    facets_.push_back(f);
    const int id = static_cast<int>(facets_.size()) - 1;
    queue_.emplace_back(f.reach.value, id);
    std::push_heap(queue_.begin(), queue_.end(), std::greater<Entry>());
    return id;
  }

  void start(std::array<BasicVertex<T>, 4> t) {
    if (dot(cross(t[1].w - t[0].w, t[2].w - t[0].w), t[3].w - t[0].w) > 0) std::swap(t[1], t[2]);
    r_.polytope.vertices.assign(t.begin(), t.end());
    // With det(t1-t0, t2-t0, t3-t0) < 0 the four faces are counter-clockwise seen from outside.
    const int ids[4] = {add({0, 1, 2}), add({0, 3, 1}), add({1, 3, 2}), add({2, 3, 0})};
    link(ids[0], 0, ids[1], 2);
    link(ids[0], 1, ids[2], 2);
    link(ids[0], 2, ids[3], 2);
    link(ids[1], 0, ids[3], 1);
    link(ids[1], 1, ids[2], 0);
    link(ids[2], 1, ids[3], 0);
  }

  void link(int f, int i, int g, int j) {
    facets_[at(f)].neighbour[at(i)] = g;
    facets_[at(g)].neighbour[at(j)] = f;
  }

  Exit grow() {
    for (;;) {
      drop_dead_facets();
      const int f = queue_.front().second;
      if (facets_[at(f)].settled) return Exit::stalled;
      if (static_cast<int>(facets_.size()) > cap_) return Exit::facet_cap;
      const Reach<T> reach = facets_[at(f)].reach;
      const Triple<T> n = normalized(reach.direction);
      const BasicVertex<T> p = support_along(n);
      if (dot(n, p.w) - reach.value <= target_) return Exit::converged;
      if (-r_.gap.lo - reach.value <= target_) return Exit::converged;
      // Where the nearest point lies on the border, the plane's own normal may still make progress.
      if (!insert(f, p) && !insert(f, support_along(facets_[at(f)].normal))) facets_[at(f)].settled = true;
    }
  }

  /// Replaces the facets that see p by a fan from p. Returns false and changes nothing when p is not new, or
  /// when the horizon touches itself or is empty.
  bool insert(int f, const BasicVertex<T>& p) {
    spend(work_of_point * static_cast<std::int64_t>(16 + d_.a.points.size() + d_.b.points.size() +
                                                    r_.polytope.vertices.size()));
    for (const BasicVertex<T>& v : r_.polytope.vertices)
      if (v.w.x == p.w.x && v.w.y == p.w.y && v.w.z == p.w.z) return false;
    const auto first = first_visible(f, p.w);
    if (!first) return false;
    spend(40 * work_of_point);
    visible_.assign(1, *first);
    horizon_.clear();
    ++stamp_;
    mark_.resize(facets_.size(), 0);
    mark_[at(*first)] = stamp_;
    for (std::size_t k = 0; k < visible_.size(); ++k) visit_neighbours(visible_[k], p.w);
    first_.resize(r_.polytope.vertices.size() + 1, -1);
    // With rounded normals p may see every facet, and then there is no horizon to build on.
    bool simple = horizon_.size() >= 3;
    for (std::size_t k = 0; k < horizon_.size(); ++k) {
      int& slot = first_[at(horizon_[k].from)];
      simple = simple && slot < 0;
      slot = static_cast<int>(k);
    }
    for (const HorizonEdge& e : horizon_) simple = simple && first_[at(e.to)] >= 0;
    if (simple) add_fan(p);
    for (const HorizonEdge& e : horizon_) first_[at(e.from)] = -1;
    return simple;
  }

  bool sees(const Facet<T>& f, const Triple<T>& p) const {
    if constexpr (std::is_same_v<T, Real>)
      if (orientation_ == Orientation::exact) return orientation_sign(w(f.v[0]), w(f.v[1]), w(f.v[2]), p) > 0;
    return dot(f.normal, p) - f.offset > dot_rounding_of<T> * d_.extent;
  }

  // The given facet; with exact signs the new point may turn out to be behind the plane of a sliver, and then
  // any facet that sees it.
  std::optional<int> first_visible(int f, const Triple<T>& p) const {
    if (sees(facets_[at(f)], p)) return f;
    for (std::size_t g = 0; g < facets_.size(); ++g)
      if (facets_[g].live && sees(facets_[g], p)) return static_cast<int>(g);
    return std::nullopt;
  }

  void visit_neighbours(int f, const Triple<T>& p) {
    for (int i = 0; i < 3; ++i) {
      const int g = facets_[at(f)].neighbour[at(i)];
      if (mark_[at(g)] == stamp_) continue;
      spend(orientation_ == Orientation::exact ? 2000 : 10 * work_of_point);
      const Facet<T>& facet = facets_[at(g)];
      if (sees(facet, p)) {
        mark_[at(g)] = stamp_;
        visible_.push_back(g);
        continue;
      }
      const int from = facets_[at(f)].v[at(i)], to = facets_[at(f)].v[at((i + 1) % 3)];
      const int j = facet.v[0] == to ? 0 : facet.v[1] == to ? 1 : 2;
      horizon_.push_back({from, to, g, j});
    }
  }

  void add_fan(const BasicVertex<T>& p) {
    for (int f : visible_) facets_[at(f)].live = false;
    r_.polytope.vertices.push_back(p);
    const int apex = static_cast<int>(r_.polytope.vertices.size()) - 1;
    const int base = static_cast<int>(facets_.size());
    for (const HorizonEdge& e : horizon_) {
      const int id = add({e.from, e.to, apex});
      link(id, 0, e.neighbour, e.neighbour_edge);
    }
    for (std::size_t k = 0; k < horizon_.size(); ++k)
      link(base + static_cast<int>(k), 1, base + first_[at(horizon_[k].to)], 2);
  }

  void finish() {
    drop_dead_facets();
    const int nearest = queue_.front().second;
    r_.nearest.size = 3;
    for (int i = 0; i < 3; ++i)
      r_.nearest.vertex[at(i)] = r_.polytope.vertices[at(facets_[at(nearest)].v[at(i)])];
    reduce(r_.nearest);
    // A point of D, whichever side of the origin it is on; roundings of the bound as in gjk.cpp.
    r_.gap.lower(norm(r_.nearest.nearest) + projection_rounding_of<T> * d_.extent + d_.error);
    keep_live(nearest);
    if constexpr (std::is_same_v<T, Real>) {
      const Real expected = facets_[at(nearest)].reach.value;
      if (!(expected > 0)) return;
      const Real l = proven_inner_radius(r_.polytope, expected) - d_.error;
      if (l > 0) r_.gap.lower(-l);
    }
  }

  void keep_live(int nearest) {
    mark_.assign(facets_.size(), -1);
    int live = 0;
    for (std::size_t g = 0; g < facets_.size(); ++g)
      if (facets_[g].live) mark_[g] = live++;
    r_.nearest_facet = mark_[at(nearest)];
    for (const auto reserve : {&r_.polytope.facets, &r_.polytope.neighbours}) reserve->reserve(at(live));
    r_.reach.reserve(at(live));
    r_.det.reserve(at(live));
    for (const Facet<T>& g : facets_) {
      if (!g.live) continue;
      r_.polytope.facets.push_back(g.v);
      r_.polytope.neighbours.push_back(
          {mark_[at(g.neighbour[0])], mark_[at(g.neighbour[1])], mark_[at(g.neighbour[2])]});
      r_.reach.push_back(g.reach.value - projection_rounding_of<T> * size_of(g));
      r_.det.push_back(g.reach.det);
    }
  }

  T size_of(const Facet<T>& f) const {
    return std::max(largest(w(f.v[0])), std::max(largest(w(f.v[1])), largest(w(f.v[2]))));
  }

  void drop_dead_facets() {
    while (!facets_[at(queue_.front().second)].live) pop();
  }

  const Triple<T>& w(int i) const { return r_.polytope.vertices[at(i)].w; }

  // Work units of a support point, the facets that see it and the new ones, per vertex.
  static constexpr std::int64_t work_of_point = std::is_same_v<T, double> ? 4
                                                : std::is_same_v<T, Real> ? 10
                                                                          : 400;
  const BasicDifference<T>& d_;
  T target_;
  int cap_;
  Orientation orientation_;
  BasicEpaResult<T> r_;
  // Reused from run to run, so that a small polytope allocates nothing.
  static Storage<T>& storage() {
    thread_local Storage<T> s;
    s.facets.clear();
    s.queue.clear();
    s.visible.clear();
    s.mark.clear();
    s.first.clear();
    s.horizon.clear();
    return s;
  }
  using Entry = typename Storage<T>::Entry;
  Storage<T>& storage_ = storage();
  std::vector<Facet<T>>& facets_ = storage_.facets;
  std::vector<Entry>& queue_ = storage_.queue;
  std::vector<int>&visible_ = storage_.visible, &mark_ = storage_.mark, &first_ = storage_.first;
  std::vector<HorizonEdge>& horizon_ = storage_.horizon;
  int stamp_ = 0;
};

// Every directed edge is the reverse of an edge of its neighbour, which in turn has it as its reverse: a
// pairing of all directed edges with their reverses.
template <class T>
bool is_closed(const BasicInnerPolytope<T>& p) {
  const auto holds_reverse = [&](std::size_t f, std::size_t i) {
    const int g = p.neighbours[f][i];
    if (g < 0 || at(g) >= p.facets.size()) return false;
    for (std::size_t j = 0; j < 3; ++j)
      if (p.neighbours[at(g)][j] == static_cast<int>(f) && p.facets[at(g)][j] == p.facets[f][(i + 1) % 3] &&
          p.facets[at(g)][(j + 1) % 3] == p.facets[f][i])
        return true;
    return false;
  };
  if (p.facets.empty() || p.neighbours.size() != p.facets.size()) return false;
  for (std::size_t f = 0; f < p.facets.size(); ++f) {
    const auto& v = p.facets[f];
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return false;
    for (std::size_t i = 0; i < 3; ++i)
      if (!holds_reverse(f, i)) return false;
  }
  return true;
}

/// The sums of proof (2), and the least reach so far.
struct Turning {
  Real forward = 0, backward = 0, least = 0;
};

// det(a, b, c)/(|a||b||c|): a determinant, three norms and a quotient.
constexpr Real sine_rounding = 32 * unit;

// One facet of the proof in extended precision. False when it proves no distance.
bool add_facet(Turning& t, const Real3& a, const Real3& b, const Real3& c) {
  const Real size = std::max(largest(a), std::max(largest(b), largest(c)));
  const bool forward = determinant_sign(a, b, c) >= 0;
  // Any direction proves a distance; if the plane's own already proves l, no better one is sought. A dot
  // product, a norm and a division: within 8 units of the largest |v_i| <= 2·size.
  const Real3 n = triangle_normal(a, b, c);
  Real reach = forward ? least_along(n, a, b, c) - projection_rounding * size : Real{0};
  if (!(reach >= t.least)) reach = reach_of(a, b, c).value - projection_rounding * size;
  if (!(reach > 0)) return false;
  t.least = std::min(t.least, reach);
  if (forward) {
    t.forward += std::max(dot(cross(a, b), c) / (4 * norm(a) * norm(b) * norm(c)) - sine_rounding, Real{0});
  } else {
    t.backward += norm(n) / (reach * reach);
  }
  return true;
}

}  // namespace

Real proven_inner_radius(const InnerPolytope& p, Real expected) {
  if (!is_closed(p)) return 0;
  Turning t{0, 0, expected};
  for (const auto& f : p.facets)
    if (!add_facet(t, p.vertices[at(f[0])].w, p.vertices[at(f[1])].w, p.vertices[at(f[2])].w)) return 0;
  return t.forward > 2 * t.backward ? t.least : 0;
}

Vertex vertex_at(const Difference& d, int ia, int ib) {
  const auto point = [](const Solid& s, int i) {
    const std::size_t n = s.points.size(), k = at(i);
    return k < n ? s.points[k] : s.points[k - n] + s.sweep;
  };
  const Real3 a = point(d.a, ia), b = point(d.b, ib);
  return {a - b, a, b, ia, ib, {}};
}

// A double vertex is within `off` of the extended one: two roundings of a point and one of the difference,
// each 2^-53 of at most the extent, and as much again for the sweep: off = 8·2^-53·extent. So a facet at
// distance `reach` in doubles is at least reach - off away. Its determinant, of vertices no longer than the
// extent, is within 64 roundings of extent³ as computed (rational.cpp) and moves by at most 3·off·extent² =
// 24 roundings of extent³ with the vertices; above 256 of them it is certainly positive.
Confirmed confirm(const Difference& d, const BasicDifference<double>& d0, const BasicEpaResult<double>& found,
                  Real target) {
  Confirmed r;
  const auto& p = found.polytope;
  if (found.nearest_facet < 0 || !is_closed(p)) return r;
  constexpr Real rounding = 0x1p-40L;                     // more than the rounding of the quotient below
  constexpr double det_rounding = 256 * unit_of<double>;  // as above
  const double off = dot_rounding_of<double> * d0.extent,
               det_slack = det_rounding * d0.extent * d0.extent * d0.extent;
  const auto vertex = [&](int i) { return vertex_at(d, p.vertices[at(i)].ia, p.vertices[at(i)].ib); };
  const auto facet = [&](std::size_t f) {
    return std::array{vertex(p.facets[f][0]), vertex(p.facets[f][1]), vertex(p.facets[f][2])};
  };
  const auto nearest = facet(at(found.nearest_facet));
  const Real3 &x = nearest[0].w, &y = nearest[1].w, &z = nearest[2].w;
  const Reach<Real> expected = reach_of(x, y, z);
  const Real3 n = normalized(expected.direction);
  r.gap.raise(-d.width_above(d.support(n), n), n);
  for (const Vertex& q : nearest) r.nearest.vertex[at(r.nearest.size++)] = q;
  reduce(r.nearest);
  r.gap.lower(norm(r.nearest.nearest) + projection_rounding * d.extent + d.error);
  r.doubles_prove = true;
  Turning t{0, 0, expected.value};
  for (std::size_t f = 0; f < p.facets.size(); ++f) {
    const bool forward = found.det[f] > det_slack;
    r.doubles_prove = r.doubles_prove && forward && found.reach[f] > d0.error;
    if (forward && static_cast<Real>(found.reach[f] - off) >= t.least) {
      t.forward +=
          static_cast<Real>(found.det[f] - det_slack) / (4 * d.extent * d.extent * d.extent) * (1 - rounding);
    } else {
      const auto q = facet(f);
      if (!add_facet(t, q[0].w, q[1].w, q[2].w)) {
        r.doubles_prove = false;
        return r;
      }
    }
  }
  if (!(t.forward > 2 * t.backward)) {
    r.doubles_prove = false;
    return r;
  }
  if (const Real l = t.least - d.error; l > 0) r.gap.lower(-l);
  r.closed = r.gap.hi - r.gap.lo <= target;
  return r;
}

EpaResult expand(const Difference& d, const Simplex& seed, Real target, int facet_cap,
                 Orientation orientation) {
  return Epa<Real>(d, target, facet_cap, orientation).run(seed);
}

Minima local_minima(const Difference& d, const Simplex& seed, Real least_known, Real slack, Real target,
                    int facet_cap) {
  return Epa<Real>(d, target, facet_cap, Orientation::rounded).minima(seed, least_known, slack);
}

BasicEpaResult<double> search(const BasicDifference<double>& d, const BasicSimplex<double>& seed,
                              double target, int facet_cap) {
  return Epa<double>(d, target, facet_cap, Orientation::rounded).run(seed);
}

}  // namespace touchstone::referee
