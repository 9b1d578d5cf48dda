// DART's collision detectors, each as an engine: a CollisionGroup of two SimpleFrames,
// CollisionGroup::collide for overlap and contact, CollisionGroup::distance where the back end has it (FCL).
#include <dart/collision/CollisionGroup.hpp>
#include <dart/collision/CollisionObject.hpp>
#include <dart/collision/dart/DARTCollisionDetector.hpp>
#include <dart/collision/fcl/FCLCollisionDetector.hpp>
#include <dart/config.hpp>
#ifdef TOUCHSTONE_DART_BULLET
#include <dart/collision/bullet/BulletCollisionDetector.hpp>
#endif
#ifdef TOUCHSTONE_DART_ODE
#include <dart/collision/ode/OdeCollisionDetector.hpp>
#endif

#include "core/math/roundoff.h"
#include "oracles/dart/shapes.h"

namespace touchstone::dart_adapter {
namespace {

namespace collision = dart::collision;

// DART_COLLISION_EPS of DARTCollide.cpp: a ball whose centre is nearer than this to a box's surface is
// handled as if it were on it.
constexpr double own_tolerance = 1e-6;
// gjk_tolerance and distance_tolerance of FCL's requests, which DART leaves at their defaults.
constexpr double fcl_tolerance = 1e-6;
// mpr_tolerance of ODE's collision_libccd.cpp.
constexpr double ode_mpr_tolerance = 1e-6;
// CONVEX_DISTANCE_MARGIN of Bullet's btCollisionMargin.h.
constexpr double bullet_margin = 0.04;
// btCollisionShape's setSafeMargin: the margin is at most this share of the least half extent.
constexpr double safe_margin_share = 0.1;

// The depth of a contact of one point is that of the bodies.
constexpr double no_depth = std::numeric_limits<double>::quiet_NaN();

struct Row {
  Backend backend;
  const char *name, *settings, *source;
};
constexpr Row rows[] = {
    {Backend::own, "dart", "DARTCollisionDetector",
     "DARTCollide.cpp: DART_COLLISION_EPS 1e-6; dBoxBox prefers faces by fudge_factor 1.05"},
    {Backend::fcl, "dart-fcl", "FCLCollisionDetector, PRIMITIVE",
     "FCL's requests: gjk_tolerance and distance_tolerance 1e-6; boxBox2 prefers faces by fudge_factor 1.05"},
    {Backend::fcl_mesh, "dart-fcl-mesh",
     "FCLCollisionDetector as created: meshes of floats in place of shapes",
     "FCL's requests: distance_tolerance 1e-6"},
#ifdef TOUCHSTONE_DART_BULLET
    {Backend::bullet, "dart-bullet", "BulletCollisionDetector, which Debian builds with Bullet in floats",
     "btCollisionMargin.h: 0.04, inside for box and cylinder (setSafeMargin); a cone's is 0, by DART; "
     "dBoxBox2 prefers faces by "
     "fudge_factor 1.05"},
#endif
#ifdef TOUCHSTONE_DART_ODE
    {Backend::ode, "dart-ode", "OdeCollisionDetector",
     "ODE's collision_libccd.cpp: mpr_tolerance 1e-6; dBoxBox2 prefers faces by fudge_factor 1.05"},
#endif
};

collision::CollisionDetectorPtr make_detector(Backend backend) {
  switch (backend) {
#ifdef TOUCHSTONE_DART_BULLET
    case Backend::bullet:
      return collision::BulletCollisionDetector::create();
#endif
#ifdef TOUCHSTONE_DART_ODE
    case Backend::ode:
      return collision::OdeCollisionDetector::create();
#endif
    case Backend::own:
      return collision::DARTCollisionDetector::create();
    default: {
      auto detector = collision::FCLCollisionDetector::create();
      if (backend == Backend::fcl)
        detector->setPrimitiveShapeType(collision::FCLCollisionDetector::PRIMITIVE);
      return detector;
    }
  }
}

class Engine {
 public:
  static std::vector<kit::CardText> cards() {
    std::vector<kit::CardText> all;
    for (const Row& r : rows)
      all.push_back({r.name, "DART", DART_VERSION, r.settings,
                     r.backend == Backend::bullet ? float_roundoff : double_roundoff, kit::oracle_tau_factor,
                     r.source});
    for (std::size_t i = 0; i < all.size(); ++i) all[i].shapes = shapes_of(rows[i].backend);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (rows[i].backend != Backend::fcl_mesh) all[i].depth_biases = {{"box box", kit::face_preference}};
    return all;
  }

  explicit Engine(unsigned index) : backend_(rows[index].backend), detector_(make_detector(backend_)) {}

  void load(const ts_scene& scene, const ts_received& received) {
    unload();
    scene_ = &scene;
    for (std::size_t i = 0; i < scene.shape_count; ++i) {
      shapes_.push_back(make_shape(backend_, scene.shapes[i]));
      if (backend_ == Backend::bullet && shapes_.back())
        report_floats(static_cast<int>(i), scene.shapes[i], received);
    }
    for (std::size_t i = 0; i < scene.body_count; ++i) {
      const int index = static_cast<int>(i), number = scene.bodies[i].shape;
      frames_.push_back(make_frame(shapes_[static_cast<std::size_t>(number)], scene.bodies[i].pose));
      report_body(index, backend_, *frames_.back(), received);
      is_mesh_.push_back(uses_fcl() && frames_.back()->getShape() &&
                         report_fcl_mesh(number, detector_, *frames_.back(), received));
    }
  }
  void unload() {
    is_mesh_.clear();
    frames_.clear();
    shapes_.clear();
    scene_ = nullptr;
  }

  void ask(ts_question question, int a, int b, ts_answer& out, const ts_sink& sink) {
    if (question != TS_OVERLAP && question != TS_CONTACT && question != TS_DISTANCE)
      throw kit::Unsupported("DART has no such query");
    if (question == TS_DISTANCE && !uses_fcl())
      throw kit::Unsupported("this back end of DART has no distances");
    for (const int i : {a, b})
      if (!frame(i).getShape()) kit::no_such_shape("this back end of DART");
    if (kind(a) == TS_HALF_SPACE && kind(b) == TS_HALF_SPACE)
      throw kit::Unsupported("DART's back ends have no code for two planes");
    if (question == TS_CONTACT && (is_mesh(a) || is_mesh(b)))
      throw kit::Unsupported("contacts of meshes are those of single triangles, not of the bodies");
    if (question == TS_DISTANCE) return ask_distance(a, b, out);
    if (question == TS_OVERLAP && backend_ != Backend::bullet) return ask_overlap(a, b, out);
    ask_contact(a, b, out, question == TS_CONTACT ? &sink : nullptr);
  }

 private:
  bool uses_fcl() const { return backend_ == Backend::fcl || backend_ == Backend::fcl_mesh; }
  const dart::dynamics::SimpleFrame& frame(int body) const {
    return *frames_[static_cast<std::size_t>(body)];
  }
  const ts_shape& shape(int body) const { return scene_->shapes[scene_->bodies[body].shape]; }
  int kind(int body) const { return shape(body).kind; }
  bool is_mesh(int body) const { return is_mesh_[static_cast<std::size_t>(body)]; }
  bool are(int a, int b, int one, int two) const {
    return (kind(a) == one && kind(b) == two) || (kind(a) == two && kind(b) == one);
  }

  double bullet_inside_margin(int body, int other) const {
    const double* z = shape(body).size;
    const bool is_nominal = kind(body) == TS_BOX && (kind(other) == TS_BOX || kind(other) == TS_HALF_SPACE);
    if (is_nominal || (kind(body) != TS_BOX && kind(body) != TS_CYLINDER)) return 0;
    const double least = kind(body) == TS_BOX ? std::min({z[0], z[1], z[2]}) : std::min(z[0], z[1]);
    return std::min(bullet_margin, safe_margin_share * least);
  }

  double claimed_tolerance(int a, int b) const {
    switch (backend_) {
      case Backend::own:
        return are(a, b, TS_SPHERE, TS_BOX) ? own_tolerance : 0;
      case Backend::bullet:
        return bullet_inside_margin(a, b) + bullet_inside_margin(b, a);
      case Backend::ode:
        return are(a, b, TS_CYLINDER, TS_CYLINDER) || are(a, b, TS_CYLINDER, TS_CAPSULE) ? ode_mpr_tolerance
                                                                                         : 0;
      default:
        return fcl_tolerance;
    }
  }

  void ask_overlap(int a, int b, ts_answer& out) {
    const auto group = detector_->createCollisionGroup(&frame(a), &frame(b));
    kit::set_overlap(out, group->collide());
    out.claimed_tolerance = claimed_tolerance(a, b);
  }

  /// With a sink, answers the whole contact; without one, only the overlap.
  void ask_contact(int a, int b, ts_answer& out, const ts_sink* sink) {
    const auto group = detector_->createCollisionGroup(&frame(a), &frame(b));
    collision::CollisionResult result;
    bool overlap = group->collide(collision::CollisionOption(), &result);
    const collision::Contact* deepest = nullptr;
    for (const collision::Contact& c : result.getContacts())
      if (!deepest || c.penetrationDepth > deepest->penetrationDepth) deepest = &c;
    // Bullet also finds contacts between separate bodies; their depth is negative.
    if (backend_ == Backend::bullet) overlap = deepest && deepest->penetrationDepth >= 0;
    kit::set_overlap(out, overlap);
    out.claimed_tolerance = claimed_tolerance(a, b);
    if (!overlap || !sink || !deepest) return;
    state_contact(a, b, result, *deepest, out, *sink);
  }

  void state_contact(int a, int b, const collision::CollisionResult& result,
                     const collision::Contact& deepest, ts_answer& out, const ts_sink& sink) {
    // DART's normal points from the second object to the first.
    const auto normal = [&](const collision::Contact& c) {
      return c.collisionObject1->getShapeFrame() == &frame(a) ? Vec3(-c.normal) : c.normal;
    };
    const bool is_manifold = result.getNumContacts() > 1;
    for (const collision::Contact& c : result.getContacts())
      sink.point(sink.ctx, c.point.data(),
                 is_manifold ? kit::depth_along(normal(deepest), normal(c), c.penetrationDepth) : no_depth);
    kit::set_normal(out, normal(deepest));
    // The deepest of several points is not the depth along the normal where the face was clipped.
    if (!is_manifold || !are(a, b, TS_BOX, TS_BOX)) kit::set_depth(out, deepest.penetrationDepth);
  }

  void ask_distance(int a, int b, ts_answer& out) {
    const auto group = detector_->createCollisionGroup(&frame(a), &frame(b));
    collision::DistanceOption option;
    option.enableNearestPoints = true;
    // DistanceOption.hpp: without it, distances below 0 are reported as 0. DistanceResult.hpp: a negative
    // distance is minus the depth.
    option.distanceLowerBound = -std::numeric_limits<double>::infinity();
    collision::DistanceResult result;
    const double distance = group->distance(option, &result);
    out.claimed_tolerance = claimed_tolerance(a, b);
    kit::set_distance(out, distance);
    if (!(distance > 0)) return;
    if (result.shapeFrame1 == &frame(a))
      kit::set_points(out, result.nearestPoint1, result.nearestPoint2);
    else
      kit::set_points(out, result.nearestPoint2, result.nearestPoint1);
  }

  Backend backend_;
  collision::CollisionDetectorPtr detector_;
  const ts_scene* scene_ = nullptr;
  std::vector<dart::dynamics::ShapePtr> shapes_;        // null if the back end does not take the shape
  std::vector<dart::dynamics::SimpleFramePtr> frames_;  // one per body
  std::vector<bool> is_mesh_;                           // whether FCL holds a mesh for the body
};

}  // namespace
}  // namespace touchstone::dart_adapter

TS_PLUGIN(touchstone::dart_adapter::Engine)
