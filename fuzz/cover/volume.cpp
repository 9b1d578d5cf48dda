#include <algorithm>
#include <cmath>

#include "fuzz/cover/limits.h"
#include "fuzz/cover/measure.h"

namespace touchstone::fuzz {
namespace {

using Polygon = std::vector<Vec3>;
// A convex polytope by its faces, whose corners go round.
using Polytope = std::vector<Polygon>;

struct Plane {
  Vec3 normal;  // unit, outward
  double offset = 0;
  double height(const Vec3& x) const { return normal.dot(x) - offset; }
};

struct Piece {
  Aabb box;
  Polytope faces;
  std::vector<Plane> planes;
};

Aabb box_of(const Polytope& p) {
  Aabb box;
  for (const Polygon& f : p)
    for (const Vec3& v : f) box.extend(v);
  return box;
}

Piece piece_of(const ExactHull& h) {
  Piece piece{h.box, {}, {}};
  for (const auto& f : h.facets) {
    Polygon& face = piece.faces.emplace_back();
    for (const int i : f) face.push_back(h.points[static_cast<std::size_t>(i)]);
    const Vec3 n = (face[1] - face[0]).cross(face[2] - face[0]);
    if (!(n.norm() > 0)) continue;  // so thin that its plane is lost in rounding
    piece.planes.push_back({n.normalized(), n.normalized().dot(face[0])});
  }
  return piece;
}

// The corners of a new face, which are in a plane, in their order around its middle.
void put_in_order(Polygon& lid, const Vec3& normal) {
  Vec3 centre = Vec3::Zero();
  for (const Vec3& v : lid) centre += v / static_cast<double>(lid.size());
  const Vec3 u = normal.unitOrthogonal(), w = normal.cross(u);
  const auto angle = [&](const Vec3& x) { return std::atan2(w.dot(x - centre), u.dot(x - centre)); };
  std::sort(lid.begin(), lid.end(), [&](const Vec3& x, const Vec3& y) { return angle(x) < angle(y); });
}

// What is below the plane (above it with side -1), closed by a new face; corners within `slack` of the plane
// are taken as on it.
Polytope clipped(const Polytope& p, const Plane& plane, double side, double slack) {
  const auto height = [&](const Vec3& x) {
    const double h = side * plane.height(x);
    return std::abs(h) <= slack ? 0 : h;
  };
  bool is_above = false, is_below = false;
  for (const Polygon& f : p)
    for (const Vec3& v : f) {
      is_above |= height(v) > 0;
      is_below |= height(v) < 0;
    }
  if (!is_below) return {};
  if (!is_above) return p;
  Polytope out;
  Polygon lid;
  for (const Polygon& f : p) {
    Polygon kept;
    for (std::size_t i = 0; i < f.size(); ++i) {
      const Vec3 &a = f[i], &b = f[(i + 1) % f.size()];
      const double at_a = height(a), at_b = height(b);
      if (at_a <= 0) kept.push_back(a);
      if (at_a == 0) lid.push_back(a);
      if (at_a * at_b >= 0) continue;
      kept.push_back(a + (at_a / (at_a - at_b)) * (b - a));
      lid.push_back(kept.back());
    }
    if (kept.size() >= 3) out.push_back(std::move(kept));
  }
  if (lid.size() < 3) return out;
  put_in_order(lid, plane.normal);
  out.push_back(std::move(lid));
  return out;
}

// By the pyramids from an inner point to the faces.
double volume(const Polytope& p) {
  Vec3 inside = Vec3::Zero();
  double corners = 0;
  for (const Polygon& f : p)
    for (const Vec3& v : f) {
      inside += v;
      ++corners;
    }
  if (corners == 0) return 0;
  inside /= corners;
  double six = 0;
  for (const Polygon& f : p)
    for (std::size_t k = 1; k + 1 < f.size(); ++k)
      six += std::abs((f[0] - inside).dot((f[k] - inside).cross(f[k + 1] - inside)));
  return six / 6;
}

// Adds up what of each piece is in none of those before it.
class Sum {
 public:
  Sum(std::span<const Piece> pieces, double slack, const std::atomic<bool>& stop)
      : pieces_(pieces), slack_(slack), stop_(stop) {}

  void add(Polytope cell, std::size_t first, std::size_t last) {
    const Aabb box = box_of(cell);
    while (first < last && !overlaps(pieces_[first].box, box)) ++first;
    if (first == last) {
      settled_ += volume(cell);
      return;
    }
    if (stop_ || ++cells_ > most_parts) {
      open_ += volume(cell);
      return;
    }
    if (is_beyond(cell, pieces_[first])) return add(std::move(cell), first + 1, last);
    for (const Plane& plane : pieces_[first].planes) {
      Polytope outside = clipped(cell, plane, -1, slack_);
      if (!outside.empty()) add(std::move(outside), first + 1, last);
      cell = clipped(cell, plane, 1, slack_);
      if (cell.empty()) return;
    }
  }

  referee::Bracket bracket() const { return {settled_, settled_ + open_}; }
  double cells() const { return static_cast<double>(cells_); }

 private:
  bool is_beyond(const Polytope& cell, const Piece& piece) const {
    return std::any_of(piece.planes.begin(), piece.planes.end(), [&](const Plane& plane) {
      return std::all_of(cell.begin(), cell.end(), [&](const Polygon& f) {
        return std::all_of(f.begin(), f.end(), [&](const Vec3& v) { return plane.height(v) >= -slack_; });
      });
    });
  }

  std::span<const Piece> pieces_;
  double slack_;
  const std::atomic<bool>& stop_;
  std::size_t cells_ = 0;
  double settled_ = 0, open_ = 0;
};

}  // namespace

referee::Bracket volume_of_union(std::span<const ExactHull> hulls, const std::atomic<bool>& stop) {
  Aabb all;
  double reach = 0;
  std::vector<Piece> pieces;
  for (const ExactHull& h : hulls) {
    pieces.push_back(piece_of(h));
    all.extend(h.box);
    for (const Vec3& v : h.points) reach = std::max(reach, v.cwiseAbs().maxCoeff());
  }
  const double slack = cover::computed_in_doubles * reach;
  Sum sum(pieces, slack, stop);
  for (std::size_t i = 0; i < pieces.size(); ++i) sum.add(pieces[i].faces, 0, i);
  const auto [lo, hi] = sum.bracket();
  // Each cut moves a face by the slack at most; no face is larger than the largest of the box.
  const Vec3 size = all.hi - all.lo;
  const double face = size.maxCoeff() * size.maxCoeff();
  const double rounding = cover::computed_in_doubles * size.prod() + slack * face * (8 + sum.cells());
  return {std::max(0.0, lo - rounding), hi + rounding};
}

}  // namespace touchstone::fuzz
