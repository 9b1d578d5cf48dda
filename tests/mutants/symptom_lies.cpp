// Lies that share a symptom with another lie: the same kind of wrong answer from different faults.
#include <algorithm>
#include <cmath>

#include "core/math/through_float.h"
#include "tests/mutants/pair.h"
#include "tests/mutants/replay.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

// ---- a distance of 0

using SaysZero = bool (*)(const Case&, const Query&, double);
Lie zero_distance_if(SaysZero says_zero) {
  return [says_zero](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::distance) && o.distance && says_zero(c, q, *o.distance)) o.distance = 0;
  };
}
bool within_epsilon(const Case&, const Query&, double d) { return std::abs(d) < 1e-3; }
bool within_share_of_size(const Case& c, const Query& q, double d) {
  return std::abs(d) < 0.02 * small_size(c, q);
}
// The difference of two coordinates in float.
bool cancels_in_float(const Case& c, const Query& q, double d) {
  const double at = body(c, q.b).pose.translation.norm();
  return at > 0 && through_float(at + d) == through_float(at);
}
// The distance of A's origin from B's box decides that there is nothing to measure.
bool origin_in_box(const Case& c, const Query& q, double) {
  const Aabb box = plain_box(c.scene.shape_of(q.b), body(c, q.b).pose);
  const Vec3& p = body(c, q.a).pose.translation;
  return (p.array() >= box.lo.array()).all() && (p.array() <= box.hi.array()).all();
}

// ---- an overlap that is missed

using FindsApart = bool (*)(const Case&, const Query&);
Lie missed_if(FindsApart finds_apart) {
  return [finds_apart](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::overlap) && o.overlap.value_or(false) && finds_apart(c, q)) o.overlap = false;
  };
}
double origins_apart(const Case& c, const Query& q) {
  return (body(c, q.b).pose.translation - body(c, q.a).pose.translation).norm();
}
// An early-out by spheres that end at the faces instead of the corners.
bool spheres_too_small(const Case& c, const Query& q) {
  if (!is_bounded(kind(c, q.a)) || !is_bounded(kind(c, q.b))) return false;
  return origins_apart(c, q) > extent(c.scene.shape_of(q.a)) + extent(c.scene.shape_of(q.b));
}
// An early-out by boxes that are not turned with their bodies.
bool upright_boxes_apart(const Case& c, const Query& q) {
  const auto box = [&](int i) {
    return plain_box(c.scene.shape_of(i), {body(c, i).pose.translation, Quat{}});
  };
  return !overlaps(box(q.a), box(q.b));
}
// Positions rounded to a grid of 1/64.
bool apart_on_grid(const Case& c, const Query& q) {
  const auto rounded = [&](int i) {
    PlacedShape p = placed(c, i);
    p.pose.translation = (p.pose.translation * 64).array().round() / 64;
    return p;
  };
  return distance(rounded(q.a), rounded(q.b)).distance > 0;
}
// Only B's origin is looked for in A.
bool origin_outside(const Case& c, const Query& q) {
  const Shape point = Sphere{0};
  return distance(placed(c, q.a), {&point, body(c, q.b).pose}).distance > 0;
}

// ---- an overlap that does not exist

using FindsOverlap = bool (*)(const Case&, const Query&);
Lie ghost_if(FindsOverlap finds_overlap) {
  return [finds_overlap](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::overlap) && !o.overlap.value_or(true) && finds_overlap(c, q)) o.overlap = true;
  };
}
bool world_boxes_overlap(const Case& c, const Query& q) {
  return overlaps(plain_box(c.scene.shape_of(q.a), body(c, q.a).pose),
                  plain_box(c.scene.shape_of(q.b), body(c, q.b).pose));
}
bool faces_do_not_separate(const Case& c, const Query& q) {
  if (!is_convex(kind(c, q.a)) || !is_convex(kind(c, q.b))) return false;
  bool has_box = false;
  for (const int i : {q.a, q.b}) {
    if (kind(c, i) != ShapeKind::box) continue;
    has_box = true;
    const Mat3 r = rotation_matrix(body(c, i).pose.rotation);
    for (Eigen::Index k = 0; k < 3; ++k)
      if (width(c, q, r.col(k)) < 0 || width(c, q, -r.col(k)) < 0) return false;
  }
  return has_box;
}
bool within_margin(const Case& c, const Query& q) { return gap(c, q) < 0.01 * small_size(c, q); }
// The diameter of the larger body in place of its radius.
bool spheres_too_large(const Case& c, const Query& q) {
  const double x = extent(c.scene.shape_of(q.a)), y = extent(c.scene.shape_of(q.b));
  return are(c, q, ShapeKind::sphere, ShapeKind::sphere) && origins_apart(c, q) < 2 * std::max(x, y);
}

// ---- a depth that is too small

void slop(const Case&, const Query&, Observation& o) { *o.depth = std::max(0.0, *o.depth - 0.005); }
void share_removed(const Case&, const Query&, Observation& o) { *o.depth *= 0.8; }
void on_grid(const Case&, const Query&, Observation& o) { *o.depth = std::floor(*o.depth * 256) / 256; }
void at_most_radius(const Case& c, const Query& q, Observation& o) {
  *o.depth = std::min(*o.depth, 0.25 * small_size(c, q));
}

// ---- a normal that is not the best

void best_of(const Case& c, const Query& q, Observation& o, const Mat3& axes) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index k = 0; k < 3; ++k)
    for (const double sign : {1.0, -1.0})
      if (const Vec3 n = sign * axes.col(k); width(c, q, n) < least) {
        least = width(c, q, n);
        o.normal = n;
      }
  o.depth = least;
}
bool may_choose_axes(const Case& c, const Query& q) {
  return is_convex(kind(c, q.a)) && is_convex(kind(c, q.b));
}
void best_world_axis(const Case& c, const Query& q, Observation& o) {
  if (may_choose_axes(c, q)) best_of(c, q, o, Mat3::Identity());
}
void best_axis_of_a(const Case& c, const Query& q, Observation& o) {
  if (may_choose_axes(c, q)) best_of(c, q, o, rotation_matrix(body(c, q.a).pose.rotation));
}
void best_axis_of_b(const Case& c, const Query& q, Observation& o) {
  if (may_choose_axes(c, q)) best_of(c, q, o, rotation_matrix(body(c, q.b).pose.rotation));
}

// ---- an impact that is missed

Motion motion_in(const Case& c, int i) { return body(c, i).motion.value_or(Motion{}); }
double gap_in_step(const Case& c, const Query& q, double t) {
  const PlacedShape a{&c.scene.shape_of(q.a), pose_at(body(c, q.a).pose, motion_in(c, q.a), t)},
      b{&c.scene.shape_of(q.b), pose_at(body(c, q.b).pose, motion_in(c, q.b), t)};
  return distance(a, b).distance;
}
using SeesNothing = bool (*)(const Case&, const Query&, double);
Lie impact_missed_if(SeesNothing sees_nothing) {
  return [sees_nothing](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::time_of_impact) && o.toi && sees_nothing(c, q, *o.toi)) o.toi.reset();
  };
}
bool apart_at_end(const Case& c, const Query& q, double) { return gap_in_step(c, q, 1) > 0; }
bool apart_half_way(const Case& c, const Query& q, double) {
  return gap_in_step(c, q, 0.5) > 0 && gap_in_step(c, q, 1) > 0 && gap_in_step(c, q, 0) > 0 &&
         gap_in_step(c, q, 0.25) > 0 && gap_in_step(c, q, 0.75) > 0;
}
bool no_approach_of_origins(const Case& c, const Query& q, double) {
  const Vec3 d = body(c, q.b).pose.translation - body(c, q.a).pose.translation;
  return d.dot(motion_in(c, q.b).linear - motion_in(c, q.a).linear) > -0.5 * d.squaredNorm();
}

// ---- a candidate pair that is lost

const Pose& pose_in(const QueryState& s, int i) { return *s.bodies[static_cast<std::size_t>(i)].pose; }
Aabb box_in(const Scene& s, const QueryState& q, int i) {
  return q.bodies[static_cast<std::size_t>(i)].pose ? plain_box(s.shape_of(i), pose_in(q, i)) : Aabb{};
}
// Cells of side 1, in which only the origin counts.
bool in_neighbour_cells(const Scene& s, const QueryState& q, int a, int b) {
  if (!is_bounded(kind_of(s.shape_of(a))) || !is_bounded(kind_of(s.shape_of(b)))) return true;
  const auto cell = [&](int i) { return Vec3((pose_in(q, i).translation).array().floor()); };
  return ((cell(a) - cell(b)).cwiseAbs().array() <= 1).all();
}
bool in_same_cell(const Scene& s, const QueryState& q, int a, int b) {
  const Aabb x = box_in(s, q, a), y = box_in(s, q, b);
  const auto first = [](const Aabb& box) { return std::floor(box.lo.x() / 4); };
  const auto last = [](const Aabb& box) { return std::floor(box.hi.x() / 4); };
  // Each box is entered in its first and last cell, not in those between.
  return first(x) == first(y) || first(x) == last(y) || last(x) == first(y) || last(x) == last(y);
}
bool within_largest_gap(const Scene& s, const QueryState& q, int a, int b) {
  // A sweep along x that looks back by the size of the later box only.
  const Aabb x = box_in(s, q, a), y = box_in(s, q, b);
  const Aabb &early = x.lo.x() <= y.lo.x() ? x : y, &later = x.lo.x() <= y.lo.x() ? y : x;
  return later.lo.x() - early.lo.x() <= 2 * (later.hi.x() - later.lo.x());
}

constexpr std::string_view zero = "distance 0", missed = "overlap missed", ghost = "overlap claimed",
                           too_small = "depth too small", not_best = "normal not the best",
                           no_impact_seen = "impact missed", pair_missed = "candidate missed";

Mutant of_symptom(std::string_view symptom, std::string_view name, std::string_view fault,
                  std::string_view family, std::string_view line, Lie lie) {
  return {name, fault, family, line, std::move(lie), true, false, symptom};
}

}  // namespace

std::vector<Mutant> symptom_lies() {
  return {
      of_symptom(zero, "zero_by_epsilon", "distance_off", "near", "distance 0 below an absolute 1e-3",
                 zero_distance_if(within_epsilon)),
      of_symptom(zero, "zero_by_share", "distance_off", "near",
                 "distance 0 below a fiftieth of the smaller body", zero_distance_if(within_share_of_size)),
      of_symptom(zero, "zero_by_cancellation", "distance_off", "near",
                 "distance 0 where it cancels between coordinates in float",
                 zero_distance_if(cancels_in_float)),
      of_symptom(zero, "zero_by_origin", "distance_off", "contained",
                 "distance 0 when A's origin is in B's box", zero_distance_if(origin_in_box)),
      of_symptom(missed, "missed_by_spheres", "missed", "shallow",
                 "an early-out by spheres that do not reach the corners", missed_if(spheres_too_small)),
      of_symptom(missed, "missed_by_boxes", "missed", "shallow", "an early-out by boxes that are not turned",
                 missed_if(upright_boxes_apart)),
      of_symptom(missed, "missed_on_grid", "missed", "shallow", "positions rounded to 1/64",
                 missed_if(apart_on_grid)),
      of_symptom(missed, "missed_by_origin", "missed", "shallow", "only B's origin is looked for in A",
                 missed_if(origin_outside)),
      of_symptom(ghost, "ghost_by_boxes", "ghost", "separate", "overlap of the bounding boxes",
                 ghost_if(world_boxes_overlap)),
      of_symptom(ghost, "ghost_by_faces", "ghost", "separate",
                 "a box overlaps what none of its faces separates from it", ghost_if(faces_do_not_separate)),
      of_symptom(ghost, "ghost_by_margin", "ghost", "near",
                 "a margin of a hundredth of the smaller body that is not claimed", ghost_if(within_margin)),
      of_symptom(ghost, "ghost_by_radius", "ghost", "separate", "for two spheres, twice the larger radius",
                 ghost_if(spheres_too_large)),
      of_symptom(too_small, "depth_less_slop", "infeasible", "shallow", "0.005 are allowed to remain",
                 on_contact(slop)),
      of_symptom(too_small, "depth_less_share", "infeasible", "shallow", "a fifth is allowed to remain",
                 on_contact(share_removed)),
      of_symptom(too_small, "depth_on_grid", "infeasible", "shallow", "rounded down to 1/256",
                 on_contact(on_grid)),
      of_symptom(too_small, "depth_within_quarter", "infeasible", "deep",
                 "at most a quarter of the smaller body's extent", on_contact(at_most_radius)),
      of_symptom(not_best, "normal_of_world", "not_minimal", "shallow", "the best axis of the world",
                 on_contact(best_world_axis)),
      of_symptom(not_best, "normal_of_a", "not_minimal", "shallow", "the best axis of A",
                 on_contact(best_axis_of_a)),
      of_symptom(not_best, "normal_of_b", "not_minimal", "shallow", "the best axis of B",
                 on_contact(best_axis_of_b)),
      of_symptom(no_impact_seen, "impact_seen_at_end", "missed", "translate", "only the end is examined",
                 impact_missed_if(apart_at_end)),
      of_symptom(no_impact_seen, "impact_seen_at_quarters", "missed", "bullet",
                 "only every quarter of the step is examined", impact_missed_if(apart_half_way)),
      of_symptom(no_impact_seen, "impact_seen_by_approach", "missed", "spin",
                 "only bodies whose origins approach by half their distance are examined",
                 impact_missed_if(no_approach_of_origins)),
      of_symptom(pair_missed, "candidate_by_origin_cell", "missed", "crowd",
                 "cells of side 1 hold origins, not boxes", keep_pairs(in_neighbour_cells)),
      of_symptom(pair_missed, "candidate_by_end_cells", "missed", "crowd",
                 "a box is entered in the first and last of its cells in x", keep_pairs(in_same_cell)),
      of_symptom(pair_missed, "candidate_by_later_size", "missed", "crowd",
                 "a sweep looks back by twice the later box", keep_pairs(within_largest_gap)),
  };
}

}  // namespace touchstone::mutants
