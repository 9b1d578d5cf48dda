#include "core/narrow/solid_depth.h"

#include <algorithm>
#include <functional>

#include "core/math/aabb.h"
#include "core/math/roundoff.h"
#include "core/narrow/mesh.h"
#include "core/narrow/solid.h"

namespace touchstone::narrow {
namespace {

// Directions tried for one pair, and motions along one of them: each passes a triangle at least. Then motions
// back along it, and directions found where the bodies touch at its end.
constexpr std::size_t most_directions = 96;
// Directions whose cosine is larger lead out equally far.
constexpr double same_cosine = 1 - 1e-12;
constexpr int most_steps = 1024, most_returns = 32, most_halvings = 52, most_turns = 256;
// A way is followed back from its end when that is at most this many times as far as the best way known.
constexpr double most_overshoot = 4;
// The shortest ways found first, each of which is turned.
constexpr std::size_t most_starts = 8;
// Turns of a direction by less than this do not matter. So many ways in a row may be no shorter than the
// best.
constexpr double same_direction = 0x1p-30;
constexpr int most_in_vain = 8;
// A motion that is this part of the best shorter is tried all around and near the best; near is this far off,
// of unit length. So often one may be found.
constexpr double shorter = 0.02, near_offset = 0.25;
constexpr int most_shorter = 64;
// Parts of bodies nearly touch that are this much of the bodies' size apart; of such pairs, at most so many.
constexpr double near_factor = 0x1p-16;
constexpr std::size_t most_planes = 12;

// From the middle of a cube to its corners and to the middles of its edges and faces.
std::vector<Vec3> directions_around() {
  std::vector<Vec3> r;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0) r.push_back(Vec3(x, y, z).normalized());
  return r;
}

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

Vec3 in_frame_of(const PlacedShape& p, const Vec3& n) {
  return rotation_matrix(p.pose.rotation).transpose() * n;
}
Interval<double> extent(const Shape& shape, const Vec3& local) {
  return std::visit([&](const auto& s) { return s.extent_along(local); }, shape);
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

// A motion of B that separates them.
struct Way {
  Vec3 normal;
  double depth;
};

class Search {
 public:
  Search(const SeenShape& a, const SeenShape& b)
      : a_(a), b_(b), parts_a_(parts_of(a)), parts_b_(parts_of(b)) {
    apart_ = b.placed().pose.translation - a.placed().pose.translation;
    size_ = a.placed().bounding_radius() + b.placed().bounding_radius() + apart_.norm();
    // Bodies moved until they touch are taken to be clear this much farther on: some roundings of the
    // lengths.
    constexpr double roundings = 8;
    clear_ = roundings * double_roundoff *
             (size_ + a.placed().pose.translation.norm() + b.placed().pose.translation.norm());
    for (const Part& p : parts_a_) boxes_a_.push_back(box(p.placed));
    for (const Part& p : parts_b_) boxes_b_.push_back(box(p.placed));
  }

  std::optional<WayOut> run(const DistanceAnswer& apart) {
    const std::vector<Meeting> meetings = meetings_here();
    std::vector<Way> found = ways_past_all(meetings);
    double least = infinity;
    for (const Way& w : found) least = std::min(least, w.depth);
    for (const Vec3& n : directions(meetings, apart)) {
      const double far = way_along(n, most_overshoot * least);
      if (!std::isfinite(far)) continue;
      found.push_back({n, shortened(far, n)});
      least = std::min(least, found.back().depth);
    }
    if (found.empty()) return std::nullopt;
    std::ranges::stable_sort(found, {}, &Way::depth);
    if (found.size() > most_starts) found.resize(most_starts);
    for (Way& w : found) turn(w);
    std::ranges::stable_sort(found, {}, &Way::depth);
    find_shorter(found);
    for (const Way& w : found) {
      const DistanceAnswer d = distance_after(w.depth, w.normal);
      const Vec3 by = (w.depth + clear_) * w.normal;
      if (d.outcome != Outcome::answered || !(d.distance > 0) || is_inside(by)) continue;
      const double at_least = std::min(depth_of_parts(meetings), w.depth);
      return WayOut{w.normal, w.depth, at_least, {d.witness[0], d.witness[1] - by}};
    }
    return std::nullopt;
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
      const Interval<double> e = extent(*p.shape, in_frame_of(p, Vec3::Unit(k)));
      r.lo[k] = at[k] + e.lo - clear_;
      r.hi[k] = at[k] + e.hi + clear_;
    }
    return r;
  }

  // The pairs of parts that meet when B is moved.
  std::vector<Met> met_after(const Vec3& by) const {
    std::vector<Met> r;
    for (std::size_t j = 0; j < parts_b_.size(); ++j) {
      const Aabb box{boxes_b_[j].lo + by, boxes_b_[j].hi + by};
      const PlacedShape b = moved(parts_b_[j].placed, by);
      for (std::size_t i = 0; i < parts_a_.size(); ++i)
        if (overlaps(boxes_a_[i], box) && overlap(parts_a_[i].placed, b).overlap) r.push_back({i, j});
    }
    return r;
  }

  Reach reach(const Vec3& n) const {
    Reach r{n, n.dot(apart_), {}, {}};
    const Vec3 in_a = in_frame_of(a_.placed(), n), in_b = in_frame_of(b_.placed(), n);
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
      if (d.outcome != Outcome::answered) break;
      const double speed = n.dot(d.normal);
      if (!(d.distance > 2 * clear_)) return speed > 0 ? settled(way, n, 2 * clear_ / speed) : way;
      const double apart = d.distance - clear_, to_plane = way - apart / speed;
      const bool is_far = speed > 0 && to_plane >= 0 && is_clear(to_plane, n);
      way = is_far ? to_plane : std::max(0.0, way - apart);
    }
    return way;
  }

  // Bodies that slide along each other where they touch are a rounding apart over a long way: the nearest
  // clear place within `unknown` before this one.
  double settled(double way, const Vec3& n, double unknown) const {
    double clear = way, met = std::max(0.0, way - unknown);
    for (int step = 0; step < most_halvings && clear - met > 2 * clear_; ++step) {
      const double middle = (clear + met) / 2;
      (is_clear(middle, n) ? clear : met) = middle;
    }
    return clear;
  }

  // Where the two touch at the end of the way, planes part them. The shortest motion past these planes is
  // the next way, at the end of which the planes are found anew: sequential quadratic programming
  // (Nocedal, Wright 2006, §18.1) without second derivatives. A way may be longer than the last.
  void turn(Way& best) const {
    std::vector<Plane> planes;
    Way last = best;
    for (int step = 0, since_best = 0; step < most_turns && since_best < most_in_vain; ++step) {
      planes = planes_at((last.depth + clear_) * last.normal, planes);
      const Vec3 by = shortest_past(planes), n = by.stableNormalized();
      if (by.isZero(0) || (n - last.normal).norm() <= same_direction) return;
      const double far = is_clear(by.norm(), n) ? by.norm() : way_along(n, most_overshoot * best.depth);
      if (!std::isfinite(far)) return;
      last.depth = shortened(far, n);
      last.normal = n;
      ++since_best;
      if (!(last.depth < best.depth)) continue;
      best = last;
      since_best = 0;
    }
  }

  // Bodies that are not convex may be clear in a direction to which no way found above turned: a way passes
  // each part that it meets as a whole. So, near the best and all around, a motion that is shorter than the
  // best is tried; where B is then clear, a shorter way begins.
  void find_shorter(std::vector<Way>& found) const {
    const std::vector<Vec3> around = directions_around();
    for (int step = 0; step < most_shorter; ++step) {
      const Way best = found.front();
      const double depth = (1 - shorter) * best.depth;
      std::vector<Vec3> tried;
      for (const Vec3& v : around) tried.push_back((best.normal + near_offset * v).normalized());
      tried.insert(tried.end(), around.begin(), around.end());
      const auto n = std::ranges::find_if(tried, [&](const Vec3& v) { return is_clear(depth, v); });
      if (n == tried.end()) return;
      Way w{*n, shortened(depth, *n)};
      turn(w);
      found.insert(found.begin(), w);
    }
  }

  // Two parts that meet, and how deep.
  struct Meeting {
    Met parts;
    Separation depth;
  };

  std::vector<Meeting> meetings_here() const {
    std::vector<Meeting> r;
    for (const Met& m : met_after(Vec3::Zero()))
      r.push_back({m, separation(parts_a_[m.a].placed, parts_b_[m.b].placed)});
    return r;
  }

  // Proven: no motion shorter than this separates the parts, and so the bodies.
  static double depth_of_parts(const std::vector<Meeting>& meetings) {
    double r = 0;
    for (const auto& [m, s] : meetings)
      if (s.outcome == Outcome::answered)
        r = std::max(r, static_cast<double>(-s.gap) - static_cast<double>(s.slack));
    return r;
  }

  // The directions in which B leaves the faces of solids that meet.
  std::vector<Vec3> ways_out(const Met& m) const {
    std::vector<Vec3> r;
    for (const Vec3& n : {parts_a_[m.a].outward, Vec3(-parts_b_[m.b].outward)})
      if (!n.isZero(0)) r.push_back(n);
    return r;
  }

  // The shortest motions past the planes of all faces that the bodies meet, and past those of least depth.
  std::vector<Way> ways_past_all(const std::vector<Meeting>& meetings) const {
    std::vector<Way> r;
    std::vector<Plane> faces, least;
    for (const auto& [m, s] : meetings) {
      for (const Vec3& n : ways_out(m)) faces.push_back({m, n, width(m, n), 0});
      if (s.outcome == Outcome::answered)
        least.push_back({m, s.normal.cast<double>(), -static_cast<double>(s.gap), 0});
    }
    for (std::vector<Plane>* planes : {&faces, &least}) {
      // Faces that slide along each other are met again unless some roundings are between them.
      for (Plane& p : *planes) p.least += 2 * clear_;
      std::ranges::stable_sort(*planes, std::greater<>(), &Plane::least);
      if (planes->size() > most_planes) planes->resize(most_planes);
      const Vec3 by = shortest_past(*planes);
      const Vec3 n = by.stableNormalized();
      if (!by.isZero(0) && is_clear(by.norm(), n)) r.push_back({n, shortened(by.norm(), n)});
    }
    return r;
  }

  double width(const Met& m, const Vec3& n) const {
    const auto along = [&](const Part& p) { return extent(*p.placed.shape, in_frame_of(p.placed, n)); };
    return along(parts_a_[m.a]).hi - along(parts_b_[m.b]).lo - n.dot(apart_);
  }

  // A plane that keeps two parts apart: they are where a motion t of B has n·t >= least.
  struct Plane {
    Met parts;
    Vec3 n;
    double least, apart;
  };

  // The planes between the parts that nearly touch when B is moved there, and between those of `known`. The
  // nearest come first.
  std::vector<Plane> planes_at(const Vec3& by, const std::vector<Plane>& known) const {
    const double near = near_factor * size_;
    std::vector<Plane> r;
    for (std::size_t j = 0; j < parts_b_.size(); ++j) {
      const Vec3 margin = Vec3::Constant(near);
      const Aabb box{boxes_b_[j].lo + by - margin, boxes_b_[j].hi + by + margin};
      const PlacedShape b = moved(parts_b_[j].placed, by);
      for (std::size_t i = 0; i < parts_a_.size(); ++i) {
        const bool is_known =
            std::ranges::any_of(known, [&](const Plane& p) { return p.parts.a == i && p.parts.b == j; });
        if (!is_known && !overlaps(boxes_a_[i], box)) continue;
        const DistanceAnswer d = distance(parts_a_[i].placed, b);
        if (d.outcome == Outcome::answered && (is_known || d.distance <= near) && !d.normal.isZero(0))
          r.push_back({{i, j}, d.normal, by.dot(d.normal) - d.distance, d.distance});
      }
    }
    std::ranges::stable_sort(r, {}, &Plane::apart);
    if (r.size() > most_planes) r.resize(most_planes);
    return r;
  }

  // The shortest motion past up to three of the planes that is past all; zero: none is. None is longer than
  // it takes to separate the bounding spheres: planes that are nearly parallel meet anywhere.
  Vec3 shortest_past(const std::vector<Plane>& planes) const {
    Vec3 best = Vec3::Zero();
    const auto consider = [&](const Vec3& t) {
      const auto is_past = [&](const Plane& p) { return p.n.dot(t) >= p.least - clear_; };
      const bool is_shorter = best.isZero(0) || t.squaredNorm() < best.squaredNorm();
      if (t.squaredNorm() <= size_ * size_ && is_shorter && std::ranges::all_of(planes, is_past)) best = t;
    };
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const Plane& p = planes[i];
      consider(p.least * p.n);
      for (std::size_t j = i + 1; j < planes.size(); ++j) {
        const Plane& q = planes[j];
        const double cosine = p.n.dot(q.n), sine_sq = p.n.cross(q.n).squaredNorm();
        consider(((p.least - cosine * q.least) * p.n + (q.least - cosine * p.least) * q.n) / sine_sq);
        for (std::size_t k = j + 1; k < planes.size(); ++k) {
          Mat3 m;
          m << p.n.transpose(), q.n.transpose(), planes[k].n.transpose();
          consider(m.fullPivLu().solve(Vec3(p.least, q.least, planes[k].least)));
        }
      }
    }
    return best;
  }

  struct Towards {
    double depth;
    Vec3 n;
  };

  std::vector<Vec3> directions(const std::vector<Meeting>& meetings, const DistanceAnswer& apart) const {
    std::vector<Towards> found;
    for (const auto& [m, s] : meetings) {
      const auto depth = static_cast<double>(-s.gap);
      if (s.outcome == Outcome::answered)
        for (const double sign : {1.0, -1.0}) found.push_back({depth, sign * s.normal.cast<double>()});
      for (const Vec3& n : ways_out(m)) found.push_back({depth, n});
    }
    if (found.empty()) {  // one is inside the other: towards the nearest points, and across each face
      found.push_back({infinity, -apart.normal});
      for (const Part& p : parts_a_)
        if (!p.outward.isZero(0)) found.push_back({0, p.outward});
      for (const Part& p : parts_b_)
        if (!p.outward.isZero(0)) found.push_back({0, -p.outward});
    }
    std::ranges::stable_sort(found, std::greater<>(), &Towards::depth);
    std::vector<Vec3> r;
    const ContactAnswer hulls = contact(a_.hull(), b_.hull());
    if (hulls.outcome == Outcome::answered && hulls.overlap) r.push_back(hulls.normal);
    for (const Towards& t : found) {
      const bool is_known = std::ranges::any_of(r, [&](const Vec3& n) { return n.dot(t.n) > same_cosine; });
      if (!is_known && r.size() < most_directions) r.push_back(t.n);
    }
    return r;
  }

  const SeenShape &a_, &b_;
  std::vector<Part> parts_a_, parts_b_;
  std::vector<Aabb> boxes_a_, boxes_b_;
  Vec3 apart_;
  double size_ = 0, clear_ = 0;
};

}  // namespace

std::optional<WayOut> way_out(const SeenShape& a, const SeenShape& b, const DistanceAnswer& apart) {
  return Search(a, b).run(apart);
}

}  // namespace touchstone::narrow
