#include "core/world/planned.h"

#include <cmath>

#include "core/broad/body_box.h"
#include "core/math/roundoff.h"
#include "core/narrow/bounded.h"

namespace touchstone {
namespace {

// Rounding of p - origin and of the sum that restores it, relative to the origin's coordinates.
constexpr double origin_rounding = 0x1p-52;
// Rounding of a ball's centre and radius, relative to both.
constexpr double ball_rounding = 0x1p-48;

// An upper bound on how far rounding the pose and sizes to float moves the body: u of each coordinate, 2u·|q|
// of the quaternion, which turns by twice that, and u of the sizes; u is float_roundoff.
double float_rounding(const Pose& pose, double reach) {
  return float_roundoff * (pose.translation.lpNorm<1>() + 8 * reach);
}

// The verdict `apart` is certain and may come without a value.
double proven(const ContactAnswer& r) {
  const bool no_value = !r.overlap && !std::isfinite(r.error_bound);
  return no_value ? 0 : std::max(r.error_bound, r.regret_bound);
}

// A pair for float arithmetic: relative to A's translation, so that float's error does not grow with the
// distance from the world origin.
struct FloatPair {
  PlacedShape a, b;
  Vec3 origin;
  double rounding;  // what rounding the bodies costs

  FloatPair(const PlacedShape& x, const PlacedShape& y) : a(x), b(y), origin(x.pose.translation) {
    a.pose.translation.setZero();
    b.pose.translation -= origin;
    rounding = float_rounding(a.pose, a.bounding_radius()) + float_rounding(b.pose, b.bounding_radius()) +
               origin_rounding * origin.lpNorm<1>();
  }
};

// The float answer, its bounds including the cost of rounding the bodies; or `unsupported`, `not_converged`.
ContactAnswer contact_by_float(const PlacedShape& a, const PlacedShape& b, PairMemory* memory) {
  const FloatPair p(a, b);
  ContactAnswer r = contact(p.a, p.b, Arithmetic::float32, memory);
  r.error_bound = r.regret_bound = proven(r) + p.rounding;
  Manifold at_home;
  for (const ContactPoint& x : r.manifold) at_home.push_back({x.position + p.origin, x.depth, x.feature});
  r.manifold = at_home;
  return r;
}

// Whether the gap is at most the margin; `gap` as far as it is known. `error`: proven, of the gap that
// decided.
struct Gap {
  Outcome outcome = Outcome::answered;
  bool within = false;
  std::optional<double> gap;
  double error = 0;
};

Gap gap_about(double margin, bool verdict_only, const PlacedShape& a, const PlacedShape& b,
              Arithmetic arithmetic, PairMemory* memory) {
  if (verdict_only) {
    const WithinAnswer w = within(a, b, margin, arithmetic, memory);
    return {w.outcome, w.within, std::nullopt, w.error_bound};
  }
  const BoundedDistanceAnswer d = distance(a, b, margin, arithmetic, memory);
  if (!d.distance) return {d.outcome, false, std::nullopt, 0};
  return {d.outcome, d.distance->distance <= margin, d.distance->distance, d.distance->error_bound};
}

Gap gap_by(Arithmetic arithmetic, double margin, bool verdict_only, const PlacedShape& a,
           const PlacedShape& b, PairMemory* memory) {
  if (arithmetic != Arithmetic::float32) return gap_about(margin, verdict_only, a, b, arithmetic, memory);
  const FloatPair p(a, b);
  Gap g = gap_about(margin, verdict_only, p.a, p.b, arithmetic, memory);
  g.error += p.rounding;
  return g;
}

}  // namespace

BoundingBall bounding_ball(const Shape& shape) {
  const std::vector<Vec3>* points = vertices_if(shape);
  if (!points) return {Vec3::Zero(), bounding_radius(shape)};
  Aabb box;
  for (const Vec3& p : *points) box.extend(p);
  BoundingBall ball{(box.lo + box.hi) / 2, 0};
  for (const Vec3& p : *points) ball.radius = std::max(ball.radius, (p - ball.middle).norm());
  ball.radius += ball_rounding * (ball.radius + ball.middle.lpNorm<1>());
  return ball;
}

std::vector<PlannedShape> planned_shapes(const Scene& scene, const Fidelity& fidelity) {
  std::vector<PlannedShape> planned;
  planned.reserve(scene.shapes.size());
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    const bool is_simpler = i < fidelity.simpler.size() && fidelity.simpler[i];
    const SimplerShape* simpler = is_simpler ? &*fidelity.simpler[i] : nullptr;
    const Shape& shape = simpler ? simpler->shape : scene.shapes[i];
    planned.push_back({Collider(shape), simpler, bounding_ball(shape), broad::box_size(shape)});
  }
  return planned;
}

PlannedBody planned_body(const PlannedShape& shape, const Pose& body) {
  PlannedBody r;
  r.pose = shape.simpler && shape.simpler->moved() ? placed_in(body, shape.simpler->in_body) : body;
  r.centre_w = shape.ball.middle.isZero(0) ? r.pose.translation : to_transform(r.pose) * shape.ball.middle;
  return r;
}

Aabb planned_box(const Fidelity& f, const PlannedShape& s, const PlannedBody& body) {
  const Aabb box =
      f.loose_boxes ? broad::loose_box(s.shape(), body.pose, s.size) : broad::body_box(s.shape(), body.pose);
  return f.margin == 0 ? box : widened(box, f.margin / 2);
}

ContactAnswer planned_contact(const Fidelity& fidelity, const PlannedShape& a, const PlannedBody& at_a,
                              const PlannedShape& b, const PlannedBody& at_b, PairMemory* memory,
                              DecidedBy* decided, double* bound) {
  const auto decide = [&](DecidedBy by, double error) {
    if (decided) *decided = by;
    if (bound) *bound = error;
  };
  const PairMethod& method = fidelity.of(kind_of(a.shape()), kind_of(b.shape()));
  if (method.balls_first && balls_apart(at_a.centre_w, a.ball.radius, at_b.centre_w, b.ball.radius)) {
    decide(DecidedBy::balls, 0);
    return {};
  }
  const PlacedShape x = a.collider.at(at_a.pose), y = b.collider.at(at_b.pose);
  const double shapes = a.error() + b.error();
  if (method.arithmetic != Arithmetic::float64) {
    const ContactAnswer r = method.arithmetic == Arithmetic::float32
                                ? contact_by_float(x, y, memory)
                                : contact(x, y, Arithmetic::float64_alone, memory);
    // A NaN proves nothing.
    if (r.outcome == Outcome::answered && proven(r) + shapes <= Fidelity::answer_share * fidelity.error) {
      decide(DecidedBy::cheap, proven(r) + shapes);
      return r;
    }
  }
  ContactAnswer r = contact(x, y, Arithmetic::float64, memory);
  decide(DecidedBy::rest, proven(r) + shapes);
  return r;
}

PlannedNear planned_near(const Fidelity& fidelity, const PlannedShape& a, const PlannedBody& at_a,
                         const PlannedShape& b, const PlannedBody& at_b, PairMemory* memory,
                         DecidedBy* decided, double* bound) {
  PlannedNear r;
  if (fidelity.margin == 0 && !fidelity.verdict_only) {
    ContactAnswer c = planned_contact(fidelity, a, at_a, b, at_b, memory, decided, bound);
    r.outcome = c.outcome;
    r.within = c.overlap;
    if (c.overlap) r.contact = std::move(c);
    return r;
  }
  const auto decide = [&](DecidedBy by, double error) {
    if (decided) *decided = by;
    if (bound) *bound = error;
  };
  const PairMethod& method = fidelity.of(kind_of(a.shape()), kind_of(b.shape()));
  if (method.balls_first &&
      balls_apart(at_a.centre_w, a.ball.radius + fidelity.margin, at_b.centre_w, b.ball.radius)) {
    decide(DecidedBy::balls, 0);
    return r;
  }
  const PlacedShape x = a.collider.at(at_a.pose), y = b.collider.at(at_b.pose);
  const double shapes = a.error() + b.error(), margin = fidelity.margin;
  DecidedBy by = DecidedBy::cheap;
  Gap g = gap_by(method.arithmetic, margin, fidelity.verdict_only, x, y, memory);
  const bool suffices =
      g.outcome == Outcome::answered && g.error + shapes <= Fidelity::answer_share * fidelity.error;
  if (method.arithmetic == Arithmetic::float64 || !suffices) {
    by = DecidedBy::rest;
    if (method.arithmetic != Arithmetic::float64)
      g = gap_by(Arithmetic::float64, margin, fidelity.verdict_only, x, y, memory);
  }
  decide(by, g.error + shapes);
  r.outcome = g.outcome;
  r.within = g.within;
  if (!g.within || fidelity.verdict_only) return r;
  if (g.gap && *g.gap > 0) {
    r.gap = g.gap;
    return r;
  }
  ContactAnswer c = planned_contact(fidelity, a, at_a, b, at_b, memory, decided, bound);
  r.outcome = c.outcome;
  if (c.overlap)
    r.contact = std::move(c);
  else
    r.gap = std::max(0.0, g.gap.value_or(0));
  return r;
}

}  // namespace touchstone
