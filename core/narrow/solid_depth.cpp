#include "core/narrow/solid_depth.h"

#include <algorithm>
#include <limits>

#include "core/math/roundoff.h"
#include "core/narrow/filtered/query.h"
#include "core/narrow/mesh.h"
#include "core/narrow/mesh_pairs.h"
#include "core/narrow/solid.h"
#include "core/tolerance.h"

namespace touchstone::narrow {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Directions tried for one pair, and motions along one of them: each passes a triangle at least. Then motions
// back along it, and directions found where the bodies touch at its end.
constexpr std::size_t most_directions = 96;
constexpr int most_steps = 1024, most_returns = 32, most_turns = 256;
// A way is followed back from its end when that is at most this many times as far as the best way known.
constexpr double most_overshoot = 2;

PlacedShape moved(const PlacedShape& p, const Vec3& by) {
  PlacedShape r = p;
  r.pose.translation += by;
  return r;
}

// A convex part of what is seen of a body: a triangle, or all of it.
struct Part {
  Shape own;  // a triangle as a hull
  PlacedShape placed;
  Vec3 outward = Vec3::Zero();  // of a solid's triangle, world; zero: none

  Part(const PlacedShape& whole) : placed(whole) {}
  Part(const PlacedShape& mesh, const std::array<Vec3, 3>& c, bool is_solid)
      : own(make_hull({c[0], c[1], c[2]})), placed(&own, mesh.pose) {
    const Vec3 n = (c[1] - c[0]).cross(c[2] - c[0]);
    if (is_solid && n.norm() > 0) outward = rotation_matrix(mesh.pose.rotation) * n.normalized();
  }
  Part(Part&& o) : own(std::move(o.own)), placed(o.placed), outward(o.outward) {
    if (o.placed.shape == &o.own) placed.shape = &own;
  }
};

Interval<double> extent_along(const PlacedShape& p, const Vec3& n) {
  const Vec3 local = rotation_matrix(p.pose.rotation).transpose() * n;
  return std::visit([&](const auto& s) { return s.extent_along(local); }, *p.shape);
}

struct Met {
  std::size_t a, b;
};

// How far the parts reach along a direction: A's forward, B's backward.
struct Reach {
  Vec3 n;
  double apart;
  std::vector<double> a, b;
  // How far B's part must move along n to be beyond A's.
  double width(const Met& m) const { return a[m.a] - b[m.b] - apart; }
};

class Search {
 public:
  Search(const SeenShape& a, const SeenShape& b)
      : a_(a), b_(b), parts_a_(parts_of(a)), parts_b_(parts_of(b)) {
    apart_ = b.placed().pose.translation - a.placed().pose.translation;
    const double size = a.placed().bounding_radius() + b.placed().bounding_radius() + apart_.norm();
    // Bodies moved until they touch are taken to be clear this much farther on: some roundings of the
    // lengths.
    constexpr double roundings = 8;
    clear_ = roundings * double_roundoff *
             (size + a.placed().pose.translation.norm() + b.placed().pose.translation.norm());
    for (const Part& p : parts_a_) boxes_a_.push_back(box(p.placed));
    for (const Part& p : parts_b_) boxes_b_.push_back(box(p.placed));
  }

  std::optional<WayOut> run(const DistanceAnswer& apart) {
    WayOut best{Vec3::Zero(), infinity, 0, {}};
    for (const Vec3& n : directions(apart)) take_if_shorter(n, best);
    if (!std::isfinite(best.depth)) return std::nullopt;
    turn(best);
    best.at_least = std::min(at_least_, best.depth);
    const Vec3 way = (best.depth + clear_) * best.normal;
    const DistanceAnswer d = distance(a_.seen(), moved(b_.seen(), way));
    if (d.outcome != Outcome::answered) return std::nullopt;
    best.witness = {d.witness[0], d.witness[1] - way};
    return best;
  }

 private:
  static std::vector<Part> parts_of(const SeenShape& x) {
    std::vector<Part> r;
    const auto* mesh = std::get_if<TriangleMesh>(x.seen().shape);
    if (!mesh) {
      r.emplace_back(x.seen());
      return r;
    }
    r.reserve(mesh->triangles.size());
    for (std::size_t i = 0; i < mesh->triangles.size(); ++i)
      r.emplace_back(x.seen(), corners(*mesh, i), x.inside() != nullptr);
    return r;
  }

  // Relative to A's origin, along the axes of the world.
  Aabb box(const PlacedShape& p) const {
    Aabb r;
    const Vec3 at = p.pose.translation - a_.placed().pose.translation;
    for (int k = 0; k < 3; ++k) {
      const Interval<double> e = extent_along(p, Vec3::Unit(k));
      r.lo[k] = at[k] + e.lo - clear_;
      r.hi[k] = at[k] + e.hi + clear_;
    }
    return r;
  }

  // The pairs of parts that meet when B is moved.
  std::vector<Met> met_after(const Vec3& by) const {
    std::vector<Met> r;
    for (std::size_t j = 0; j < parts_b_.size(); ++j) {
      const Vec3 lo = boxes_b_[j].lo + by, hi = boxes_b_[j].hi + by;
      const PlacedShape b = moved(parts_b_[j].placed, by);
      for (std::size_t i = 0; i < parts_a_.size(); ++i) {
        if ((boxes_a_[i].lo.array() > hi.array()).any() || (lo.array() > boxes_a_[i].hi.array()).any())
          continue;
        if (overlap(parts_a_[i].placed, b).overlap) r.push_back({i, j});
      }
    }
    return r;
  }

  Reach reach(const Vec3& n) const {
    Reach r{n, n.dot(apart_), {}, {}};
    const auto along = [&](const PlacedShape& whole) {
      return Vec3(rotation_matrix(whole.pose.rotation).transpose() * n);
    };
    const auto extent = [](const Shape& shape, const Vec3& local) {
      return std::visit([&](const auto& s) { return s.extent_along(local); }, shape);
    };
    const Vec3 in_a = along(a_.placed()), in_b = along(b_.placed());
    for (const Part& p : parts_a_) r.a.push_back(extent(*p.placed.shape, in_a).hi);
    for (const Part& p : parts_b_) r.b.push_back(extent(*p.placed.shape, in_b).lo);
    return r;
  }

  bool is_inside(const Vec3& by) const {
    const SeenShape there = b_.moved(by);
    return contains_part(a_, there) || contains_part(there, a_);
  }

  // The next place along n where B is beyond another part, for bodies one of which is inside the other.
  double next_part(const Reach& r, double from) const {
    double next = infinity;
    for (std::size_t i = 0; i < parts_a_.size(); ++i)
      for (std::size_t j = 0; j < parts_b_.size(); ++j)
        if (const double w = r.width({i, j}); w > from) next = std::min(next, w);
    return next;
  }

  // A motion along n after which B is beyond each part that it met on the way, and clear of A; infinity when
  // it is not less than `enough`.
  double way_along(const Vec3& n, double enough) const {
    const Reach r = reach(n);
    double way = 0;
    for (int step = 0; step < most_steps && way < enough; ++step) {
      const Vec3 by = (way + clear_) * n;
      const std::vector<Met> met = met_after(by);
      if (met.empty() && !is_inside(by)) return way;
      double next = met.empty() ? next_part(r, way + clear_) : way + clear_;
      for (const Met& m : met) next = std::max(next, r.width(m));
      way = next;
    }
    return infinity;
  }

  DistanceAnswer distance_after(double way, const Vec3& n) const {
    return distance(a_.seen(), moved(b_.seen(), (way + clear_) * n));
  }

  bool is_clear(double way, const Vec3& n) const {
    const Vec3 by = (way + clear_) * n;
    return met_after(by).empty() && !is_inside(by);
  }

  // Back from a place where B is clear until the two touch. As far as they are apart, B may move; as far as
  // along the nearest planes between them, if it is then clear of all else.
  double shortened(double way, const Vec3& n) const {
    for (int step = 0; step < most_returns; ++step) {
      const DistanceAnswer d = distance_after(way, n);
      if (d.outcome != Outcome::answered || !(d.distance > 2 * clear_)) break;
      const double apart = d.distance - clear_, speed = n.dot(d.normal), to_plane = way - apart / speed;
      const bool is_far = speed > 0 && to_plane >= 0 && is_clear(to_plane, n);
      way = is_far ? to_plane : std::max(0.0, way - apart);
    }
    return way;
  }

  bool take_if_shorter(const Vec3& n, WayOut& best) const {
    const double far = way_along(n, most_overshoot * best.depth);
    if (!std::isfinite(far)) return false;
    const double way = shortened(far, n);
    if (!(way < best.depth)) return false;
    best.depth = way;
    best.normal = n;
    return true;
  }

  // Where the two touch at the end of the way, they may be apart sooner along the normal of that contact.
  void turn(WayOut& best) const {
    for (int step = 0; step < most_turns; ++step) {
      const DistanceAnswer d = distance_after(best.depth, best.normal);
      if (d.outcome != Outcome::answered || d.normal.isZero(0)) return;
      if (!take_if_shorter(d.normal, best)) return;
    }
  }

  struct Towards {
    double depth;
    Vec3 n;
  };

  // Of a pair of parts that meet: the least depth of the two, and the ways out of the solids' faces.
  void add(const Met& m, std::vector<Towards>& out) {
    const Part &a = parts_a_[m.a], &b = parts_b_[m.b];
    const Separation s = separation(a.placed, b.placed);
    const auto depth = static_cast<double>(-s.gap);
    if (s.outcome == Outcome::answered) {
      at_least_ = std::max(at_least_, depth - static_cast<double>(s.slack));
      for (const double sign : {1.0, -1.0}) out.push_back({depth, sign * s.normal.cast<double>()});
    }
    if (!a.outward.isZero(0)) out.push_back({depth, a.outward});
    if (!b.outward.isZero(0)) out.push_back({depth, -b.outward});
  }

  std::vector<Vec3> directions(const DistanceAnswer& apart) {
    std::vector<Towards> found;
    for (const Met& m : met_after(Vec3::Zero())) add(m, found);
    if (found.empty()) {  // one is inside the other: towards the nearest points, and across each face
      found.push_back({infinity, -apart.normal});
      for (const Part& p : parts_a_)
        if (!p.outward.isZero(0)) found.push_back({0, p.outward});
      for (const Part& p : parts_b_)
        if (!p.outward.isZero(0)) found.push_back({0, -p.outward});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Towards& x, const Towards& y) { return x.depth > y.depth; });
    std::vector<Vec3> r;
    const ContactAnswer hulls = contact(a_.hull(), b_.hull());
    if (hulls.outcome == Outcome::answered && hulls.overlap) r.push_back(hulls.normal);
    for (const Towards& t : found) {
      constexpr double same = 1 - 1e-12;  // cosine of directions that lead out equally far
      const bool is_known = std::ranges::any_of(r, [&](const Vec3& n) { return n.dot(t.n) > same; });
      if (!is_known && r.size() < most_directions) r.push_back(t.n);
    }
    return r;
  }

  const SeenShape &a_, &b_;
  std::vector<Part> parts_a_, parts_b_;
  std::vector<Aabb> boxes_a_, boxes_b_;
  Vec3 apart_;
  double clear_ = 0, at_least_ = 0;
};

}  // namespace

std::optional<WayOut> way_out(const SeenShape& a, const SeenShape& b, const DistanceAnswer& apart) {
  return Search(a, b).run(apart);
}

}  // namespace touchstone::narrow
