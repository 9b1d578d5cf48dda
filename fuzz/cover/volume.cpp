#include <algorithm>
#include <cmath>
#include <queue>

#include "fuzz/cover/limits.h"
#include "fuzz/cover/measure.h"

namespace touchstone::fuzz {
namespace {

using Polygon = std::vector<Vec3>;
// A convex polytope by its faces; no order of the corners is relied on but that they go round.
using Polytope = std::vector<Polygon>;

// What is at or below the plane x[axis] = at (above it with sign -1), closed by a new face.
Polytope clipped(const Polytope& p, Eigen::Index axis, double at, double sign) {
  bool is_above = false, is_below = false;
  for (const Polygon& f : p)
    for (const Vec3& v : f) {
      is_above |= sign * (v[axis] - at) > 0;
      is_below |= sign * (v[axis] - at) < 0;
    }
  if (!is_below) return {};
  if (!is_above) return p;
  Polytope out;
  Polygon lid;
  for (const Polygon& f : p) {
    Polygon kept;
    for (std::size_t i = 0; i < f.size(); ++i) {
      const Vec3 &a = f[i], &b = f[(i + 1) % f.size()];
      const double u = sign * (a[axis] - at), v = sign * (b[axis] - at);
      if (u <= 0) kept.push_back(a);
      if (u == 0) lid.push_back(a);
      if (u * v < 0) {
        Vec3 x = a + (u / (u - v)) * (b - a);
        x[axis] = at;
        kept.push_back(x);
        lid.push_back(x);
      }
    }
    if (kept.size() >= 3) out.push_back(std::move(kept));
  }
  if (lid.size() < 3) return out;
  Vec3 centre = Vec3::Zero();
  for (const Vec3& v : lid) centre += v / static_cast<double>(lid.size());
  const Eigen::Index i = (axis + 1) % 3, j = (axis + 2) % 3;
  std::sort(lid.begin(), lid.end(), [&](const Vec3& x, const Vec3& y) {
    return std::atan2(x[j] - centre[j], x[i] - centre[i]) < std::atan2(y[j] - centre[j], y[i] - centre[i]);
  });
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

// A box, what of the pieces is in it, and how much of it they fill.
struct Part {
  Aabb box;
  std::vector<Polytope> inside;
  referee::Bracket filled;
  double open() const { return filled.hi - filled.lo; }
  bool operator<(const Part& o) const { return open() < o.open(); }
};

Part part_of(const Aabb& box, const std::vector<Polytope>& pieces) {
  Part part{box, {}, {}};
  const Vec3 size = box.hi - box.lo;
  const double whole = size.x() * size.y() * size.z();
  double sum = 0;
  for (const Polytope& piece : pieces) {
    Polytope p = piece;
    for (Eigen::Index axis = 0; axis < 3 && !p.empty(); ++axis)
      p = clipped(clipped(p, axis, box.hi[axis], 1), axis, box.lo[axis], -1);
    const double v = volume(p);
    if (v <= 0) continue;
    part.filled.lo = std::max(part.filled.lo, v);
    sum += v;
    part.inside.push_back(std::move(p));
  }
  part.filled.hi = std::min(whole, sum);
  part.filled.lo = std::min(part.filled.lo, part.filled.hi);
  return part;
}

}  // namespace

referee::Bracket volume_of_union(std::span<const ExactHull> pieces, const std::atomic<bool>& stop) {
  Aabb all;
  std::vector<Polytope> whole;
  for (const ExactHull& h : pieces) {
    all.extend(h.box);
    Polytope& p = whole.emplace_back();
    for (const auto& f : h.facets) {
      Polygon& face = p.emplace_back();
      for (const int i : f) face.push_back(h.points[static_cast<std::size_t>(i)]);
    }
  }
  std::priority_queue<Part> parts;
  parts.push(part_of(all, whole));
  referee::Bracket sum = parts.top().filled;
  const double rounding = cover::computed_in_doubles * (all.hi - all.lo).prod();
  // A part whose pieces fill it to rounding is settled. The share is of the union: of what is left over, the
  // caller sees the same bracket.
  for (std::size_t split = 0; split < most_parts / 8 && !stop; ++split) {
    if (sum.hi - sum.lo <= bracket_share * bracket_share * sum.hi || parts.empty()) break;
    const Part p = parts.top();
    parts.pop();
    const Vec3 middle = (p.box.lo + p.box.hi) / 2;
    sum.lo -= p.filled.lo;
    sum.hi -= p.filled.hi;
    for (int octant = 0; octant < 8; ++octant) {
      Aabb box = p.box;
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        ((octant >> axis & 1) != 0 ? box.lo : box.hi)[axis] = middle[axis];
      Part child = part_of(box, p.inside);
      sum.lo += child.filled.lo;
      sum.hi += child.filled.hi;
      if (child.inside.size() > 1) parts.push(std::move(child));
    }
  }
  return {std::max(0.0, sum.lo - rounding), sum.hi + rounding};
}

}  // namespace touchstone::fuzz
