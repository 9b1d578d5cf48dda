// Lies about the gradient of the signed distance.
#include <cmath>

#include "core/narrow/gradient.h"
#include "tests/mutants/pair.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

// Changes the derivative by rotations of B about the origin of its frame.
using NewMoment = Vec3 (*)(const Case&, const Query&, const Observation&);
Lie moment(NewMoment f) {
  return [f](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::distance) && o.moment && o.normal) o.moment = f(c, q, o);
  };
}
Vec3 about(const Vec3& p, const Observation& o) { return Vec3(((*o.witness)[1] - p).cross(*o.normal)); }

Vec3 opposite(const Case&, const Query&, const Observation& o) { return -*o.moment; }
Vec3 in_frame_of_b(const Case& c, const Query& q, const Observation& o) {
  return rotation_matrix(body(c, q.b).pose.rotation).transpose() * *o.moment;
}
Vec3 about_world_origin(const Case&, const Query&, const Observation& o) { return about(Vec3::Zero(), o); }
Vec3 about_a(const Case& c, const Query& q, const Observation& o) {
  return about(body(c, q.a).pose.translation, o);
}
Vec3 halved(const Case&, const Query&, const Observation& o) { return *o.moment / 2; }
Vec3 none(const Case&, const Query&, const Observation&) { return Vec3::Zero(); }
Vec3 slightly_off(const Case&, const Query&, const Observation& o) { return *o.moment * (1 + 1e-5); }
Vec3 not_a_number(const Case&, const Query&, const Observation& o) {
  return *o.distance < 0 ? Vec3(Vec3::Constant(std::nan(""))) : *o.moment;
}
// By the angles of successive rotations about x, y and z instead of a rotation vector: y is turned by x.
Vec3 by_euler_angles(const Case& c, const Query& q, const Observation& o) {
  const Mat3 r = rotation_matrix(body(c, q.b).pose.rotation);
  return {o.moment->x(), r.col(1).dot(*o.moment), r.col(2).dot(*o.moment)};
}

using NewNormal = void (*)(Observation&);
Lie normal(NewNormal f) {
  return [f](const Case&, const Query& q, Observation& o) {
    if (asks(q, Question::distance) && o.moment && o.normal) f(o);
  };
}
// The derivative of the unsigned distance.
void of_absolute_distance(Observation& o) {
  if (*o.distance >= 0) return;
  o.normal = -*o.normal;
  o.moment = -*o.moment;
}
// The distance squared.
void of_square(Observation& o) {
  o.normal = *o.normal * 2 * *o.distance;
  o.moment = *o.moment * 2 * *o.distance;
}
void by_pose_of_a(Observation& o) { o.normal = -*o.normal; }

Lie claims_unique(bool value) {
  return [value](const Case& c, const Query& q, Observation& o) {
    if (!asks(q, Question::distance) || !o.moment) return;
    const auto right = gradients(placed(c, q.a), placed(c, q.b), body(c, q.b).pose.translation).unique;
    if (right && *right != value) o.unique_gradient = value;
  };
}

}  // namespace

std::vector<Mutant> gradient_lies() {
  constexpr std::string_view off = "gradient_off";
  return {
      {"gradient_opposite", off, "separate", "rotations the other way round", moment(opposite)},
      {"gradient_local", off, "separate", "the derivative by rotations in B's own frame",
       moment(in_frame_of_b)},
      {"gradient_about_world", off, "separate", "rotations about the world's origin",
       moment(about_world_origin)},
      {"gradient_about_a", off, "separate", "rotations about A's origin", moment(about_a)},
      {"gradient_halved", off, "shallow", "half the derivative by rotations", moment(halved)},
      {"gradient_no_moment", off, "deep", "rotations change nothing", moment(none)},
      {"gradient_1e5", off, "separate", "1e-5 off", moment(slightly_off)},
      {"gradient_nan", "no_number", "shallow", "NaN for bodies that overlap", moment(not_a_number)},
      {"gradient_euler", off, "separate", "by Euler angles", moment(by_euler_angles)},
      {"gradient_of_absolute", off, "shallow", "of the unsigned distance", normal(of_absolute_distance)},
      {"gradient_of_square", off, "separate", "of the squared distance", normal(of_square)},
      {"gradient_by_a", off, "separate", "by translations of A", normal(by_pose_of_a)},
      {"gradient_always_unique", off, "lattice", "a face on a face has one gradient", claims_unique(true)},
      {"gradient_never_unique", off, "separate", "no gradient is the only one", claims_unique(false)},
  };
}

}  // namespace touchstone::mutants
