// Jolt Physics through TransformedShape: CollideShape and CastShape, as shipped and tuned. What the answers
// mean follows CollideShape.h and ShapeCast.h:
//
// - mPenetrationAxis is the direction that moves shape 2 out of the collision, so from A to B for shape 1 =
// A;
//   its length is meaningless. mPenetrationDepth is how far.
// - With mMaxSeparationDistance, shapes apart are found as well: the depth is then minus their distance, and
//   the contact points are the closest ones.
// - A cast hits at mFraction of its direction; shapes cannot rotate during a cast.
#include <Jolt/Jolt.h>

#include <Jolt/Core/Factory.h>
#include <Jolt/Core/Memory.h>
#include <Jolt/Physics/Collision/CollideShape.h>
#include <Jolt/Physics/Collision/CollisionCollectorImpl.h>
#include <Jolt/Physics/Collision/ShapeCast.h>
#include <Jolt/Physics/Collision/TransformedShape.h>
#include <Jolt/RegisterTypes.h>

#include <algorithm>
#include <optional>

#include "core/math/roundoff.h"
#include "oracles/abi/plugin_kit.h"
#include "oracles/jolt/shapes.h"

namespace touchstone::jolt_adapter {
namespace {

constexpr Setting rows[] = {{"jolt", false}, {"jolt-tuned", true}};
constexpr const char* shipped_settings =
    "CollideShape and CastShape as shipped: convex radius 0.05 or the smallest half extent";
constexpr const char* tuned_settings =
    "CollideShape and CastShape, convex radius 0, tolerances 1e-7, back faces hit by casts";
constexpr const char* source =
    "PhysicsSettings.h: cDefaultCollisionTolerance, cDefaultPenetrationTolerance, cDefaultConvexRadius; "
    "ConvexHullShape.h: mMaxErrorConvexRadius, mHullTolerance";

// On the search distance, so that rounding does not lose the closest points.
constexpr float reach_slack = 1.001F;

// Jolt's allocator, factory and types are global.
void start_jolt() {
  static const bool started = [] {
    JPH::RegisterDefaultAllocator();
    JPH::Factory::sInstance = new JPH::Factory();
    JPH::RegisterTypes();
    return true;
  }();
  (void)started;
}

std::string version() {
  return std::to_string(JPH_VERSION_MAJOR) + "." + std::to_string(JPH_VERSION_MINOR) + "." +
         std::to_string(JPH_VERSION_PATCH);
}

struct Body {
  const Held* held;
  Placed placed;
  const ts_body* asked;
  int kind;

  // Jolt positions a shape by its centre of mass.
  JPH::RMat44 mass_centre() const {
    return JPH::RMat44::sRotationTranslation(placed.rotation, placed.translation)
        .PreTranslated(held->shape->GetCenterOfMass());
  }
  JPH::TransformedShape transformed() const {
    return JPH::TransformedShape(mass_centre().GetTranslation(), placed.rotation, held->shape.GetPtr(),
                                 JPH::BodyID());
  }
};

class Engine {
 public:
  static constexpr ts_question later_questions[] = {TS_WITHIN, TS_BOUNDED_DISTANCE, TS_CONTACT_WITHIN};
  static std::vector<kit::CardText> cards() {
    std::vector<kit::CardText> all;
    for (const Setting& s : rows)
      all.push_back({s.name, "Jolt Physics", version(), s.tuned ? tuned_settings : shipped_settings,
                     float_roundoff, kit::oracle_tau_factor, source});
    return all;
  }
  explicit Engine(unsigned index) : setting_(rows[index]) { start_jolt(); }

  void load(const ts_scene& scene, const ts_received& received) {
    unload();
    margin_ = scene.margin;
    shapes_.reserve(scene.shape_count);
    for (std::size_t i = 0; i < scene.shape_count; ++i) {
      shapes_.push_back(make_shape(scene.shapes[i], setting_));
      report_shape(static_cast<int>(i), scene.shapes[i], received);
    }
    for (std::size_t i = 0; i < scene.body_count; ++i) {
      const ts_body& b = scene.bodies[i];
      const int kind = scene.shapes[b.shape].kind;
      bodies_.push_back({&shapes_[static_cast<std::size_t>(b.shape)], make_placed(b.pose, kind), &b, kind});
      report_body(static_cast<int>(i), bodies_.back().placed, kind, received);
    }
  }
  void unload() {
    bodies_.clear();
    shapes_.clear();
  }

  void ask(ts_question question, int a, int b, ts_answer& out, const ts_sink& sink) {
    if (question == TS_CANDIDATES || question == TS_SCENE_CONTACTS || question == TS_SWEPT_CANDIDATES)
      throw kit::Unsupported("pairs only");
    const Body &one = bodies_[static_cast<std::size_t>(a)], &two = bodies_[static_cast<std::size_t>(b)];
    switch (question) {
      case TS_OVERLAP:
        out.claimed_tolerance = claim(one, two, 0);
        return kit::set_overlap(out, collide(one, two, 0).has_value());
      case TS_DISTANCE:
        return ask_distance(one, two, out);
      case TS_CONTACT:
        return ask_contact(one, two, out, sink);
      case TS_WITHIN:
      case TS_BOUNDED_DISTANCE:
        return ask_near(question, one, two, out);
      case TS_CONTACT_WITHIN:
        return ask_contact_within(one, two, out, sink);
      default:
        return ask_time(one, two, out);
    }
  }

 private:
  double claim(const Body& a, const Body& b, double depth) const {
    return double{setting_.tolerance()} * (1 + std::abs(depth)) + a.held->claim + b.held->claim;
  }

  std::optional<JPH::CollideShapeResult> collide(const Body& a, const Body& b, float farthest) const {
    JPH::CollideShapeSettings settings;
    settings.mCollisionTolerance = settings.mPenetrationTolerance = setting_.tolerance();
    settings.mMaxSeparationDistance = farthest;
    JPH::ClosestHitCollisionCollector<JPH::CollideShapeCollector> found;
    b.transformed().CollideShape(a.held->shape.GetPtr(), JPH::Vec3::sReplicate(1), a.mass_centre(), settings,
                                 JPH::RVec3::sZero(), found);
    return found.HadHit() ? std::optional(found.mHit) : std::nullopt;
  }

  // The distance between the centres of mass, which both shapes contain. Jolt inflates a shape by the
  // distance that it searches, so more than that would cost digits.
  static float reach(const Body& a, const Body& b) {
    const JPH::RVec3 between = a.mass_centre().GetTranslation() - b.mass_centre().GetTranslation();
    return reach_slack * static_cast<float>(between.Length());
  }

  // First without a search distance, which would spoil shallow depths.
  std::optional<JPH::CollideShapeResult> closest(const Body& a, const Body& b, float farthest) const {
    const auto hit = collide(a, b, 0);
    return hit ? hit : collide(a, b, farthest);
  }

  void state_distance(const Body& a, const Body& b, const JPH::CollideShapeResult& hit,
                      ts_answer& out) const {
    const double distance = -double{hit.mPenetrationDepth};
    out.claimed_tolerance = claim(a, b, distance);
    kit::set_distance(out, distance);
    kit::set_points(out, to_vec3(hit.mContactPointOn1), to_vec3(hit.mContactPointOn2));
  }

  void ask_distance(const Body& a, const Body& b, ts_answer& out) const {
    const auto hit = closest(a, b, reach(a, b));
    if (!hit) throw kit::Unsupported("Jolt found no closest points");
    state_distance(a, b, *hit, out);
  }

  // CollideShape.h, mMaxSeparationDistance: shapes that are no farther apart are found.
  std::optional<JPH::CollideShapeResult> near(const Body& a, const Body& b) const {
    if (margin_ < 0) throw kit::Unsupported("a separation distance is not for depths");
    return closest(a, b, static_cast<float>(margin_));
  }

  void ask_near(ts_question question, const Body& a, const Body& b, ts_answer& out) const {
    const auto hit = near(a, b);
    out.claimed_tolerance = claim(a, b, margin_);
    if (question == TS_WITHIN) return kit::set_overlap(out, hit.has_value());
    if (hit) return state_distance(a, b, *hit, out);
    kit::set_lower_bound(out, margin_);
  }

  void ask_contact(const Body& a, const Body& b, ts_answer& out, const ts_sink& sink) const {
    state_contact(a, b, collide(a, b, 0), out, sink);
  }

  void ask_contact_within(const Body& a, const Body& b, ts_answer& out, const ts_sink& sink) const {
    state_contact(a, b, near(a, b), out, sink);
  }

  void state_contact(const Body& a, const Body& b, const std::optional<JPH::CollideShapeResult>& hit,
                     ts_answer& out, const ts_sink& sink) const {
    const double depth = hit ? double{hit->mPenetrationDepth} : 0;
    out.claimed_tolerance = claim(a, b, depth);
    kit::set_overlap(out, hit.has_value());
    if (!hit) return;
    kit::set_normal(out, to_vec3(hit->mPenetrationAxis).normalized());
    kit::set_depth(out, depth);
    const Vec3 middle = (to_vec3(hit->mContactPointOn1) + to_vec3(hit->mContactPointOn2)) / 2;
    sink.point(sink.ctx, middle.data(), depth);
  }

  void ask_time(const Body& a, const Body& b, ts_answer& out) const {
    const Motion one = kit::motion_of(*a.asked), two = kit::motion_of(*b.asked);
    if (one.angular.squaredNorm() > 0 || two.angular.squaredNorm() > 0)
      throw kit::Unsupported("Jolt's shape casts support no rotation");
    const Vec3 along = one.linear - two.linear;
    JPH::ShapeCastSettings settings;
    settings.mCollisionTolerance = settings.mPenetrationTolerance = setting_.tolerance();
    if (setting_.tuned) settings.SetBackFaceMode(JPH::EBackFaceMode::CollideWithBackFaces);
    const JPH::RShapeCast cast(a.held->shape.GetPtr(), JPH::Vec3::sReplicate(1), a.mass_centre(),
                               JPH::Vec3(static_cast<float>(along.x()), static_cast<float>(along.y()),
                                         static_cast<float>(along.z())));
    JPH::ClosestHitCollisionCollector<JPH::CastShapeCollector> found;
    b.transformed().CastShape(cast, settings, JPH::RVec3::sZero(), found);
    out.claimed_tolerance = claim(a, b, 0);
    if (found.HadHit()) kit::set_toi(out, std::max(0.0, double{found.mHit.mFraction}));
  }

  const Setting& setting_;
  std::vector<Held> shapes_;
  std::vector<Body> bodies_;
  double margin_ = 0;
};

}  // namespace
}  // namespace touchstone::jolt_adapter

TS_PLUGIN(touchstone::jolt_adapter::Engine)
