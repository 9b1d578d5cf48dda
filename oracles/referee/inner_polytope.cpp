#include "oracles/referee/inner_polytope.h"

#include <algorithm>
#include <optional>
#include <queue>

#include "oracles/referee/exact_sign.h"

namespace touchstone::referee {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Real3 nearest_on_segment(const Real3& p, const Real3& q) {
  const Real3 d = q - p;
  const Real dd = dot(d, d), t = -dot(p, d);
  if (!(t > 0)) return p;
  return t >= dd ? q : p + (t / dd) * d;
}

Real3 nearest_on_border(const Real3& p, const Real3& q, const Real3& r) {
  const Real3 a = nearest_on_segment(p, q), b = nearest_on_segment(q, r), c = nearest_on_segment(r, p);
  const Real aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
  return cc < aa && cc < bb ? c : bb < aa ? b : a;
}

/// A lower bound of the triangle's extent along n (not zero), up to rounding.
Real least_along(const Real3& n, const Real3& p, const Real3& q, const Real3& r) {
  return std::fmin(dot(n, p), std::fmin(dot(n, q), dot(n, r))) / norm(n);
}

struct Reach {
  Real value;  // least_along(direction)
  Real3 direction;
};

// How far the triangle stays from the origin: along its plane's normal, or, where the origin's foot is
// outside of the triangle or the normal is a sliver's and not to be trusted, along the nearest point of its
// border. A triangle that has the origin clearly behind it is measured along its normal only, negative, so
// that it is the first to grow.
constexpr Real behind = -0x1p-40L;  // of det/(|p||q||r|); far above its rounding, 2^-58

Reach reach_of(const Real3& p, const Real3& q, const Real3& r) {
  const Real3 n = cross(q - p, r - p);
  Reach best{-std::numeric_limits<Real>::infinity(), n};
  if (largest(n) > 0) {
    best.value = least_along(n, p, q, r);
    const Real3 pq = cross(p, q);
    const Real det = dot(pq, r);
    if (det < 0 && det < behind * norm(p) * norm(q) * norm(r)) return best;
    // The origin's foot well inside of a triangle that is no sliver: no direction does better than the
    // normal.
    const Real nn = dot(n, n), inside = 0x1p-20L * nn;
    if (det > 0 && dot(pq, n) > inside && dot(cross(q, r), n) > inside && dot(cross(r, p), n) > inside &&
        nn > 0x1p-40L * dot(q - p, q - p) * dot(r - p, r - p))
      return best;
  }
  const Real3 c = nearest_on_border(p, q, r);
  if (!(largest(c) > 0)) return best;
  const Real along = least_along(c, p, q, r);
  return along > best.value ? Reach{along, c} : best;
}

struct Facet {
  std::array<int, 3> v;
  std::array<int, 3> neighbour{-1, -1, -1};  // across edge v[i], v[i+1]
  Real3 normal;                              // unit; zero for a triangle without area
  Real offset = 0;
  Reach reach;
  bool live = true, settled = false;
};

struct HorizonEdge {
  int from, to, neighbour, neighbour_edge;
};

class Epa {
 public:
  Epa(const Difference& d, Real target, int facet_cap, Orientation orientation)
      : d_(d), target_(target), cap_(facet_cap), orientation_(orientation) {}

  EpaResult run(const Simplex& seed) {
    if (const auto t = tetrahedron(seed)) {
      start(*t);
      r_.exit = grow();
      finish();
    } else {
      r_.exit = EpaResult::Exit::flat;
      r_.nearest = seed;
    }
    return std::move(r_);
  }

 private:
  Vertex ask(const Real3& n) {
    const Vertex v = d_.support(n);
    r_.gap.raise(-d_.width_above(v, n), n);
    return v;
  }

  /// Four support points that span a volume; nullopt when D is flat up to rounding, and then `gap` has been
  /// raised along the flat's normals, which proves that.
  std::optional<std::array<Vertex, 4>> tetrahedron(const Simplex& seed) {
    std::vector<Vertex> found(seed.vertex.begin(), seed.vertex.begin() + seed.size);
    const Real tiny = 64 * unit * d_.extent;
    if (seed.size == 4) {
      const std::array<Vertex, 4> t = seed.vertex;
      const Real3 n = cross(t[1].w - t[0].w, t[2].w - t[0].w);
      if (largest(n) > 0 && std::fabs(dot(normalized(n), t[3].w - t[0].w)) > tiny) return t;
    }
    for (int k = 0; k < 3; ++k) {
      const Real3 axis{k == 0 ? 1.0L : 0.0L, k == 1 ? 1.0L : 0.0L, k == 2 ? 1.0L : 0.0L};
      found.push_back(ask(axis)), found.push_back(ask(-axis));
    }
    std::array<Vertex, 4> t;
    t[0] = found[0];
    const auto farthest = [&](auto&& measure) {
      return *std::max_element(found.begin(), found.end(),
                               [&](const Vertex& x, const Vertex& y) { return measure(x) < measure(y); });
    };
    t[1] = farthest([&](const Vertex& x) { return norm(x.w - t[0].w); });
    const Real3 axis = t[1].w - t[0].w;
    if (norm(axis) <= tiny) return std::nullopt;
    const Real3 u = normalized(axis), e = normalized(perpendicular(u)), f = cross(u, e);
    for (const Real3& n : {e, -e, f, -f}) found.push_back(ask(n));
    t[2] = farthest([&](const Vertex& x) { return norm(cross(u, x.w - t[0].w)); });
    const Real3 n = cross(u, t[2].w - t[0].w);
    if (norm(n) <= tiny) return raise_around(u, e, f), std::nullopt;
    const Real3 m = normalized(n);
    found.push_back(ask(m)), found.push_back(ask(-m));
    t[3] = farthest([&](const Vertex& x) { return std::fabs(dot(m, x.w - t[0].w)); });
    if (std::fabs(dot(m, t[3].w - t[0].w)) <= tiny) return std::nullopt;
    return t;
  }

  // D is a segment along u, or a point: the direction at a right angle to it in which the origin lies off it.
  void raise_around(const Real3& u, const Real3& e, const Real3& f) {
    const Vertex v = ask(u);
    const Real3 off = v.w - dot(u, v.w) * u;
    for (const Real3& n : {-off, e, f})
      if (largest(n) > 0) ask(n);
  }

  int add(std::array<int, 3> v) {
    Facet f;
    f.v = v;
    const Real3 &p = w(v[0]), &q = w(v[1]), &r = w(v[2]);
    f.normal = normalized(cross(q - p, r - p));
    f.offset = dot(f.normal, p);
    f.reach = reach_of(p, q, r);
    facets_.push_back(f);
    const int id = static_cast<int>(facets_.size()) - 1;
    queue_.push({f.reach.value, id});
    return id;
  }

  void start(std::array<Vertex, 4> t) {
    if (dot(cross(t[1].w - t[0].w, t[2].w - t[0].w), t[3].w - t[0].w) > 0) std::swap(t[1], t[2]);
    r_.polytope.vertices.assign(t.begin(), t.end());
    // With det(t1-t0, t2-t0, t3-t0) < 0 these four are counter-clockwise from outside.
    const int ids[4] = {add({0, 1, 2}), add({0, 3, 1}), add({1, 3, 2}), add({2, 3, 0})};
    link(ids[0], 0, ids[1], 2), link(ids[0], 1, ids[2], 2), link(ids[0], 2, ids[3], 2);
    link(ids[1], 0, ids[3], 1), link(ids[1], 1, ids[2], 0), link(ids[2], 1, ids[3], 0);
  }

  void link(int f, int i, int g, int j) {
    facets_[at(f)].neighbour[at(i)] = g;
    facets_[at(g)].neighbour[at(j)] = f;
  }

  EpaResult::Exit grow() {
    for (;;) {
      while (!facets_[at(queue_.top().second)].live) queue_.pop();
      const int f = queue_.top().second;
      if (facets_[at(f)].settled) return EpaResult::Exit::stalled;
      if (static_cast<int>(facets_.size()) > cap_) return EpaResult::Exit::facet_cap;
      const Reach reach = facets_[at(f)].reach;
      const Real3 n = normalized(reach.direction);
      const Vertex p = ask(n);
      if (dot(n, p.w) - reach.value <= target_) return EpaResult::Exit::converged;
      if (-r_.gap.lo - reach.value <= target_) return EpaResult::Exit::converged;
      // Where the nearest point lies on the border, the plane's own normal may still lead on.
      if (!insert(f, p) && !insert(f, ask(facets_[at(f)].normal))) facets_[at(f)].settled = true;
    }
  }

  /// Replaces the facets that see p by a fan from p. False, and nothing changed, when p is not new or the
  /// horizon touches itself.
  bool insert(int f, const Vertex& p) {
    for (const Vertex& v : r_.polytope.vertices)
      if (v.w.x == p.w.x && v.w.y == p.w.y && v.w.z == p.w.z) return false;
    const auto first = first_visible(f, p.w);
    if (!first) return false;
    visible_.assign(1, *first);
    horizon_.clear();
    ++stamp_;
    mark_.resize(facets_.size(), 0);
    mark_[at(*first)] = stamp_;
    for (std::size_t k = 0; k < visible_.size(); ++k) look_around(visible_[k], p.w);
    first_.resize(r_.polytope.vertices.size() + 1, -1);
    bool simple = true;
    for (std::size_t k = 0; k < horizon_.size(); ++k) {
      int& slot = first_[at(horizon_[k].from)];
      simple = simple && slot < 0;
      slot = static_cast<int>(k);
    }
    for (const HorizonEdge& e : horizon_) simple = simple && first_[at(e.to)] >= 0;
    if (simple) cone(p);
    for (const HorizonEdge& e : horizon_) first_[at(e.from)] = -1;
    return simple;
  }

  bool sees(const Facet& f, const Real3& p) const {
    if (orientation_ == Orientation::rounded) return dot(f.normal, p) - f.offset > 8 * unit * d_.extent;
    return orientation_sign(w(f.v[0]), w(f.v[1]), w(f.v[2]), p) > 0;
  }

  // The facet that asked; with exact signs the plane of a sliver may turn out to have the new point behind
  // it.
  std::optional<int> first_visible(int f, const Real3& p) const {
    if (sees(facets_[at(f)], p)) return f;
    for (std::size_t g = 0; g < facets_.size(); ++g)
      if (facets_[g].live && sees(facets_[g], p)) return static_cast<int>(g);
    return std::nullopt;
  }

  void look_around(int f, const Real3& p) {
    for (int i = 0; i < 3; ++i) {
      const int g = facets_[at(f)].neighbour[at(i)];
      if (mark_[at(g)] == stamp_) continue;
      const Facet& facet = facets_[at(g)];
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

  void cone(const Vertex& p) {
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
    while (!facets_[at(queue_.top().second)].live) queue_.pop();
    const Facet& f = facets_[at(queue_.top().second)];
    r_.nearest.size = 3;
    for (int i = 0; i < 3; ++i) r_.nearest.vertex[at(i)] = r_.polytope.vertices[at(f.v[at(i)])];
    reduce(r_.nearest);
    // A point of D, whichever side of the origin it is on; the bound's roundings as in gjk.cpp.
    r_.gap.lower(norm(r_.nearest.nearest) + 16 * unit * d_.extent + d_.error);
    for (const Facet& g : facets_)
      if (g.live) r_.polytope.facets.push_back(g.v);
    if (!(f.reach.value > 0)) return;
    const Real l = proven_inner_radius(r_.polytope, f.reach.value) - d_.error;
    if (l > 0) r_.gap.lower(-l);
  }

  const Real3& w(int i) const { return r_.polytope.vertices[at(i)].w; }

  const Difference& d_;
  Real target_;
  int cap_;
  Orientation orientation_;
  EpaResult r_;
  std::vector<Facet> facets_;
  using Entry = std::pair<Real, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue_;
  std::vector<int> visible_, mark_, first_;
  std::vector<HorizonEdge> horizon_;
  int stamp_ = 0;
};

bool is_closed(const InnerPolytope& p) {
  std::vector<std::pair<int, int>> forward, backward;
  for (const auto& f : p.facets)
    for (int i = 0; i < 3; ++i) {
      forward.emplace_back(f[at(i)], f[at((i + 1) % 3)]);
      backward.emplace_back(f[at((i + 1) % 3)], f[at(i)]);
    }
  std::sort(forward.begin(), forward.end());
  std::sort(backward.begin(), backward.end());
  return !forward.empty() && forward == backward;
}

}  // namespace

Real proven_inner_radius(const InnerPolytope& p, Real expected) {
  if (!is_closed(p)) return 0;
  Real l = expected, turning = 0, against = 0;
  for (const auto& f : p.facets) {
    const Real3 &a = p.vertices[at(f[0])].w, &b = p.vertices[at(f[1])].w, &c = p.vertices[at(f[2])].w;
    const Real size = std::fmax(largest(a), std::fmax(largest(b), largest(c)));
    const bool forward = determinant_sign(a, b, c) >= 0;
    // Any direction proves a distance; where the plane's own already proves l, no better one is looked for. A
    // dot product, a norm and a division: within 8 units of the largest |v_i| <= 2·size.
    const Real3 n = cross(b - a, c - a);
    Real reach = forward && largest(n) > 0 ? least_along(n, a, b, c) - 16 * unit * size : Real{0};
    if (!(reach >= l)) reach = reach_of(a, b, c).value - 16 * unit * size;
    if (!(reach > 0)) return 0;
    l = std::fmin(l, reach);
    if (forward) {
      turning += std::fmax(dot(cross(a, b), c) / (4 * norm(a) * norm(b) * norm(c)) - 32 * unit, Real{0});
    } else {
      against += norm(n) / (reach * reach);
    }
  }
  return turning > 2 * against ? l : 0;
}

EpaResult expand(const Difference& d, const Simplex& seed, Real target, int facet_cap,
                 Orientation orientation) {
  return Epa(d, target, facet_cap, orientation).run(seed);
}

}  // namespace touchstone::referee
