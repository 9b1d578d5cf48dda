#include "fuzz/cover/exact_hull.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "core/math/expansion.h"

namespace touchstone::fuzz {
namespace {

using Facet = std::array<int, 3>;

class Builder {
 public:
  explicit Builder(std::span<const Vec3> p) : p_(p) {}

  bool start() {
    const int n = static_cast<int>(p_.size());
    // The corners of the first tetrahedron: each leaves the flat through those before it.
    int b = 1;
    while (b < n && at(b) == at(0)) ++b;
    int c = b + 1;
    while (c < n && is_on_line(b, c)) ++c;
    int d = c + 1;
    while (d < n && orient3d_sign(at(0), at(b), at(c), at(d)) == 0) ++d;
    if (d >= n) return false;
    if (orient3d_sign(at(0), at(b), at(c), at(d)) > 0) std::swap(b, c);
    facets_ = {{0, b, c}, {0, c, d}, {c, b, d}, {b, 0, d}};
    return true;
  }

  // Replaces the facets that see the point by a cone from the point to their outline.
  void add(int i) {
    const auto first_hidden = std::partition(facets_.begin(), facets_.end(), [&](const Facet& f) {
      return orient3d_sign(at(f[0]), at(f[1]), at(f[2]), at(i)) > 0;
    });
    std::set<std::pair<int, int>> edges;
    for (auto f = facets_.begin(); f != first_hidden; ++f)
      for (std::size_t k = 0; k < 3; ++k) edges.emplace((*f)[k], (*f)[(k + 1) % 3]);
    facets_.erase(facets_.begin(), first_hidden);
    for (const auto& [from, to] : edges)
      if (!edges.contains({to, from})) facets_.push_back({from, to, i});
  }

  std::vector<Facet> take() { return std::move(facets_); }

 private:
  const Vec3& at(int i) const { return p_[static_cast<std::size_t>(i)]; }
  bool is_on_line(int b, int c) const {
    const Vec3 &x = at(0), &y = at(b), &z = at(c);
    return orient2d_sign(x.x(), x.y(), y.x(), y.y(), z.x(), z.y()) == 0 &&
           orient2d_sign(x.y(), x.z(), y.y(), y.z(), z.y(), z.z()) == 0 &&
           orient2d_sign(x.z(), x.x(), y.z(), y.x(), z.z(), z.x()) == 0;
  }

  std::span<const Vec3> p_;
  std::vector<Facet> facets_;
};

}  // namespace

std::optional<ExactHull> exact_hull(std::span<const Vec3> points) {
  Builder builder(points);
  if (points.empty() || !builder.start()) return std::nullopt;
  for (int i = 1; i < static_cast<int>(points.size()); ++i) builder.add(i);
  ExactHull hull;
  hull.facets = builder.take();
  std::vector<int> number(points.size(), -1);
  for (Facet& f : hull.facets)
    for (int& i : f) {
      int& n = number[static_cast<std::size_t>(i)];
      if (n < 0) {
        n = static_cast<int>(hull.points.size());
        hull.points.push_back(points[static_cast<std::size_t>(i)]);
        hull.box.extend(hull.points.back());
      }
      i = n;
    }
  return hull;
}

bool contains(const ExactHull& h, const Vec3& p) {
  return std::none_of(h.facets.begin(), h.facets.end(), [&](const Facet& f) {
    const auto corner = [&](std::size_t k) -> const Vec3& {
      return h.points[static_cast<std::size_t>(f[k])];
    };
    return orient3d_sign(corner(0), corner(1), corner(2), p) > 0;
  });
}

}  // namespace touchstone::fuzz
