// ODE as an oracle: dCollide for overlap and contact. It has no distance and no time-of-impact query; its
// spaces are in broad_engine.cpp. ODE prints warnings to standard output, which the host separates from the
// protocol.
#include <algorithm>
#include <optional>

#include "core/math/roundoff.h"
#include "oracles/ode/shapes.h"

namespace touchstone::ode_adapter {
namespace {

// mpr_tolerance in collision_libccd.cpp, which handles the pairs without their own code.
constexpr double mpr_tolerance = 1e-6;
constexpr int most_contacts = 64;

bool goes_to_libccd(int a, int b) {
  if (a > b) std::swap(a, b);
  if (b == TS_HALF_SPACE) return false;
  return a == TS_HULL || b == TS_HULL || (a == TS_CYLINDER && b == TS_CYLINDER) ||
         (a == TS_CAPSULE && b == TS_CYLINDER);
}

class Engine {
 public:
  static constexpr ts_question later_questions[] = {TS_RAY};
  static std::vector<kit::CardText> cards() {
    kit::CardText ode{
        "ode",
        "ODE",
        dODE_VERSION,
        "dCollide as shipped",
        double_roundoff,
        kit::oracle_tau_factor,
        "collision_libccd.cpp: mpr_tolerance 1e-6, for hulls and for cylinders with cylinders and capsules; "
        "box.cpp: dBoxBox prefers faces by fudge_factor 1.05; none elsewhere"};
    ode.depth_biases = {{"box box", kit::face_preference}};
    return {ode};
  }
  explicit Engine(unsigned) {}
  void load(const ts_scene& scene, const ts_received& received) { world_.emplace(scene, received); }
  void unload() { world_.reset(); }

  void ask(ts_question question, int a, int b, ts_answer& out, const ts_sink& sink) {
    if (question == TS_RAY) return ask_ray(a, b, out);
    world_->require_sizes();
    if (question != TS_OVERLAP && question != TS_CONTACT) throw kit::Unsupported("ODE has no such query");
    if (world_->kind(a) == TS_HALF_SPACE && world_->kind(b) == TS_HALF_SPACE)
      throw kit::Unsupported("ODE has no code for two planes");
    ask_contact(a, b, out, question == TS_CONTACT ? &sink : nullptr);
  }

 private:
  // A dRayClass geometry against a, with the first contact asked for. ODE's depth is then the distance along
  // the ray, its normal that of a's surface.
  void ask_ray(int a, int b, ts_answer& out) {
    const ts_body& ray = world_->scene().bodies[b];
    const Vec3 start = kit::vec3(ray.pose.translation), way = kit::vec3(ray.linear);
    const double length = way.norm();
    if (world_->kind(a) == TS_SPHERE && world_->scene().shapes[world_->scene().bodies[a].shape].size[0] == 0)
      throw kit::Unsupported("ODE ignores geometries of zero size: GEOM_ZERO_SIZED");
    if (!(length > 0)) throw kit::Unsupported("a ray of ODE needs a direction");
    const GeomPtr geom(dCreateRay(nullptr, length));
    dGeomRaySet(geom.get(), start.x(), start.y(), start.z(), way.x(), way.y(), way.z());
    dGeomRaySetClosestHit(geom.get(), 1);
    dContactGeom hit;
    if (dCollide(geom.get(), world_->geom(a), 1, &hit, sizeof hit) == 0) return;
    kit::set_toi(out, std::min(hit.depth / length, 1.0));
    kit::set_normal(out, Vec3(hit.normal[0], hit.normal[1], hit.normal[2]));
  }

  /// With a sink, answers the whole contact; without one, only the overlap.
  void ask_contact(int a, int b, ts_answer& out, const ts_sink* sink) {
    std::vector<dContactGeom> all(most_contacts);
    const int n = dCollide(world_->geom(a), world_->geom(b), sink ? most_contacts : 1, all.data(),
                           sizeof(dContactGeom));
    kit::set_overlap(out, n > 0);
    out.claimed_tolerance = goes_to_libccd(world_->kind(a), world_->kind(b)) ? mpr_tolerance : 0;
    if (n == 0 || !sink) return;
    const dContactGeom* deepest = all.data();
    for (int i = 0; i < n; ++i) {
      const dContactGeom& c = all[static_cast<std::size_t>(i)];
      if (c.depth > deepest->depth) deepest = &c;
    }
    const auto normal = [](const dContactGeom& c) { return Vec3(c.normal[0], c.normal[1], c.normal[2]); };
    for (int i = 0; i < n; ++i) {
      const dContactGeom& c = all[static_cast<std::size_t>(i)];
      const double position[3] = {c.pos[0], c.pos[1], c.pos[2]};
      sink->point(sink->ctx, position, kit::depth_along(normal(*deepest), normal(c), c.depth));
    }
    // ODE's normal points from the second geometry into the first.
    kit::set_normal(out, -normal(*deepest));
    kit::set_depth(out, deepest->depth);
  }

  std::optional<World> world_;
};

}  // namespace
}  // namespace touchstone::ode_adapter

TS_PLUGIN(touchstone::ode_adapter::Engine)
