#include "core/impact/pair.h"
#include "core/impact/pursue.h"
#include "core/narrow/pair_table.h"

namespace touchstone::impact {
namespace {

bool turns(const MovingShape& s) { return !s.motion.angular.isZero(0); }

// Coordinates relative to the first body's start, so that a large common offset costs no accuracy.
WideFrame shifted(const Pose& p, const WideVec& origin) {
  WideFrame f = wide_frame(p);
  f.translation -= origin;
  return f;
}

ImpactAnswer to_answer(const filtered::Search& s, const MovingShape& a) {
  return shift_witnesses(filtered::answer_of(s, a.motion.linear), a.pose.translation);
}

// Computes the nearest points in extended precision where double has found the time but no accurate points.
ImpactAnswer to_refined_answer(const filtered::Search& s, const MovingShape& a, const MovingShape& b) {
  ImpactAnswer r = to_answer(s, a);
  if (!s.rough) return r;
  const WideVec origin = a.pose.translation.cast<Wide>();
  WideFrame fa = wide_frame_at(a.pose, a.motion, *r.toi), fb = wide_frame_at(b.pose, b.motion, *r.toi);
  fa.translation -= origin;
  fb.translation -= origin;
  const Separation x = narrow::separate_placed(a, fa, b, fb);
  if (x.outcome != Outcome::answered) return r;
  r.normal_ab = x.normal.cast<double>();
  r.witness_w = {Vec3((x.a + origin).cast<double>()), Vec3((x.b + origin).cast<double>())};
  return r;
}

// Stands for a half-space, whose face the sweep's offset leads to.
filtered::Mover point_at_rest() {
  filtered::Mover m;
  m.start_wide.setIdentity();
  m.start.setIdentity();
  return m;
}

filtered::Search translated(const MovingShape& a, const MovingShape& b, const ClosedForm& form) {
  if (!form.solve || turns(a) || turns(b)) return {};
  return form.solve(a, b,
                    {narrow::filtered::rounded_pose<double>(a.pose),
                     narrow::filtered::rounded_pose<double>(b.pose), b.motion.linear - a.motion.linear});
}

}  // namespace

ImpactAnswer convex_convex(const MovingShape& a, const MovingShape& b, ImpactDetail detail, const Row& row) {
  const filtered::Search closed_form = translated(a, b, row.translation);
  const bool points = row.translation.has_points || detail == ImpactDetail::time;
  if (closed_form.end == filtered::SearchEnd::clear ||
      (closed_form.end == filtered::SearchEnd::hit && points))
    return to_answer(closed_form, a);
  const WideFrame fa{filtered::rotation_of(a.pose.rotation), WideVec::Zero()};
  const WideFrame fb{filtered::rotation_of(b.pose.rotation),
                     b.pose.translation.cast<Wide>() - a.pose.translation.cast<Wide>()};
  const filtered::Mover ma = filtered::make_mover(a, fa.rotation, a.motion);
  const filtered::Mover mb = filtered::make_mover(b, fb.rotation, b.motion);
  const filtered::Sweep sweep(ma, mb, fb.translation);
  const double accuracy = accuracy_of(std::max(scale_of(a, ma.body.extent), scale_of(b, mb.body.extent)));
  if (closed_form.end == filtered::SearchEnd::hit)
    return to_refined_answer(filtered::with_points(sweep, closed_form, accuracy), a, b);
  if (row.cast && !sweep.turns())
    if (const filtered::Search s = translating_polytopes(sweep, accuracy); settled(s)) return to_answer(s, a);
  const auto search_from = [&](double t) { return search(sweep, t, 1, accuracy, {}); };
  const filtered::Search s = search_from(0);
  if (settled(s)) return to_refined_answer(s, a, b);
  if (s.end == filtered::SearchEnd::start)
    if (const auto met = contact_at_start(a, b, detail)) return *met;
  const MovingCore ca = moving_core(narrow::make_core(a, fa), a.motion);
  const MovingCore cb = moving_core(narrow::make_core(b, fb), b.motion);
  const Pursuit p = pursue(sweep, s, search_from, [&](double t, double leave) {
    return advance(ca, cb, t, {1, accuracy, leave});
  });
  return settled(p.search) ? to_refined_answer(p.search, a, b) : shift_witnesses(p.fine, a.pose.translation);
}

ImpactAnswer convex_half_space(const MovingShape& a, const MovingShape& b, ImpactDetail detail, const Row&) {
  const WideFrame fa = shifted(a.pose, a.pose.translation.cast<Wide>());
  const narrow::WidePlane plane =
      narrow::place(*std::get_if<HalfSpace>(b.shape), shifted(b.pose, a.pose.translation.cast<Wide>()));
  const filtered::Mover ma = filtered::make_mover(a, fa.rotation, a.motion);
  const filtered::Mover face = point_at_rest();
  const WideVec foot = plane.normal * plane.offset;
  const filtered::Sweep sweep(ma, face, foot);
  const Vec3 normal = -plane.normal.cast<double>();
  const double accuracy = accuracy_of(scale_of(a, ma.body.extent));
  const auto search_from = [&](double t) { return search(sweep, t, 1, accuracy, normal); };
  const filtered::Search s = search_from(0);
  if (settled(s)) return to_answer(s, a);
  if (s.end == filtered::SearchEnd::start)
    if (const auto met = contact_at_start(a, b, detail)) return *met;
  const MovingCore ca = moving_core(narrow::make_core(a, fa), a.motion);
  const Pursuit p = pursue(sweep, s, search_from, [&](double t, double leave) {
    return advance(ca, plane, t, {1, accuracy, leave});
  });
  return settled(p.search) ? to_answer(p.search, a) : shift_witnesses(p.fine, a.pose.translation);
}

}  // namespace touchstone::impact
