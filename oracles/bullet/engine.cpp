// The Bullet plug-in, in one precision: query path and simulation path, each with Bullet's default margins
// and without margins, and, as a separate plug-in, with other settings (settings.h).
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string>

#include "oracles/abi/plugin_kit.h"
#include "oracles/bullet/pair.h"
#include "oracles/bullet/settings.h"

// A global of btGjkPairDetector.cpp that no header declares.
extern btScalar gGjkEpaPenetrationTolerance;

namespace touchstone::bullet_adapter {
namespace {

// btContinuousConvexCollision stops at a gap of 0.001, a length hard-coded in its source.
constexpr double sweep_gap = 0.001;
// The same in btGjkConvexCast, which casts rays.
constexpr double ray_gap = 0.001;

constexpr const char* source =
    "btCollisionMargin.h: 0.04; inside for box and cylinder (setSafeMargin), outside for hull, cone; "
    "btContinuousConvexCollision.cpp: sweep ends at a gap of 0.001; btGjkConvexCast.cpp: ray ends at a gap "
    "of "
    "0.001; btBoxBoxDetector.cpp: dBoxBox2 prefers faces by fudge_factor 1.05; btInternalEdgeUtility.h: "
    "without it, normals at internal edges of meshes are wrong; btBvhTriangleMeshShape.h: a mesh is a static "
    "set of triangles without an inside";

btDefaultCollisionConstructionInfo construction_of(const Setting& s) {
  btDefaultCollisionConstructionInfo info;
  info.m_useEpaPenetrationAlgorithm = !s.minkowski;
  return info;
}

class Engine {
 public:
  static constexpr ts_question later_questions[] = {TS_WITHIN, TS_RAY, TS_CONTACT_WITHIN};
  static std::vector<kit::CardText> cards() {
    const std::string prefix = is_double ? "bullet-f64-" : "bullet-f32-";
    const std::string version =
        std::to_string(BT_BULLET_VERSION / 100) + "." + std::to_string(BT_BULLET_VERSION % 100);
    std::vector<kit::CardText> all;
    for (const Setting& s : settings)
      all.push_back({prefix + std::string(s.name), "Bullet", version, text_of(s), unit_roundoff,
                     kit::oracle_tau_factor, source});
    for (kit::CardText& card : all) {
      card.separate_triangles = true;
      card.more_shapes = held_by_margin;
    }
    // Queries send boxes through GJK and EPA, the simulation through btBoxBoxDetector.
    for (std::size_t i = 0; i < all.size(); ++i)
      if (settings[i].sim) all[i].depth_biases = {{"box box", kit::face_preference}};
    return all;
  }

  explicit Engine(unsigned index)
      : setting_(settings[index]),
        sim_(setting_.sim),
        configuration_(construction_of(setting_)),
        query_world_(configuration_) {
    if (setting_.epa_tolerance) gGjkEpaPenetrationTolerance = static_cast<btScalar>(*setting_.epa_tolerance);
  }

  void load(const ts_scene& scene, const ts_received& received) {
    unload();
    for (std::size_t i = 0; i < scene.shape_count; ++i) {
      shapes_.push_back(make_shape(scene.shapes[i], setting_.margin));
      report_shape(static_cast<int>(i), *shapes_.back(), received);
    }
    for (std::size_t i = 0; i < scene.body_count; ++i) {
      auto o = std::make_unique<btCollisionObject>();
      o->setCollisionShape(shapes_[static_cast<std::size_t>(scene.bodies[i].shape)]->shape.get());
      o->setWorldTransform(make_transform(kit::pose_of(scene.bodies[i].pose)));
      o->setUserIndex(static_cast<int>(i));
      report_body(static_cast<int>(i), o->getWorldTransform(), received);
      objects_.push_back(std::move(o));
    }
    scene_ = &scene;
    filter_ = kit::PairFilter(scene);
  }
  void unload() {
    objects_.clear();
    shapes_.clear();
    scene_ = nullptr;
  }

  void ask(ts_question question, int a, int b, ts_answer& out, const ts_sink& sink) {
    const bool of_depths = setting_.minkowski || setting_.epa_tolerance,
               of_sweeps = setting_.allowed_penetration.has_value();
    if (question == TS_TIME_OF_IMPACT ? of_depths : question == TS_RAY ? of_depths || of_sweeps : of_sweeps)
      throw kit::Unsupported("this engine's setting does not affect this question");
    if (question == TS_SWEPT_CANDIDATES)
      throw kit::Unsupported("Bullet's broad phases do not support moving bodies");
    if (question == TS_CANDIDATES || question == TS_SCENE_CONTACTS) {
      for (const auto& s : shapes_)
        if (!s->shape) kit::no_such_shape("Bullet");
      return question == TS_CANDIDATES ? ask_candidates(sink) : ask_scene(out, sink);
    }
    for (int i : {a, b})
      if (!shape(i).shape) kit::no_such_shape("Bullet");
    if (!shape(a).is_convex() && !shape(b).is_convex())
      throw kit::Unsupported("Bullet has no algorithm for two concave or infinite shapes");
    switch (question) {
      case TS_OVERLAP:
        return ask_contact(a, b, out, nullptr);
      case TS_CONTACT:
        return ask_contact(a, b, out, &sink);
      case TS_CONTACT_WITHIN:
        return ask_within(a, b, out, &sink);
      case TS_DISTANCE:
        return ask_distance(a, b, out);
      case TS_WITHIN:
        return ask_within(a, b, out, nullptr);
      case TS_RAY:
        return ask_ray(a, b, out);
      default:
        return ask_time(a, b, out);
    }
  }

 private:
  const Shape& shape(int body) const {
    return *shapes_[static_cast<std::size_t>(scene_->bodies[body].shape)];
  }
  btCollisionObject& object(int body) { return *objects_[static_cast<std::size_t>(body)]; }

  // Plane algorithms use the support point with margin. Of a box it is the nominal corner; a cylinder adds a
  // sphere of the margin to its smaller core, which rounds its edges there too (btCylinderShape.h,
  // localGetSupportingVertex). btBoxBoxDetector works on the nominal boxes.
  bool is_nominal(const Shape& s, const Shape& other) const {
    return s.kind == TS_BOX && (other.kind == TS_HALF_SPACE || (sim_ && other.kind == TS_BOX));
  }
  double claimed_margin(int a, int b) const {
    const Shape &one = shape(a), &two = shape(b);
    return one.outside_margin() + two.outside_margin() + (is_nominal(one, two) ? 0 : one.inside_margin()) +
           (is_nominal(two, one) ? 0 : two.inside_margin());
  }

  std::vector<Point> points(int a, int b) {
    return sim_ ? simulated_points(configuration_, object(a), object(b))
                : query_points(*query_world_, object(a), object(b), 0);
  }

  /// With a sink, answers the whole contact; without one, only the overlap.
  void ask_contact(int a, int b, ts_answer& out, const ts_sink* sink) {
    // Bullet also reports points within its contact breaking threshold that do not touch.
    state_contact(points(a, b), 0, out, sink);
    out.claimed_tolerance = claimed_margin(a, b);
  }

  // What is no farther apart than `reach`; without a sink, only whether there is any.
  static void state_contact(const std::vector<Point>& all, double reach, ts_answer& out,
                            const ts_sink* sink) {
    const Point* const d = deepest(all);
    const bool found = d && d->distance <= reach;
    kit::set_overlap(out, found);
    if (!found || !sink) return;
    kit::set_normal(out, d->normal_ab);
    kit::set_depth(out, -d->distance);
    for (const Point& p : all)
      if (p.distance <= reach)
        sink->point(sink->ctx, p.on_b.data(), kit::depth_along(d->normal_ab, p.normal_ab, -p.distance));
  }

  void ask_distance(int a, int b, ts_answer& out) {
    if (sim_) throw kit::Unsupported("the simulation path has no distance query");
    const std::vector<Point> all =
        query_points(*query_world_, object(a), object(b), btScalar(BT_LARGE_FLOAT));
    const Point* const d = deepest(all);
    out.claimed_tolerance = claimed_margin(a, b);
    if (!d) {
      out.outcome = TS_NOT_CONVERGED;
      return kit::set_detail(out, "contactPairTest reported no closest point");
    }
    kit::set_distance(out, d->distance);
    kit::set_points(out, d->on_a, d->on_b);
  }

  // ContactResultCallback::m_closestDistanceThreshold: points are reported up to that distance. Without a
  // sink, only whether there are any.
  void ask_within(int a, int b, ts_answer& out, const ts_sink* sink) {
    if (sim_) throw kit::Unsupported("the simulation path has no distance query");
    if (scene_->margin < 0) throw kit::Unsupported("m_closestDistanceThreshold is not for depths");
    const auto margin = static_cast<btScalar>(scene_->margin);
    state_contact(query_points(*query_world_, object(a), object(b), margin), margin, out, sink);
    out.claimed_tolerance = claimed_margin(a, b);
  }

  void ask_ray(int a, int b, ts_answer& out) {
    if (sim_) throw kit::Unsupported("the simulation path has no ray test");
    const Pose start = kit::pose_of(scene_->bodies[b].pose);
    const Vec3 end = start.translation + kit::vec3(scene_->bodies[b].linear);
    const auto hit = cast_ray(object(a), start.translation, end);
    out.claimed_tolerance = shape(a).outside_margin() + shape(a).inside_margin() + ray_gap;
    if (!hit) return;
    kit::set_toi(out, hit->part);
    kit::set_normal(out, hit->normal);
  }

  // The sweep requires a target at rest. A target that only translates is brought to rest by using the
  // relative motion. The swept body is the one that rotates, or the only convex one.
  void ask_time(int a, int b, ts_answer& out) {
    if (sim_) throw kit::Unsupported("the simulation path has no time of impact");
    const auto motion = [&](int i) { return kit::motion_of(scene_->bodies[i]); };
    const auto turns = [&](int i) { return motion(i).angular.norm() > 0; };
    if (turns(a) && turns(b))
      throw kit::Unsupported("convexSweepTest requires a target at rest, and both bodies rotate");
    const bool sweep_b = turns(b) || !shape(a).is_convex();
    const int mover = sweep_b ? b : a, target = sweep_b ? a : b;
    if (!shape(mover).is_convex()) throw kit::Unsupported("convexSweepTest sweeps convex shapes only");
    Motion relative = motion(mover);
    if (relative.angular.norm() >= std::numbers::pi)
      throw kit::Unsupported("convexSweepTest defines a motion by its end poses: only less than half a turn");
    relative.linear -= motion(target).linear;
    const Pose start = kit::pose_of(scene_->bodies[mover].pose);
    const auto t = sweep(configuration_, static_cast<const btConvexShape&>(*shape(mover).shape),
                         make_transform(start), make_transform(pose_at(start, relative, 1)), object(target),
                         setting_.allowed_penetration.value_or(0));
    out.claimed_tolerance = claimed_margin(a, b) + sweep_gap + setting_.allowed_penetration.value_or(0);
    if (t) kit::set_toi(out, *t);
  }

  void ask_candidates(const ts_sink& sink) {
    World world(configuration_);
    // Objects that the script never removes must leave the world before it is destroyed; afterwards all poses
    // are reset to those of the scene.
    run_script(*scene_, objects_, world, [&](int k, int a, int b) {
      if (!filter_.drops(a, b)) sink.pair(sink.ctx, k, a, b);
    });
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      if (objects_[i]->getBroadphaseHandle()) world->removeCollisionObject(objects_[i].get());
      objects_[i]->setWorldTransform(make_transform(kit::pose_of(scene_->bodies[i].pose)));
    }
  }

  void ask_scene(ts_answer& out, const ts_sink& sink) {
    const auto report = [&](int a, int b, const std::vector<Point>& all) {
      const Point* const d = deepest(all);
      if (filter_.drops(a, b) || !d || d->distance > 0) return;
      sink.contact(sink.ctx, a, b, d->normal_ab.data(), -d->distance);
      out.claimed_tolerance = std::max(out.claimed_tolerance, claimed_margin(a, b));
    };
    if (sim_)
      simulate_scene(report);
    else
      query_scene(report);
  }

  template <class Report>
  void simulate_scene(const Report& report) {
    const Assembly assembly(*scene_, objects_);
    World world(configuration_);
    for (btCollisionObject* o : assembly.objects()) world->addCollisionObject(o);
    world->performDiscreteCollisionDetection();
    std::map<std::pair<int, int>, std::vector<Point>> of_pair;
    for (int i = 0; i < world->getDispatcher()->getNumManifolds(); ++i) {
      const btPersistentManifold& m = *world->getDispatcher()->getManifoldByIndexInternal(i);
      for (const Point& p : manifold_points(m, *m.getBody0()))
        of_pair[{assembly.body_of(*m.getBody0(), p.index_a), assembly.body_of(*m.getBody1(), p.index_b)}]
            .push_back(p);
    }
    for (const auto& [pair, points] : of_pair) report(pair.first, pair.second, points);
    for (btCollisionObject* o : assembly.objects()) world->removeCollisionObject(o);
  }

  template <class Report>
  void query_scene(const Report& report) {
    World world(configuration_);
    for (auto& o : objects_) world->addCollisionObject(o.get());
    world->updateAabbs();
    world->computeOverlappingPairs();
    for_each_cached_pair(*world, [&](int a, int b) {
      if (!filter_.drops(a, b)) report(a, b, query_points(*query_world_, object(a), object(b), 0));
    });
    for (auto& o : objects_) world->removeCollisionObject(o.get());
  }

  const Setting& setting_;
  bool sim_;
  btDefaultCollisionConfiguration configuration_;
  World query_world_;
  const ts_scene* scene_ = nullptr;
  std::vector<std::unique_ptr<Shape>> shapes_;
  Objects objects_;
  kit::PairFilter filter_;
};

}  // namespace
}  // namespace touchstone::bullet_adapter

TS_PLUGIN(touchstone::bullet_adapter::Engine)
