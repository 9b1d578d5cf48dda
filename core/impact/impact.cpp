#include "core/impact/impact.h"

#include <algorithm>
#include <cmath>

#include "core/impact/convex_mesh.h"
#include "core/impact/filtered/translation.h"
#include "core/impact/pursue.h"
#include "core/math/roundoff.h"
#include "core/narrow/pair_table.h"
#include "core/narrow/unit_scale.h"
#include "core/tolerance.h"

namespace touchstone {
namespace {

using namespace impact;

bool moves(const MovingShape& s) { return !s.motion.linear.isZero(0) || !s.motion.angular.isZero(0); }
bool is_static_shape(const Shape& s) { return !is_convex(kind_of(s)); }

// Coordinates relative to the first body's start, so that a large common offset costs no accuracy.
WideFrame shifted(const Pose& p, const WideVec& origin) {
  WideFrame f = wide_frame(p);
  f.translation -= origin;
  return f;
}

// A lower bound of the pair's L, which τ is relative to.
double scale_of(const MovingShape& s, double extent) {
  const double from = s.pose.translation.cwiseAbs().maxCoeff();
  return std::max({extent, from, (s.pose.translation + s.motion.linear).cwiseAbs().maxCoeff()});
}

double accuracy_of(double scale) { return (tolerance::core_tau_factor - 4) * double_roundoff * scale; }

narrow::FastAnswer<double> in_double(const MovingShape& a, const MovingShape& b, narrow::filtered::Asked asked) {
  narrow::FastAnswer<double> f;
  narrow::separate_fast<double>({a.shape, a.pose, a.tree}, {b.shape, b.pose, b.tree}, asked, f);
  return f;
}

// Whether they meet at t = 0, and how, in bounded time. A depth that double cannot prove to be the least
// still decides the verdict and is reported: it does separate them, and no time depends on it. (In extended
// precision, two ellipsoids about one centre take up to a minute: every facet that the polytope may
// have.)
std::optional<ImpactAnswer> contact_at_start(const MovingShape& a, const MovingShape& b,
                                             ImpactDetail detail) {
  using narrow::filtered::Asked;
  using narrow::filtered::Found;
  ImpactAnswer r;
  r.toi = 0;
  const Found found = in_double(a, b, Asked::overlap).answer.found;
  if (found == Found::apart) return std::nullopt;
  if (found == Found::meeting && detail == ImpactDetail::time) return r;
  const auto x = in_double(a, b, Asked::distance).answer;
  if (x.valued && x.gap < -x.bound) {
    r.separation = x.gap;
    r.normal_ab = x.normal;
    r.witness_w = {Vec3(x.a + a.pose.translation), Vec3(x.b + a.pose.translation)};
    return r;
  }
  const PlacedShape pa{a.shape, a.pose, a.tree}, pb{b.shape, b.pose, b.tree};
  if (const OverlapAnswer o = overlap(pa, pb); o.outcome != Outcome::answered || !o.overlap)
    return std::nullopt;
  if (detail == ImpactDetail::time) return r;
  const DistanceAnswer d = distance(pa, pb);
  r.separation = d.distance;
  r.normal_ab = d.normal;
  r.witness_w = d.witness;
  if (d.outcome != Outcome::answered) {
    r.outcome = d.outcome;
    r.toi.reset();
  }
  return r;
}

ImpactAnswer at_rest(const MovingShape& a, const MovingShape& b, ImpactDetail detail) {
  const PlacedShape pa{a.shape, a.pose, a.tree}, pb{b.shape, b.pose, b.tree};
  if (const auto met = contact_at_start(a, b, detail)) return *met;
  ImpactAnswer r;
  r.clear_until = 1;
  const DistanceAnswer d = distance(pa, pb);
  r.outcome = d.outcome;
  r.separation = d.distance;
  return r;
}

ImpactAnswer to_answer(const filtered::Search& s, const MovingShape& a) {
  ImpactAnswer r = filtered::answer_of(s, a.motion.linear);
  for (Vec3& x : r.witness_w) x += a.pose.translation;
  return r;
}

// Computes the nearest points in extended precision where double has found the time but no accurate points.
ImpactAnswer to_refined_answer(const filtered::Search& s, const MovingShape& a, const MovingShape& b) {
  ImpactAnswer r = to_answer(s, a);
  if (!s.rough) return r;
  const WideVec origin = a.pose.translation.cast<Wide>();
  WideFrame fa = wide_frame_at(a.pose, a.motion, *r.toi), fb = wide_frame_at(b.pose, b.motion, *r.toi);
  fa.translation -= origin;
  fb.translation -= origin;
  const Separation x = narrow::separate_placed(*a.shape, fa, *b.shape, fb);
  if (x.outcome != Outcome::answered) return r;
  r.normal_ab = x.normal.cast<double>();
  r.witness_w = {Vec3((x.a + origin).cast<double>()), Vec3((x.b + origin).cast<double>())};
  return r;
}

// Shifts the witness points of advance(), which are relative to A's start, to the world.
ImpactAnswer shift_witnesses(ImpactAnswer r, const Vec3& origin) {
  for (Vec3& x : r.witness_w) x += origin;
  return r;
}

bool turns(const MovingShape& s) { return !s.motion.angular.isZero(0); }

std::optional<filtered::Round> round_of(const Shape& s) {
  if (const auto* x = std::get_if<Sphere>(&s)) return filtered::Round{0, x->radius};
  if (const auto* x = std::get_if<Capsule>(&s)) return filtered::Round{x->half_height, x->radius};
  return std::nullopt;
}

// Closed forms for translations; `unsure` if there is none for the pair.
filtered::Search translated(const MovingShape& a, const MovingShape& b) {
  if (turns(a) || turns(b)) return {};
  const filtered::Translation m{narrow::filtered::rounded_pose<double>(a.pose), narrow::filtered::rounded_pose<double>(b.pose),
                            b.motion.linear - a.motion.linear};
  const auto accuracy = [&](double extent_a, double extent_b) {
    return accuracy_of(std::max(scale_of(a, extent_a), scale_of(b, extent_b)));
  };
  const auto *box_a = std::get_if<Box>(a.shape), *box_b = std::get_if<Box>(b.shape);
  if (box_a && box_b)
    return translating_boxes(m, box_a->half_extents, box_b->half_extents,
                             accuracy(box_a->half_extents.maxCoeff(), box_b->half_extents.maxCoeff()));
  if (const auto* ball = std::get_if<Sphere>(a.shape); ball && box_b)
    return translating_ball_and_box(m, ball->radius, box_b->half_extents,
                                    accuracy(ball->radius, box_b->half_extents.maxCoeff()));
  if (const auto ra = round_of(*a.shape), rb = round_of(*b.shape); ra && rb)
    return translating_rounds(m, *ra, *rb,
                              accuracy(ra->half_height + ra->radius, rb->half_height + rb->radius));
  return {};
}

ImpactAnswer convex_convex(const MovingShape& a, const MovingShape& b, ImpactDetail detail) {
  const filtered::Search closed_form = translated(a, b);
  // Two boxes are the only closed form without witness points.
  const bool both_boxes = kind_of(*a.shape) == ShapeKind::box && kind_of(*b.shape) == ShapeKind::box;
  const bool points = !both_boxes || detail == ImpactDetail::time;
  if (closed_form.end == filtered::SearchEnd::clear || (closed_form.end == filtered::SearchEnd::hit && points))
    return to_answer(closed_form, a);
  const WideFrame fa{filtered::rotation_of(a.pose.rotation), WideVec::Zero()};
  const WideFrame fb{filtered::rotation_of(b.pose.rotation),
                     b.pose.translation.cast<Wide>() - a.pose.translation.cast<Wide>()};
  const filtered::Mover ma = filtered::make_mover(*a.shape, fa.rotation, a.motion);
  const filtered::Mover mb = filtered::make_mover(*b.shape, fb.rotation, b.motion);
  const filtered::Sweep sweep(ma, mb, fb.translation);
  const double accuracy = accuracy_of(std::max(scale_of(a, ma.body.extent), scale_of(b, mb.body.extent)));
  if (closed_form.end == filtered::SearchEnd::hit)
    return to_refined_answer(filtered::with_points(sweep, closed_form, accuracy), a, b);
  if (!sweep.turns() && is_polytope(*a.shape) && is_polytope(*b.shape) && !both_boxes)
    if (const filtered::Search s = translating_polytopes(sweep, accuracy); settled(s)) return to_answer(s, a);
  const auto search_from = [&](double t) { return search(sweep, t, 1, accuracy, {}); };
  const filtered::Search s = search_from(0);
  if (settled(s)) return to_refined_answer(s, a, b);
  if (s.end == filtered::SearchEnd::start)
    if (const auto met = contact_at_start(a, b, detail)) return *met;
  const MovingCore ca = moving_core(narrow::make_core(*a.shape, fa), a.motion);
  const MovingCore cb = moving_core(narrow::make_core(*b.shape, fb), b.motion);
  const Pursuit p = pursue(sweep, s, search_from, [&](double t, double leave) {
    return advance(ca, cb, t, {1, accuracy, leave});
  });
  return settled(p.search) ? to_refined_answer(p.search, a, b) : shift_witnesses(p.fine, a.pose.translation);
}

ImpactAnswer convex_half_space(const MovingShape& a, const MovingShape& b, ImpactDetail detail) {
  const WideFrame fa = shifted(a.pose, a.pose.translation.cast<Wide>());
  const narrow::WidePlane plane =
      narrow::place(*std::get_if<HalfSpace>(b.shape), shifted(b.pose, a.pose.translation.cast<Wide>()));
  const filtered::Mover ma = filtered::make_mover(*a.shape, fa.rotation, a.motion);
  const filtered::Mover face;
  const WideVec foot = plane.normal * plane.offset;
  const filtered::Sweep sweep(ma, face, foot);
  const Vec3 normal = -plane.normal.cast<double>();
  const double accuracy = accuracy_of(scale_of(a, ma.body.extent));
  const auto search_from = [&](double t) { return search(sweep, t, 1, accuracy, normal); };
  const filtered::Search s = search_from(0);
  if (settled(s)) return to_answer(s, a);
  if (s.end == filtered::SearchEnd::start)
    if (const auto met = contact_at_start(a, b, detail)) return *met;
  const MovingCore ca = moving_core(narrow::make_core(*a.shape, fa), a.motion);
  const Pursuit p = pursue(sweep, s, search_from, [&](double t, double leave) {
    return advance(ca, plane, t, {1, accuracy, leave});
  });
  return settled(p.search) ? to_answer(p.search, a) : shift_witnesses(p.fine, a.pose.translation);
}

ImpactAnswer mirrored(ImpactAnswer r) {
  r.normal_ab = -r.normal_ab;
  std::swap(r.witness_w[0], r.witness_w[1]);
  return r;
}

ImpactAnswer from_convex(const MovingShape& a, const MovingShape& b, ImpactDetail detail) {
  if (kind_of(*b.shape) == ShapeKind::half_space) return convex_half_space(a, b, detail);
  const auto* mesh = std::get_if<TriangleMesh>(b.shape);
  if (!mesh && kind_of(*b.shape) == ShapeKind::sphere && kind_of(*a.shape) == ShapeKind::box)
    return mirrored(convex_convex(b, a, detail));
  if (!mesh) return convex_convex(a, b, detail);
  const WideFrame frame = shifted(b.pose, a.pose.translation.cast<Wide>());
  const double accuracy = accuracy_of(std::max(scale_of(a, 0), scale_of(b, 0)));
  return shift_witnesses(convex_mesh(a, *mesh, b.tree, frame, accuracy), a.pose.translation);
}

// A ball is invariant under rotation.
MovingShape without_ineffective_rotation(MovingShape s) {
  const bool ball = std::visit(
      []<class S>(const S& shape) {
        if constexpr (is_convex_shape<S>)
          return shape.is_ball();
        else
          return false;
      },
      *s.shape);
  if (ball) s.motion.angular.setZero();
  return s;
}

}  // namespace

ImpactAnswer time_of_impact(const MovingShape& first, const MovingShape& second, ImpactDetail detail) {
  const MovingShape a = without_ineffective_rotation(first), b = without_ineffective_rotation(second);
  for (const MovingShape* s : {&a, &b})
    if (is_static_shape(*s->shape) && moves(*s)) {
      ImpactAnswer r;
      r.outcome = Outcome::unsupported;
      return r;
    }
  if (!moves(a) && !moves(b)) return at_rest(a, b, detail);
  const double way = std::max(a.motion.linear.cwiseAbs().maxCoeff(), b.motion.linear.cwiseAbs().maxCoeff());
  if (const int e = narrow::unit_scale(a, b, way); e != 0) {
    const narrow::ScaledPair<MovingShape> pair(a, b, e);
    ImpactAnswer r = time_of_impact(pair.a, pair.b, detail);
    r.separation = std::ldexp(r.separation, -e);
    if (r.toi)
      for (Vec3& x : r.witness_w) x = narrow::scaled(x, -e) + pair.origin;
    return r;
  }
  return is_static_shape(*a.shape) ? mirrored(from_convex(b, a, detail)) : from_convex(a, b, detail);
}

}  // namespace touchstone
