#include "fuzz/judge/pair_forms.h"

#include <cmath>
#include <utility>

#include "fuzz/judge/exact_map.h"
#include "fuzz/judge/judge.h"

namespace touchstone::fuzz {
namespace {

void nudge(Scene& s, Rng& rng) {
  for (double& x : s.bodies[1].pose.translation)
    x = std::nextafter(x, rng.chance(0.5) ? HUGE_VAL : -HUGE_VAL);
}

// Times are ill-conditioned where bodies graze, so different times are a contradiction only if one is wrong.
bool times_contradict(const Observation& x, bool x_is_wrong, const PairForm& form,
                      const CaseObservations& observed, std::size_t query, const EngineCard& card,
                      Truth& truth) {
  const Observation& y = observed.answers[query];
  if (!x.toi && !y.toi) return false;
  const double l = truth.scale(0, 1);
  const double tau =
      tau_of(card, x, form.c.scene, 0, 1, l) + tau_of(card, y, form.c.scene, 0, 1, l) + sweep_skin(card);
  if (x.toi && y.toi && std::fabs(*x.toi - *y.toi) * truth.speed(0, 1) <= tau) return false;
  if (x_is_wrong) return true;
  Truth of_form(form.c.scene);
  return !judge(form.c, card, observed, of_form)[query].faults.empty();
}

}  // namespace

std::vector<PairForm> other_forms(const Case& c, Rng& rng) {
  std::vector<PairForm> forms;
  const auto add = [&](FormKind kind, double scale = 1) -> Case& {
    return forms.emplace_back(PairForm{{c, scale}, kind}).c;
  };
  nudge(add(FormKind::nudged).scene, rng);
  for (Query& q : add(FormKind::exchanged).queries) std::swap(q.a, q.b);
  for (int axis = 0; axis < 3; ++axis) half_turn(add(FormKind::frame).scene, axis);
  if (!cycle_axes(add(FormKind::frame).scene)) forms.pop_back();
  if (!translate_by(add(FormKind::frame).scene, -c.scene.bodies[0].pose.translation)) forms.pop_back();
  for (const double factor : {enlarged, reduced})
    if (!scale_by(add(FormKind::unit, factor).scene, factor)) forms.pop_back();
  return forms;
}

bool contradicts(const FormAnswer& asked, bool asked_is_wrong, const PairForm& form,
                 const CaseObservations& observed, std::size_t query, const EngineCard& card, Truth& truth) {
  const Observation &x = asked.observed.answers[query], &y = observed.answers[query];
  if (is_answered_once(x.outcome, y.outcome)) return true;
  if (x.outcome != Outcome::answered || y.outcome != Outcome::answered) return false;
  if (is_motion_question(asked.c.queries[query].question))
    return times_contradict(x, asked_is_wrong, form, observed, query, card, truth);
  return miss(form, implied_gap(asked.c.scene, asked.c.queries[query], x, card),
              implied_gap(form.c.scene, form.c.queries[query], y, card)) > 0;
}

}  // namespace touchstone::fuzz
