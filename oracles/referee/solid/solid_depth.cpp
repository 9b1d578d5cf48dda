// Brackets of depths with solids. A depth is the least motion that separates. Whatever convex sets lie inside
// the two bodies, each motion that separates the bodies separates these sets: the depth of two triangles, of
// a ball and the other body, or of two convex pieces is a lower bound. A place where the bodies are certainly
// apart gives an upper bound.
#include <algorithm>
#include <cmath>

#include "core/math/roundoff.h"
#include "oracles/referee/filter/convex.h"
#include "oracles/referee/solid/solid.h"
#include "oracles/referee/work.h"

namespace touchstone::referee {
namespace {

// Directions for which a way out is looked for, steps along one of them, and steps of the proof that no place
// before is clear. More of them narrow a bracket.
constexpr std::size_t most_directions = 8;
constexpr int most_steps = 64, most_proof_steps = 40;
// Steps back from a clear place towards a nearer one. The way to it may be this many times as long as the
// best one known.
constexpr int most_returns = 8;
constexpr double most_overshoot = 2;
// Pairs of convex pieces of which the depth is found. More of them narrow a bracket.
constexpr int most_pieces = 24;
// In units of the bodies' size: bodies moved until they touch are moved by this more, which is several
// roundings. A bracket four times as wide is as narrow as it gets.
constexpr double beyond_touching = 0x1p-50, narrow_enough = 0x1p-48;

// A place of B, and how far it is from where it was: an upper and a lower bound.
struct Place {
  Placed b;
  double hi, lo;
};

class Pair {
 public:
  Pair(const Placed& a, const Placed& b) : a_(a), b_(b), as_a_(a), as_b_(b) {
    size_ = bounding_radius(*a.shape) + bounding_radius(*b.shape) +
            (translation_of(b) - translation_of(a)).norm() + translation_of(a).norm() +
            translation_of(b).norm();
  }

  double size() const { return size_; }

  Place moved(double s, const Vec3& n) const {
    const Vec3 to = translation_of(b_) + s * n;
    // The motion is the difference of the two translations, whatever n is.
    const Real3 way = to_real(to) - to_real(translation_of(b_));
    const Real length = norm(way);
    return {with_translation(b_, to), round_up(length * (1 + dot_rounding)),
            round_down(length * (1 - dot_rounding))};
  }

  /// The pairs of parts that meet when B is there.
  struct Met {
    std::size_t i, j;
  };

  /// How far B there is from A, at least; nullopt where it may meet it.
  std::optional<double> clearance(const Placed& b) const {
    const Placed surface_b = with_translation(*as_b_, translation_of(b));
    const PairTruth t = judge_pair(*as_a_, surface_b);
    if (t.verdict != Verdict::disjoint || point_inside(a_, b)) return std::nullopt;
    return std::max(0.0, t.gap.lo);
  }
  bool is_clear(const Placed& b) const { return clearance(b).has_value(); }

  /// How much farther along n the parts of B that meet those of A must move; 0 if none meet.
  double way_past_parts(const Placed& b, const Vec3& n) const {
    const Vec3 origin = translation_of(a_);
    const std::vector<Operand> x = parts_of(*as_a_, origin),
                               y = parts_of(with_translation(*as_b_, translation_of(b)), origin);
    double way = 0;
    for_meeting(x, y, [&](const Operand& p, const Operand& q) { way = std::max(way, width_of(p, q, n)); });
    return way;
  }

  /// How much farther along n until the first part of B is beyond one of A; infinity: all are.
  double way_past_one(const Placed& b, const Vec3& n) const {
    const Vec3 origin = translation_of(a_);
    const std::vector<Operand> x = parts_of(*as_a_, origin),
                               y = parts_of(with_translation(*as_b_, translation_of(b)), origin);
    double way = infinity;
    for (const Operand& p : x)
      for (const Operand& q : y)
        if (const double w = width_of(p, q, n); w > beyond_touching * size_) way = std::min(way, w);
    return way;
  }

  /// Proven: no shorter motion of B from there separates them. 0 where nothing is known.
  double depth_at_least(const Placed& b) const {
    const Placed surface_b = with_translation(*as_b_, translation_of(b));
    const Vec3 origin = translation_of(a_);
    double depth = 0;
    for_meeting(parts_of(*as_a_, origin), parts_of(surface_b, origin),
                [&](const Operand& p, const Operand& q) {
                  depth = std::max(depth, -round_up(judge_convex(p, q).hi));
                });
    for (const Vec3& c : {centre_of(a_), centre_of(b), common_centre(b)})
      depth = std::max(depth, depth_about(c, b, surface_b));
    if (depth > 0) return depth;
    if (const auto p = point_inside(a_, b))
      depth = depth_about({p->x.convert_to<double>(), p->y.convert_to<double>(), p->z.convert_to<double>()},
                          b, surface_b);
    return depth;
  }

  /// Proven: no shorter motion of B separates them, by the convex pieces in both that n leads out of about as
  /// far as out of the bodies. `known`: a bracket; its lower end where nothing better is found.
  double depth_of_pieces(const Vec3& n, Bracket known) const {
    const auto is_narrow = [&] { return !(known.hi - known.lo > narrow_enough * size_); };
    if (is_narrow() || !std::isfinite(known.hi)) return known.lo;
    const std::vector<Operand> x = pieces_of(a_, *as_a_), y = pieces_of(b_, *as_b_);
    int found = 0;
    for (const auto& [i, j] : by_width(x, y, n, known)) {
      if (found == most_pieces || is_narrow()) break;
      const ConvexTruth t = judge_convex(x[i], y[j]);
      found += t.verdict == Verdict::overlap;
      known.lo = std::max(known.lo, -round_up(t.hi));
    }
    return known.lo;
  }

  struct Towards {
    double depth;
    Vec3 n;
  };

  /// Outward normals of the solids' triangles that the other body meets, and the normals of least depth
  /// there; the deepest first.
  std::vector<Towards> ways_out() const {
    const Vec3 origin = translation_of(a_);
    const std::vector<Operand> x = parts_of(*as_a_, origin), y = parts_of(*as_b_, origin);
    std::vector<Towards> r;
    for_meeting(x, y, [&](const Operand& p, const Operand& q) {
      const ConvexTruth t = judge_convex(p, q);
      const double depth = -round_up(t.hi);
      if (is_solid(a_)) r.push_back({depth, outward(p)});
      if (is_solid(b_)) r.push_back({depth, -outward(q)});
      for (const double sign : {1.0, -1.0}) r.push_back({depth, sign * to_double(t.normal)});
    });
    std::stable_sort(r.begin(), r.end(),
                     [](const Towards& p, const Towards& q) { return p.depth > q.depth; });
    return r;
  }

 private:
  template <class F>
  static void for_meeting(const std::vector<Operand>& x, const std::vector<Operand>& y, const F& f) {
    std::vector<Aabb> boxes;
    for (const Operand& q : y) boxes.push_back(box_of(q.body));
    spend(static_cast<std::int64_t>(x.size() * y.size()) * 10);
    for (const Operand& p : x) {
      const Aabb box = box_of(p.body);
      for (std::size_t j = 0; j < y.size(); ++j)
        if (overlaps(box, boxes[j]) &&
            judge_convex(p, y[j], {}, Effort::verdict_only).verdict != Verdict::disjoint)
          f(p, y[j]);
    }
  }

  // Convex sets in the body: with the kernel, each triangle spans a piece.
  std::vector<Operand> pieces_of(const Placed& p, const Placed& surface) const {
    const Vec3 origin = translation_of(a_);
    const TriangleMesh* mesh = triangles_if(*p.shape);
    const std::vector<Vec3> kernel = mesh ? kernel_points(*mesh) : std::vector<Vec3>{};
    if (kernel.empty()) return parts_of(surface, origin);
    std::vector<Operand> r;
    spend(static_cast<std::int64_t>(mesh->triangles.size() * kernel.size()) * 50);
    for (const auto& t : mesh->triangles) {
      std::vector<Vec3> points = kernel;
      for (const int v : t) {
        const Vec3& corner = mesh->vertices[static_cast<std::size_t>(v)];
        if (std::ranges::find(kernel, corner) == kernel.end()) points.push_back(corner);
      }
      Operand piece{make_body(points, 0, frame_of(p, origin)), std::nullopt};
      piece.exact = ExactBody{std::move(points), 0, p.pose};
      r.push_back(std::move(piece));
    }
    return r;
  }

  // Pairs whose boxes meet and of which the depth may exceed what is known; those first that the way along n
  // out of is nearest to that out of the bodies.
  static std::vector<std::pair<std::size_t, std::size_t>> by_width(const std::vector<Operand>& x,
                                                                   const std::vector<Operand>& y,
                                                                   const Vec3& n, const Bracket& known) {
    struct Width {
      double beside;
      std::size_t i, j;
    };
    std::vector<Width> found;
    std::vector<Aabb> boxes;
    for (const Operand& q : y) boxes.push_back(box_of(q.body));
    spend(static_cast<std::int64_t>(x.size() * y.size()) * 10);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Aabb box = box_of(x[i].body);
      for (std::size_t j = 0; j < y.size(); ++j) {
        if (!overlaps(box, boxes[j])) continue;
        spend(static_cast<std::int64_t>(x[i].body.points.size() + y[j].body.points.size()) * 5);
        const double width = width_of(x[i], y[j], n);
        if (width > known.lo) found.push_back({std::abs(width - known.hi), i, j});
      }
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Width& p, const Width& q) { return p.beside < q.beside; });
    std::vector<std::pair<std::size_t, std::size_t>> r;
    for (const Width& w : found) r.emplace_back(w.i, w.j);
    return r;
  }

  // An upper bound of how far q must move along n to be beyond p.
  static double width_of(const Operand& p, const Operand& q, const Vec3& n) {
    const Difference d(p.body, q.body);
    const Real3 u = normalized(to_real(n));
    return round_up(d.width_above(d.support(u), u) + d.radius + d.radius_error);
  }

  static Vec3 outward(const Operand& triangle) {
    const std::vector<Real3>& p = triangle.body.points;
    return to_double(normalized(cross(p[1] - p[0], p[2] - p[0])));
  }

  static Vec3 centre_of(const Placed& p) {
    const TriangleMesh* m = triangles_if(*p.shape);
    const auto* h = hull_if(*p.shape);
    if (!m && !h) return translation_of(p);
    const std::vector<Vec3>& v = m ? m->vertices : h->vertices;
    const Solid s = make_body(v, 0, frame_of(p, Vec3::Zero()));
    Real3 sum;
    for (const Real3& x : s.points) sum = sum + x;
    return to_double((1.0L / static_cast<Real>(s.points.size())) * sum);
  }
  // About the middle of what both boxes have in common.
  Vec3 common_centre(const Placed& b) const {
    const Aabb x = outer_box(*as_a_), y = outer_box(with_translation(*as_b_, translation_of(b)));
    return 0.5 * x.lo.cwiseMax(y.lo) + 0.5 * x.hi.cwiseMin(y.hi);
  }

  // The radius of a ball about c inside the body; not positive, minus the distance of c from it: then only
  // the other body's ball reaches it.
  static double ball_inside(const Placed& p, const Placed& surface, const Vec3& c) {
    static const Shape dot_shape = Sphere{0};
    const Placed point{&dot_shape, Pose{c, {}}};
    if (!is_solid(p)) return -judge_pair(p, point).gap.hi;
    const Bracket d = distance_to(surface, c);
    return is_inside(p, exact(c)) ? d.lo : -d.hi;
  }
  // The sum of both: balls about c of radii r and s need r + s; a ball of radius r and a point at distance d
  // from it, r - d.
  double depth_about(const Vec3& c, const Placed& b, const Placed& surface_b) const {
    const double r = ball_inside(a_, *as_a_, c), s = ball_inside(b, surface_b, c);
    if (r <= 0 && s <= 0) return 0;
    // The other body's point at that distance is in its ball of radius 0.
    return std::max(0.0, std::nextafter(r + s, -infinity));
  }

  const Placed &a_, &b_;
  AsSurface as_a_, as_b_;
  double size_ = 0;
};

// Back along n from a clear place: as far as the bodies are apart, B may move.
double nearest_clear(const Pair& pair, const Vec3& n, double s, double apart) {
  const double little = beyond_touching * pair.size();
  double nearest = pair.moved(s, n).hi;
  for (int step = 0; step < most_returns && apart > 4 * little; ++step) {
    s -= apart - little;
    const Place at = pair.moved(s, n);
    const auto clear = pair.clearance(at.b);
    if (!clear || !(s >= 0)) break;
    nearest = std::min(nearest, at.hi);
    apart = *clear;
  }
  return nearest;
}

// An upper bound of the least motion along n that separates them; infinity if none is found that is less than
// `enough`.
double clear_after(const Pair& pair, const Vec3& n, double enough) {
  double s = 0;
  const double little = beyond_touching * pair.size();
  for (int step = 0; step < most_steps; ++step) {
    const Place at = pair.moved(s, n);
    if (!(at.hi < enough)) return infinity;
    if (step > 0)
      if (const auto apart = pair.clearance(at.b)) return nearest_clear(pair, n, s, *apart);
    double more = pair.way_past_parts(at.b, n);
    if (more == 0) more = pair.way_past_one(at.b, n);
    if (!std::isfinite(more)) return infinity;
    s += std::max(more, 0.0) + little;
  }
  return infinity;
}

void add_hull_normal(const Placed& a, const Placed& b, std::vector<Vec3>& out) {
  Shape own_a, own_b;
  const auto hull = [](const Placed& p, Shape& own) {
    const TriangleMesh* m = triangles_if(*p.shape);
    if (!m) return p;
    Hull h;
    h.vertices = m->vertices;
    own = std::move(h);
    return Placed{&own, p.pose};
  };
  const PairTruth t = judge_pair(hull(a, own_a), hull(b, own_b));
  if (t.verdict == Verdict::overlap && t.normal.allFinite() && !t.normal.isZero(0)) out.push_back(t.normal);
}

}  // namespace

SolidDepth depth_of_solids(const Placed& a, const Placed& b, std::span<const Vec3> hint_directions) {
  const Pair pair(a, b);
  SolidDepth r{{pair.depth_at_least(b), infinity}, Vec3::Zero()};
  std::vector<Vec3> directions;
  add_hull_normal(a, b, directions);
  const auto ways = pair.ways_out();
  if (ways.empty()) {  // one is inside the other: towards the nearest points of the surfaces
    const AsSurface x(a), y(b);
    const Vec3 n = -judge_pair(*x, *y).normal;
    if (!n.isZero(0)) directions.push_back(n);
  }
  for (const Pair::Towards& w : ways)
    if (directions.size() < most_directions && w.n.allFinite() && !w.n.isZero(0)) directions.push_back(w.n);
  for (const Vec3& n : hint_directions)
    if (n.allFinite() && !n.isZero(0)) directions.push_back(n.stableNormalized());
  for (const Vec3& n : directions) {
    const double s = clear_after(pair, n, most_overshoot * r.depth.hi);
    if (!(s < r.depth.hi)) continue;
    r.depth.hi = s;
    r.normal = n;
  }
  r.depth.lo = std::min(pair.depth_of_pieces(r.normal, r.depth), r.depth.hi);
  return r;
}

double depth_at_least(const Placed& a, const Placed& b) { return Pair(a, b).depth_at_least(b); }

Bracket way_along(const Placed& a, const Placed& b, const Vec3& n) {
  const Pair pair(a, b);
  const Vec3 u = n.stableNormalized();
  const double least = beyond_touching * pair.size();
  Bracket r{0, clear_after(pair, u, infinity)};
  if (pair.is_clear(b)) return {0, 0};
  r.lo = std::max(0.0, pair.depth_of_pieces(u, r));
  double s = r.lo;
  for (int step = 0; step < most_proof_steps; ++step) {
    const Place at = pair.moved(s, u);
    const double more = pair.depth_at_least(at.b);
    // The place is beside the line by a rounding, less than `least`.
    r.lo = std::max(r.lo, at.lo + more - least);
    if (more <= 2 * least || r.lo >= r.hi) break;
    s = at.lo + more - least;
  }
  r.lo = std::min(std::max(r.lo, 0.0), r.hi);
  return r;
}

}  // namespace touchstone::referee
