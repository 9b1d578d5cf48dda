// Lies about the time of impact.
#include <algorithm>
#include <cmath>

#include "core/impact/impact.h"
#include "core/math/through_float.h"
#include "tests/mutants/pair.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

Motion motion(const Case& c, int i) { return body(c, i).motion.value_or(Motion{}); }
MovingShape moving(const Case& c, int i) { return {&c.scene.shape_of(i), body(c, i).pose, motion(c, i)}; }
double spin(const Case& c, const Query& q) {
  return std::max(motion(c, q.a).angular.norm(), motion(c, q.b).angular.norm());
}

using Change = void (*)(const Case&, const Query&, Observation&);
Lie on_impact(Change f) {
  return [f](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::time_of_impact) && o.outcome == Outcome::answered) f(c, q, o);
  };
}

// The right answer for another motion of the two bodies.
Lie for_motion(Motion (*other)(const Case&, int)) {
  return [other](const Case& c, const Query& q, Observation& o) {
    if (!asks(q, Question::time_of_impact) || o.outcome != Outcome::answered) return;
    MovingShape a = moving(c, q.a), b = moving(c, q.b);
    a.motion = other(c, q.a);
    b.motion = other(c, q.b);
    const ImpactAnswer r = time_of_impact(a, b);
    if (r.outcome == Outcome::answered) o.toi = r.toi;
  };
}

Motion without_rotation(const Case& c, int i) { return {motion(c, i).linear, Vec3::Zero()}; }
Motion turning_back(const Case& c, int i) { return {motion(c, i).linear, -motion(c, i).angular}; }
Motion in_body_frame(const Case& c, int i) {
  const Motion m = motion(c, i);
  return {m.linear, rotation_matrix(body(c, i).pose.rotation) * m.angular};
}
Motion second_only(const Case& c, int i) { return i == 0 ? Motion{} : motion(c, i); }
Motion travel_clamped(const Case& c, int i) {
  Motion m = motion(c, i);
  if (m.linear.norm() > 4) m.linear *= 4 / m.linear.norm();
  return m;
}
Motion spin_clamped(const Case& c, int i) {
  Motion m = motion(c, i);
  if (m.angular.norm() > 3) m.angular *= 3 / m.angular.norm();
  return m;
}

void late(const Case&, const Query&, Observation& o) {
  if (o.toi && *o.toi > 0) o.toi = std::min(1.0, *o.toi + 0.02);
}
void late_a_little(const Case&, const Query&, Observation& o) {
  if (o.toi && *o.toi > 0) o.toi = std::min(1.0, *o.toi + 1e-9);
}
void early(const Case&, const Query&, Observation& o) {
  if (o.toi) *o.toi *= 0.9;
}
void early_a_little(const Case&, const Query&, Observation& o) {
  if (o.toi) o.toi = std::max(0.0, *o.toi - 1e-9);
}
void denied(const Case&, const Query&, Observation& o) { o.toi.reset(); }
void denied_at_start(const Case&, const Query&, Observation& o) {
  if (o.toi && *o.toi == 0) o.toi.reset();
}
void after_start(const Case&, const Query&, Observation& o) {
  if (o.toi && *o.toi == 0) o.toi = 1e-6;
}
void denied_at_end(const Case&, const Query&, Observation& o) {
  if (o.toi && *o.toi > 0.9) o.toi.reset();
}
void denied_fast_spin(const Case& c, const Query& q, Observation& o) {
  if (spin(c, q) > 5) o.toi.reset();
}
void invented(const Case&, const Query&, Observation& o) {
  if (!o.toi) o.toi = 0.5;
}
void as_length(const Case& c, const Query& q, Observation& o) {
  if (o.toi) o.toi = *o.toi * (motion(c, q.b).linear - motion(c, q.a).linear).norm();
}
void reversed(const Case&, const Query&, Observation& o) {
  if (o.toi) o.toi = 1 - *o.toi;
}
void as_float(const Case&, const Query&, Observation& o) {
  if (o.toi) o.toi = through_float(*o.toi);
}

double gap_at(const Case& c, const Query& q, double t) {
  const PlacedShape a{&c.scene.shape_of(q.a), pose_at(body(c, q.a).pose, motion(c, q.a), t)},
      b{&c.scene.shape_of(q.b), pose_at(body(c, q.b).pose, motion(c, q.b), t)};
  return distance(a, b).distance;
}
// The first of 16 substeps at which the bodies overlap.
void substeps(const Case& c, const Query& q, Observation& o) {
  if (!o.toi) return;
  for (int k = 0; k <= 16; ++k)
    if (gap_at(c, q, k / 16.0) <= 0) return void(o.toi = k / 16.0);
  o.toi.reset();
}
// Right if one of 32 samples sees an overlap; passes between two samples are lost.
void between_samples(const Case& c, const Query& q, Observation& o) {
  if (!o.toi) return;
  for (int k = 0; k <= 32; ++k)
    if (gap_at(c, q, k / 32.0) <= 0) return;
  o.toi.reset();
}
// A tolerance, relative to the smaller body, below which a touch is not reported.
void grazing_lost(const Case& c, const Query& q, Observation& o) {
  if (!o.toi || *o.toi >= 1) return;
  const double t = std::min(1.0, *o.toi + 0.05);
  if (gap_at(c, q, t) > -1e-4 * small_size(c, q) && gap_at(c, q, 1) > 0) o.toi.reset();
}
void thin_lost(const Case& c, const Query& q, Observation& o) {
  const auto* plate = std::get_if<Box>(&c.scene.shape_of(q.a));
  if (plate && plate->half_extents.minCoeff() < 0.01) o.toi.reset();
}
void fast_lost(const Case& c, const Query& q, Observation& o) {
  if ((motion(c, q.b).linear - motion(c, q.a).linear).norm() > 500 * small_size(c, q)) o.toi.reset();
}
bool with_mesh(const Case& c, const Query& q) {
  return kind(c, q.a) == ShapeKind::mesh || kind(c, q.b) == ShapeKind::mesh;
}
void mesh_never(const Case& c, const Query& q, Observation& o) {
  if (with_mesh(c, q)) o.toi.reset();
}
void mesh_late(const Case& c, const Query& q, Observation& o) {
  if (with_mesh(c, q) && o.toi && *o.toi > 0) o.toi = std::min(1.0, *o.toi + 0.02);
}
void mesh_late_a_little(const Case& c, const Query& q, Observation& o) {
  if (with_mesh(c, q) && o.toi && *o.toi > 0) o.toi = std::min(1.0, *o.toi + 1e-9);
}
void mesh_ends_lost(const Case& c, const Query& q, Observation& o) {
  if (with_mesh(c, q) && o.toi && *o.toi > 0.75) o.toi.reset();
}
// Not the earliest hit but the first in the list.
void first_triangle(const Case& c, const Query& q, Observation& o) {
  const auto* mesh = std::get_if<TriangleMesh>(&c.scene.shape_of(q.a));
  if (!mesh || !o.toi) return;
  for (const auto& t : mesh->triangles) {
    TriangleMesh one;
    for (const int v : t) one.vertices.push_back(mesh->vertices[static_cast<std::size_t>(v)]);
    one.triangles = {{0, 1, 2}};
    const Shape shape = one;
    MovingShape a = moving(c, q.a);
    a.shape = &shape;
    const ImpactAnswer r = time_of_impact(a, moving(c, q.b));
    if (r.outcome == Outcome::answered && r.toi) return void(o.toi = r.toi);
  }
}
// Curved bodies that rotate take most steps.
void cap_as_miss(const Case& c, const Query& q, Observation& o) {
  if (smooth(kind(c, q.a)) && smooth(kind(c, q.b)) && spin(c, q) > 2) o.toi.reset();
}

}  // namespace

std::vector<Mutant> impact_lies() {
  return {
      {"impact_late", "late", "translate", "0.02 too late", on_impact(late)},
      {"impact_late_little", "late", "translate", "1e-9 too late", on_impact(late_a_little)},
      {"impact_early", "early", "translate", "a tenth too early", on_impact(early)},
      {"impact_early_little", "early", "translate", "1e-9 too early", on_impact(early_a_little)},
      {"impact_denied", "missed", "spin", "never", on_impact(denied)},
      {"impact_invented", "ghost", "spin", "at 0.5 where there is none", on_impact(invented)},
      {"impact_start_denied", "missed", "start", "bodies that overlap from the start never meet",
       on_impact(denied_at_start)},
      {"impact_after_start", "late", "start", "bodies that overlap from the start meet at 1e-6",
       on_impact(after_start)},
      {"impact_end_denied", "missed", "translate", "none in the last tenth of the step",
       on_impact(denied_at_end)},
      {"impact_fast_spin_denied", "missed", "spin", "none when a body turns by more than 5 radians",
       on_impact(denied_fast_spin)},
      {"impact_rotation_ignored", "missed", "spin", "bodies do not turn", for_motion(without_rotation)},
      {"impact_rotation_reversed", "early", "spin", "bodies turn the other way", for_motion(turning_back)},
      {"impact_rotation_local", "early", "spin", "the angular velocity is taken in the body's frame",
       for_motion(in_body_frame)},
      {"impact_rotation_clamped", "late", "spin", "bodies turn by at most 3 radians",
       for_motion(spin_clamped)},
      {"impact_first_rests", "early", "translate", "the first body's motion is ignored",
       for_motion(second_only)},
      {"impact_travel_clamped", "missed", "bullet", "bodies travel by at most 4", for_motion(travel_clamped)},
      {"impact_length_for_time", "no_number", "translate", "the distance travelled until then, not the time",
       on_impact(as_length)},
      {"impact_time_reversed", "early", "translate", "counted from the end", on_impact(reversed)},
      {"impact_in_float", "late", "translate", "the time rounded to float", on_impact(as_float)},
      {"impact_at_substeps", "late", "translate", "the first of 16 substeps that overlaps",
       on_impact(substeps)},
      {"impact_between_samples", "missed", "bullet", "impacts between 32 samples are lost",
       on_impact(between_samples)},
      {"impact_grazing_lost", "missed", "graze", "contact of less than 1e-4 of the smaller body is ignored",
       on_impact(grazing_lost)},
      {"impact_thin_lost", "missed", "bullet", "nothing meets a plate thinner than 0.02",
       on_impact(thin_lost)},
      {"impact_fast_lost", "missed", "bullet",
       "none if a body travels more than 500 times the smaller body's extent", on_impact(fast_lost)},
      {"impact_mesh_never", "missed", "translate", "nothing ever hits a mesh", on_impact(mesh_never)},
      {"impact_mesh_late", "late", "translate", "0.02 too late into a mesh", on_impact(mesh_late)},
      {"impact_mesh_late_little", "late", "spin", "1e-9 too late into a mesh", on_impact(mesh_late_a_little)},
      {"impact_mesh_end_lost", "missed", "spin", "no mesh is hit in the last quarter of the step",
       on_impact(mesh_ends_lost)},
      {"impact_first_triangle", "late", "translate",
       "the search ends at the first triangle in the list that is hit", on_impact(first_triangle)},
      {"impact_cap_as_miss", "missed", "spin",
       "for two curved bodies turning fast, the iteration limit counts as no hit", on_impact(cap_as_miss)},
  };
}

}  // namespace touchstone::mutants
