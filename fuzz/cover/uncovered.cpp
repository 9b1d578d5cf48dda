#include "fuzz/cover/exact_hull.h"

#include <algorithm>
#include <vector>

#include "core/math/expansion.h"

namespace touchstone::fuzz {
namespace {

using referee::exact;
using referee::Rational;
using referee::Rational3;

struct Plane {
  Rational3 point, normal;  // outward
};

Rational3 minus(const Rational3& a, const Rational3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

Rational height(const Plane& p, const Rational3& x) {
  const Rational3 d = minus(x, p.point);
  return p.normal.x * d.x + p.normal.y * d.y + p.normal.z * d.z;
}

// A convex polygon, a segment or a point, in rational numbers. Its corners are in order.
using Cell = std::vector<Rational3>;

Plane plane_of(const ExactHull& h, const std::array<int, 3>& f) {
  const auto corner = [&](std::size_t k) { return exact(h.points[static_cast<std::size_t>(f[k])]); };
  const Rational3 a = corner(0), u = minus(corner(1), a), v = minus(corner(2), a);
  return {a, {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x}};
}

// What is between two corners at heights of opposite signs.
Rational3 crossing(const Rational3& a, const Rational& at_a, const Rational3& b, const Rational& at_b) {
  const Rational t = at_a / (at_a - at_b);
  const Rational3 d = minus(b, a);
  return {a.x + t * d.x, a.y + t * d.y, a.z + t * d.z};
}

struct Split {
  Cell outside, inside;
};

Split split(const Cell& cell, const std::vector<Rational>& heights) {
  Split s;
  const std::size_t n = cell.size(), edges = n > 2 ? n : n - 1;
  for (std::size_t i = 0; i < n; ++i) {
    if (heights[i] >= 0) s.outside.push_back(cell[i]);
    if (heights[i] <= 0) s.inside.push_back(cell[i]);
    const std::size_t j = (i + 1) % n;
    if (i >= edges || heights[i] * heights[j] >= 0) continue;
    const Rational3 x = crossing(cell[i], heights[i], cell[j], heights[j]);
    s.outside.push_back(x);
    s.inside.push_back(x);
  }
  return s;
}

struct Piece {
  const ExactHull* hull;
  std::vector<Plane> planes;
};

// What of the cell is outside the piece: convex cells whose relative interiors do not meet the piece. What is
// left out is in the closed piece. A set that is open in the cell is empty or of the cell's dimension, so
// cells of less dimension need not be kept.
std::vector<Cell> taken_away(Cell cell, const Piece& piece) {
  std::vector<std::vector<Rational>> heights;
  for (const Plane& p : piece.planes) {
    auto& h = heights.emplace_back();
    for (const Rational3& x : cell) h.push_back(height(p, x));
    const bool is_outside = std::all_of(h.begin(), h.end(), [](const Rational& x) { return x >= 0; }) &&
                            std::any_of(h.begin(), h.end(), [](const Rational& x) { return x > 0; });
    if (is_outside) return {std::move(cell)};
  }
  std::vector<Cell> outside;
  for (const Plane& p : piece.planes) {
    std::vector<Rational> h;
    for (const Rational3& x : cell) h.push_back(height(p, x));
    const bool is_above = std::any_of(h.begin(), h.end(), [](const Rational& x) { return x > 0; });
    const bool is_below = std::any_of(h.begin(), h.end(), [](const Rational& x) { return x < 0; });
    if (!is_above) continue;
    if (!is_below) {  // what is left of the cell meets the piece at most in its boundary
      outside.push_back(std::move(cell));
      return outside;
    }
    Split s = split(cell, h);
    outside.push_back(std::move(s.outside));
    cell = std::move(s.inside);
  }
  return outside;
}

std::optional<Cell> uncovered(Cell cell, std::span<const Piece> pieces) {
  if (pieces.empty()) return cell;
  for (Cell& c : taken_away(std::move(cell), pieces.front()))
    if (auto found = uncovered(std::move(c), pieces.subspan(1))) return found;
  return std::nullopt;
}

// The triangle's corners, without those that are between or equal to others.
Cell cell_of(const Triangle& t) {
  const Rational3 a = exact(t[0]), b = exact(t[1]), c = exact(t[2]);
  const Rational3 u = minus(b, a), v = minus(c, a);
  const Rational3 n{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
  if (!referee::is_zero(n)) return {a, b, c};
  // On one line: the two ends are the least and the greatest in the order of coordinates.
  const auto before = [](const Rational3& p, const Rational3& q) {
    return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
  };
  const auto [least, greatest] = std::minmax({a, b, c}, before);
  return before(least, greatest) ? Cell{least, greatest} : Cell{least};
}

Rational3 middle(const Cell& c) {
  Rational3 sum{0, 0, 0};
  for (const Rational3& x : c) sum = {sum.x + x.x, sum.y + x.y, sum.z + x.z};
  const Rational n = static_cast<long long>(c.size());
  return {sum.x / n, sum.y / n, sum.z / n};
}

int side(const ExactHull& h, const std::array<int, 3>& f, const Vec3& p) {
  const auto corner = [&](std::size_t k) -> const Vec3& { return h.points[static_cast<std::size_t>(f[k])]; };
  return orient3d_sign(corner(0), corner(1), corner(2), p);
}

// Some facet has the whole triangle beyond it, not all of it in its plane.
bool is_beyond_a_facet(const Triangle& t, const ExactHull& h) {
  return std::any_of(h.facets.begin(), h.facets.end(), [&](const std::array<int, 3>& f) {
    const int a = side(h, f, t[0]), b = side(h, f, t[1]), c = side(h, f, t[2]);
    return a >= 0 && b >= 0 && c >= 0 && a + b + c > 0;
  });
}

}  // namespace

std::optional<Rational3> uncovered_point(const Triangle& t, std::span<const ExactHull> hulls) {
  Aabb box;
  for (const Vec3& v : t) box.extend(v);
  std::vector<Piece> pieces;
  for (const ExactHull& h : hulls) {
    if (!overlaps(h.box, box)) continue;
    if (contains(h, t[0]) && contains(h, t[1]) && contains(h, t[2])) return std::nullopt;
    if (!is_beyond_a_facet(t, h)) pieces.push_back({&h, {}});
  }
  for (Piece& p : pieces)
    for (const auto& f : p.hull->facets)
      // Only planes that the triangle reaches beyond cut something off.
      if (side(*p.hull, f, t[0]) > 0 || side(*p.hull, f, t[1]) > 0 || side(*p.hull, f, t[2]) > 0)
        p.planes.push_back(plane_of(*p.hull, f));
  const auto found = uncovered(cell_of(t), pieces);
  return found ? std::optional(middle(*found)) : std::nullopt;
}

}  // namespace touchstone::fuzz
