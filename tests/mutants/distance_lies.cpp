// Lies about the signed distance and its witness points.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/through_float.h"
#include "tests/mutants/pair.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

using NewDistance = double (*)(const Case&, const Query&, double d);
using NewWitness = void (*)(const Case&, const Query&, std::array<Vec3, 2>& w);

Lie says(NewDistance f) {
  return [f](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::distance) && o.distance) o.distance = f(c, q, *o.distance);
  };
}
Lie points(NewWitness f) {
  return [f](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::distance) && o.witness) f(c, q, *o.witness);
  };
}

double absolute(const Case&, const Query&, double d) { return d + 1e-12; }
double relative(const Case&, const Query&, double d) { return d * (1 + 1e-12); }
double loose_when_near(const Case&, const Query&, double d) { return d > 0 && d < 1e-3 ? d * (1 + 1e-5) : d; }
double unsigned_distance(const Case&, const Query&, double d) { return std::abs(d); }
double clamped(const Case&, const Query&, double d) { return std::max(0.0, d); }
double squared(const Case&, const Query&, double d) { return d > 0 ? d * d : d; }
double as_float(const Case&, const Query&, double d) { return through_float(d); }
double margin(const Case& c, const Query& q, double d) {
  return kind(c, q.a) == ShapeKind::box || kind(c, q.b) == ShapeKind::box ? d - 0.04 : d;
}
double one_order(const Case& c, const Query& q, double d) {
  return d > 0 && kind(c, q.b) < kind(c, q.a) ? d + 1e-6 : d;
}
double about_world_origin(const Case& c, const Query& q, double d) {
  const double far = body(c, q.b).pose.translation.norm() * 4096;
  return (d + far) - far;
}
// As if the surfaces were their vertices.
double between_vertices(const Case& c, const Query& q, double d) {
  if (!two_meshes(c, q) || d <= 0) return d;
  double least = std::numeric_limits<double>::infinity();
  const auto at = [&](int i, const Vec3& v) {
    return Vec3(rotation_matrix(body(c, i).pose.rotation) * v + body(c, i).pose.translation);
  };
  for (const Vec3& x : std::get<TriangleMesh>(c.scene.shape_of(q.a)).vertices)
    for (const Vec3& y : std::get<TriangleMesh>(c.scene.shape_of(q.b)).vertices)
      least = std::min(least, (at(q.b, y) - at(q.a, x)).norm());
  return least;
}
double radius_forgotten(const Case& c, const Query& q, double d) {
  const auto* sphere = std::get_if<Sphere>(&c.scene.shape_of(q.b));
  return sphere && kind(c, q.a) == ShapeKind::capsule ? d + sphere->radius : d;
}
double centre_distance(const Case& c, const Query& q, double d) {
  return are(c, q, ShapeKind::ellipsoid, ShapeKind::ellipsoid)
             ? (body(c, q.a).pose.translation - body(c, q.b).pose.translation).norm()
             : d;
}
double contained_by_centre(const Case& c, const Query& q, double d) {
  return contained(c, q) ? d * 0.999 : d;
}
double depth_capped(const Case&, const Query&, double d) { return std::max(d, -0.5); }
double zero_when_near(const Case&, const Query&, double d) { return std::abs(d) < 1e-8 ? 0 : d; }
// The remaining error of a search that gives up after n steps.
double cap_as_answer(const Case& c, const Query& q, double d) {
  return smooth(kind(c, q.a)) && smooth(kind(c, q.b)) ? d + 1e-10 * small_size(c, q) : d;
}

void swapped(const Case&, const Query&, std::array<Vec3, 2>& w) { std::swap(w[0], w[1]); }
void in_local_frame(const Case& c, const Query& q, std::array<Vec3, 2>& w) {
  const Pose& p = body(c, q.a).pose;
  w[0] = rotation_matrix(p.rotation).transpose() * (w[0] - p.translation);
}
void second_off(const Case&, const Query&, std::array<Vec3, 2>& w) { w[1] += Vec3::Constant(1e-10); }
void both_in_the_middle(const Case&, const Query&, std::array<Vec3, 2>& w) {
  w[0] = w[1] = (w[0] + w[1]) / 2;
}
void first_is_centre(const Case& c, const Query& q, std::array<Vec3, 2>& w) {
  if (contained(c, q)) w[0] = body(c, q.a).pose.translation;
}
void not_a_point(const Case&, const Query&, std::array<Vec3, 2>& w) {
  if ((w[1] - w[0]).norm() < 1e-9) w[0].setConstant(std::numeric_limits<double>::quiet_NaN());
}
void relative_to_first(const Case& c, const Query& q, std::array<Vec3, 2>& w) {
  for (Vec3& p : w) p -= body(c, q.a).pose.translation;
}

}  // namespace

std::vector<Mutant> distance_lies() {
  return {
      {"distance_absolute", "distance_off", "tiny", "1e-12 too large", says(absolute)},
      {"distance_relative", "distance_off", "separate", "relative error 1e-12", says(relative)},
      {"distance_loose_near", "distance_off", "near", "relative error 1e-5 below 1e-3",
       says(loose_when_near)},
      {"distance_sign_lost", "missed", "deep", "the sign is lost", says(unsigned_distance)},
      {"distance_clamped", "distance_off", "deep", "0 for every overlap", says(clamped)},
      {"distance_squared", "distance_off", "separate", "the square of the distance", says(squared)},
      {"distance_in_float", "distance_off", "separate", "rounded to float", says(as_float)},
      {"distance_margin", "distance_off", "separate", "a margin of 0.04 about boxes that is not claimed",
       says(margin)},
      {"distance_one_order", "distance_off", "separate",
       "off by 1e-6 when B's kind of shape is the lower one", says(one_order)},
      {"distance_cancels", "distance_off", "far", "computed from coordinates 4096 times as large",
       says(about_world_origin)},
      {"distance_between_vertices", "distance_off", "surfaces",
       "of two meshes, that of their nearest vertices", says(between_vertices)},
      {"distance_radius_forgotten", "distance_off", "separate", "capsule-sphere without the sphere's radius",
       says(radius_forgotten)},
      {"distance_of_centres", "distance_off", "separate", "for two ellipsoids, the distance of their centres",
       says(centre_distance)},
      {"distance_contained", "distance_off", "contained", "0.1 % off when one body is within the other's box",
       says(contained_by_centre)},
      {"distance_depth_capped", "distance_off", "deep", "never below -0.5", says(depth_capped)},
      {"distance_zero_near", "distance_off", "near", "0 within 1e-8", says(zero_when_near)},
      {"distance_cap_as_answer", "distance_off", "separate",
       "for two curved bodies, the value at the iteration limit", says(cap_as_answer)},
      {"witness_swapped", "witness_off", "separate", "the two points are exchanged", points(swapped)},
      {"witness_local", "witness_off", "separate", "the point on A in A's frame", points(in_local_frame)},
      {"witness_relative", "witness_off", "far", "the points relative to A's origin",
       points(relative_to_first)},
      {"witness_second_off", "witness_off", "separate", "the point on B is off by 1e-10", points(second_off)},
      {"witness_middle", "witness_off", "separate", "both points in the middle", points(both_in_the_middle)},
      {"witness_centre", "witness_off", "contained", "A's centre when one body is within the other's box",
       points(first_is_centre)},
      {"witness_not_a_number", "witness_off", "near", "NaN when the points are within 1e-9",
       points(not_a_point)},
  };
}

}  // namespace touchstone::mutants
