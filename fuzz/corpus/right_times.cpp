// The times at which an impact may be reported, by the judge's own conditions (fuzz/judge/checks/
// time_of_impact.cpp): the gap then is at most τ, and no depth before it exceeds τ.
#include <algorithm>
#include <cmath>
#include <limits>

#include "fuzz/corpus/truth.h"
#include "fuzz/judge/truth.h"

namespace touchstone::fuzz::corpus {
namespace {

using Verdict = referee::TimeTruth::Verdict;

class Times {
 public:
  explicit Times(const Scene& s) : truth_(s), found_(truth_.motion(0, 0, 1)) {}

  bool is_early(double t, double tau) { return truth_.gap_at(0, 0, 1, t).lo > tau; }
  bool is_late(double t, double tau) {
    if (t == 0) return false;
    if (-truth_.gap_at(0, 0, 1, t).hi > tau) return true;
    const double after = found_.verdict == Verdict::none ? 0 : t - found_.t_lo;
    if (after <= 0 || after * truth_.speed(0, 1) <= tau) return false;
    return truth_.depth_before(0, 0, 1, t) > tau;
  }
  bool is_right(double t, double tau) { return !is_early(t, tau) && !is_late(t, tau); }

  // A time at which the bodies are as near as they get before they overlap.
  double nearest_time() {
    if (found_.verdict == Verdict::hit) return found_.t_hi;
    // Turning bodies may approach several times.
    constexpr int samples = 64;
    int first = 0;
    for (int i = 1; i <= samples; ++i)
      if (low_gap(double(i) / samples) < low_gap(double(first) / samples)) first = i;
    double lo = std::max(0, first - 1) / double(samples), hi = std::min(samples, first + 1) / double(samples);
    constexpr int steps = 200;  // each leaves two thirds of the interval
    for (int i = 0; i < steps && lo < hi; ++i) {
      const double l = lo + (hi - lo) / 3, r = hi - (hi - lo) / 3;
      if (low_gap(l) <= low_gap(r))
        hi = r;
      else
        lo = l;
    }
    double best = lo;
    for (const double t : {0.0, 1.0, lo + (hi - lo) / 2, hi})
      if (low_gap(t) < low_gap(best)) best = t;
    return best;
  }

  // The right time farthest from `from`, which is right, on the way to `end`.
  double farthest(double from, double end, double tau) {
    if (is_right(end, tau)) return end;
    const double way = end < from ? -1 : 1, speed = std::max(truth_.speed(0, 1), tau);
    double right = from, wrong = end, step = tau / speed;
    for (double t = from + way * step; (t - end) * way < 0 && step > 0; t = from + way * step) {
      if (!is_right(t, tau)) {
        wrong = t;
        break;
      }
      right = t;
      step *= 2;
    }
    constexpr double enough = 0x1p-20;  // of the window: no engine's time is as near to its end by chance
    while (std::abs(wrong - right) > enough * std::abs(right - from)) {
      const double middle = right + (wrong - right) / 2;
      if (middle == right || middle == wrong) break;
      (is_right(middle, tau) ? right : wrong) = middle;
    }
    return right;
  }

  const referee::TimeTruth& found() const { return found_; }
  double deepest() {
    if (found_.verdict != Verdict::hit) return 0;
    return std::max({0.0, -found_.least_gap.hi, truth_.depth_in_step(0, 0, 1)});
  }

 private:
  double low_gap(double t) { return truth_.gap_at(0, 0, 1, t).lo; }

  Truth truth_;
  const referee::TimeTruth& found_;
};

}  // namespace

std::optional<MotionFacts> motion_facts(const Scene& s) {
  const Placed a{&s.shape_of(0), s.bodies[0].pose}, b{&s.shape_of(1), s.bodies[1].pose};
  MotionFacts f;
  f.answer =
      answer_motion(a, s.bodies[0].motion.value_or(Motion{}), b, s.bodies[1].motion.value_or(Motion{}));
  if (f.answer.truth.verdict == Verdict::undecided) return std::nullopt;
  Times times(s);
  f.deepest = times.deepest();
  if (!std::isfinite(f.deepest)) return std::nullopt;
  const double l = scale_of_pair(s, 0, 1), near = times.nearest_time();
  for (const int k : listed_exponents) {
    const double tau = std::ldexp(l, -k);
    RightTimes r{k, {}};
    if (times.is_right(near, tau))
      r.window = {times.farthest(near, 0, tau), times.farthest(near, 1, tau)};
    else if (!(times.found().least_gap.lo > tau))
      continue;  // not known; the next row serves
    f.right_times.push_back(r);
  }
  if (f.right_times.empty()) return std::nullopt;
  return f;
}

}  // namespace touchstone::fuzz::corpus
