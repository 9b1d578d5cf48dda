#include "core/shape/hull_graph.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/math/expansion.h"
#include "core/shape/hull.h"
#include "core/shape/vertex_climb.h"
#include "core/shape/vertex_scan.h"

namespace touchstone {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Coordinates other than 0 lie between these: orient3d_sign is exact from 1e-95 to 1e95, and means of
// coordinates may be smaller than the coordinates.
constexpr double least_coordinate = 1e-60, largest_coordinate = 1e60;
// 16 roundings of float, in units of the reach; a support value in float is off by 5.
constexpr double inside_margin = 0x1p-20;
// Sine of the corner angle below which a face is a sliver. The normal of any other face is accurate to 2⁻²⁷.
constexpr double sliver_sine = 0x1p-24;

struct HalfEdge {
  int from, to, opposite;
  auto key() const { return std::tie(from, to); }
};

class Builder {
 public:
  explicit Builder(const Hull& h) : v_(h.vertices), faces_(h.faces) {}

  bool is_proven() {
    reach_ = std::sqrt(convex::largest_norm_sq(v_));
    const auto is_fit = [](double x) {
      return x == 0 || (std::abs(x) > least_coordinate && std::abs(x) < largest_coordinate);
    };
    for (const Vec3& p : v_)
      if (!is_fit(p.x()) || !is_fit(p.y()) || !is_fit(p.z())) return false;
    if (faces_.empty()) return false;
    return collect_edges() && is_locally_convex() && covers_sphere_once() && unused_vertices_are_inside();
  }

  HullGraph graph() const {
    HullGraph g;
    g.first.assign(v_.size() + 1, 0);
    g.reach = reach_;
    for (const HalfEdge& e : edges_) {
      ++g.first[at(e.from) + 1];
      g.neighbour.push_back(static_cast<std::uint16_t>(e.to));
    }
    for (std::size_t i = 0; i < v_.size(); ++i) g.first[i + 1] += g.first[i];
    // About four cells per vertex: most starts are maxima already (one cell per vertex: a quarter slower;
    // sixteen: no faster, and the table no longer fits in the cache).
    g.cells = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(v_.size()) / 1.5)));
    fill_starts(g);
    return g;
  }

 private:
  const Vec3& v(int i) const { return v_[at(i)]; }

  bool collect_edges() {
    for (const auto& f : faces_)
      for (std::size_t k = 0; k < 3; ++k) {
        if (f[k] < 0 || at(f[k]) >= v_.size()) return false;
        edges_.push_back({f[k], f[(k + 1) % 3], f[(k + 2) % 3]});
      }
    std::sort(edges_.begin(), edges_.end(),
              [](const HalfEdge& a, const HalfEdge& b) { return a.key() < b.key(); });
    return std::adjacent_find(edges_.begin(), edges_.end(), [](const HalfEdge& a, const HalfEdge& b) {
             return a.key() == b.key();
           }) == edges_.end();
  }

  bool is_locally_convex() const {
    for (const HalfEdge& e : edges_) {
      const HalfEdge back{e.to, e.from, 0};
      const auto twin =
          std::lower_bound(edges_.begin(), edges_.end(), back,
                           [](const HalfEdge& a, const HalfEdge& b) { return a.key() < b.key(); });
      if (twin == edges_.end() || twin->key() != back.key()) return false;
      if (orient3d_sign(v(e.from), v(e.to), v(e.opposite), v(twin->opposite)) > 0) return false;
    }
    return true;
  }

  bool covers_sphere_once() const {
    Vec3 o = Vec3::Zero();
    for (const HalfEdge& e : edges_) o += v(e.from);
    o /= static_cast<double>(edges_.size());
    const Vec3 p = (v(faces_[0][0]) + v(faces_[0][1]) + v(faces_[0][2])) / 3;
    const auto crosses = [&](const std::array<int, 3>& f, int least) {
      return orient3d_sign(o, v(f[0]), v(f[1]), p) >= least &&
             orient3d_sign(o, v(f[1]), v(f[2]), p) >= least && orient3d_sign(o, v(f[2]), v(f[0]), p) >= least;
    };
    if (!crosses(faces_[0], 1)) return false;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      const auto& f = faces_[i];
      if (orient3d_sign(v(f[0]), v(f[1]), v(f[2]), o) >= 0 || (i > 0 && crosses(f, 0))) return false;
    }
    return true;
  }

  bool unused_vertices_are_inside() const {
    std::vector<char> used(v_.size(), 0);
    for (const HalfEdge& e : edges_) used[at(e.from)] = 1;
    const std::size_t rest = static_cast<std::size_t>(std::count(used.begin(), used.end(), 0));
    if (rest * faces_.size() > most_tests) return false;
    for (std::size_t i = 0; i < v_.size(); ++i)
      for (std::size_t k = 0; !used[i] && k < faces_.size(); ++k) {
        const auto& f = faces_[k];
        const Vec3 e1 = v(f[1]) - v(f[0]), e2 = v(f[2]) - v(f[0]), n = e1.cross(e2);
        const bool sliver = !(n.norm() > sliver_sine * e1.norm() * e2.norm());
        if (sliver || !(n.dot(v_[i] - v(f[0])) < -inside_margin * reach_ * n.norm())) return false;
      }
    return true;
  }

  // Each cell's climb starts from the previous cell's result.
  void fill_starts(HullGraph& g) const {
    const int c = g.cells;
    std::int32_t last = edges_.front().from;
    for (int face = 0; face < 6; ++face)
      for (int row = 0; row < c; ++row)
        for (int column = 0; column < c; ++column) {
          Vec3 d;
          d[face / 2] = face % 2 ? -1 : 1;
          d[(face / 2 + 1) % 3] = (2 * row + 1.0) / c - 1;
          d[(face / 2 + 2) % 3] = (2 * column + 1.0) / c - 1;
          last = convex::climb_from(g, v_, d, last);
          g.start.push_back(static_cast<std::uint16_t>(last));
        }
  }

  // Cap on point–face tests: a tenth of a second.
  static constexpr std::size_t most_tests = std::size_t{1} << 24;
  const std::vector<Vec3>& v_;
  const std::vector<std::array<int, 3>>& faces_;
  std::vector<HalfEdge> edges_;
  double reach_ = 0;
};

}  // namespace

HullGraph build_hull_graph(const Hull& hull, std::size_t least) {
  if (hull.vertices.size() < least || hull.vertices.size() > hull_graph_most) return {};
  Builder b(hull);
  return b.is_proven() ? b.graph() : HullGraph{};
}

}  // namespace touchstone
