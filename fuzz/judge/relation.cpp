#include "fuzz/judge/relation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/input_error.h"
#include "core/math/roundoff.h"
#include "fuzz/judge/largest_number.h"
#include "fuzz/judge/truth.h"

namespace touchstone::fuzz {
namespace {

constexpr std::array rows{
    Relation{"relation_questions", "overlap, distance and contact of a pair agree, also when asked again",
             derive_questions},
    Relation{"relation_swap", "A and B exchanged", derive_swap},
    Relation{"relation_axes", "axes permuted or their signs flipped: exact", derive_axes},
    Relation{"relation_scale", "everything scaled by a power of two: exact", derive_scale},
    Relation{"relation_rigid", "both bodies moved by one rigid motion", derive_rigid},
    Relation{"relation_push", "B pushed by the stated depth along the stated normal touches", derive_push},
    Relation{"relation_grow", "a body grown: the gap does not grow", derive_grow},
    Relation{"relation_slope", "B moved a little to either side: the distance follows its own gradient",
             derive_slope},
    Relation{"relation_step", "the bodies placed where they are during the step", derive_step},
    Relation{"relation_order", "bodies in another order: the same pairs", derive_order},
    Relation{"relation_reinsert", "bodies removed and inserted again: the same pairs", derive_reinsert},
};

bool is_mesh(const Scene& s, int i) { return touchstone::is_mesh(s.shape_of(i)); }

GapInterval of_verdict(bool overlap, double tau) {
  return overlap ? GapInterval{-infinity, tau} : GapInterval{-tau, infinity};
}

// A mesh has no depth, and that of a solid is known as a bracket: an overlap only implies that there is no
// gap.
GapInterval of_distance(double d, double tau, bool mesh) {
  if (mesh && d <= 0) return {-infinity, tau};
  return {d - tau, d + tau};
}

GapInterval of_margin(bool within, double margin, double tau, bool mesh) {
  if (mesh && margin < 0) return {};
  return within ? GapInterval{-infinity, margin + tau} : GapInterval{margin - tau, infinity};
}

// A bound that is not a number implies nothing here: the judge reports it.
GapInterval of_bounds(const Observation& o, double tau, bool mesh) {
  GapInterval g;
  if (o.lower_bound && *o.lower_bound > -infinity && !(mesh && *o.lower_bound <= 0))
    g.lo = *o.lower_bound - tau;
  if (o.upper_bound && *o.upper_bound < infinity)
    g.hi = (mesh ? std::max(0.0, *o.upper_bound) : *o.upper_bound) + tau;
  return g;
}

double displacement(const Scene& s, const ReceivedScene& received) {
  if (!is_held(s, received, {Question::scene_contacts})) return infinity;
  Truth truth(s);
  return truth.displacement(truth.frame_of(received));
}

// A contradiction that the rounding of the received scenes can explain is blamed on that rounding: bodies
// displaced by D from the given ones change a gap by at most 2D.
Blame blame_of_contradiction(double miss_by, const RelationInput& in, const Derived& d,
                             const CaseObservations& observed) {
  const double explained =
      2 * (d.scale * displacement(in.c.scene, in.base.received) + displacement(d.c.scene, observed.received));
  return miss_by <= explained ? Blame::representation : Blame::algorithm;
}

std::string interval_text(const GapInterval& g) { return fmt::format("[{:.9g}, {:.9g}]", g.lo, g.hi); }

std::optional<RelationBreak> find_gap_break(const Relation& r, const RelationInput& in, const Derived& d,
                                            const CaseObservations& observed) {
  std::optional<RelationBreak> worst;
  double worst_miss = 0;
  for (const Expected& e : d.expected)
    for (std::size_t k = 0; k < d.c.queries.size(); ++k) {
      const Query& q = d.c.queries[k];
      const GapInterval here = implied_gap(d.c.scene, q, observed.answers[k], in.card);
      const double by = miss(d, e.gap, here);
      if (!(by > worst_miss)) continue;
      worst_miss = by;
      const Query& base = in.c.queries[static_cast<std::size_t>(e.query)];
      worst = RelationBreak{r.name, e.query, base.a, base.b, by / scale_of_pair(d.c.scene, q.a, q.b), {}, {}};
      worst->words = fmt::format("{}: `{}` puts the gap in {}, but `{}` put it in {} before", d.words,
                                 to_string(q.question), interval_text(here), to_string(base.question),
                                 interval_text(mapped(d, e.gap)));
    }
  if (worst) worst->blame = blame_of_contradiction(worst_miss, in, d, observed);
  return worst;
}

// Reports an engine that answers in one form but not in the other.
std::optional<RelationBreak> find_missing_answer(const Relation& r, const RelationInput& in, const Derived& d,
                                                 const CaseObservations& observed) {
  std::size_t k = 0;
  for (std::size_t i = 0; i < in.c.queries.size() && k < observed.answers.size(); ++i) {
    const Query& q = in.c.queries[i];
    if (d.body_of.empty() && !is_pair_question(q.question)) continue;
    const Outcome before = in.base.answers[i].outcome, after = observed.answers[k++].outcome;
    if (!is_answered_once(before, after)) continue;
    return RelationBreak{r.name,
                         static_cast<int>(i),
                         q.a,
                         q.b,
                         0,
                         Blame::algorithm,
                         fmt::format("{}: `{}` was {}, now {}", d.words, to_string(q.question),
                                     to_string(before), to_string(after))};
  }
  return std::nullopt;
}

}  // namespace

GapInterval mapped(const Form& form, const GapInterval& in_base) {
  return {form.scale * in_base.lo - form.rounding, form.scale * in_base.hi + form.rounding};
}

double miss(const Form& form, const GapInterval& in_base, const GapInterval& here) {
  const GapInterval due = mapped(form, in_base);
  return std::max(here.lo, due.lo) - std::min(here.hi, due.hi);
}

bool is_answered_once(Outcome in_base, Outcome here) {
  if (depends_on_time(in_base) || depends_on_time(here)) return false;
  return (in_base == Outcome::answered) != (here == Outcome::answered);
}

std::span<const Relation> relations() { return rows; }

bool is_relation(std::string_view fault) {
  return std::any_of(rows.begin(), rows.end(), [&](const Relation& r) { return r.name == fault; });
}

namespace {

// The largest single number among all sizes, positions and velocities: squares may exceed the range of
// doubles.
double largest_length(const Scene& s) {
  double most = 0;
  for (const Shape& shape : s.shapes) most = std::max(most, largest_number(shape));
  for (const Body& b : s.bodies) {
    most = std::max(most, largest_number(b.pose.translation));
    if (b.motion) most = std::max(most, largest_number(b.motion->linear));
  }
  return most;
}

}  // namespace

bool is_within_numbers(const Scene& base, const Scene& derived) {
  try {
    validate(derived);
  } catch (const InputError&) {
    return false;
  }
  // Below this limit the sum of a few coordinates is still a double.
  constexpr double far = 0x1p1020;
  const double l = largest_length(derived);
  return l <= far || l <= largest_length(base);
}

GapInterval implied_gap(const Scene& s, const Query& q, const Observation& o, const EngineCard& card) {
  if (o.outcome != Outcome::answered || !is_pair_question(q.question)) return {};
  const double tau = tau_of(card, o, s, q.a, q.b, scale_of_pair(s, q.a, q.b));
  const bool mesh = is_mesh(s, q.a) || is_mesh(s, q.b);
  const bool measures = q.question == Question::distance || q.question == Question::bounded_distance;
  if (measures && o.distance)
    return std::isfinite(*o.distance) ? of_distance(*o.distance, tau, mesh) : GapInterval{};
  if (measures && (o.lower_bound || o.upper_bound)) return of_bounds(o, tau, mesh);
  if (is_contact_question(q.question) && o.overlap && *o.overlap && o.normal && o.depth && !mesh) {
    const double p = *o.depth;
    const double bias = depth_bias(card, kind_of(s.shape_of(q.a)), kind_of(s.shape_of(q.b)));
    const double least = -p + 2 * tau + bias * std::max(0.0, p);
    return std::isfinite(p) ? GapInterval{-p - tau, least} : GapInterval{};
  }
  if (q.question == Question::within || q.question == Question::contact_within)
    return o.overlap ? of_margin(*o.overlap, s.margin, tau, mesh) : GapInterval{};
  if (!is_motion_question(q.question) && o.overlap)
    return of_verdict(*o.overlap, *o.overlap ? tau + contact_offset(card) : tau);
  return {};
}

std::optional<BodyPair> pair_asked(const Case& c) {
  std::optional<BodyPair> pair;
  bool at_rest = false;
  for (const Query& q : c.queries) {
    if (!is_pair_question(q.question)) continue;
    if (pair && *pair != BodyPair{q.a, q.b}) return std::nullopt;
    pair = BodyPair{q.a, q.b};
    at_rest |= !is_motion_question(q.question);
  }
  return at_rest ? pair : std::nullopt;
}

std::vector<Expected> implied_gaps(const RelationInput& in) {
  std::vector<Expected> r;
  for (std::size_t i = 0; i < in.c.queries.size(); ++i) {
    const GapInterval g = implied_gap(in.c.scene, in.c.queries[i], in.base.answers[i], in.card);
    if (!g.says_nothing()) r.push_back({static_cast<int>(i), g});
  }
  return r;
}

std::vector<Query> same_queries(const Case& c) {
  std::vector<Query> r;
  for (const Query& q : c.queries)
    if (is_pair_question(q.question)) r.push_back({q.question, 0, 1});
  return r;
}

double pose_rounding(const Scene& pair) {
  double size = 0;
  for (std::size_t i = 0; i < pair.bodies.size(); ++i) {
    const Shape& shape = pair.shape_of(static_cast<int>(i));
    size += pair.bodies[i].pose.translation.stableNorm();
    if (const auto* h = std::get_if<HalfSpace>(&shape))
      size += std::abs(h->offset) / h->normal.stableNorm();
    else
      size += bounding_radius(shape);
  }
  // A quaternion product and a rotated vector: about 16 roundings, times two for the two bodies, times two in
  // reserve.
  constexpr double roundings = 64;
  return roundings * double_roundoff * size;
}

std::optional<RelationBreak> find_break(const Relation& r, const RelationInput& in, const Derived& d,
                                        const CaseObservations& observed) {
  if (d.same_questions)
    if (auto b = find_missing_answer(r, in, d, observed)) return b;
  if (!d.body_of.empty()) return find_scene_break(r, in, d, observed);
  return find_gap_break(r, in, d, observed);
}

}  // namespace touchstone::fuzz
