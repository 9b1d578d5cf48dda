// MuJoCo 2.2: contacts by mj_collision, for pairs and for whole scenes. It has no distance query.
#include <optional>
#include <set>

#include "core/math/roundoff.h"
#include "oracles/mujoco2/model.h"

namespace touchstone::mujoco2 {
namespace {

// mpr_tolerance of mjOption, for all pairs of mjCOLLISIONFUNC (engine_collision_driver.c) that go to
// mjc_Convex.
constexpr double mpr_tolerance = 1e-6;

bool goes_to_mpr(int a, int b) {
  if (a > b) std::swap(a, b);
  if (a == mjGEOM_PLANE) return false;
  const bool is_curved =
      a == mjGEOM_ELLIPSOID || a == mjGEOM_CYLINDER || b == mjGEOM_ELLIPSOID || b == mjGEOM_CYLINDER;
  return is_curved || b == mjGEOM_MESH;
}

// Relative to the depth: more than its rounding.
constexpr double same_depth = 1e-9;

// The points of two boxes are those of a clipped face, whose deepest point may have been clipped off. Three
// points of the same depth show that the faces are parallel, and so every point is as deep as the boxes are.
bool are_parallel(const std::vector<const mjContact*>& points) {
  const double depth = points.front()->dist;
  return points.size() >= 3 && std::ranges::all_of(points, [&](const mjContact* c) {
           return std::abs(c->dist - depth) <= same_depth * std::abs(depth);
         });
}

Vec3 normal_of(const mjContact& c) { return kit::vec3(c.frame); }

class Engine {
 public:
  static constexpr ts_question later_questions[] = {TS_WITHIN, TS_CONTACT_WITHIN};
  static std::vector<kit::CardText> cards() {
    kit::CardText card{
        "mujoco2",
        "MuJoCo",
        mj_versionString(),
        "mj_collision, options as shipped: margin 0, MPR",
        double_roundoff,
        kit::oracle_tau_factor,
        "XML reference: option mpr_tolerance 1e-6, for pairs of meshes, cylinders and ellipsoids; "
        "mjmodel.h: vertices of meshes are float"};
    card.unit_roundoffs = {{"hull", float_roundoff}};
    card.shapes = {"sphere", "box", "capsule", "cylinder", "ellipsoid", "hull", "half_space"};
    return {card};
  }
  explicit Engine(unsigned) {}

  void load(const ts_scene& scene, const ts_received& received) {
    unload();
    world_.emplace(scene, received);
    margin_ = scene.margin;
    filter_ = kit::PairFilter(scene);
  }
  void unload() {
    world_.reset();
    collided_ = false;
  }

  void ask(ts_question question, int a, int b, ts_answer& out, const ts_sink& sink) {
    if (question == TS_SCENE_CONTACTS) return ask_scene(out, sink);
    const bool of_margin = question == TS_WITHIN || question == TS_CONTACT_WITHIN;
    if (question != TS_OVERLAP && question != TS_CONTACT && !of_margin)
      throw kit::Unsupported("MuJoCo 2.2 has no such query");
    for (const int i : {a, b})
      if (!world_->has_geom(i)) kit::no_such_shape("MuJoCo");
    if (world_->type(a) == mjGEOM_PLANE && world_->type(b) == mjGEOM_PLANE)
      throw kit::Unsupported("MuJoCo has no code for two planes");
    const ts_sink* const of_contact =
        question == TS_CONTACT || question == TS_CONTACT_WITHIN ? &sink : nullptr;
    if (of_margin) return ask_within(a, b, out, of_contact);
    ask_contact(a, b, out, of_contact);
  }

 private:
  /// MuJoCo collides all bodies at once, which is what a question costs.
  void collide() {
    world_->collide();
    collided_ = true;
  }

  std::vector<const mjContact*> contacts_of(int a, int b) const {
    std::vector<const mjContact*> all;
    for (const mjContact& c : *world_) {
      const int one = world_->body_of(c.geom1), two = world_->body_of(c.geom2);
      if ((one == a && two == b) || (one == b && two == a)) all.push_back(&c);
    }
    return all;
  }

  // MuJoCo's normal points from geom1 to geom2; it orders geoms by their types.
  Vec3 normal_from(int a, const mjContact& c) const {
    return world_->body_of(c.geom1) == a ? normal_of(c) : Vec3(-normal_of(c));
  }

  bool knows_depth(int a, int b, const std::vector<const mjContact*>& all) const {
    const bool are_boxes = world_->type(a) == mjGEOM_BOX && world_->type(b) == mjGEOM_BOX;
    return all.size() == 1 || !are_boxes || are_parallel(all);
  }

  double claimed(int a, int b) const {
    return goes_to_mpr(world_->type(a), world_->type(b)) ? mpr_tolerance : 0;
  }

  // XML reference, geom/margin: contacts are detected below this distance. With a sink, answers the whole
  // contact.
  void ask_within(int a, int b, ts_answer& out, const ts_sink* sink) {
    if (margin_ < 0) throw kit::Unsupported("a margin is not for depths");
    world_->collide_within(a, margin_);
    collided_ = false;
    state_contact(a, b, out, sink);
  }

  /// With a sink, answers the whole contact; without one, only the overlap.
  void ask_contact(int a, int b, ts_answer& out, const ts_sink* sink) {
    if (!collided_ || world_->bodies() == 2) collide();  // a larger scene once for all its pairs
    state_contact(a, b, out, sink);
  }

  void state_contact(int a, int b, ts_answer& out, const ts_sink* sink) const {
    const std::vector<const mjContact*> all = contacts_of(a, b);
    kit::set_overlap(out, !all.empty());
    out.claimed_tolerance = claimed(a, b);
    if (all.empty() || !sink) return;
    const mjContact& deepest = **std::ranges::min_element(all, {}, &mjContact::dist);
    const Vec3 normal = normal_from(a, deepest);
    // The depth of a single contact is that of the bodies.
    for (const mjContact* c : all)
      sink->point(sink->ctx, c->pos,
                  all.size() > 1 ? kit::depth_along(normal, normal_from(a, *c), -c->dist)
                                 : std::numeric_limits<double>::quiet_NaN());
    kit::set_normal(out, normal);
    if (knows_depth(a, b, all)) kit::set_depth(out, -deepest.dist);
  }

  void ask_scene(ts_answer& out, const ts_sink& sink) {
    if (!world_->has_all()) kit::no_such_shape("MuJoCo");
    collide();
    std::set<std::pair<int, int>> touching;
    for (const mjContact& c : *world_)
      touching.insert(std::minmax(world_->body_of(c.geom1), world_->body_of(c.geom2)));
    for (const auto& pair : touching) {
      if (filter_.drops(pair.first, pair.second)) continue;
      const std::vector<const mjContact*> all = contacts_of(pair.first, pair.second);
      if (!knows_depth(pair.first, pair.second, all))
        throw kit::Unsupported(
            "the depth of two boxes is not known from a clipped face, and each contact needs one");
      const mjContact* const c = *std::ranges::min_element(all, {}, &mjContact::dist);
      sink.contact(sink.ctx, pair.first, pair.second, normal_from(pair.first, *c).eval().data(), -c->dist);
      out.claimed_tolerance = std::max(out.claimed_tolerance, claimed(pair.first, pair.second));
    }
  }

  std::optional<World> world_;
  bool collided_ = false;
  double margin_ = 0;
  kit::PairFilter filter_;
};

}  // namespace
}  // namespace touchstone::mujoco2

TS_PLUGIN(touchstone::mujoco2::Engine)
