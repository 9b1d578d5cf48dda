#include "core/shape/vertex_climb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/shape/vertex_scan.h"

namespace touchstone::convex {
namespace {

template <class R>
class Climb {
 public:
  Climb(const HullGraph& g, std::span<const Vec3> v, const V3<R>& d)
      : first_(g.first.data()), neighbour_(g.neighbour.data()), v_(v.data()), d_(d) {}

  /// `unique`: no neighbour of the maximum comes within `band` of it.
  std::int32_t climb(std::int32_t i, R band, bool& unique) {
    top_ = value(i);
    for (;;) {
      std::int32_t next = i;
      R most = -std::numeric_limits<R>::infinity();
      for (std::int32_t k = first_[i]; k < first_[i + 1]; ++k)
        if (const R f = value(neighbour_[k]); f > most) {
          most = f;
          next = neighbour_[k];
        }
      if (!(most > top_)) {
        unique = most < top_ - band;
        return i;
      }
      i = next;
      top_ = most;
    }
  }

  R top() const { return top_; }

  /// The vertices with values from `least` on that are connected to `from` through such vertices; out.size()
  /// + 1: too many.
  std::size_t gather(std::int32_t from, R least, std::span<std::int32_t> out) const {
    std::size_t n = 1;
    out[0] = from;
    for (std::size_t i = 0; i < n; ++i)
      for (std::int32_t k = first_[out[i]]; k < first_[out[i] + 1]; ++k) {
        const std::int32_t j = neighbour_[k];
        if (!(value(j) >= least)) continue;
        const auto end = out.begin() + static_cast<std::ptrdiff_t>(n);
        if (std::find(out.begin(), end, j) != end) continue;
        if (n == out.size()) return n + 1;
        out[n++] = j;
      }
    return n;
  }

  /// The first of the largest in C of the header; −1: too many.
  std::int32_t among_equals(std::int32_t summit, R band) const {
    std::array<std::int32_t, 32> all;
    const std::size_t n = gather(summit, top_ - band, all);
    if (n > all.size()) return -1;
    std::int32_t best = summit;
    R most = top_;
    for (std::size_t i = 1; i < n; ++i)
      if (const R f = value(all[i]); f > most || (f == most && all[i] < best)) {
        most = f;
        best = all[i];
      }
    return best;
  }

 private:
  // As in vertex_scan.cpp.
  R value(std::int32_t i) const {
    const double* p = v_[i].data();
    return (static_cast<R>(p[0]) * d_[0] + static_cast<R>(p[1]) * d_[1]) + static_cast<R>(p[2]) * d_[2];
  }

  const std::int32_t* first_;
  const std::uint16_t* neighbour_;
  const Vec3* v_;
  const V3<R> d_;
  R top_ = 0;
};

// Start vertex from the table. A direction that is not finite gets an arbitrary one.
template <class R>
std::int32_t start(const HullGraph& g, const V3<R>& d) {
  const V3<R> size = d.cwiseAbs();
  const int k = size[0] >= size[1] ? (size[0] >= size[2] ? 0 : 2) : (size[1] >= size[2] ? 1 : 2);
  const R half = R(g.cells) / 2, scale = size[k] > 0 ? half / size[k] : R(0);
  const auto cell = [&](R x) {
    return static_cast<int>(std::min(std::max(R(0), x * scale + half), R(g.cells) - R(0.5)));
  };
  const int face = 2 * k + (d[k] < 0 ? 1 : 0);
  const int row = cell(d[(k + 1) % 3]), column = cell(d[(k + 2) % 3]);
  return g.start[static_cast<std::size_t>((face * g.cells + row) * g.cells + column)];
}

template <class R>
std::size_t farthest(const HullGraph& g, std::span<const Vec3> v, const V3<R>& d) {
  constexpr R u = std::numeric_limits<R>::epsilon() / 2;
  // 2e with room for its own rounding; the 1-norm bounds the length. Underflow is far below min().
  const R band = 12 * u * static_cast<R>(g.reach) * d.template lpNorm<1>() + std::numeric_limits<R>::min();
  Climb<R> path(g, v, d);
  bool unique = false;
  const std::int32_t summit = path.climb(start(g, d), band, unique);
  if (unique) return static_cast<std::size_t>(summit);
  const std::int32_t best = path.among_equals(summit, band);
  return best < 0 ? farthest_vertex(v, d) : static_cast<std::size_t>(best);
}

template <class R>
std::size_t above(const HullGraph& g, std::span<const Vec3> v, const V3<R>& d, R least,
                  std::span<std::int32_t> out) {
  Climb<R> path(g, v, d);
  bool unique = false;
  const std::int32_t summit = path.climb(start(g, d), 0, unique);
  return path.top() >= least ? path.gather(summit, least, out) : 0;
}

}  // namespace

std::size_t vertices_above(const HullGraph& g, std::span<const Vec3> v, const V3<double>& d, double least,
                           std::span<std::int32_t> out) {
  return above<double>(g, v, d, least, out);
}

std::size_t vertices_above(const HullGraph& g, std::span<const Vec3> v, const V3<float>& d, float least,
                           std::span<std::int32_t> out) {
  return above<float>(g, v, d, least, out);
}

std::size_t farthest_vertex(const HullGraph& g, std::span<const Vec3> v, const V3<double>& d) {
  return farthest<double>(g, v, d);
}

std::size_t farthest_vertex(const HullGraph& g, std::span<const Vec3> v, const V3<float>& d) {
  return farthest<float>(g, v, d);
}

std::int32_t climb_from(const HullGraph& g, std::span<const Vec3> v, const V3<double>& d, std::int32_t from) {
  bool unique = false;
  return Climb<double>(g, v, d).climb(from, 0, unique);
}

}  // namespace touchstone::convex
