// Lies that the referee cannot see, or not in the generated cases: an engine that declines what it answers in
// another form, or errs at sizes and positions that no family has. Relations find them, because they derive
// such forms from other cases.
#include <algorithm>
#include <cstdint>
#include <set>

#include "tests/mutants/pair.h"
#include "tests/mutants/replay.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

Observation declined() {
  Observation o;
  o.outcome = Outcome::unsupported;
  return o;
}

double largest(const Case& c, const Query& q) {
  return std::max(extent(c.scene.shape_of(q.a)), extent(c.scene.shape_of(q.b)));
}

void declines_one_order(const Case& c, const Query& q, Observation& o) {
  if (asks(q, Question::contact) && kind(c, q.b) < kind(c, q.a)) o = declined();
}
void declines_one_side(const Case& c, const Query& q, Observation& o) {
  if (asks(q, Question::distance) && body(c, q.b).pose.translation.x() < 0) o = declined();
}
void declines_large(const Case& c, const Query& q, Observation& o) {
  if (asks(q, Question::overlap) && largest(c, q) > 1000) o = declined();
}
void errs_when_large(const Case& c, const Query& q, Observation& o) {
  if (asks(q, Question::distance) && o.distance && largest(c, q) > 1000) *o.distance += 1;
}
void declines_away_from_origin(const Case& c, const Query& q, Observation& o) {
  if (asks(q, Question::overlap) && !body(c, q.a).pose.translation.isZero(0)) o = declined();
}
void declines_above_table(const Case& c, const Query& q, Observation& o) {
  if (asks(q, Question::distance) && small_size(c, q) > 1.25) o = declined();
}
void jumps_when_pushed_apart(const Case& c, const Query& q, Observation& o) {
  if (asks(q, Question::distance) && o.distance && std::abs(*o.distance) < 1e-14 * largest(c, q))
    o.distance = -0.25 * small_size(c, q);
}
void four_times(const Case&, const Query& q, Observation& o) {
  if (asks(q, Question::distance) && o.distance && *o.distance > 0) *o.distance *= 4;
}
void casts_nothing(const Case&, const Query& q, Observation& o) {
  if (asks(q, Question::time_of_impact)) o.toi.reset();
}

// Reports every pair that overlaps, but of the others only those in one order along x.
Lie superfluous_by_order() {
  return keep_pairs([](const Scene& s, const QueryState& state, int a, int b) {
    const auto &x = state.bodies[static_cast<std::size_t>(a)].pose,
               &y = state.bodies[static_cast<std::size_t>(b)].pose;
    if (!x || !y || x->translation.x() <= y->translation.x()) return true;
    return overlap({&s.shape_of(a), *x}, {&s.shape_of(b), *y}).overlap;
  });
}
// The same for bodies that have been inserted more than once.
Lie superfluous_once() {
  return keep_pairs([](const Scene& s, const QueryState& state, int a, int b) {
    const BodyHistory &x = state.bodies[static_cast<std::size_t>(a)],
                      &y = state.bodies[static_cast<std::size_t>(b)];
    if (!x.pose || !y.pose || (x.inserts < 2 && y.inserts < 2)) return true;
    return overlap({&s.shape_of(a), *x.pose}, {&s.shape_of(b), *y.pose}).overlap;
  });
}
// Answers a pair once and declines it afterwards.
Lie answers_once() {
  return [seen = std::set<std::uint64_t>{}](const Case& c, const Query& q, Observation& o) mutable {
    if (asks(q, Question::overlap) && !seen.insert(hash(c.scene)).second) o = declined();
  };
}

}  // namespace

std::vector<Mutant> relation_lies() {
  return {
      {"declines_one_order", "relation_swap", "shallow", "no contact when B's kind of shape is the lower one",
       declines_one_order},
      {"declines_one_side", "relation_axes", "separate", "no distance when B is at negative x",
       declines_one_side},
      {"declines_large", "relation_scale", "deep", "no verdict on bodies larger than 1000", declines_large},
      {"errs_when_large", "relation_scale", "separate", "off by 1 for bodies larger than 1000",
       errs_when_large},
      {"declines_off_origin", "relation_rigid", "deep", "no verdict unless A is at the origin",
       declines_away_from_origin},
      {"declines_grown", "relation_grow", "separate", "no distance for two bodies larger than 1.25",
       declines_above_table},
      {"slope_steep", "relation_slope", "separate", "a distance four times too large", four_times},
      {"jumps_when_touching", "relation_push", "shallow", "bodies that touch within rounding overlap deeply",
       jumps_when_pushed_apart},
      {"casts_nothing", "relation_step", "translate", "no impact, ever", casts_nothing},
      {"superfluous_by_order", "relation_order", "crowd", "superfluous pairs in only one order along x",
       superfluous_by_order()},
      {"superfluous_once", "relation_reinsert", "crowd", "superfluous pairs until a body is reinserted",
       superfluous_once()},
      {"answers_once", "relation_questions", "separate", "a repeated question gets no answer", answers_once(),
       false},
  };
}

}  // namespace touchstone::mutants
