// judge_motion and its kin. The frame travels with B's translation, so A moves with v = vA - vB and B turns
// in place.
//
// Without (visible) rotation the predicate "A swept over [s, t] touches B" is monotone in t, and a swept
// polytope or rounded shape is one again, so that the exact level decides it: the verdict is always decided
// for such pairs, and the time of impact is bracketed down to neighbouring doubles.
//
// With rotation: conservative advancement (Mirtich 1996). Let n be a unit direction from A to B along which
// the bodies are g > 0 apart at time t. A point of A at p from its origin moves along n at v·n + (ω×p)·n =
// v·n + p·(n×ω), which is at most v·n + ρ|n×ω|, ρ the core's radius about its origin (a ball around the core
// adds nothing: it does not turn). Likewise for B. So there is no contact before t + g/μ, μ = v·n + ρA|n×ωA|
// + ρB|n×ωB|. Where spinning makes μ large and the step small, the same is tried for the hulls of the circles
// that the vertices run through, for which μ = v·n.
#include "oracles/referee/motion.h"

#include <algorithm>

#include "core/tolerance.h"
#include "oracles/referee/box_of.h"
#include "oracles/referee/half_space.h"
#include "oracles/referee/mesh.h"

namespace touchstone::referee {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Part A against part B or against a resting half-space.
struct Course {
  Mover a;
  std::optional<Mover> b;
  std::optional<Placed> half_space;
  Vec3 origin;
  int evaluations = 0;

  bool spins() const { return a.spins() || (b && b->spins()); }
  ConvexTruth judge(const Operand& x, const Operand& y_or_none, Effort effort) {
    ++evaluations;
    return half_space ? judge_half_space(*half_space, x, origin) : judge_convex(x, y_or_none, {}, effort);
  }
  Operand b_at(double t) const { return b ? b->at(t, origin) : Operand{}; }
  ConvexTruth at(double t, Effort effort = Effort::verdict_only) {
    return judge(a.at(t, origin), b_at(t), effort);
  }
  ConvexTruth swept(double from, double to, Effort effort = Effort::verdict_only) {
    return judge(a.swept(from, to, origin), b_at(0), effort);
  }
  ConvexTruth orbits(double t) {
    return judge(a.orbit(t, origin), b ? b->orbit(t, origin) : Operand{}, Effort::verdict_only);
  }
  // judge_half_space points out of the half-space, from it to A; here it is B.
  Real3 a_to_b(const ConvexTruth& t) const { return half_space ? -t.normal : t.normal; }
  double spin_a = 0, spin_b = 0;  // core radii about the origins, rounded up

  void measure() {
    spin_a = a.spins() ? round_up(a.at(0, origin).body.spin_radius) : 0;
    spin_b = b && b->spins() ? round_up(b->at(0, origin).body.spin_radius) : 0;
  }
  /// Bound of the closing speed along n over any stretch of time, rounded up.
  Real closing_speed(const Real3& n, bool turning) const {
    const Real3 v = a.velocity();
    Real mu = dot(v, n) + 16 * unit * norm(v);
    if (turning && spin_a > 0) mu += spin_a * norm(cross(n, a.angular())) * (1 + 16 * unit);
    if (turning && spin_b > 0) mu += spin_b * norm(cross(n, b->angular())) * (1 + 16 * unit);
    const Real length = norm(n);
    return mu > 0 ? mu / length * (1 + 16 * unit) : 0;
  }
};

/// The last time before which there is no contact, from t and a separation; above 1 when there is none left.
double advance(double t, Real gap, Real speed) {
  if (!(gap > 0)) return t;
  if (!(speed > 0)) return infinity;
  const Real step = gap / speed * (1 - 0x1p-50L);
  return static_cast<Real>(t) + step > 1 ? infinity : std::max(t, round_down(static_cast<Real>(t) + step));
}

double next_time(double t, double step) { return std::min(1.0, std::max(std::nextafter(t, 2.0), t + step)); }

TimeTruth hit(double lo, double hi, const char* note = "") {
  TimeTruth r;
  r.verdict = TimeTruth::Verdict::hit;
  r.t_lo = lo;
  r.t_hi = hi;
  r.least_gap = {-infinity, 0};
  r.note = note;
  return r;
}

// Newton's step from below never passes the first contact; sweeps of doubling length then bracket it, and
// bisection closes the bracket to neighbouring doubles or to what curved pairs can decide.
TimeTruth close_in(Course& c) {
  double lo = 0;
  for (int i = 0; i < 64; ++i) {
    const ConvexTruth g = c.at(lo);
    const double next = advance(lo, g.lo, c.closing_speed(c.a_to_b(g), false));
    if (!(next > lo) || next > 1) break;
    lo = next;
  }
  double hi = 1;
  for (double step = 0x1p-60; lo + step < 1; step *= 2) {
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
      from = middle;  // curved, within its bracket: contact is certain later, absence up to lo only
  }
  return hit(lo, hi);
}

TimeTruth judge_translation(Course& c) {
  const ConvexTruth start = c.at(0, Effort::gap);
  if (start.verdict == Verdict::overlap) return hit(0, 0, "overlap at the start");
  const ConvexTruth all = c.swept(0, 1, Effort::gap);
  if (all.verdict == Verdict::overlap) {
    TimeTruth r = close_in(c);
    r.least_gap.lo = round_down(all.lo);
    return r;
  }
  TimeTruth r;
  // The swept body holds A at all times: its gap bounds theirs from below, and is their least when positive.
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

// From `start` until contact, the end, or no progress. A step shorter than `least_step` counts as none: near
// a graze the steps shrink for ever.
Advance advance_from(Course& c, double start, double least_step) {
  Advance r;
  r.t = start;
  while (c.evaluations < tolerance::referee_motion_evaluations) {
    const ConvexTruth g = c.at(r.t);
    r.least_hi = std::min(r.least_hi, g.hi);
    if (g.verdict == Verdict::overlap) return r.exit = Advance::Exit::contact, r;
    const Real3 n = c.a_to_b(g);
    const Real speed = c.closing_speed(n, true);
    double next = advance(r.t, g.lo, speed);
    Real kept = next > 1 ? g.lo - speed * (1 - static_cast<Real>(r.t)) : 0;
    if (next - r.t < 0.01) {
      const ConvexTruth o = c.orbits(r.t);
      const Real slow = c.closing_speed(c.a_to_b(o), false);
      const double far = advance(r.t, o.lo, slow);
      if (far > next) next = far, kept = far > 1 ? o.lo - slow * (1 - static_cast<Real>(r.t)) : 0;
    }
    r.least_lo = std::min(r.least_lo, kept);
    if (next > 1) return r.t = 1, r.exit = Advance::Exit::passed, r;
    if (next - r.t < least_step) return r.exit = Advance::Exit::stalled, r;
    r.t = next;
  }
  r.exit = Advance::Exit::evaluation_cap;
  return r;
}

// The first certain contact after a stall, by doubling steps; infinity when there is none close by.
double contact_after(Course& c, double t, double& clear_at) {
  clear_at = infinity;
  for (double step = 0x1p-58; c.evaluations < tolerance::referee_motion_evaluations; step *= 2) {
    const double s = next_time(t, step);
    const ConvexTruth g = c.at(s);
    if (g.verdict == Verdict::overlap) return s;
    if (g.verdict == Verdict::disjoint && step >= 0x1p-30 && clear_at == infinity) clear_at = s;
    if (s >= 1 || step > 0x1p-8) return infinity;
  }
  return infinity;
}

// Nearest approach in [from, to] by golden section on the upper bound of the gap; only times at which contact
// is certified are believed.
double contact_within(Course& c, double from, double to) {
  constexpr double golden = 0.6180339887498949;
  double x = to - golden * (to - from), y = from + golden * (to - from);
  ConvexTruth gx = c.at(x, Effort::gap), gy = c.at(y, Effort::gap);
  for (int i = 0; i < 90 && to > from; ++i) {
    if (gx.verdict == Verdict::overlap) return x;
    if (gy.verdict == Verdict::overlap) return y;
    if (gx.hi <= gy.hi) {
      to = y, y = x, gy = gx;
      x = to - golden * (to - from), gx = c.at(x, Effort::gap);
    } else {
      from = x, x = y, gx = gy;
      y = from + golden * (to - from), gy = c.at(y, Effort::gap);
    }
  }
  return infinity;
}

// hi is a certain contact, lo < hi has none before it; halves the part of (lo, hi] whose end is still a
// contact.
double earliest_contact(Course& c, double lo, double hi) {
  for (int i = 0; i < 64; ++i) {
    const double middle = lo + (hi - lo) / 2;
    if (middle <= lo || middle >= hi) break;
    if (c.at(middle).verdict == Verdict::overlap)
      hi = middle;
    else
      lo = middle;
  }
  return hi;
}

TimeTruth judge_rotation(Course& c) {
  c.measure();
  double t = 0, first_stall = infinity;
  Real least_lo = std::numeric_limits<Real>::infinity(), least_hi = least_lo;
  const char* note = "";
  while (t < 1) {
    const Advance a = advance_from(c, t, 0x1p-52);
    least_lo = std::min(least_lo, a.least_lo);
    least_hi = std::min(least_hi, a.least_hi);
    if (a.exit == Advance::Exit::passed) break;
    const double clear_before = std::min(first_stall, a.t);
    if (a.exit == Advance::Exit::contact) return hit(clear_before, earliest_contact(c, clear_before, a.t));
    first_stall = clear_before;
    if (a.exit == Advance::Exit::evaluation_cap) {
      note = "evaluation cap reached";
      break;
    }
    double clear_at = infinity;
    double s = contact_after(c, a.t, clear_at);
    if (s == infinity) s = contact_within(c, a.t, std::min(1.0, clear_at));
    if (s != infinity) return hit(first_stall, earliest_contact(c, first_stall, s));
    note = "grazes: contact is neither certain nor excluded";
    if (clear_at == infinity) break;
    t = clear_at;
  }
  TimeTruth r;
  r.note = note;
  if (first_stall == infinity) {
    r.verdict = TimeTruth::Verdict::none;
    r.t_lo = 1;
    r.least_gap = {std::max(0.0, round_down(least_lo)), round_up(least_hi)};
    return r;
  }
  r.t_lo = first_stall;
  // Before first_stall the gap is positive; afterwards nothing is known from below.
  r.least_gap = {-infinity, round_up(least_hi)};
  return r;
}

TimeTruth judge_course(Course& c) {
  if (!c.spins()) return judge_translation(c);
  // The start is exact for every polytope; a contact there is decided whatever follows.
  const ConvexTruth start = c.at(0);
  if (start.verdict == Verdict::overlap) return hit(0, 0, "overlap at the start");
  return judge_rotation(c);
}

template <class S>
bool is(const Placed& p) {
  return std::holds_alternative<S>(*p.shape);
}

const Vec3& translation_of(const Placed& p) {
  if (const auto* pose = std::get_if<Pose>(&p.pose)) return pose->translation;
  return std::get<Placement>(p.pose).translation;
}

bool overlap_closed(const Aabb& a, const Aabb& b) { return overlaps(a, b); }

/// The courses of the convex parts of A and B that can meet at all; `far` bounds the gap of the others from
/// below.
std::vector<Course> courses(const Placed& a, const Motion& ma, const Placed& b, const Motion& mb, bool all) {
  const auto count = [](const Placed& p) {
    const auto* m = std::get_if<TriangleMesh>(p.shape);
    return m ? m->triangles.size() : std::size_t{1};
  };
  const auto part = [](const Placed& p, std::size_t i) -> std::optional<std::size_t> {
    if (is<TriangleMesh>(p)) return i;
    return std::nullopt;
  };
  const Vec3 origin = translation_of(a);
  Motion turning = mb;
  turning.linear = Vec3::Zero();
  std::vector<Mover> y;
  if (!is<HalfSpace>(b))
    for (std::size_t j = 0; j < count(b); ++j) y.emplace_back(b, turning, Vec3::Zero(), part(b, j));
  std::vector<Course> r;
  std::vector<Aabb> boxes;
  for (const Mover& m : y) boxes.push_back(box_over(m, origin));
  for (std::size_t i = 0; i < count(a); ++i) {
    const Mover x(a, ma, mb.linear, part(a, i));
    const bool filter = !all && (count(a) > 1 || count(b) > 1);
    if (is<HalfSpace>(b)) r.push_back({x, std::nullopt, b, origin});
    const Aabb box = filter ? box_over(x, origin) : Aabb{};
    for (std::size_t j = 0; j < y.size(); ++j)
      if (!filter || overlap_closed(box, boxes[j])) r.push_back({x, y[j], std::nullopt, origin});
  }
  return r;
}

bool unbounded_and_turning(const Placed& p, const Motion& m) {
  return is<HalfSpace>(p) && !m.angular.isZero(0);
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

Aabb box_over(const Mover& m, const Vec3& origin) {
  if (!m.spins()) return box_of(m.swept(0, 1, origin).body);
  Solid whole = m.orbit(0, origin).body;
  const Real3 v = m.velocity();
  add_sweep(whole, v, 4 * unit * largest(v));
  const Aabb coarse = box_of(whole);
  // Slices of time: at its middle every core point is within ρ|ω|·(half a slice) of where it is anywhere in
  // the slice.
  constexpr int slices = 64;
  const Real turn = m.at(0, origin).body.spin_radius * norm(m.angular()) / (2 * slices) * (1 + 16 * unit);
  Aabb fine;
  for (int i = 0; i < slices; ++i) {
    Solid b = m.at((i + 0.5) / slices, origin).body;
    const Real3 step = (1.0L / slices) * v;
    for (Real3& p : b.points) p = p - 0.5L * step;
    b.centre = b.centre - 0.5L * step;
    b.extent += largest(step) * 2;
    add_sweep(b, step, 8 * unit * largest(v));
    b.error += turn;
    fine.extend(box_of(b));
  }
  return {fine.lo.cwiseMax(coarse.lo), fine.hi.cwiseMin(coarse.hi)};
}

TimeTruth judge_motion(const Placed& a, const Motion& motion_a, const Placed& b, const Motion& motion_b) {
  if (is<HalfSpace>(a) && !is<HalfSpace>(b)) return judge_motion(b, motion_b, a, motion_a);
  TimeTruth r;
  r.least_gap = {-infinity, infinity};
  if (is<HalfSpace>(a) || unbounded_and_turning(a, motion_a) || unbounded_and_turning(b, motion_b)) {
    r.note = "two half-spaces, or a half-space that turns, are not judged in motion";
    return r;
  }
  std::vector<Course> all = courses(a, motion_a, b, motion_b, false);
  r.verdict = TimeTruth::Verdict::none;
  r.t_lo = 1;
  r.least_gap = {0, infinity};
  bool first = true;
  for (Course& c : all) {
    const TimeTruth t = judge_course(c);
    r = first ? t : join(r, t);
    first = false;
  }
  if (first) r.note = "the boxes of all parts stay apart";
  return r;
}

Bracket gap_at(const Placed& a, const Motion& motion_a, const Placed& b, const Motion& motion_b, double t) {
  if (is<HalfSpace>(a) && !is<HalfSpace>(b)) return gap_at(b, motion_b, a, motion_a, t);
  if (is<HalfSpace>(a) || unbounded_and_turning(b, motion_b)) return {-infinity, infinity};
  const Vec3 origin = translation_of(a);
  std::vector<Operand> x, y;
  const auto fill = [&](std::vector<Operand>& out, const Placed& p, const Motion& m, const Vec3& minus) {
    const auto* mesh = std::get_if<TriangleMesh>(p.shape);
    if (!mesh) return out.push_back(Mover(p, m, minus, std::nullopt).at(t, origin));
    for (std::size_t i = 0; i < mesh->triangles.size(); ++i)
      out.push_back(Mover(p, m, minus, i).at(t, origin));
  };
  Motion turning = motion_b;
  turning.linear = Vec3::Zero();
  fill(x, a, motion_a, motion_b.linear);
  const bool surface = is<TriangleMesh>(a) || is<TriangleMesh>(b);
  ConvexTruth g;
  if (is<HalfSpace>(b)) {
    g = judge_parts_half_space(x, b, origin, surface);
  } else {
    fill(y, b, turning, Vec3::Zero());
    g = judge_parts(x, y, surface);
  }
  return {round_down(g.lo), round_up(g.hi)};
}

double certified_depth_before(const Placed& a, const Motion& motion_a, const Placed& b,
                              const Motion& motion_b, double t) {
  // A surface has no depth.
  if (is<TriangleMesh>(a) || is<TriangleMesh>(b) || !(t > 0)) return 0;
  const auto gap = [&](double s) { return gap_at(a, motion_a, b, motion_b, s).hi; };
  const double turns = t * std::max(motion_a.angular.norm(), motion_b.angular.norm()) / 6.28;
  const int samples = std::min(512, 24 + static_cast<int>(8 * turns));
  double best = t, least = gap(t);
  for (int i = 0; i < samples; ++i) {
    const double s = t * i / samples;
    if (const double g = gap(s); g < least) least = g, best = s;
  }
  double from = std::max(0.0, best - t / samples), to = std::min(t, best + t / samples);
  constexpr double golden = 0.6180339887498949;
  double x = to - golden * (to - from), y = from + golden * (to - from);
  double gx = gap(x), gy = gap(y);
  for (int i = 0; i < 48; ++i) {
    least = std::min({least, gx, gy});
    if (gx <= gy) {
      to = y, y = x, gy = gx;
      x = to - golden * (to - from), gx = gap(x);
    } else {
      from = x, x = y, gx = gy;
      y = from + golden * (to - from), gy = gap(y);
    }
  }
  return std::max(0.0, -least);
}

Aabb outer_box(const Placed& a, const Motion& motion) {
  if (is<HalfSpace>(a)) {
    const bool rests = motion.linear.isZero(0) && motion.angular.isZero(0);
    return rests ? outer_box(a) : Aabb{Vec3::Constant(-infinity), Vec3::Constant(infinity)};
  }
  if (!is<TriangleMesh>(a)) return box_over(Mover(a, motion, Vec3::Zero(), std::nullopt), Vec3::Zero());
  Aabb box;
  for (std::size_t i = 0; i < std::get<TriangleMesh>(*a.shape).triangles.size(); ++i)
    box.extend(box_over(Mover(a, motion, Vec3::Zero(), i), Vec3::Zero()));
  return box;
}

}  // namespace touchstone::referee
