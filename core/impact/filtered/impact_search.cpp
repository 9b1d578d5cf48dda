#include "core/impact/filtered/impact_search.h"

#include "core/impact/filtered/feature_turn.h"

namespace touchstone::ccd::fast {
namespace {

constexpr int step_cap = 20000;
// Far from contact a direction that is good to a tenth of the gap carries as far as the best.
constexpr double far_look = 0.1;
// A step ends two errors before contact; a few more are the direction's.
constexpr double near_enough = 8;
// Below so many errors of the gap, rotations are worked out in extended precision.
constexpr double near_errors = 512;

View look_at_plane(const Sweep& w, const Spot& x, const Vec& n) {
  View v;
  v.normal = n;
  v.side = w.along(x, n);
  v.upper = v.side.s;
  return v;
}

// Nearest points about A's origin; the ball of each core is added along their own difference.
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

// Two features that are nearly parallel, or roll on each other, hide which of them the direction goes with: a
// wrong guess proves steps that shrink by a constant. After this many steps every guess is followed.
constexpr int sure_steps = 8;

// The farthest of all: with either body, still, and as it has turned since the last look.
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

// From one look towards the next.
Followed go_on(const Sweep& w, const Spot& x, const View& v, const Features& features, Direction& last,
               int steps, double end) {
  const bool near = w.turns() && v.side.s < w.a().body.reach + w.b().body.reach;
  Followed f = follow(w, x, v, near ? feature_turn(w, x, features, v.normal) : Vec(Vec::Zero()), end);
  if (steps >= sure_steps && w.turns()) {
    const double since = x.t - last.t;
    const Vec seen = since > 0 ? Vec(last.normal.cross(v.normal) / since) : Vec(Vec::Zero());
    f = follow_any(w, x, v, seen, end, f);
  }
  last = {x.t, v.normal};
  return f;
}

// How far the points are from being where the bodies meet, but for a few errors: along n, and across it.
double off(const Search& r, double error) {
  const Vec d = r.b - r.a;
  const double along = d.dot(r.normal);
  const double e =
      std::max({along - 16 * error, -8 * error - along, (d - along * r.normal).norm() - 64 * error, 0.0});
  return std::isfinite(e) ? e : std::numeric_limits<double>::infinity();
}

// Where a hit's features are too near each other to tell (a simplex of length 0 has no direction): B is
// pushed along n by h, which leaves n and the nearest points as they are and the gap h longer. Bounds that
// are e apart leave the points √(2he) across n, and e along it. The best of what is found; a short h first.
void improve_points(Search& r, const Sweep& w, const Spot& hit, const Features& near) {
  const double size = w.a().body.reach + w.b().body.reach + w.radii();
  double best = off(r, hit.error);
  for (const double share : {0x1p-20, 0x1p-13, 0x1p-7})
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
      if (const double e = off(tried, hit.error); e < best) {
        best = e;
        r = tried;
      }
    }
}

// Worse than the gap may be along n, or visibly across it.
bool is_rough(const Search& r, const Sweep& w, double accuracy) {
  const Vec d = r.b - r.a;
  const double along = d.dot(r.normal), size = w.a().body.reach + w.b().body.reach + w.radii();
  return !(std::abs(along) <= accuracy && (d - along * r.normal).norm() <= 0x1p-30 * size);
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
    return plane ? look_at_plane(w, x, *plane) : look(w, x, features, far_look, x.error);
  };
  for (r.steps = 0; r.steps < step_cap; ++r.steps) {
    View v = see();
    r.clear_until = x.t;
    r.gap = v.upper;
    if (!x.precise && v.side.s < near_errors * x.error) {
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
        plane ? follow(w, x, v, Vec::Zero(), end) : go_on(w, x, v, features, last, r.steps, end);
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

}  // namespace touchstone::ccd::fast
