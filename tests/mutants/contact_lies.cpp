// Lies about the normal and the depth of a contact.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/through_float.h"
#include "tests/mutants/pair.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

Mat3 rotation(const Case& c, int i) { return rotation_matrix(body(c, i).pose.rotation); }

// A valid direction with its own width: right except that it is not the least.
void along(const Case& c, const Query& q, Observation& o, const Vec3& n) {
  const double w = width(c, q, n);
  if (std::isfinite(w)) {
    o.normal = n;
    o.depth = w;
  }
}

void flipped(const Case&, const Query&, Observation& o) { *o.normal = -*o.normal; }
void flipped_deep(const Case& c, const Query& q, Observation& o) {
  if (*o.depth > small_size(c, q)) *o.normal = -*o.normal;
}
void flipped_one_order(const Case& c, const Query& q, Observation& o) {
  if (kind(c, q.b) < kind(c, q.a)) *o.normal = -*o.normal;
}
void zero(const Case&, const Query&, Observation& o) { o.normal->setZero(); }
void zero_when_touching(const Case&, const Query&, Observation& o) {
  if (*o.depth < 1e-9) o.normal->setZero();
}
bool on_surface(const Case& c, const Query& q) {
  return kind(c, q.a) == ShapeKind::mesh || kind(c, q.b) == ShapeKind::mesh;
}
void zero_on_surface(const Case& c, const Query& q, Observation& o) {
  if (on_surface(c, q)) o.normal->setZero();
}
void not_a_number(const Case& c, const Query& q, Observation& o) {
  if (body(c, q.a).pose.translation == body(c, q.b).pose.translation) o.normal->setConstant(nan_value);
}
void not_unit(const Case&, const Query&, Observation& o) { *o.normal *= 1 + 1e-9; }
void as_float(const Case&, const Query&, Observation& o) { *o.normal = through_float(*o.normal); }
void local(const Case& c, const Query& q, Observation& o) {
  *o.normal = rotation(c, q.a).transpose() * *o.normal;
}
void from_centres(const Case& c, const Query& q, Observation& o) {
  const Vec3 line = body(c, q.b).pose.translation - body(c, q.a).pose.translation;
  if (line.norm() > 1e-6) along(c, q, o, line.normalized());
}
void second_best_face(const Case& c, const Query& q, Observation& o) {
  if (!are(c, q, ShapeKind::box, ShapeKind::box)) return;
  const Mat3 axes = rotation(c, q.a);
  Vec3 second = *o.normal;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index k = 0; k < 3; ++k)
    for (const double sign : {-1.0, 1.0}) {
      const Vec3 n = (axes.col(k) * sign).normalized();
      const double w = width(c, q, n);
      if (w > *o.depth * (1 + 1e-9) && w < least) {
        least = w;
        second = n;
      }
    }
  along(c, q, o, second);
}
void edges_forgotten(const Case& c, const Query& q, Observation& o) {
  if (!are(c, q, ShapeKind::box, ShapeKind::box)) return;
  Vec3 best = *o.normal;
  double least = std::numeric_limits<double>::infinity();
  for (const int i : {q.a, q.b})
    for (Eigen::Index k = 0; k < 3; ++k)
      for (const double sign : {-1.0, 1.0}) {
        const Vec3 n = (rotation(c, i).col(k) * sign).normalized();
        const double w = width(c, q, n);
        if (w < least) {
          least = w;
          best = n;
        }
      }
  along(c, q, o, best);
}
void tilted(const Case& c, const Query& q, Observation& o) {
  const Vec3 n = (*o.normal + 1e-6 * o.normal->unitOrthogonal()).normalized();
  along(c, q, o, n);
}
void snapped_to_axis(const Case& c, const Query& q, Observation& o) {
  Eigen::Index k = 0;
  o.normal->cwiseAbs().maxCoeff(&k);
  if (std::abs((*o.normal)[k]) > 0.99) along(c, q, o, Vec3::Unit(k) * ((*o.normal)[k] > 0 ? 1 : -1));
}

// The contact of the triangle in which the body is least deep, as if the others were not there.
void of_one_triangle(const Case& c, const Query& q, Observation& o) {
  const bool first = kind(c, q.a) == ShapeKind::mesh;
  if (!on_surface(c, q) || two_meshes(c, q)) return;
  const int surface = first ? q.a : q.b, other = first ? q.b : q.a;
  const auto& m = std::get<TriangleMesh>(c.scene.shape_of(surface));
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [i, j, k] : m.triangles) {
    const auto at = [&](int v) { return m.vertices[static_cast<std::size_t>(v)]; };
    const Shape triangle = make_hull({at(i), at(j), at(k)});
    const PlacedShape x{&triangle, body(c, surface).pose}, y = placed(c, other);
    const ContactAnswer r = first ? contact(x, y) : contact(y, x);
    if (r.outcome != Outcome::answered || !r.overlap || r.depth >= least) continue;
    least = r.depth;
    o.normal = r.normal;
  }
}

void halved(const Case&, const Query&, Observation& o) { *o.depth /= 2; }
void doubled(const Case&, const Query&, Observation& o) { *o.depth *= 2; }
void scaled(const Case&, const Query&, Observation& o) { *o.depth *= 1 - 1e-10; }
void absolute(const Case&, const Query&, Observation& o) { *o.depth += 1e-11; }
void capped(const Case&, const Query&, Observation& o) { *o.depth = std::min(*o.depth, 0.5); }
void margin_added(const Case& c, const Query& q, Observation& o) {
  if (kind(c, q.a) == ShapeKind::hull || kind(c, q.b) == ShapeKind::hull) *o.depth += 0.04;
}
void zero_depth_near(const Case&, const Query&, Observation& o) {
  if (*o.depth < 1e-8) o.depth = 0;
}
void depth_in_float(const Case&, const Query&, Observation& o) { o.depth = through_float(*o.depth); }
void not_past_the_smaller(const Case& c, const Query& q, Observation& o) {
  o.depth = std::min(*o.depth, 1.5 * small_size(c, q));
}
void negative(const Case&, const Query&, Observation& o) { *o.depth = -*o.depth; }
void negative_on_surface(const Case& c, const Query& q, Observation& o) {
  if (on_surface(c, q)) {
    o.depth = -0.107;
    o.normal = o.normal->unitOrthogonal();
  }
}
void huge_on_surface(const Case& c, const Query& q, Observation& o) {
  if (on_surface(c, q)) *o.depth += 10 * scale_of_pair(c.scene, q.a, q.b);
}
void not_a_number_on_surface(const Case& c, const Query& q, Observation& o) {
  if (on_surface(c, q)) o.depth = nan_value;
}
void not_a_claim(const Case&, const Query&, Observation& o) { o.claimed_tolerance = nan_value; }
void negative_claim(const Case&, const Query&, Observation& o) { o.claimed_tolerance = -1; }
void not_a_depth(const Case&, const Query&, Observation& o) {
  if (*o.depth < 1e-10) o.depth = nan_value;
}

// The depth of the previous contact, from a buffer that is written too late.
Lie of_pair_before() {
  return [last = 0.0](const Case&, const Query& q, Observation& o) mutable {
    if (asks(q, Question::contact) && o.depth) std::swap(last, *o.depth);
  };
}

}  // namespace

std::vector<Mutant> normal_lies() {
  return {
      {"normal_flipped", "infeasible", "shallow", "from B to A", on_contact(flipped)},
      {"normal_flipped_deep", "infeasible", "deep", "from B to A when deeper than the smaller body",
       on_contact(flipped_deep)},
      {"normal_flipped_one_order", "infeasible", "shallow",
       "from B to A when B's kind of shape is the lower one", on_contact(flipped_one_order)},
      {"normal_zero", "normal_not_unit", "shallow", "zero", on_contact(zero)},
      {"normal_zero_touching", "normal_not_unit", "near", "zero when overlapping by less than 1e-9",
       on_contact(zero_when_touching)},
      {"normal_not_a_number", "normal_not_unit", "contained", "NaN for bodies with equal origins",
       on_contact(not_a_number)},
      {"normal_zero_on_mesh", "normal_not_unit", "shallow", "zero for meshes", on_contact(zero_on_surface)},
      {"normal_not_unit", "normal_not_unit", "shallow", "longer than 1 by 1e-9", on_contact(not_unit)},
      {"normal_in_float", "normal_not_unit", "shallow", "rounded to float", on_contact(as_float)},
      {"normal_local", "infeasible", "shallow", "in A's frame", on_contact(local)},
      {"normal_of_centres", "not_minimal", "deep", "along the line of centres, with the depth along it",
       on_contact(from_centres)},
      {"normal_second_best", "not_minimal", "shallow", "for two boxes, another face of A and its depth",
       on_contact(second_best_face)},
      {"normal_edges_forgotten", "not_minimal", "deep", "for two boxes, the best face, without edges",
       on_contact(edges_forgotten)},
      {"normal_tilted", "not_minimal", "shallow", "tilted by 1e-6, with the depth along it",
       on_contact(tilted)},
      {"normal_of_one_triangle", "inner_edge", "mesh",
       "on a mesh, that of the triangle in which the body is least deep", on_contact(of_one_triangle)},
      {"normal_snapped", "not_minimal", "deep", "within 8 degrees of an axis, that axis and its depth",
       on_contact(snapped_to_axis)},
  };
}

std::vector<Mutant> depth_lies() {
  return {
      {"depth_halved", "infeasible", "shallow", "half the depth", on_contact(halved)},
      {"depth_doubled", "depth_excess", "shallow", "twice the depth", on_contact(doubled)},
      {"depth_scaled", "infeasible", "deep", "relative error 1e-10, too small", on_contact(scaled)},
      {"depth_absolute", "depth_excess", "tiny", "larger by 1e-11", on_contact(absolute)},
      {"depth_capped", "infeasible", "deep", "at most 0.5", on_contact(capped)},
      {"depth_margin", "depth_excess", "shallow", "a margin of 0.04 about hulls that is not claimed",
       on_contact(margin_added)},
      {"depth_zero_near", "infeasible", "near", "0 for less than 1e-8", on_contact(zero_depth_near)},
      {"depth_in_float", "depth_excess", "shallow", "rounded to float", on_contact(depth_in_float)},
      {"depth_within_smaller", "infeasible", "contained", "at most 1.5 of the smaller body's extent",
       on_contact(not_past_the_smaller)},
      {"depth_negative", "infeasible", "shallow", "with the sign of a distance", on_contact(negative)},
      {"depth_not_a_number", "no_number", "near", "NaN for less than 1e-10", on_contact(not_a_depth)},
      {"depth_negative_on_mesh", "infeasible", "shallow", "negative for meshes, along another normal",
       on_contact(negative_on_surface)},
      {"depth_huge_on_mesh", "depth_excess", "shallow", "for meshes, larger by ten times L",
       on_contact(huge_on_surface)},
      {"depth_nan_on_mesh", "no_number", "shallow", "NaN for meshes", on_contact(not_a_number_on_surface)},
      {"claim_not_a_number", "no_number", "shallow", "claims a tolerance of NaN", on_contact(not_a_claim)},
      {"claim_negative", "no_number", "shallow", "claims a tolerance of -1", on_contact(negative_claim)},
      {"depth_of_pair_before", "infeasible", "shallow", "the depth of the previous contact", of_pair_before(),
       false},
  };
}

}  // namespace touchstone::mutants
