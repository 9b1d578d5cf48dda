// Lies about the outcome itself: no number, failure on valid input, answers that change or are left over.
#include <cmath>
#include <limits>

#include "tests/mutants/pair.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

Observation outcome(Outcome what) {
  Observation o;
  o.outcome = what;
  return o;
}

void distance_nan(const Case&, const Query& q, Observation& o) {
  if (asks(q, Question::distance) && o.distance) o.distance = nan_value;
}
void distance_infinite(const Case&, const Query& q, Observation& o) {
  if (asks(q, Question::distance) && o.distance && *o.distance < 0) o.distance = -inf;
}
void distance_largest_double(const Case&, const Query& q, Observation& o) {
  if (asks(q, Question::distance) && o.distance && *o.distance > 1)
    o.distance = std::numeric_limits<double>::max();
}
void distance_withheld(const Case&, const Query& q, Observation& o) {
  if (asks(q, Question::distance)) {
    o.distance.reset();
    o.overlap.reset();
  }
}
void verdict_withheld(const Case& c, const Query& q, Observation& o) {
  if (asks(q, Question::overlap) && are(c, q, ShapeKind::cone, ShapeKind::cone)) o.overlap.reset();
}
void contact_without_verdict(const Case&, const Query& q, Observation& o) {
  if (asks(q, Question::contact) && o.depth) o.overlap.reset();
}
void impact_not_a_time(const Case&, const Query& q, Observation& o) {
  if (asks(q, Question::time_of_impact) && o.toi && *o.toi == 0) o.toi = -0x1p-60;
}
void gives_up_on_contact(const Case&, const Query& q, Observation& o) {
  if (asks(q, Question::contact)) o = outcome(Outcome::not_converged);
}
void gives_up_near(const Case& c, const Query& q, Observation& o) {
  if (asks(q, Question::distance) && o.distance && std::abs(*o.distance) < 1e-10 * small_size(c, q))
    o = outcome(Outcome::not_converged);
}
void throws_on_equal_origins(const Case& c, const Query& q, Observation& o) {
  if (is_pair_question(q.question) && body(c, q.a).pose.translation == body(c, q.b).pose.translation)
    o = outcome(Outcome::threw);
}
void refuses_flat_hulls(const Case& c, const Query& q, Observation& o) {
  if (!is_pair_question(q.question)) return;
  for (const int i : {q.a, q.b}) {
    const auto* h = std::get_if<Hull>(&c.scene.shape_of(i));
    if (h && h->dimension < 3) o = outcome(Outcome::invalid_input);
  }
}
void refuses_quaternions(const Case& c, const Query& q, Observation& o) {
  if (!asks(q, Question::contact)) return;
  const Quat& r = body(c, q.b).pose.rotation;
  const double length = r.x * r.x + r.y * r.y + r.z * r.z + r.w * r.w;
  if (std::abs(length - 1) > 1e-6) o = outcome(Outcome::invalid_input);
}

// Every third verdict is inverted, independent of the question.
Lie every_third_flips() {
  return [n = 0](const Case&, const Query& q, Observation& o) mutable {
    if (asks(q, Question::overlap) && o.overlap && ++n % 3 == 0) o.overlap = !*o.overlap;
  };
}
// Cached by the kinds of the two shapes only: the answer of the previous pair of the same kinds.
Lie cached_by_kinds() {
  return [key = std::pair{ShapeKind::sphere, ShapeKind::sphere}, last = 0.0](const Case& c, const Query& q,
                                                                             Observation& o) mutable {
    if (!asks(q, Question::distance) || !o.distance) return;
    const auto kinds = std::pair{kind(c, q.a), kind(c, q.b)};
    const double now = *o.distance;
    if (kinds == key) o.distance = last;
    key = kinds;
    last = now;
  };
}
// The previous contact is left over when the next pair has no contact.
Lie contact_left_over() {
  return [last = Observation{}](const Case&, const Query& q, Observation& o) mutable {
    if (!asks(q, Question::contact)) return;
    if (o.overlap.value_or(false))
      last = o;
    else if (last.overlap)
      o = last;
  };
}
void unwritten_witness(const Case&, const Query& q, Observation& o) {
  if (asks(q, Question::distance) && o.witness) o.witness = {Vec3::Zero(), Vec3::Zero()};
}
// Answers the first hundred questions correctly.
Lie worn_out() {
  return [n = 0](const Case&, const Query& q, Observation& o) mutable {
    if (asks(q, Question::distance) && o.distance && ++n > 100) *o.distance += 1e-9 * n;
  };
}

}  // namespace

std::vector<Mutant> outcome_lies() {
  return {
      {"not_a_number", "no_number", "separate", "NaN for every distance", distance_nan},
      {"minus_infinity", "no_number", "deep", "minus infinity for every overlap", distance_infinite},
      {"largest_double", "distance_off", "separate", "the largest double beyond 1", distance_largest_double},
      {"distance_withheld", "no_number", "separate", "answered without a distance", distance_withheld},
      {"verdict_withheld", "no_number", "deep", "two cones: answered without a verdict", verdict_withheld},
      {"contact_without_verdict", "no_number", "shallow", "a normal and a depth, but no verdict",
       contact_without_verdict},
      {"time_below_zero", "no_number", "start", "just below 0 for bodies that overlap from the start",
       impact_not_a_time},
      {"cap_as_failure", "not_converged", "near", "gives up on every contact", gives_up_on_contact},
      {"gives_up_near", "not_converged", "near", "gives up on distances below 1e-10 of the size",
       gives_up_near},
      {"throws_on_equal_origins", "threw", "contained", "throws when the two origins are equal",
       throws_on_equal_origins},
      {"refuses_flat_hulls", "invalid_input", "shallow", "calls a flat hull invalid", refuses_flat_hulls},
      {"refuses_quaternions", "invalid_input", "lattice", "calls a quaternion that is not unit invalid",
       refuses_quaternions},
      {"third_verdict_flips", "missed", "deep", "every third verdict is the opposite", every_third_flips(),
       false},
      {"cached_by_kinds", "distance_off", "separate", "the previous distance of a pair of the same kinds",
       cached_by_kinds(), false},
      {"contact_left_over", "ghost", "near", "the previous contact in place of no contact",
       contact_left_over(), false},
      {"worn_out", "distance_off", "separate", "right for a hundred distances, then with a growing error",
       worn_out(), false},
      {"unwritten_witness", "unstable", "separate", "witness points that were never set", unwritten_witness,
       true, true},
  };
}

}  // namespace touchstone::mutants
