// Bullet as a simulation runs it: one world for as long as the bodies stay the same, so that its persistent
// manifolds keep points from step to step. For motions in frames; answers depend on what was asked before,
// which is the setting and is documented by Bullet.
#include <algorithm>
#include <string>

#include "oracles/abi/plugin_kit.h"
#include "oracles/bullet/pair.h"

namespace touchstone::bullet_adapter {
namespace {

constexpr const char* source =
    "btCollisionMargin.h: 0.04; btBoxBoxDetector.cpp: dBoxBox2 prefers faces by fudge_factor 1.05; "
    "btInternalEdgeUtility.h: without it, normals at internal edges of meshes are wrong; "
    "btPersistentManifold.h: points are kept while they are within the contact breaking threshold, 0.02";

// The shapes of a scene as numbers, and which body has which: a world is kept while they stay the same.
std::vector<double> identity_of(const ts_scene& s) {
  std::vector<double> all;
  const auto add = [&](auto x) { all.push_back(static_cast<double>(x)); };
  for (std::size_t i = 0; i < s.shape_count; ++i) {
    const ts_shape& x = s.shapes[i];
    add(x.kind);
    for (const double v : x.size) add(v);
    add(x.vertex_count);
    for (std::size_t k = 0; k < 3 * x.vertex_count; ++k) add(x.vertices[k]);
    add(x.triangle_count);
    for (std::size_t k = 0; k < 3 * x.triangle_count; ++k) add(x.triangles[k]);
  }
  for (std::size_t i = 0; i < s.body_count; ++i) add(s.bodies[i].shape);
  return all;
}

class Engine {
 public:
  static std::vector<kit::CardText> cards() {
    const std::string version =
        std::to_string(BT_BULLET_VERSION / 100) + "." + std::to_string(BT_BULLET_VERSION % 100);
    kit::CardText card{
        is_double ? "bullet-f64-sim@warm" : "bullet-f32-sim@warm",
        "Bullet",
        version,
        "performDiscreteCollisionDetection in one world for scenes of the same shapes in a row, "
        "whose manifolds persist; no distance, no time of impact, no candidates; default "
        "margins",
        unit_roundoff,
        kit::oracle_tau_factor,
        source};
    card.separate_triangles = true;
    card.more_shapes = held_by_margin;
    card.depth_biases = {{"box box", kit::face_preference}};
    return {card};
  }

  explicit Engine(unsigned) {}

  void load(const ts_scene& scene, const ts_received& received) {
    if (const auto identity = identity_of(scene); identity != identity_ || !world_) {
      begin(scene);
      identity_ = identity;
    }
    scene_ = &scene;
    for (std::size_t i = 0; i < shapes_.size(); ++i) report_shape(static_cast<int>(i), *shapes_[i], received);
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      objects_[i]->setWorldTransform(make_transform(kit::pose_of(scene.bodies[i].pose)));
      report_body(static_cast<int>(i), objects_[i]->getWorldTransform(), received);
    }
    is_current_ = false;
  }
  void unload() { scene_ = nullptr; }

  void ask(ts_question question, int a, int b, ts_answer& out, const ts_sink& sink) {
    if (question != TS_OVERLAP && question != TS_CONTACT)
      throw kit::Unsupported("this engine answers about the contacts of a step");
    for (const auto& s : shapes_)
      if (!s->shape) kit::no_such_shape("Bullet");
    if (!shape(a).is_convex() && !shape(b).is_convex())
      throw kit::Unsupported("Bullet has no algorithm for two concave or infinite shapes");
    step();
    answer(question == TS_CONTACT, a, b, out, sink);
  }

 private:
  const Shape& shape(int body) const {
    return *shapes_[static_cast<std::size_t>(scene_->bodies[body].shape)];
  }

  void begin(const ts_scene& scene) {
    world_.reset();
    objects_.clear();
    shapes_.clear();
    for (std::size_t i = 0; i < scene.shape_count; ++i)
      shapes_.push_back(make_shape(scene.shapes[i], std::nullopt));
    for (std::size_t i = 0; i < scene.body_count; ++i) {
      auto o = std::make_unique<btCollisionObject>();
      o->setCollisionShape(shapes_[static_cast<std::size_t>(scene.bodies[i].shape)]->shape.get());
      o->setWorldTransform(make_transform(kit::pose_of(scene.bodies[i].pose)));
      o->setUserIndex(static_cast<int>(i));
      objects_.push_back(std::move(o));
    }
    world_ = std::make_unique<World>(configuration_);
    for (const auto& o : objects_)
      if (o->getCollisionShape()) (*world_)->addCollisionObject(o.get());
  }

  // One step for each scene, whatever is asked about it.
  void step() {
    if (!is_current_) (*world_)->performDiscreteCollisionDetection();
    is_current_ = true;
  }

  void answer(bool whole_contact, int a, int b, ts_answer& out, const ts_sink& sink) {
    std::vector<Point> all;
    double breaking = 0;
    btDispatcher& dispatcher = *(*world_)->getDispatcher();
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& m = *dispatcher.getManifoldByIndexInternal(i);
      const int one = m.getBody0()->getUserIndex(), two = m.getBody1()->getUserIndex();
      if (std::minmax(one, two) != std::minmax(a, b)) continue;
      breaking = std::max(breaking, static_cast<double>(m.getContactBreakingThreshold()));
      for (const Point& p : manifold_points(m, *objects_[static_cast<std::size_t>(a)])) all.push_back(p);
    }
    const Point* const d = deepest(all);
    const bool overlap = d && d->distance <= 0;
    kit::set_overlap(out, overlap);
    out.claimed_tolerance = breaking;
    for (const int body : {a, b})
      out.claimed_tolerance += shape(body).outside_margin() + shape(body).inside_margin();
    if (!overlap || !whole_contact) return;
    kit::set_normal(out, d->normal_ab);
    kit::set_depth(out, -d->distance);
    for (const Point& p : all)
      if (p.distance <= 0)
        sink.point(sink.ctx, p.on_b.data(), kit::depth_along(d->normal_ab, p.normal_ab, -p.distance));
  }

  btDefaultCollisionConfiguration configuration_;
  std::vector<std::unique_ptr<Shape>> shapes_;
  Objects objects_;
  std::unique_ptr<World> world_;
  std::vector<double> identity_;
  const ts_scene* scene_ = nullptr;
  bool is_current_ = false;
};

}  // namespace
}  // namespace touchstone::bullet_adapter

TS_PLUGIN(touchstone::bullet_adapter::Engine)
