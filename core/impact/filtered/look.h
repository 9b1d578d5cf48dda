// The gap at one time, to the requested accuracy: Gilbert, Johnson, Keerthi 1988, warm-started with the
// features of the previous time, whose points move with their bodies. The bounds are those of the simplex
// (above) and of the best support plane (below); a bad start costs an iteration, never correctness.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "core/impact/filtered/sweep.h"
#include "core/narrow/simplex.h"

namespace touchstone::impact::filtered {

/// A few core points of each body, in its own frame, that define the nearest points.
struct Features {
  std::array<Vec, 4> a, b;
  std::array<double, 4> weight;  // of the previous nearest points
  int size = 0;
};

struct View {
  bool meeting = false;  // the cores meet according to the simplex
  Vec normal = Vec::UnitX();
  Side side;                                               // along normal
  double upper = std::numeric_limits<double>::infinity();  // of the gap
};

namespace detail {

inline constexpr int look_cap = 64;
/// No gap of more errors than this is taken for contact. Tested by: tests/core "a needle of points does not
/// meet an ellipsoid early".
inline constexpr double contact_errors = 16;

class Looker {
 public:
  Looker(const Sweep& sweep, const Spot& x, Features& f, View& v) : w_(sweep), x_(x), f_(f), v_(v) {}

  // Ends when the bounds of the gap differ by at most `relative` of it or by `absolute`.
  void run(double relative, double absolute) {
    const double touching =
        narrow::rounding::height * u<double> * (w_.a().body.reach + w_.b().body.reach + x_.offset.norm());
    Vec v = x_.offset;
    if (!start(v)) return;
    // The features of the smallest upper bound: a later simplex may be worse, or contain the origin.
    Features best_features = f_;
    double length = v.norm(), best = -std::numeric_limits<double>::infinity();
    if (!(length > 0)) {
      v = Vec::UnitX();
      length = 1;
    }
    int idle = 0;
    for (int i = 0; i < look_cap; ++i) {
      const Vec n = v / length;
      const Side s = w_.along(x_, n);
      const bool better = s.s > best;
      if (better) {
        best = s.s;
        v_.normal = n;
        v_.side = s;
      }
      if (v_.upper - best <= std::max(relative * best, absolute)) break;
      idle = better ? 0 : idle + 1;
      if (simplex_.size == 4 || idle > 4 || !add(s, v)) break;
      length = v.norm();
      if (!(length > touching)) {
        v_.meeting = true;
        break;
      }
      if (const double upper = upper_of(v); upper < v_.upper) {
        v_.upper = upper;
        best_features = f_;
      }
    }
    if (best_features.size > 0) f_ = best_features;
  }

 private:
  Vec point(const Vec& a, const Vec& b) const { return x_.rb * b + x_.offset - x_.ra * a; }

  // Starts from the previous features at their present position; false: they meet.
  bool start(Vec& v) {
    if (f_.size == 0) return true;
    simplex_.size = f_.size;
    for (int i = 0; i < f_.size; ++i) {
      const auto k = static_cast<std::size_t>(i);
      simplex_.p[k].w = point(f_.a[k], f_.b[k]);
    }
    if (!shrink(v)) {
      // These are points of both bodies, but perhaps a sliver that rounding has inverted.
      f_.size = 0;
      simplex_.size = 0;
      v = x_.offset;
      return true;
    }
    v_.upper = upper_of(v);
    return true;
  }

  // The foot on a triangle that is a needle may be nearer than any of its points, by the rounding of its
  // normal times its length. A weighted mean is one of its points. Without balls, only a length that could
  // pass for contact needs one, with weights as exact as the foot.
  double upper_of(const Vec& v) {
    const double length = v.norm();
    if (simplex_.size < 3 || (w_.radii() == 0 && length > contact_errors * x_.error))
      return length - w_.radii();
    const auto& p = simplex_.p;
    if (w_.radii() == 0) narrow::refine_weights<double>(p[0].w, p[1].w, p[2].w, v, f_.weight.data());
    const Vec mean = f_.weight[0] * p[0].w + f_.weight[1] * p[1].w + f_.weight[2] * p[2].w;
    return mean.norm() - w_.radii();
  }

  bool add(const Side& s, Vec& v) {
    const auto k = static_cast<std::size_t>(simplex_.size);
    const Vec w = x_.offset + s.pb - s.pa;
    for (std::size_t i = 0; i < k; ++i)
      if (simplex_.p[i].w == w) return false;
    simplex_.p[k].w = w;
    f_.a[k] = s.local_a;
    f_.b[k] = s.local_b;
    f_.size = ++simplex_.size;
    if (shrink(v)) return true;
    v_.meeting = true;
    return false;
  }

  // Reduces the simplex to the points that support the nearest point; false: it contains the origin.
  bool shrink(Vec& v) {
    const auto before = simplex_.p;
    const int size = simplex_.size;
    double dist_sq = 0, margin = 0;
    if (narrow::reduce(simplex_, v, dist_sq, margin)) return false;
    const Features previous = f_;
    f_.size = simplex_.size;
    for (int i = 0; i < simplex_.size; ++i) {
      const auto k = static_cast<std::size_t>(i);
      std::size_t from = 0;
      while (from + 1 < static_cast<std::size_t>(size) && before[from].w != simplex_.p[k].w) ++from;
      f_.a[k] = previous.a[from];
      f_.b[k] = previous.b[from];
      f_.weight[k] = simplex_.weight[k];
    }
    return true;
  }

  const Sweep& w_;
  const Spot& x_;
  Features& f_;
  View& v_;
  narrow::Simplex<double> simplex_;
};

}  // namespace detail

namespace detail {

// A point against a point or a box: no search. Sets the features as the search would; false: they meet.
inline bool point_and_box(const Sweep& w, const Spot& x, Features& f, View& v) {
  const bool first = is_point(w.a());
  const Mover& other = first ? w.b() : w.a();
  const Mat& r = first ? x.rb : x.ra;
  const Vec o = first ? Vec(-x.offset) : x.offset;  // of the point, from the box
  const auto* box = box_core(other);
  const Vec p = r.transpose() * o, h = box ? box->half() : Vec(Vec::Zero()), q = p.cwiseMax(-h).cwiseMin(h);
  const Vec away = r * (p - q);
  const double length = away.norm();
  v.meeting = !(length > 0);
  if (v.meeting) return false;
  v.normal = away * ((first ? -1 : 1) / length);
  v.side = w.along(x, v.normal);
  v.upper = length - w.radii();
  f.size = 1;
  f.weight[0] = 1;
  (first ? f.a : f.b)[0] = Vec::Zero();
  (first ? f.b : f.a)[0] = q;
  return true;
}

}  // namespace detail

inline View look(const Sweep& sweep, const Spot& x, Features& f, double relative, double absolute) {
  View v;
  const bool point_a = is_point(sweep.a()), point_b = is_point(sweep.b());
  if ((point_a && (point_b || box_core(sweep.b()))) || (point_b && box_core(sweep.a()))) {
    detail::point_and_box(sweep, x, f, v);
    return v;
  }
  detail::Looker(sweep, x, f, v).run(relative, absolute);
  return v;
}

}  // namespace touchstone::impact::filtered
