#include "reports/stability/forms.h"

#include <algorithm>
#include <cmath>

#include "fuzz/judge/exact_map.h"
#include "fuzz/judge/judge.h"
#include "fuzz/judge/relation.h"

namespace touchstone::fuzz {
namespace {

void nudge(Scene& s, Rng& rng) {
  for (double& x : s.bodies[1].pose.translation)
    x = std::nextafter(x, rng.chance(0.5) ? HUGE_VAL : -HUGE_VAL);
}

// Times are ill-conditioned where bodies graze, so different times are a contradiction only if one is wrong.
bool times_contradict(const Observation& x, bool x_is_wrong, const Form& form,
                      const CaseObservations& observed, std::size_t query, const EngineCard& card,
                      Truth& truth) {
  const Observation& y = observed.answers[query];
  if (!x.toi && !y.toi) return false;
  const double tau = tau_of(card, x, truth.scale(0, 1)) + tau_of(card, y, truth.scale(0, 1));
  if (x.toi && y.toi && std::fabs(*x.toi - *y.toi) * truth.speed(0, 1) <= tau) return false;
  if (x_is_wrong) return true;
  Truth of_form(form.c.scene);
  return !judge(form.c, card, observed, of_form)[query].faults.empty();
}

bool gaps_contradict(const FormAnswer& asked, const Form& form, const CaseObservations& observed,
                     std::size_t query, const EngineCard& card) {
  const GapInterval x =
      implied_gap(asked.c.scene, asked.c.queries[query], asked.observed.answers[query], card);
  const GapInterval y = implied_gap(form.c.scene, form.c.queries[query], observed.answers[query], card);
  return std::max(form.scale * x.lo, y.lo) > std::min(form.scale * x.hi, y.hi);
}

}  // namespace

std::vector<Form> other_forms(const Case& c, Rng& rng) {
  std::vector<Form> forms;
  const auto add = [&](FormKind kind, double scale = 1) -> Form& {
    return forms.emplace_back(Form{kind, c, scale});
  };
  nudge(add(FormKind::nudged).c.scene, rng);
  for (Query& q : add(FormKind::exchanged).c.queries) std::swap(q.a, q.b);
  for (int axis = 0; axis < 3; ++axis) half_turn(add(FormKind::frame).c.scene, axis);
  if (std::none_of(c.scene.shapes.begin(), c.scene.shapes.end(), has_own_axis)) {
    Mat3 cycle;
    cycle << 0, 1, 0, 0, 0, 1, 1, 0, 0;
    turn_axes(add(FormKind::frame).c.scene, cycle);
  }
  if (!translate_by(add(FormKind::frame).c.scene, -c.scene.bodies[0].pose.translation)) forms.pop_back();
  for (const double factor : {enlarged, reduced})
    if (!scale_by(add(FormKind::unit, factor).c.scene, factor)) forms.pop_back();
  return forms;
}

double number_of(const Query& q, const Observation& o) {
  const double nan = std::nan("");
  if (o.outcome != Outcome::answered) return nan;
  switch (q.question) {
    case Question::distance:
      return o.distance.value_or(nan);
    case Question::contact:
      return o.overlap && *o.overlap ? o.depth.value_or(nan) : nan;
    case Question::time_of_impact:
      return o.toi.value_or(nan);
    default:
      return nan;
  }
}

bool contradicts(const FormAnswer& asked, bool asked_is_wrong, const Form& form,
                 const CaseObservations& observed, std::size_t query, const EngineCard& card, Truth& truth) {
  const Observation &x = asked.observed.answers[query], &y = observed.answers[query];
  if (depends_on_time(x.outcome) || depends_on_time(y.outcome)) return false;
  const bool answered = x.outcome == Outcome::answered;
  if (answered != (y.outcome == Outcome::answered)) return true;
  if (!answered) return false;
  if (asked.c.queries[query].question == Question::time_of_impact)
    return times_contradict(x, asked_is_wrong, form, observed, query, card, truth);
  return gaps_contradict(asked, form, observed, query, card);
}

}  // namespace touchstone::fuzz
