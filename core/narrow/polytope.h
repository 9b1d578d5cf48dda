// The surface of an expanding polytope (van den Bergen 2001): closed, of triangles of support points of
// D = B − A, each counter-clockwise seen from outside. It grows by one support point at a time: the facets
// that the point sees, all connected to a first one, are replaced by a fan of triangles from their horizon to
// it.
//
// The horizon is repaired first: where the new point is nearly collinear with a horizon edge, or would fold
// the surface over the origin, the facet behind that edge is removed as well. A horizon that is pinched or
// has several loops is filled or given up.
//
// One surface for two arithmetics. They differ in what makes a facet near and an edge bad, in when the search
// ends, and in storage: in double and float (filtered/epa.h) it is fixed, and a facet's support point is
// computed only when the facet is the nearest; in extended precision (extended/epa.h), which decides what
// doubles could not, storage grows, and every facet is probed, so that the best direction is never missed.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "core/narrow/simplex.h"

namespace touchstone::narrow {

/// A list in place, of items that are not initialised. Indices are int, as in GrowingList.
template <class T, int capacity>
class FixedList {
 public:
  FixedList() {}
  int size() const { return size_; }
  void clear() { size_ = 0; }
  /// Items from the old size on are not initialised.
  void resize(int n) { size_ = n; }
  void push_back(const T& x) { item_[size_++] = x; }
  T pop_back() { return item_[--size_]; }
  T& operator[](int i) { return item_[i]; }
  const T& operator[](int i) const { return item_[i]; }

 private:
  int size_ = 0;
  T item_[capacity];
};

template <class T>
class GrowingList {
 public:
  int size() const { return static_cast<int>(item_.size()); }
  void clear() { item_.clear(); }
  void resize(int n) { item_.resize(static_cast<std::size_t>(n)); }
  void push_back(const T& x) { item_.push_back(x); }
  T& operator[](int i) { return item_[static_cast<std::size_t>(i)]; }
  const T& operator[](int i) const { return item_[static_cast<std::size_t>(i)]; }

 private:
  std::vector<T> item_;
};

template <class R, class Index>
struct PolytopeFacet {
  V3<R> n;                           // outward
  std::array<Index, 3> v, adjacent;  // adjacent[i] lies across v[i], v[i+1]
  int stamp;                         // of the expansion that last took it
};

/// An edge of the horizon; `behind`: the facet on its far side.
template <class Index>
struct PolytopeEdge {
  Index from, to, behind;
};

/// Types: R, Index, Facet and Edge, derived from the two above, and List<T, n> for about n items.
/// Self provides
///   Index new_facet()              storage for a facet
///   bool measure_start(f)          a facet of the first tetrahedron; false: it is degenerate
///   void measure(f, edge)          a facet of the fan, which is_bad(edge, p) has been asked about
///   void retire(f)                 is no longer part of the surface
///   bool visible(f, p) const       whether p is beyond the facet
///   bool is_bad(edge, p)           whether the triangle of the edge and p may not be part of the surface
///   bool fill_horizon()            takes facets so that a horizon of several loops becomes one; false: gives
///   up
template <class Self, class Types>
class Polytope {
 protected:
  using R = typename Types::R;
  using Index = typename Types::Index;
  using Facet = typename Types::Facet;
  using Edge = typename Types::Edge;

  int vertex_count() const { return w_.size(); }
  const V3<R>& w(int i) const { return w_[i]; }
  const V3<R>& on_a(int i) const { return a_[i]; }
  void add_vertex(const Vertex<R>& v) {
    w_.push_back(v.w);
    a_.push_back(v.a);
  }
  void remove_vertex(int i) {
    for (int k = i; k + 1 < w_.size(); ++k) {
      w_[k] = w_[k + 1];
      a_[k] = a_[k + 1];
    }
    keep_vertices(w_.size() - 1);
  }
  void keep_vertices(int n) {
    w_.resize(n);
    a_.resize(n);
  }

  Facet& facet(int i) { return facets_[i]; }
  const Facet& facet(int i) const { return facets_[i]; }
  int facet_count() const { return facets_.size(); }
  Index append_facet() {
    facets_.resize(facets_.size() + 1);
    return static_cast<Index>(facets_.size() - 1);
  }

  /// The tetrahedron of the first four vertices; false: a facet is degenerate.
  bool build() {
    const V3<R> n = (w(1) - w(0)).cross(w(2) - w(0));
    if (n.dot(w(3) - w(0)) > 0) {
      std::swap(w_[1], w_[2]);
      std::swap(a_[1], a_[2]);
    }
    return start({0, 1, 2}, {3, 1, 2}) && start({1, 3, 2}, {3, 2, 0}) && start({0, 2, 3}, {0, 1, 3}) &&
           start({0, 3, 1}, {2, 1, 0});
  }

  /// Replaces what s sees from facet f on; false: the horizon could not be repaired.
  bool expand(int f, const Vertex<R>& s) {
    if (!find_region(f, s.w)) return false;
    fan(s);
    return true;
  }

  bool in_region(int f) const { return facet(f).stamp == stamp_; }
  void take(int f) {
    facet(f).stamp = stamp_;
    region_.push_back(static_cast<Index>(f));
  }

  int horizon_size() const { return horizon_.size(); }
  const Edge& horizon(int i) const { return horizon_[i]; }
  /// The edge that follows; only where the horizon is not pinched.
  int next_on_horizon(int i) const { return next_[horizon_[i].to]; }
  /// An edge that starts where an earlier one does, or -1.
  int pinched() const { return pinched_; }

 private:
  Self& self() { return static_cast<Self&>(*this); }
  const Self& self() const { return static_cast<const Self&>(*this); }

  bool start(const std::array<Index, 3>& v, const std::array<Index, 3>& adjacent) {
    const int f = self().new_facet();
    facet(f).v = v;
    facet(f).adjacent = adjacent;
    facet(f).stamp = 0;
    return self().measure_start(f);
  }

  void flood(int from, const V3<R>& p) {
    for (int i = from; i < region_.size(); ++i)
      for (const Index n : std::array<Index, 3>(facet(region_[i]).adjacent))
        if (!in_region(n) && self().visible(n, p)) take(n);
  }

  void collect_horizon() {
    horizon_.clear();
    for (int i = 0; i < region_.size(); ++i) {
      const Facet& f = facet(region_[i]);
      for (std::size_t k = 0; k < 3; ++k) {
        if (in_region(f.adjacent[k])) continue;
        horizon_.resize(horizon_.size() + 1);
        Edge& e = horizon_[horizon_.size() - 1];
        e.from = f.v[k];
        e.to = f.v[(k + 1) % 3];
        e.behind = f.adjacent[k];
      }
    }
  }

  // True: the horizon is one loop, and loop_ lists its edges in order.
  bool order_horizon() {
    next_.resize(vertex_count());
    for (int i = 0; i < horizon_.size(); ++i) next_[horizon_[i].from] = -1;
    pinched_ = -1;
    for (int i = 0; i < horizon_.size(); ++i) {
      Index& next = next_[horizon_[i].from];
      if (next >= 0) {
        pinched_ = i;
        return false;
      }
      next = static_cast<Index>(i);
    }
    loop_.clear();
    int i = 0;
    do {
      loop_.push_back(static_cast<Index>(i));
      i = next_on_horizon(i);
    } while (i != 0);
    return loop_.size() == horizon_.size();
  }

  bool find_region(int f, const V3<R>& p) {
    ++stamp_;
    region_.clear();
    take(f);
    flood(0, p);
    for (;;) {
      collect_horizon();
      if (horizon_.size() < 3) return false;
      const int before = region_.size();
      for (int i = 0; i < horizon_.size(); ++i)
        if (Edge& e = horizon_[i]; !in_region(e.behind) && self().is_bad(e, p)) take(e.behind);
      if (region_.size() == before) {
        if (order_horizon()) return true;
        if (!self().fill_horizon()) return false;
      }
      flood(before, p);
    }
  }

  void fan(const Vertex<R>& s) {
    for (int i = 0; i < region_.size(); ++i) self().retire(region_[i]);
    const Index apex = static_cast<Index>(vertex_count());
    add_vertex(s);
    const int n = loop_.size();
    slot_.clear();
    for (int i = 0; i < n; ++i) slot_.push_back(self().new_facet());
    for (int i = 0; i < n; ++i) {
      const Edge& e = horizon_[loop_[i]];
      Facet& f = facet(slot_[i]);
      f.v = {e.from, e.to, apex};
      f.adjacent = {e.behind, slot_[i + 1 < n ? i + 1 : 0], slot_[i > 0 ? i - 1 : n - 1]};
      f.stamp = 0;
      self().measure(slot_[i], e);
      Facet& behind = facet(e.behind);
      for (std::size_t k = 0; k < 3; ++k)
        if (behind.v[k] == e.to && behind.v[(k + 1) % 3] == e.from) behind.adjacent[k] = slot_[i];
    }
  }

  template <class T, int n>
  using List = typename Types::template List<T, n>;
  // The surface is closed and of one piece: of V vertices, it has 2V − 4 facets.
  static constexpr int vertices_ = Types::vertex_capacity + 1, facets_of_them_ = 4 * Types::vertex_capacity;
  List<V3<R>, vertices_> w_, a_;
  List<Facet, facets_of_them_> facets_;
  List<Index, facets_of_them_> region_;
  List<Edge, 3 * facets_of_them_> horizon_;
  List<Index, 3 * facets_of_them_> loop_, slot_;
  List<Index, vertices_> next_;  // by vertex: the edge of the horizon that starts there
  int pinched_ = -1, stamp_ = 0;
};

}  // namespace touchstone::narrow
