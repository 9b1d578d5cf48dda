// Lies that differ from another lie by their trigger only: the same wrong answer, given in other cases.
#include <algorithm>

#include "tests/mutants/pair.h"
#include "tests/mutants/replay.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

using Trigger = bool (*)(const Case&, const Query&);

// ---- the wrong answers

Lie half_depth_if(Trigger trigger) {
  return [trigger](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::contact) && o.depth && trigger(c, q)) *o.depth /= 2;
  };
}
Lie overlap_denied_if(Trigger trigger) {
  return [trigger](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::overlap) && o.overlap.value_or(false) && trigger(c, q)) o.overlap = false;
  };
}
Lie too_far_if(Trigger trigger) {
  return [trigger](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::distance) && o.distance && trigger(c, q)) *o.distance += 1e-6 * small_size(c, q);
  };
}
Lie flipped_if(Trigger trigger) {
  return [trigger](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::contact) && o.normal && trigger(c, q)) o.normal = -*o.normal;
  };
}
Lie late_if(Trigger trigger) {
  return [trigger](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::time_of_impact) && o.toi && *o.toi > 0 && trigger(c, q))
      o.toi = std::min(1.0, *o.toi + 0.02);
  };
}
using PairTrigger = bool (*)(const Scene&, const QueryState&, int, int);
Lie lost_if(PairTrigger trigger) {
  return keep_pairs(
      [trigger](const Scene& s, const QueryState& q, int a, int b) { return !trigger(s, q, a, b); });
}

// ---- the triggers

template <ShapeKind x, ShapeKind y>
bool of_kinds(const Case& c, const Query& q) {
  return are(c, q, x, y);
}
template <ShapeKind k>
bool with_kind(const Case& c, const Query& q) {
  return kind(c, q.a) == k || kind(c, q.b) == k;
}
constexpr auto two_boxes = of_kinds<ShapeKind::box, ShapeKind::box>;
constexpr auto two_hulls = of_kinds<ShapeKind::hull, ShapeKind::hull>;

bool is_turned(const Case& c, int i) {
  const Quat& r = body(c, i).pose.rotation;
  return r.x != 0 || r.y != 0 || r.z != 0;
}
bool is_a_turned(const Case& c, const Query& q) { return is_turned(c, q.a); }
bool is_a_upright(const Case& c, const Query& q) { return !is_turned(c, q.a); }
bool is_b_upright(const Case& c, const Query& q) { return !is_turned(c, q.b); }

double larger_size(const Case& c, const Query& q) {
  return std::max(extent(c.scene.shape_of(q.a)), extent(c.scene.shape_of(q.b)));
}
bool is_a_far(const Case& c, const Query& q) { return body(c, q.a).pose.translation.norm() > 1000; }
bool below_a_centimetre(const Case& c, const Query& q) { return larger_size(c, q) < 0.01; }
bool tenfold(const Case& c, const Query& q) { return larger_size(c, q) > 10 * small_size(c, q); }
bool deeper_than_half(const Case& c, const Query& q) { return gap(c, q) < -0.5 * small_size(c, q); }
bool shallower_than_a_hundredth(const Case& c, const Query& q) {
  return gap(c, q) > -0.01 * small_size(c, q);
}
bool farther_than_half(const Case& c, const Query& q) { return gap(c, q) > 0.5 * small_size(c, q); }
bool nearer_than_a_hundredth(const Case& c, const Query& q) {
  return gap(c, q) > 0 && gap(c, q) < 0.01 * small_size(c, q);
}
bool do_overlap(const Case& c, const Query& q) { return gap(c, q) < 0; }
bool is_b_static(const Case& c, const Query& q) { return body(c, q.b).is_static; }
bool is_a_static(const Case& c, const Query& q) { return body(c, q.a).is_static; }

Vec3 from_a_to_b(const Case& c, const Query& q) {
  return body(c, q.b).pose.translation - body(c, q.a).pose.translation;
}
bool is_b_above(const Case& c, const Query& q) {
  const Vec3 d = from_a_to_b(c, q);
  return d.z() > 0 && d.z() == d.cwiseAbs().maxCoeff();
}
bool is_b_left(const Case& c, const Query& q) {
  const Vec3 d = from_a_to_b(c, q);
  return d.x() < 0 && -d.x() == d.cwiseAbs().maxCoeff();
}
bool is_a_off_origin(const Case& c, const Query& q) { return !body(c, q.a).pose.translation.isZero(0); }

bool is_spinning(const Case& c, int i) { return body(c, i).motion && !body(c, i).motion->angular.isZero(0); }
bool one_spins(const Case& c, const Query& q) { return is_spinning(c, q.a) != is_spinning(c, q.b); }
bool none_spins(const Case& c, const Query& q) { return !is_spinning(c, q.a) && !is_spinning(c, q.b); }
bool both_spin(const Case& c, const Query& q) { return is_spinning(c, q.a) && is_spinning(c, q.b); }

bool sphere_and_box(const Scene& s, const QueryState&, int a, int b) {
  const ShapeKind x = kind_of(s.shape_of(a)), y = kind_of(s.shape_of(b));
  return std::min(x, y) == ShapeKind::sphere && std::max(x, y) == ShapeKind::box;
}
bool both_moved(const Scene&, const QueryState& q, int a, int b) {
  return q.bodies[static_cast<std::size_t>(a)].moves > 0 && q.bodies[static_cast<std::size_t>(b)].moves > 0;
}
bool both_below_zero(const Scene&, const QueryState& q, int a, int b) {
  const auto is_below = [&](int i) {
    const auto& p = q.bodies[static_cast<std::size_t>(i)].pose;
    return p && p->translation.z() < 0;
  };
  return is_below(a) && is_below(b);
}

constexpr std::string_view halved = "depth halved", denied = "overlap denied", farther = "too far by 1e-6",
                           flipped = "normal flipped", late = "impact late", lost = "pair lost";

Mutant row(std::string_view symptom, std::string_view name, std::string_view fault, std::string_view family,
           std::string_view line, Lie lie) {
  return {name, fault, family, line, std::move(lie), true, false, symptom};
}

}  // namespace

std::vector<Mutant> trigger_lies() {
  return {
      row(halved, "depth_halved_boxes", "infeasible", "shallow", "half the depth of two boxes",
          half_depth_if(two_boxes)),
      row(halved, "depth_halved_hulls", "infeasible", "shallow", "half the depth of two hulls",
          half_depth_if(two_hulls)),
      row(halved, "depth_halved_half_space", "infeasible", "shallow", "half the depth in a half-space",
          half_depth_if(with_kind<ShapeKind::half_space>)),
      row(halved, "depth_halved_turned", "infeasible", "shallow", "half the depth when A is turned",
          half_depth_if(is_a_turned)),
      row(halved, "depth_halved_upright", "infeasible", "lattice", "half the depth when A is upright",
          half_depth_if(is_a_upright)),
      row(halved, "depth_halved_far", "infeasible", "far",
          "half the depth when A is beyond 1000 from the origin", half_depth_if(is_a_far)),
      row(halved, "depth_halved_small", "infeasible", "tiny", "half the depth of bodies below 0.01",
          half_depth_if(below_a_centimetre)),
      row(halved, "depth_halved_deep", "infeasible", "deep",
          "half the depth when that is more than half the smaller body", half_depth_if(deeper_than_half)),
      row(halved, "depth_halved_static", "infeasible", "shallow", "half the depth when B is static",
          half_depth_if(is_b_static)),
      row(denied, "overlap_denied_cylinders", "missed", "shallow", "two cylinders never overlap",
          overlap_denied_if(of_kinds<ShapeKind::cylinder, ShapeKind::cylinder>)),
      row(denied, "overlap_denied_above", "missed", "shallow", "apart when B is above A",
          overlap_denied_if(is_b_above)),
      row(denied, "overlap_denied_left", "missed", "shallow", "apart when B is left of A",
          overlap_denied_if(is_b_left)),
      row(denied, "overlap_denied_tenfold", "missed", "unequal", "apart when one body is ten times larger",
          overlap_denied_if(tenfold)),
      row(denied, "overlap_denied_off_origin", "missed", "far", "apart when A is not at the origin",
          overlap_denied_if(is_a_off_origin)),
      row(denied, "overlap_denied_upright", "missed", "lattice", "apart when B is upright",
          overlap_denied_if(is_b_upright)),
      row(denied, "overlap_denied_slight", "missed", "shallow",
          "apart when the overlap is less than a hundredth of the smaller body",
          overlap_denied_if(shallower_than_a_hundredth)),
      row(denied, "overlap_denied_static", "missed", "shallow", "apart when A is static",
          overlap_denied_if(is_a_static)),
      row(farther, "distance_farther_ellipsoids", "distance_off", "separate", "too far between ellipsoids",
          too_far_if(of_kinds<ShapeKind::ellipsoid, ShapeKind::ellipsoid>)),
      row(farther, "distance_farther_box_hull", "distance_off", "separate", "too far between box and hull",
          too_far_if(of_kinds<ShapeKind::box, ShapeKind::hull>)),
      row(farther, "distance_farther_when_far", "distance_off", "separate",
          "too far when farther than half the smaller body", too_far_if(farther_than_half)),
      row(farther, "distance_farther_when_near", "distance_off", "near",
          "too far when nearer than a hundredth of the smaller body", too_far_if(nearer_than_a_hundredth)),
      row(farther, "distance_farther_when_deep", "distance_off", "deep", "not deep enough when overlapping",
          too_far_if(do_overlap)),
      row(flipped, "normal_flipped_capsules", "infeasible", "shallow", "from B to A for two capsules",
          flipped_if(of_kinds<ShapeKind::capsule, ShapeKind::capsule>)),
      row(flipped, "normal_flipped_cones", "infeasible", "shallow", "from B to A for two cones",
          flipped_if(of_kinds<ShapeKind::cone, ShapeKind::cone>)),
      row(flipped, "normal_flipped_left", "infeasible", "shallow", "from B to A when B is left of A",
          flipped_if(is_b_left)),
      row(late, "impact_late_one_spins", "late", "spin", "0.02 too late when one body spins",
          late_if(one_spins)),
      row(late, "impact_late_both_spin", "late", "spin", "0.02 too late when both bodies spin",
          late_if(both_spin)),
      row(late, "impact_late_no_spin", "late", "translate", "0.02 too late without rotation",
          late_if(none_spins)),
      row(lost, "pair_lost_sphere_box", "missed", "crowd", "no candidates of a sphere and a box",
          lost_if(sphere_and_box)),
      row(lost, "pair_lost_both_moved", "missed", "script", "lost when both bodies have moved",
          lost_if(both_moved)),
      row(lost, "pair_lost_below_zero", "missed", "crowd", "lost when both bodies are below z = 0",
          lost_if(both_below_zero)),
  };
}

}  // namespace touchstone::mutants
