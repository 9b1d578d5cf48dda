// ODE as an oracle: dCollide for overlap and contact. It has no distance and no time-of-impact query; its
// spaces are in broad_engine.cpp. ODE prints warnings to standard output, which the host separates from the
// protocol.
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
    if (question != TS_OVERLAP && question != TS_CONTACT) throw kit::Unsupported("ODE has no such query");
    if (world_->kind(a) == TS_HALF_SPACE && world_->kind(b) == TS_HALF_SPACE)
      throw kit::Unsupported("ODE has no code for two planes");
    ask_contact(a, b, out, question == TS_CONTACT ? &sink : nullptr);
  }

 private:
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
