// Box3D, by its functions for use outside of a simulation: b3ShapeDistance, b3Overlap*, b3Collide* and
// b3TimeOfImpact. What the answers mean follows types.h and docs/collision.md:
//
// - b3DistanceOutput.distance is 0 for overlapping shapes; such an answer states the overlap and no distance.
// - Manifolds are speculative: their points may be apart. The bodies overlap if one point is not.
// - A manifold of hulls is clipped and reduced to four points, so it states points and a normal but no depth
//   of the whole contact. With a sphere there is one point, and its separation is the depth.
// - Sweeps interpolate quaternions between the ends of a step, which is not the motion asked for, so bodies
//   that rotate are not asked.
#include <box3d/constants.h>

#include <algorithm>
#include <array>

#include "core/math/roundoff.h"
#include "oracles/abi/plugin_kit.h"
#include "oracles/box3d/shapes.h"

namespace touchstone::box3d_adapter {
namespace {

constexpr const char* settings =
    "b3ShapeDistance with radii, no cache; b3OverlapSphere, -Capsule, -Hull; b3Collide* without cache; "
    "b3TimeOfImpact for bodies that do not rotate";
constexpr const char* source =
    "box3d/constants.h: B3_OVERLAP_SLOP (overlap), B3_LINEAR_SLOP, the collision tolerance (contact; time of "
    "impact stops that far apart, to a quarter of it)";

// The part of B3_LINEAR_SLOP to which b3TimeOfImpact reaches its target.
constexpr double impact_slack = 0.25;

struct Body {
  const Shape* shape;
  b3WorldTransform pose;
  const ts_body* asked;
};

std::string version() {
  const b3Version v = b3GetVersion();
  return std::to_string(v.major) + "." + std::to_string(v.minor) + "." + std::to_string(v.revision);
}

// Where the order of the shapes is A, B; `flipped` if the function took them as B, A.
struct Manifold {
  std::array<b3LocalManifoldPoint, B3_MAX_MANIFOLD_POINTS> points{};
  b3LocalManifold local{};
  bool flipped = false;
};

// Box3D has one function for each pair of kinds, in this order: hull, capsule, sphere.
int rank_of(const Shape& s) {
  return std::holds_alternative<b3Sphere>(s) ? 2 : std::holds_alternative<b3Capsule>(s) ? 1 : 0;
}

void collide(Manifold& m, const Shape& a, const Shape& b, const b3Transform& b_in_a) {
  constexpr int most = B3_MAX_MANIFOLD_POINTS;
  b3SimplexCache simplex{};
  b3SATCache axes{};
  m.local.points = m.points.data();
  const auto *ball_a = std::get_if<b3Sphere>(&a), *ball_b = std::get_if<b3Sphere>(&b);
  const auto *capsule_a = std::get_if<b3Capsule>(&a), *capsule_b = std::get_if<b3Capsule>(&b);
  if (ball_a)
    b3CollideSpheres(&m.local, most, ball_a, ball_b, b_in_a);
  else if (capsule_a && ball_b)
    b3CollideCapsuleAndSphere(&m.local, most, capsule_a, ball_b, b_in_a);
  else if (capsule_a)
    b3CollideCapsules(&m.local, most, capsule_a, capsule_b, b_in_a);
  else if (ball_b)
    b3CollideHullAndSphere(&m.local, most, hull_of(a), ball_b, b_in_a, &simplex);
  else if (capsule_b)
    b3CollideHullAndCapsule(&m.local, most, hull_of(a), capsule_b, b_in_a, &simplex);
  else
    b3CollideHulls(&m.local, most, hull_of(a), hull_of(b), b_in_a, &axes);
}

b3Sweep sweep_of(const Body& body) {
  b3Sweep s{};
  s.q1 = s.q2 = body.pose.q;
  s.c1 = {static_cast<float>(body.pose.p.x), static_cast<float>(body.pose.p.y),
          static_cast<float>(body.pose.p.z)};
  const Vec3 end = to_vec3(s.c1) + kit::motion_of(*body.asked).linear;
  s.c2 = {static_cast<float>(end.x()), static_cast<float>(end.y()), static_cast<float>(end.z())};
  return s;
}

class Engine {
 public:
  static std::vector<kit::CardText> cards() {
    return {{"box3d", "Box3D", version(), settings, float_roundoff, kit::oracle_tau_factor, source}};
  }
  explicit Engine(unsigned) {}

  void load(const ts_scene& scene, const ts_received& received) {
    unload();
    shapes_.reserve(scene.shape_count);
    for (std::size_t i = 0; i < scene.shape_count; ++i) {
      shapes_.push_back(make_shape(scene.shapes[i]));
      report_shape(static_cast<int>(i), scene.shapes[i], shapes_.back(), received);
    }
    for (std::size_t i = 0; i < scene.body_count; ++i) {
      const ts_body& b = scene.bodies[i];
      bodies_.push_back(
          {&shapes_[static_cast<std::size_t>(b.shape)], make_transform(kit::pose_of(b.pose)), &b});
      report_body(static_cast<int>(i), bodies_.back().pose, received);
    }
  }
  void unload() {
    bodies_.clear();
    shapes_.clear();
  }

  void ask(ts_question question, int a, int b, ts_answer& out, const ts_sink& sink) {
    if (question > TS_TIME_OF_IMPACT) throw kit::Unsupported("pairs only");
    const Body &one = bodies_[static_cast<std::size_t>(a)], &two = bodies_[static_cast<std::size_t>(b)];
    switch (question) {
      case TS_OVERLAP:
        return ask_overlap(one, two, out);
      case TS_DISTANCE:
        return ask_distance(one, two, out);
      case TS_CONTACT:
        return ask_contact(one, two, out, sink);
      default:
        return ask_time(one, two, out);
    }
  }

 private:
  static void ask_overlap(const Body& a, const Body& b, ts_answer& out) {
    const Proxy points = make_proxy(*b.shape);
    const b3ShapeProxy proxy = points.view();
    const b3Transform a_in_b = b3InvMulWorldTransforms(b.pose, a.pose);
    bool overlap = false;
    if (const auto* sphere = std::get_if<b3Sphere>(a.shape))
      overlap = b3OverlapSphere(sphere, a_in_b, &proxy);
    else if (const auto* capsule = std::get_if<b3Capsule>(a.shape))
      overlap = b3OverlapCapsule(capsule, a_in_b, &proxy);
    else
      overlap = b3OverlapHull(hull_of(*a.shape), a_in_b, &proxy);
    kit::set_overlap(out, overlap);
    out.claimed_tolerance = double{B3_OVERLAP_SLOP};
  }

  static void ask_distance(const Body& a, const Body& b, ts_answer& out) {
    const Proxy points_a = make_proxy(*a.shape), points_b = make_proxy(*b.shape);
    b3DistanceInput input{};
    input.proxyA = points_a.view();
    input.proxyB = points_b.view();
    input.transform = b3InvMulWorldTransforms(a.pose, b.pose);
    input.useRadii = true;
    b3SimplexCache cache{};
    const b3DistanceOutput r = b3ShapeDistance(&input, &cache, nullptr, 0);
    if (!(r.distance > 0)) return kit::set_overlap(out, true);
    kit::set_distance(out, double{r.distance});
    kit::set_points(out, to_world(a, to_vec3(r.pointA)), to_world(a, to_vec3(r.pointB)));
  }

  static void ask_contact(const Body& a, const Body& b, ts_answer& out, const ts_sink& sink) {
    Manifold m;
    m.flipped = rank_of(*a.shape) > rank_of(*b.shape);
    const Body &first = m.flipped ? b : a, &second = m.flipped ? a : b;
    collide(m, *first.shape, *second.shape, b3InvMulWorldTransforms(first.pose, second.pose));
    double least = HUGE_VAL;
    for (int i = 0; i < m.local.pointCount; ++i)
      least = std::min(least, double{m.points[static_cast<std::size_t>(i)].separation});
    out.claimed_tolerance = double{B3_LINEAR_SLOP};
    kit::set_overlap(out, least <= 0);
    if (!(least <= 0)) return;
    const Vec3 normal = rotation_of(first.pose.q) * to_vec3(m.local.normal);
    kit::set_normal(out, m.flipped ? Vec3(-normal) : normal);
    if (std::holds_alternative<b3Sphere>(*second.shape)) kit::set_depth(out, -least);
    for (int i = 0; i < m.local.pointCount; ++i) {
      const b3LocalManifoldPoint& p = m.points[static_cast<std::size_t>(i)];
      if (p.separation > 0) continue;
      const Vec3 at = to_world(first, to_vec3(p.point));
      sink.point(sink.ctx, at.data(), -double{p.separation});
    }
  }

  static void ask_time(const Body& a, const Body& b, ts_answer& out) {
    for (const Body* body : {&a, &b})
      if (kit::motion_of(*body->asked).angular.squaredNorm() > 0)
        throw kit::Unsupported("Box3D's sweeps interpolate the rotation");
    const Proxy points_a = make_proxy(*a.shape), points_b = make_proxy(*b.shape);
    b3TOIInput input{};
    input.proxyA = points_a.view();
    input.proxyB = points_b.view();
    input.sweepA = sweep_of(a);
    input.sweepB = sweep_of(b);
    input.maxFraction = 1;
    const b3TOIOutput r = b3TimeOfImpact(&input);
    out.claimed_tolerance = (1 + impact_slack) * double{B3_LINEAR_SLOP};
    if (r.state == b3_toiStateOverlapped) kit::set_toi(out, 0);
    if (r.state == b3_toiStateHit) kit::set_toi(out, double{r.fraction});
    if (r.state == b3_toiStateFailed || r.state == b3_toiStateUnknown) {
      out.outcome = TS_NOT_CONVERGED;
      kit::set_detail(out, "b3TimeOfImpact reports that it failed");
    }
  }

  static Vec3 to_world(const Body& frame, const Vec3& p) {
    return rotation_of(frame.pose.q) * p + Vec3(frame.pose.p.x, frame.pose.p.y, frame.pose.p.z);
  }

  std::vector<Shape> shapes_;
  std::vector<Body> bodies_;
};

}  // namespace
}  // namespace touchstone::box3d_adapter

TS_PLUGIN(touchstone::box3d_adapter::Engine)
