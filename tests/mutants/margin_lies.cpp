// Lies about margins, bounds and rays.
#include <algorithm>
#include <cmath>

#include "core/broad/catalog.h"
#include "core/impact/impact.h"
#include "core/narrow/bounded.h"
#include "core/world/world.h"
#include "tests/mutants/pair.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

// --- within a margin

// The verdict for another margin.
Lie for_margin(double (*other)(const Case&, const Query&)) {
  return [other](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::within) && o.overlap) o.overlap = gap(c, q) <= other(c, q);
  };
}
double no_margin(const Case&, const Query&) { return 0; }
double margin_of_each(const Case& c, const Query&) { return 2 * c.scene.margin; }
double half_margin(const Case& c, const Query&) { return c.scene.margin / 2; }
double magnitude(const Case& c, const Query&) { return std::abs(c.scene.margin); }
double never_negative(const Case& c, const Query&) { return std::max(0.0, c.scene.margin); }
double a_little_more(const Case& c, const Query&) { return c.scene.margin + 1e-9; }
double a_little_less(const Case& c, const Query&) { return c.scene.margin - 1e-9; }
double none_between_balls(const Case& c, const Query& q) {
  return are(c, q, ShapeKind::sphere, ShapeKind::sphere) ? 0 : c.scene.margin;
}
double squared_margin(const Case& c, const Query&) { return c.scene.margin * std::abs(c.scene.margin); }

// Boxes widened by the margin: corners are too near.
void by_boxes(const Case& c, const Query& q, Observation& o) {
  if (!asks(q, Question::within) || !o.overlap || c.scene.margin <= 0) return;
  const auto* a = std::get_if<Box>(&c.scene.shape_of(q.a));
  const auto* b = std::get_if<Box>(&c.scene.shape_of(q.b));
  const bool upright = body(c, q.a).pose.rotation == Quat{} && body(c, q.b).pose.rotation == Quat{};
  if (!a || !b || !upright) return;
  const Vec3 apart = (body(c, q.a).pose.translation - body(c, q.b).pose.translation).cwiseAbs();
  o.overlap = ((apart - a->half_extents - b->half_extents).array() <= c.scene.margin).all();
}

// --- candidates within a margin

Lie for_candidates(double (*other)(double)) {
  return [other](const Case& c, const Query& q, Observation& o) {
    if (!asks(q, Question::candidates_within) || o.outcome != Outcome::answered) return;
    Scene s = c.scene;
    s.margin = other(s.margin);
    o.candidate_pairs = candidate_pairs_within(s, *broad::make_broad_phase("automatic"));
  };
}
double ignored(double) { return 0; }
double halved(double m) { return m / 2; }
double nearly(double m) { return std::max(0.0, m - 1e-3); }
double squared(double m) { return m * m; }

// The pairs of another margin in the queries or of the bodies that `is_one` accepts.
Lie some_candidates(bool (*is_one)(const Case&, std::size_t query, const BodyPair&)) {
  return [is_one](const Case& c, const Query& q, Observation& o) {
    if (!asks(q, Question::candidates_within) || o.outcome != Outcome::answered) return;
    Scene s = c.scene;
    s.margin = 0;
    const auto touching = candidate_pairs_within(s, *broad::make_broad_phase("automatic"));
    for (std::size_t k = 0; k < o.candidate_pairs.size(); ++k)
      std::erase_if(o.candidate_pairs[k], [&](const BodyPair& p) {
        return is_one(c, k, p) && !std::ranges::binary_search(touching.at(k), p);
      });
  };
}
bool later(const Case&, std::size_t query, const BodyPair&) { return query > 0; }
bool of_balls(const Case& c, std::size_t, const BodyPair& p) {
  return kind(c, p.first) == ShapeKind::sphere && kind(c, p.second) == ShapeKind::sphere;
}

void last_near_pair_lost(const Case&, const Query& q, Observation& o) {
  if (asks(q, Question::candidates_within) && !o.candidate_pairs.empty() && !o.candidate_pairs[0].empty())
    o.candidate_pairs[0].pop_back();
}
void near_stranger(const Case& c, const Query& q, Observation& o) {
  if (asks(q, Question::candidates_within) && !o.candidate_pairs.empty())
    o.candidate_pairs[0].emplace_back(0, static_cast<int>(c.scene.bodies.size()));
}

// --- bounds

Lie bound(double (*lower)(const Case&, const Query&, double)) {
  return [lower](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::bounded_distance) && o.lower_bound) o.lower_bound = lower(c, q, *o.lower_bound);
  };
}
double of_centres(const Case& c, const Query& q, double) {
  return (body(c, q.a).pose.translation - body(c, q.b).pose.translation).norm();
}
double one_percent_more(const Case& c, const Query& q, double) { return 1.01 * gap(c, q); }
double below_margin(const Case& c, const Query&, double) { return c.scene.margin - 1; }
double not_finite(const Case&, const Query&, double) { return std::nan(""); }

// "Farther than that" without looking where the bodies are near.
void always_farther(const Case& c, const Query& q, Observation& o) {
  if (!asks(q, Question::bounded_distance) || !o.distance || *o.distance > c.scene.margin) return;
  o = Observation{};
  o.outcome = Outcome::answered;
  o.lower_bound = c.scene.margin + 1e-6;
}
void cut_off(const Case& c, const Query& q, Observation& o) {
  if (asks(q, Question::bounded_distance) && o.distance) o.distance = std::min(*o.distance, c.scene.margin);
}
void upper_too_low(const Case&, const Query& q, Observation& o) {
  if (!asks(q, Question::distance) || !o.distance) return;
  o.upper_bound = *o.distance - 1e-9;
}
void lower_too_high(const Case&, const Query& q, Observation& o) {
  if (asks(q, Question::distance) && o.distance) o.lower_bound = *o.distance + 1e-9;
}

// --- rays

Lie on_ray(void (*lie)(const Case&, const Query&, Observation&)) {
  return [lie](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::ray) && o.outcome == Outcome::answered) lie(c, q, o);
  };
}
void ray_missed(const Case&, const Query&, Observation& o) {
  if (o.toi && *o.toi > 0.5) o.toi.reset();
}
void ray_late(const Case&, const Query&, Observation& o) {
  if (o.toi && *o.toi > 0) o.toi = std::min(1.0, *o.toi + 1e-9);
}
void ray_early(const Case&, const Query&, Observation& o) {
  if (o.toi) *o.toi *= 0.999;
}
void ray_hits_all(const Case&, const Query&, Observation& o) {
  if (!o.toi) o.toi = 0.5;
}
void ray_normal_inward(const Case&, const Query&, Observation& o) {
  if (o.normal) o.normal = -*o.normal;
}
void ray_normal_against_ray(const Case& c, const Query& q, Observation& o) {
  if (o.normal) o.normal = -body(c, q.b).motion->linear.normalized();
}
void ray_normal_long(const Case&, const Query&, Observation& o) {
  if (o.normal) *o.normal *= 1.01;
}
void ray_ball_of_box(const Case& c, const Query& q, Observation& o) {
  const Shape ball = Sphere{bounding_radius(c.scene.shape_of(q.a))};
  if (kind(c, q.a) != ShapeKind::box) return;
  const Body& b = body(c, q.b);
  o.toi = time_of_impact({&ball, body(c, q.a).pose, {}}, {&c.scene.shape_of(q.b), b.pose, *b.motion}).toi;
  o.overlap.reset();
}
void ray_inside_denied(const Case&, const Query&, Observation& o) {
  if (o.overlap.value_or(false)) o.overlap = false;
}

}  // namespace

std::vector<Mutant> margin_lies() {
  return {
      {"within_no_margin", "missed", "margins", "the margin is ignored", for_margin(no_margin)},
      {"within_twice", "ghost", "margins", "each body gets the margin", for_margin(margin_of_each)},
      {"within_half", "missed", "margins", "half the margin", for_margin(half_margin)},
      {"within_magnitude", "ghost", "margins", "the sign of the margin is lost", for_margin(magnitude)},
      {"within_clamped", "ghost", "margins", "a negative margin counts as 0", for_margin(never_negative)},
      {"within_ghost_near", "ghost", "margins", "1e-9 beyond the margin is within",
       for_margin(a_little_more)},
      {"within_missed_near", "missed", "margins", "the last 1e-9 of the margin is beyond",
       for_margin(a_little_less)},
      {"within_spheres", "missed", "margins", "two spheres have no margin", for_margin(none_between_balls)},
      {"within_squared", "missed", "margins", "the square of the margin", for_margin(squared_margin)},
      {"within_boxes", "ghost", "margins", "upright boxes are widened by the margin", by_boxes},
      {"near_pairs_no_margin", "missed", "loose", "the margin is ignored", for_candidates(ignored)},
      {"near_pairs_half", "missed", "loose", "half the margin in all", for_candidates(halved)},
      {"near_pairs_short", "missed", "loose", "0.001 less than the margin", for_candidates(nearly)},
      {"near_pairs_squared", "missed", "loose", "the square of the margin", for_candidates(squared)},
      {"near_pairs_first_query", "missed", "loose", "no margin after the first query",
       some_candidates(later)},
      {"near_pairs_spheres", "missed", "loose", "two spheres have no margin", some_candidates(of_balls)},
      {"near_pairs_last_lost", "missed", "loose", "the last pair is lost", last_near_pair_lost},
      {"near_pairs_stranger", "stale", "loose", "a pair names a body that does not exist", near_stranger},
      {"bound_of_centres", "bound_off", "margins", "the distance of the origins as a lower bound",
       bound(of_centres)},
      {"bound_one_percent", "bound_off", "margins", "a lower bound one percent too high",
       bound(one_percent_more)},
      {"bound_below_margin", "no_number", "margins", "a lower bound that does not reach the margin",
       bound(below_margin)},
      {"bound_not_a_number", "no_number", "margins", "a lower bound of NaN", bound(not_finite)},
      {"bound_always_farther", "bound_off", "margins", "everything is farther than the margin",
       always_farther},
      {"bound_cut_off", "distance_off", "margins", "distances end at the margin", cut_off},
      {"bound_upper_low", "bound_off", "separate", "an upper bound that is 1e-9 too low", upper_too_low},
      {"bound_lower_high", "bound_off", "separate", "a lower bound that is 1e-9 too high", lower_too_high},
      {"ray_missed", "missed", "rays", "nothing is hit in the second half", on_ray(ray_missed)},
      {"ray_late", "late", "rays", "1e-9 too late", on_ray(ray_late)},
      {"ray_early", "early", "rays", "a thousandth too early", on_ray(ray_early)},
      {"ray_hits_all", "ghost", "rays", "every ray hits", on_ray(ray_hits_all)},
      {"ray_normal_inward", "not_minimal", "rays", "the normal points into the body",
       on_ray(ray_normal_inward)},
      {"ray_normal_of_ray", "not_minimal", "rays", "the normal is opposite to the ray",
       on_ray(ray_normal_against_ray)},
      {"ray_normal_long", "normal_not_unit", "rays", "the normal is 1 % too long", on_ray(ray_normal_long)},
      {"ray_bounding_ball", "early", "rays", "a box is its bounding ball", on_ray(ray_ball_of_box)},
      {"ray_inside_denied", "missed", "rays", "no ray starts inside", on_ray(ray_inside_denied)},
  };
}

}  // namespace touchstone::mutants
