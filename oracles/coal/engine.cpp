// Coal 3.0 as shipped: coal::distance with signed distance, coal::collide with security margin 0, or that of
// the question. What the answers mean follows coal/collision_data.h:
//
// - DistanceResult::min_distance is the signed distance, and the nearest points achieve it.
// - Contact::penetration_depth is that signed distance too (getDistanceToCollision subtracts the security
//   margin from it), so the depth is its negative, and a contact with a positive one is of bodies that are
//   apart.
// - Contact::normal points from the first body to the second.
// - CollisionRequest::security_margin is the distance below which bodies are considered in collision.
// - CollisionResult::distance_lower_bound is a lower bound of the distance of bodies that are not.
// - A triangle mesh's contacts are those of its triangles, of which none is the depth of the whole: only its
//   overlap and its distance from bodies apart are stated.
#include <coal/collision.h>
#include <coal/distance.h>
#include <coal/config.hh>

#include "core/math/roundoff.h"
#include "oracles/abi/plugin_kit.h"
#include "oracles/coal/shapes.h"

namespace touchstone::coal_adapter {
namespace {

constexpr const char* settings =
    "default requests: distance with enable_signed_distance; collide with security_margin 0 and one contact";
constexpr const char* source =
    "coal/collision_data.h: gjk_tolerance, the precision of distances of bodies apart, and epa_tolerance, of "
    "bodies that overlap; relative to the distance (GJKConvergenceCriterionType::Relative)";
constexpr double unit_roundoff =
    sizeof(coal::CoalScalar) == sizeof(double) ? double_roundoff : float_roundoff;

struct Body {
  const coal::CollisionGeometry* geometry;
  coal::Transform3s transform;
  int kind;
};

// The tolerances are relative; below distance 1 they are taken as absolute, in the engine's favour.
double claimed(const coal::QueryRequest& request, double distance) {
  const double tolerance =
      std::max(static_cast<double>(request.gjk_tolerance), static_cast<double>(request.epa_tolerance));
  return tolerance * std::max(1.0, std::abs(distance));
}

class Engine {
 public:
  static constexpr ts_question later_questions[] = {TS_WITHIN, TS_BOUNDED_DISTANCE, TS_CONTACT_WITHIN};
  static std::vector<kit::CardText> cards() {
    return {{"coal", "Coal", COAL_VERSION, settings, unit_roundoff, kit::oracle_tau_factor, source}};
  }
  explicit Engine(unsigned) {}

  void load(const ts_scene& scene, const ts_received& received) {
    unload();
    margin_ = scene.margin;
    for (std::size_t i = 0; i < scene.shape_count; ++i) {
      geometries_.push_back(make_geometry(scene.shapes[i]));
      geometries_.back()->computeLocalAABB();
      report_shape(static_cast<int>(i), scene.shapes[i], *geometries_.back(), received);
    }
    for (std::size_t i = 0; i < scene.body_count; ++i) {
      const ts_body& b = scene.bodies[i];
      const auto shape = static_cast<std::size_t>(b.shape);
      bodies_.push_back(
          {geometries_[shape].get(), make_transform(kit::pose_of(b.pose)), scene.shapes[shape].kind});
      report_body(static_cast<int>(i), bodies_.back().transform, received);
    }
  }
  void unload() {
    bodies_.clear();
    geometries_.clear();
  }

  void ask(ts_question question, int a, int b, ts_answer& out, const ts_sink& sink) {
    const bool of_margin =
        question == TS_WITHIN || question == TS_BOUNDED_DISTANCE || question == TS_CONTACT_WITHIN;
    if (question > TS_CONTACT && !of_margin)
      throw kit::Unsupported("Coal answers overlap, distance, contact and margins of two bodies");
    const Body &one = bodies_[static_cast<std::size_t>(a)], &two = bodies_[static_cast<std::size_t>(b)];
    if (question == TS_DISTANCE) return ask_distance(one, two, out);
    if (of_margin) return ask_near(question, one, two, out, sink);
    ask_contact(one, two, out, question == TS_CONTACT ? &sink : nullptr);
  }

 private:
  static bool has_mesh(const Body& a, const Body& b) { return a.kind == TS_MESH || b.kind == TS_MESH; }

  static void ask_distance(const Body& a, const Body& b, ts_answer& out) {
    const coal::DistanceRequest request;
    coal::DistanceResult result;
    coal::distance(a.geometry, a.transform, b.geometry, b.transform, request, result);
    const double distance = result.min_distance;
    out.claimed_tolerance = claimed(request, distance);
    if (distance <= 0 && has_mesh(a, b)) return kit::set_overlap(out, true);
    kit::set_distance(out, distance);
    const Vec3 on_a = result.nearest_points[0].cast<double>(), on_b = result.nearest_points[1].cast<double>();
    kit::set_points(out, on_a, on_b);
  }

  /// With a sink, answers the whole contact; without one, only the overlap.
  static void ask_contact(const Body& a, const Body& b, ts_answer& out, const ts_sink* sink) {
    const coal::CollisionRequest request;
    coal::CollisionResult result;
    coal::collide(a.geometry, a.transform, b.geometry, b.transform, request, result);
    out.claimed_tolerance = claimed(request, 0);
    kit::set_overlap(out, result.isCollision());
    if (!result.isCollision() || !sink || has_mesh(a, b)) return;
    const coal::Contact& contact = result.getContact(0);
    const double signed_distance = contact.penetration_depth;
    out.claimed_tolerance = claimed(request, signed_distance);
    if (signed_distance > 0) return kit::set_overlap(out, false);
    state(contact, out, *sink);
  }

  static void state(const coal::Contact& contact, ts_answer& out, const ts_sink& sink) {
    const Vec3 normal = contact.normal.cast<double>(), position = contact.pos.cast<double>();
    kit::set_normal(out, normal);
    kit::set_depth(out, -contact.penetration_depth);
    sink.point(sink.ctx, position.data(), -contact.penetration_depth);
  }

  void ask_near(ts_question question, const Body& a, const Body& b, ts_answer& out,
                const ts_sink& sink) const {
    coal::CollisionRequest request;
    request.security_margin = static_cast<coal::CoalScalar>(margin_);
    request.enable_distance_lower_bound = question == TS_BOUNDED_DISTANCE;
    coal::CollisionResult result;
    coal::collide(a.geometry, a.transform, b.geometry, b.transform, request, result);
    out.claimed_tolerance = claimed(request, margin_);
    if (question != TS_BOUNDED_DISTANCE) kit::set_overlap(out, result.isCollision());
    if (question == TS_WITHIN || (question == TS_CONTACT_WITHIN && !result.isCollision())) return;
    if (!result.isCollision()) return kit::set_lower_bound(out, result.distance_lower_bound);
    if (has_mesh(a, b)) throw kit::Unsupported("a mesh's contacts have the distances of single triangles");
    const double distance = result.getContact(0).penetration_depth;
    out.claimed_tolerance = claimed(request, distance);
    if (question == TS_CONTACT_WITHIN) return state(result.getContact(0), out, sink);
    kit::set_distance(out, distance);
  }

  std::vector<Geometry> geometries_;
  std::vector<Body> bodies_;
  double margin_ = 0;
};

}  // namespace
}  // namespace touchstone::coal_adapter

TS_PLUGIN(touchstone::coal_adapter::Engine)
