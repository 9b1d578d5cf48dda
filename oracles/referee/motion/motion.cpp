// judge_motion and its helpers. The frame travels with B's translation, so A moves with v = vA - vB and B
// turns in place.
//
// Without (visible) rotation the predicate "A swept over [s, t] touches B" is monotone in t, and a swept
// polytope or rounded shape is again one, so the exact level decides it: for such pairs the verdict is always
// decided, and the time of impact is bracketed down to neighbouring doubles. So it is for a point against a
// curved body (exact/ray.h).
//
// With rotation: steps over which a separation certainly lasts (course.h), and where they stall, a search for
// a time of certain contact.
#include "oracles/referee/motion/motion.h"

#include <algorithm>

#include "core/math/roundoff.h"
#include "oracles/referee/limits.h"
#include "oracles/referee/solid/solid.h"
#include "oracles/referee/work.h"

namespace touchstone::referee {

namespace {

// Newton's steps towards a first contact; the sweeps bracket what they leave.
constexpr int newton_steps = 64;
// Halvings of a bracket within [0, 1], which ends earlier when its ends are neighbouring doubles.
constexpr int most_halvings = 64;
// Golden-section steps that narrow an interval within [0, 1] to 2^-62.
constexpr int golden_steps = 90;
// Lengths are fractions of the step. First length of the sweeps that bracket a translation's contact.
constexpr double first_sweep = 0x1p-60;
// Below this advance the gap's own direction is worth the cost of computing it, unless the bracket is
// narrower than this part of the gap.
constexpr double short_advance = 0x1p-6;
constexpr Real narrow_bracket = 0x1p-10L;
// Conservative advancement that progresses by less has stalled.
constexpr double least_advance = 0x1p-52;
// The search for contact after a stall doubles its steps from first to last; a separation found at clear_step
// or later is taken to lie beyond the graze.
constexpr double first_step = 0x1p-58, clear_step = 0x1p-30, last_step = 0x1p-8;

double next_time(double t, double step) { return std::min(1.0, std::max(std::nextafter(t, 2.0), t + step)); }

// Newton's steps from below never pass the first contact; sweeps of doubling length then bracket it, and
// bisection narrows the bracket to neighbouring doubles, or to what can be decided for curved pairs.
TimeTruth bracket_contact(Course& c) {
  double lo = 0;
  for (int i = 0; i < newton_steps; ++i) {
    const ConvexTruth g = c.at(lo);
    const double next = c.clear_without_turning(lo, g);
    if (!(next > lo) || next > 1) break;
    lo = next;
  }
  double hi = 1;
  for (double step = first_sweep; lo + step < 1; step *= 2) {
    const double t = next_time(lo, step);
    const Verdict v = c.swept(lo, t).verdict;
    if (v == Verdict::disjoint) lo = t;
    if (v == Verdict::overlap) {
      hi = t;
      break;
    }
  }
  for (double from = lo; std::nextafter(std::max(lo, from), 2.0) < hi;) {
    const double middle = std::max(lo, from) + (hi - std::max(lo, from)) / 2;
    if (middle <= std::max(lo, from) || middle >= hi) break;
    const Verdict v = c.swept(lo, middle).verdict;
    if (v == Verdict::overlap)
      hi = middle;
    else if (v == Verdict::disjoint)
      lo = middle;
    else
      from = middle;  // curved, undecided: contact is certain only later, absence only up to lo
  }
  return hit_between(lo, hi);
}

// A point and a curved body, decided exactly; `all` is what is known of the whole step.
TimeTruth judge_ray(const Ray& ray, const ConvexTruth& all) {
  const auto meeting = ray.first_meeting();
  TimeTruth r;
  if (meeting) {
    r = hit_between(meeting->lo, meeting->hi);
    r.least_gap.lo = std::min(0.0, round_down(all.lo));
    return r;
  }
  r.verdict = TimeTruth::Verdict::none;
  r.t_lo = 1;
  r.least_gap = {std::max(0.0, round_down(all.lo)), std::max(0.0, round_up(all.hi))};
  return r;
}

TimeTruth judge_translation(Course& c) {
  const ConvexTruth start = c.at(0, Effort::gap);
  if (start.verdict == Verdict::overlap) return hit_between(0, 0, "overlap at the start");
  const ConvexTruth all = c.swept(0, 1, Effort::gap);
  if (all.verdict != Verdict::disjoint)
    if (const auto ray = c.ray()) return judge_ray(ray->ray, all);
  if (all.verdict == Verdict::overlap) {
    TimeTruth r = bracket_contact(c);
    r.least_gap.lo = round_down(all.lo);
    return r;
  }
  TimeTruth r;
  // The swept body contains A at all times: its gap is a lower bound of theirs, and equals the least of them
  // when it is positive.
  r.least_gap = {round_down(all.lo), std::max(0.0, round_up(all.hi))};
  if (all.verdict == Verdict::disjoint) {
    r.verdict = TimeTruth::Verdict::none;
    r.least_gap.lo = std::max(0.0, r.least_gap.lo);
    r.t_lo = 1;
    return r;
  }
  r.note = "the swept body touches within the bracket of a curved pair";
  return r;
}

/// State of conservative advancement.
struct Advance {
  double t = 0;
  Real least_lo = std::numeric_limits<Real>::infinity(), least_hi = std::numeric_limits<Real>::infinity();
  enum class Exit { passed, stalled, contact, evaluation_cap } exit = Exit::stalled;
};

// How long the bodies certainly stay apart after t, given c.at(t). Where that is short and the bracket wide
// compared with the gap, the gap's own bracket and direction give a longer step.
Course::Clear clear_after(Course& c, double t, const ConvexTruth& g) {
  const Course::Clear clear = c.clear_from(t, g);
  if (clear.until - t >= short_advance || g.hi - g.lo <= narrow_bracket * g.lo) return clear;
  const Course::Clear other = c.clear_from(t, c.at(t, Effort::gap));
  return other.until > clear.until ? other : clear;
}

// Advances from `start` until contact, the time `end`, or no progress. A step shorter than `least_step`
// counts as none: near a graze the steps shrink forever.
Advance advance_from(Course& c, double start, double end, double least_step) {
  Advance r;
  r.t = start;
  while (c.evaluations < limits::motion_evaluations) {
    const ConvexTruth g = c.at(r.t);
    r.least_hi = std::min(r.least_hi, g.hi);
    if (g.verdict == Verdict::overlap) {
      r.exit = Advance::Exit::contact;
      return r;
    }
    const Course::Clear clear = clear_after(c, r.t, g);
    r.least_lo = std::min(r.least_lo, clear.kept);
    if (clear.until > end) {
      r.t = 1;
      r.exit = Advance::Exit::passed;
      return r;
    }
    if (clear.until - r.t < least_step) {
      r.exit = Advance::Exit::stalled;
      return r;
    }
    r.t = clear.until;
  }
  r.exit = Advance::Exit::evaluation_cap;
  return r;
}

// The first certain contact after a stall, found by doubling steps; infinity when there is none close by.
double contact_after(Course& c, double t, double& clear_at) {
  clear_at = infinity;
  for (double step = first_step; c.evaluations < limits::motion_evaluations; step *= 2) {
    const double s = next_time(t, step);
    const ConvexTruth g = c.at(s);
    if (g.verdict == Verdict::overlap) return s;
    if (g.verdict == Verdict::disjoint && step >= clear_step && clear_at == infinity) clear_at = s;
    if (s >= 1 || step > last_step) return infinity;
  }
  return infinity;
}

// The gap's bracket at t; where the bodies overlap, the verdict is enough.
ConvexTruth gap_unless_overlap(Course& c, double t) {
  ConvexTruth g = c.at(t);
  return g.verdict == Verdict::overlap ? g : c.at(t, Effort::gap);
}

// Nearest approach in [from, to] by golden-section search on the upper bound of the gap. Returns only times
// at which contact is certified.
double contact_within(Course& c, double from, double to) {
  double x = to - limits::golden * (to - from), y = from + limits::golden * (to - from);
  ConvexTruth gx = gap_unless_overlap(c, x), gy = gap_unless_overlap(c, y);
  for (int i = 0; i < golden_steps && to > from; ++i) {
    if (gx.verdict == Verdict::overlap) return x;
    if (gy.verdict == Verdict::overlap) return y;
    if (gx.hi <= gy.hi) {
      to = y;
      y = x;
      gy = gx;
      x = to - limits::golden * (to - from);
      gx = gap_unless_overlap(c, x);
    } else {
      from = x;
      x = y;
      gx = gy;
      y = from + limits::golden * (to - from);
      gy = gap_unless_overlap(c, y);
    }
  }
  return infinity;
}

// hi is a certain contact; lo < hi has none before it. Bisects (lo, hi], keeping the half whose end is still
// a contact.
double earliest_contact(Course& c, double lo, double hi) {
  for (int i = 0; i < most_halvings; ++i) {
    const double middle = lo + (hi - lo) / 2;
    if (middle <= lo || middle >= hi) break;
    if (c.at(middle).verdict == Verdict::overlap)
      hi = middle;
    else
      lo = middle;
  }
  return hi;
}

TimeTruth no_hit(Real least_lo, Real least_hi) {
  TimeTruth r;
  r.verdict = TimeTruth::Verdict::none;
  r.t_lo = 1;
  r.least_gap = {std::max(0.0, round_down(least_lo)), round_up(least_hi)};
  return r;
}

TimeTruth judge_rotation(Course& c, double end) {
  double t = 0, first_stall = infinity;
  Real least_lo = std::numeric_limits<Real>::infinity(), least_hi = least_lo;
  const char* note = "";
  while (t < end) {
    const Advance a = advance_from(c, t, end, least_advance);
    least_lo = std::min(least_lo, a.least_lo);
    least_hi = std::min(least_hi, a.least_hi);
    if (a.exit == Advance::Exit::passed) break;
    const double clear_before = std::min(first_stall, a.t);
    if (a.exit == Advance::Exit::contact)
      return hit_between(clear_before, earliest_contact(c, clear_before, a.t));
    first_stall = clear_before;
    if (a.exit == Advance::Exit::evaluation_cap) {
      note = "evaluation cap reached";
      break;
    }
    double clear_at = infinity;
    double s = contact_after(c, a.t, clear_at);
    if (s == infinity) s = contact_within(c, a.t, std::min(1.0, clear_at));
    if (s != infinity) return hit_between(first_stall, earliest_contact(c, first_stall, s));
    note = "grazes: contact is neither certain nor excluded";
    if (clear_at == infinity) break;
    t = clear_at;
  }
  if (first_stall == infinity) return no_hit(least_lo, least_hi);
  TimeTruth r;
  r.note = note;
  r.t_lo = first_stall;
  // Before first_stall the gap is positive; afterwards nothing is known from below.
  r.least_gap = {-infinity, round_up(least_hi)};
  return r;
}

// `end`: a contact is known at this time, 1 if none is. A first contact certainly later counts as none, with
// a least gap that is about the time before.
TimeTruth judge_course(Course& c, double end) {
  if (!c.turns()) {
    if (end < 1)
      if (const ConvexTruth g = c.swept(0, end); g.verdict == Verdict::disjoint)
        return no_hit(g.lo, infinity);
    return judge_translation(c);
  }
  // The start is exact for every polytope; a contact there is decided whatever follows.
  const ConvexTruth start = c.at(0);
  if (start.verdict == Verdict::overlap) return hit_between(0, 0, "overlap at the start");
  return judge_rotation(c, end);
}

TimeTruth join(const TimeTruth& x, const TimeTruth& y) {
  using V = TimeTruth::Verdict;
  TimeTruth r = x;
  if (x.verdict == V::none) r = y;
  if (x.verdict != V::none && y.verdict != V::none) {
    r.verdict = x.verdict == V::hit || y.verdict == V::hit ? V::hit : V::undecided;
    r.t_lo = std::min(x.t_lo, y.t_lo);
    r.t_hi = std::min(x.verdict == V::hit ? x.t_hi : 1, y.verdict == V::hit ? y.t_hi : 1);
    r.note = x.note.empty() ? y.note : x.note;
  }
  r.least_gap = {std::min(x.least_gap.lo, y.least_gap.lo), std::min(x.least_gap.hi, y.least_gap.hi)};
  return r;
}

}  // namespace

TimeTruth hit_between(double lo, double hi, const char* note) {
  TimeTruth r;
  r.verdict = TimeTruth::Verdict::hit;
  r.t_lo = lo;
  r.t_hi = hi;
  r.least_gap = {-infinity, 0};
  r.note = note;
  return r;
}

std::vector<PartPair> part_pairs(const Placed& a, const Motion& ma, const Placed& b, const Motion& mb) {
  const auto count = [](const Placed& p) {
    const auto* m = std::get_if<TriangleMesh>(p.shape);
    return m ? m->triangles.size() : std::size_t{1};
  };
  const auto part = [](const Placed& p, std::size_t i) -> std::optional<std::size_t> {
    if (is<TriangleMesh>(p)) return i;
    return std::nullopt;
  };
  std::vector<PartPair> r;
  if (is<HalfSpace>(b)) {
    const Vec3 turn = visible_turn(b, mb.angular);
    const Vec3 origin = translation_of(turn.isZero(0) ? a : b);
    for (std::size_t i = 0; i < count(a); ++i)
      r.push_back({i, 0, Course(Mover(a, ma, mb.linear, part(a, i)), b, turn, origin)});
    return r;
  }
  const Vec3 origin = translation_of(a);
  Motion turning = mb;
  turning.linear = Vec3::Zero();
  std::vector<Mover> y;
  for (std::size_t j = 0; j < count(b); ++j) y.emplace_back(b, turning, Vec3::Zero(), part(b, j));
  std::vector<Aabb> boxes;
  for (const Mover& m : y) boxes.push_back(box_over(m, origin));
  const bool filter = count(a) > 1 || count(b) > 1;
  for (std::size_t i = 0; i < count(a); ++i) {
    const Mover x(a, ma, mb.linear, part(a, i));
    const Aabb box = filter ? box_over(x, origin) : Aabb{};
    for (std::size_t j = 0; j < y.size(); ++j)
      if (!filter || overlaps(box, boxes[j])) r.push_back({i, j, Course(x, y[j], origin)});
  }
  return r;
}

namespace {

TimeTruth judge(const Placed& a, const Motion& motion_a, const Placed& b, const Motion& motion_b) {
  if (is<HalfSpace>(a) && is<HalfSpace>(b)) return judge_half_spaces_in_motion(a, motion_a, b, motion_b);
  if (is<HalfSpace>(a)) return judge(b, motion_b, a, motion_a);
  TimeTruth r;
  r.verdict = TimeTruth::Verdict::none;
  r.t_lo = 1;
  r.least_gap = {0, infinity};
  bool first = true;
  for (PartPair& p : part_pairs(a, motion_a, b, motion_b)) {
    const bool known = !first && r.verdict == TimeTruth::Verdict::hit;
    const TimeTruth t = judge_course(p.course, known ? r.t_hi : 1);
    r = first ? t : join(r, t);
    first = false;
    p.course.forget();
    if (r.verdict == TimeTruth::Verdict::hit && r.t_hi == 0) break;
  }
  if (first) r.note = "the boxes of all parts stay apart";
  // Parts whose boxes stay apart have not been measured.
  if (is<TriangleMesh>(a) || is<TriangleMesh>(b)) r.least_gap.lo = std::min(0.0, r.least_gap.lo);
  return r;
}

// What begins outside a solid meets its surface first.
TimeTruth judge_solids(const Placed& a, const Motion& motion_a, const Placed& b, const Motion& motion_b) {
  if (point_inside(a, b)) return hit_between(0, 0, "overlap at the start");
  const AsSurface x(a), y(b);
  return judge(*x, motion_a, *y, motion_b);
}

}  // namespace

TimeTruth judge_motion(const Placed& a, const Motion& motion_a, const Placed& b, const Motion& motion_b) {
  TimeTruth open;
  open.least_gap = {-infinity, infinity};
  open.note = too_expensive;
  return within_limit(std::move(open), [&] {
    return has_solid(a, b) ? judge_solids(a, motion_a, b, motion_b) : judge(a, motion_a, b, motion_b);
  });
}

}  // namespace touchstone::referee
