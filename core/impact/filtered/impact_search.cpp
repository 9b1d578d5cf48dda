#include "core/impact/filtered/impact_search.h"

#include "core/impact/filtered/feature_turn.h"

namespace touchstone::impact::filtered {
namespace {

constexpr int step_cap = 20000;
// Far from contact, a direction accurate to a tenth of the gap carries as far as the best.
constexpr double far_accuracy = 0.1;
// A step ends two errors before contact; the direction accounts for a few more.
constexpr double near_enough = 8;
// Below this many errors of the gap, rotations are computed in extended precision.
constexpr double precise_errors = 512;

// Distances by which bodies are pushed apart to find their nearest points (improve_points), in units of size.
constexpr double pushes[] = {0x1p-20, 0x1p-13, 0x1p-7};

// In units of size: witness points that are farther apart across n than this are visibly wrong.
constexpr double visible = 0x1p-30;

View look_at_plane(const Sweep& w, const Spot& x, const Vec& n) {
  View v;
  v.normal = n;
  v.side = w.along(x, n);
  v.upper = v.side.s;
  return v;
}

// Nearest points relative to A's origin; the ball of each core is added along their own difference.
void set_points(Search& r, const Sweep& w, const Spot& x, const View& v, const Features& f) {
  r.normal = v.normal;
  r.a = Vec::Zero();
  r.b = Vec::Zero();
  for (int i = 0; i < std::min(f.size, 3); ++i) {
    const auto k = static_cast<std::size_t>(i);
    r.a += f.weight[k] * (x.ra * f.a[k]);
    r.b += f.weight[k] * (x.rb * f.b[k]);
  }
  if (f.size == 0) {  // a plane
    r.a = v.side.pa;
    r.b = r.a + v.normal * (v.side.s + w.radii());
  } else {
    r.b += x.offset;
  }
  const Vec d = r.b - r.a;
  const double length = d.norm();
  const Vec n = length > 0 && w.radii() > 0 ? Vec(d / length) : v.normal;
  r.a += w.a().body.radius * n;
  r.b -= w.b().body.radius * n;
}

// Features that are nearly parallel, or roll on each other, do not reveal which of them the direction
// follows, and a wrong guess proves steps that shrink by a constant factor. After this many steps every guess
// is tried.
constexpr int steps_before_trying_all = 8;

// The farthest of all: rotating with either body, fixed, and as it has rotated since the last look.
Followed follow_any(const Sweep& w, const Spot& x, const View& v, const Vec& seen, double end,
                    Followed best) {
  const Vec still = Vec::Zero();
  for (const Vec* turn : {&still, &w.a().angular, &w.b().angular, &seen}) {
    if (best.clear) break;
    const Followed f = follow(w, x, v, *turn, end);
    if (f.clear || f.spot.t > best.spot.t) best = f;
  }
  return best;
}

struct Direction {
  double t = 0;
  Vec normal = Vec::Zero();
};

// Advances from one look to the next.
Followed follow_guess(const Sweep& w, const Spot& x, const View& v, const Features& features, Direction& last,
                      int steps, double end) {
  const bool near = w.turns() && v.side.s < w.a().body.reach + w.b().body.reach;
  Followed f = follow(w, x, v, near ? feature_turn(w, x, features, v.normal) : Vec(Vec::Zero()), end);
  if (steps >= steps_before_trying_all && w.turns()) {
    const double since = x.t - last.t;
    const Vec seen = since > 0 ? Vec(last.normal.cross(v.normal) / since) : Vec(Vec::Zero());
    f = follow_any(w, x, v, seen, end, f);
  }
  last = {x.t, v.normal};
  return f;
}

// Distance of the witness points from a true contact, less a few errors: along n and across it.
double witness_error(const Search& r, double error) {
  const Vec d = r.b - r.a;
  const double along = d.dot(r.normal);
  const double e =
      std::max({along - 16 * error, -8 * error - along, (d - along * r.normal).norm() - 64 * error, 0.0});
  return std::isfinite(e) ? e : std::numeric_limits<double>::infinity();
}

// For a hit whose features are too close to each other (a simplex of length 0 has no direction): B is pushed
// along n by h, which preserves n and the nearest points and makes the gap longer by h. Bounds that differ by
// e leave the points √(2he) off across n, and e off along it. Keeps the best result; a short h is tried
// first.
void improve_points(Search& r, const Sweep& w, const Spot& hit, const Features& near) {
  const double size = w.a().body.reach + w.b().body.reach + w.radii();
  double best = witness_error(r, hit.error);
  for (const double share : pushes)
    for (const bool warm : {true, false}) {
      if (!(best > 0)) return;
      Spot x = hit;
      const Vec away = r.normal * std::max(0.0, share * size - w.radii());
      x.offset += away;
      Features f = warm ? near : Features{};
      View v = look(w, x, f, 0, x.error / 2);
      if (f.size == 0 || f.size > 3) continue;
      v.normal = r.normal;
      Search tried = r;
      set_points(tried, w, x, v, f);
      tried.b -= away;
      if (const double e = witness_error(tried, hit.error); e < best) {
        best = e;
        r = tried;
      }
    }
}

// Whether the points are farther apart along n than the gap may be, or visibly apart across it.
bool is_rough(const Search& r, const Sweep& w, double accuracy) {
  const Vec d = r.b - r.a;
  const double along = d.dot(r.normal), size = w.a().body.reach + w.b().body.reach + w.radii();
  return !(std::abs(along) <= accuracy && (d - along * r.normal).norm() <= visible * size);
}

}  // namespace

Search with_points(const Sweep& w, Search hit, double accuracy) {
  const Spot x = w.at(hit.clear_until, true);
  hit.b = Vec::Constant(std::numeric_limits<double>::infinity());
  improve_points(hit, w, x, {});
  hit.rough = is_rough(hit, w, accuracy);
  return hit;
}

Search search(const Sweep& w, double start, double end, double accuracy, const std::optional<Vec>& plane) {
  Search r;
  Features features;
  Spot x = w.at(start, !w.turns());
  Direction last{start};
  const auto see = [&] {
    return plane ? look_at_plane(w, x, *plane) : look(w, x, features, far_accuracy, x.error);
  };
  for (r.steps = 0; r.steps < step_cap; ++r.steps) {
    View v = see();
    r.clear_until = x.t;
    r.gap = v.upper;
    if (!x.precise && v.side.s < precise_errors * x.error) {
      x = w.at(x.t, true);
      v = see();
    }
    if (v.meeting || !(v.side.s > x.error)) {
      r.end = x.t > start ? SearchEnd::unsure : SearchEnd::start;
      return r;
    }
    if (v.upper + x.error <= std::min(accuracy, near_enough * x.error)) {
      set_points(r, w, x, v, features);
      if (!plane) {
        improve_points(r, w, x, features);
        r.rough = is_rough(r, w, accuracy);
      }
      r.gap = v.upper;
      r.end = SearchEnd::hit;
      return r;
    }
    if (x.t >= end) {
      r.end = SearchEnd::clear;
      return r;
    }
    const double before = x.t;
    const Followed f =
        plane ? follow(w, x, v, Vec::Zero(), end) : follow_guess(w, x, v, features, last, r.steps, end);
    if (f.clear) {
      r.clear_until = end;
      r.end = SearchEnd::clear;
      return r;
    }
    if (!(f.spot.t > before)) {
      r.end = SearchEnd::unsure;
      return r;
    }
    x = f.spot;
  }
  r.end = SearchEnd::unsure;
  return r;
}

ImpactAnswer answer_of(const Search& s, const Vec& linear_a) {
  ImpactAnswer r;
  r.steps = s.steps;
  r.clear_until = s.clear_until;
  r.separation = s.gap;
  if (s.end != SearchEnd::hit) return r;
  r.toi = s.clear_until;
  r.normal_ab = s.normal;
  const Vec origin = s.clear_until * linear_a;
  r.witness_w = {Vec3(s.a + origin), Vec3(s.b + origin)};
  return r;
}

}  // namespace touchstone::impact::filtered
