// The FCL plug-in: two solvers, each as shipped and tuned. With TOUCHSTONE_SWEEP, a separate plug-in: as
// shipped with one setting changed, for narrow-phase questions (fcl-libccd@1e-3) or for motions
// (fcl-naive@64: CCDC_NAIVE with that many samples; fcl-advance@1e-2: conservative advancement with that
// toc_err), so that a chart shows a method as a curve. FCL's requests have no iteration limits.
#include <fcl/config.h>

#include <algorithm>

#include "core/math/roundoff.h"
#include "oracles/abi/plugin_kit.h"
#include "oracles/fcl/queries.h"

namespace touchstone::fcl_adapter {
namespace {

#ifndef TOUCHSTONE_SWEEP
constexpr const char* shipped_settings =
    "default tolerances 1e-6; distance with enable_signed_distance; contact by collide, up to 256 points; "
    "time of impact CCDC_NAIVE, 10 samples, CCDM_TRANS or CCDM_LINEAR; candidates "
    "DynamicAABBTreeCollisionManager";
constexpr const char* tuned_libccd_settings =
    "collide 1e-12; distance unsigned 1e-12, signed 1e-7 if overlapping; contact normal and depth by signed "
    "distance 1e-7; time of impact CCDC_CONSERVATIVE_ADVANCEMENT over InterpMotion, pivot 0";
constexpr const char* tuned_indep_settings =
    "collide 1e-12; distance unsigned 1e-12, no depth; contact by collide; time of impact "
    "CCDC_CONSERVATIVE_ADVANCEMENT over InterpMotion, pivot 0";
#endif
// continuousCollide documents toc_err as an error in time; the corresponding length is toc_err times the
// closing speed.
constexpr const char* source =
    "fcl/narrowphase/collision_request.h: gjk_tolerance; distance_request.h: distance_tolerance; "
    "continuous_collision_request.h: toc_err times the closing speed; box_box-inl.h: boxBox2 prefers faces "
    "by "
    "fudge_factor 1.05; contact.h: a contact with a mesh is that of the triangle b1 or b2; "
    "BVH_model.h: a mesh is a hierarchy of triangles without an inside";

#ifdef TOUCHSTONE_SWEEP
struct Sweep {
  const char *name, *text;
  Settings settings;
};
constexpr const char* naive = "as fcl-libccd; CCDC_NAIVE with num_max_iterations as named";
constexpr const char* advance =
    "as fcl-libccd-tuned; CCDC_CONSERVATIVE_ADVANCEMENT with toc_err as named, which FCL 0.7.0 reads in "
    "CCDC_NAIVE only";
// The values in the names.
constexpr Sweep sweeps[] = {
    {"fcl-libccd@1e-3", "as fcl-libccd with tolerances 1e-3", {fcl::GST_LIBCCD, false, 1e-3}},
    {"fcl-indep@1e-3", "as fcl-indep with tolerances 1e-3", {fcl::GST_INDEP, false, 1e-3}},
    {"fcl-libccd@1e-9", "as fcl-libccd with tolerances 1e-9", {fcl::GST_LIBCCD, false, 1e-9}},
    {"fcl-indep@1e-9", "as fcl-indep with tolerances 1e-9", {fcl::GST_INDEP, false, 1e-9}},
    {"fcl-naive@4", naive, {fcl::GST_LIBCCD, false, 0, 4}},
    {"fcl-naive@16", naive, {fcl::GST_LIBCCD, false, 0, 16}},
    {"fcl-naive@64", naive, {fcl::GST_LIBCCD, false, 0, 64}},
    {"fcl-naive@256", naive, {fcl::GST_LIBCCD, false, 0, 256}},
    {"fcl-advance@1e-2", advance, {fcl::GST_LIBCCD, true, 0, 0, 1e-2}},
    {"fcl-advance@1e-8", advance, {fcl::GST_LIBCCD, true, 0, 0, 1e-8}},
};
#endif

class Engine {
 public:
  static std::vector<kit::CardText> cards() {
    const auto card = [](const char* name, const char* settings) {
      kit::CardText c{name, "FCL", FCL_VERSION, settings, double_roundoff, kit::oracle_tau_factor, source};
      c.separate_triangles = true;
      c.more_shapes = kit::padded_shapes;
      // Contacts by collide take boxBox2, those by signed distance do not.
      if (c.name != "fcl-libccd-tuned") c.depth_biases = {{"box box", kit::face_preference}};
      return c;
    };
#ifndef TOUCHSTONE_SWEEP
    return {card("fcl-libccd", shipped_settings), card("fcl-libccd-tuned", tuned_libccd_settings),
            card("fcl-indep", shipped_settings), card("fcl-indep-tuned", tuned_indep_settings)};
#else
    std::vector<kit::CardText> all;
    for (const Sweep& s : sweeps) all.push_back(card(s.name, s.text));
    return all;
#endif
  }

#ifndef TOUCHSTONE_SWEEP
  explicit Engine(unsigned index)
      : settings_{index >= 2 ? fcl::GST_INDEP : fcl::GST_LIBCCD, index % 2 == 1} {}
#else
  explicit Engine(unsigned index) : settings_(sweeps[index].settings) {}
#endif

  void load(const ts_scene& scene, const ts_received& received) {
    unload();
    for (std::size_t i = 0; i < scene.shape_count; ++i) {
      geometries_.push_back(make_geometry(scene.shapes[i]));
      geometries_.back()->computeLocalAABB();
      report_shape(static_cast<int>(i), scene.shapes[i], *geometries_.back(), received);
    }
    for (std::size_t i = 0; i < scene.body_count; ++i) {
      const ts_body& b = scene.bodies[i];
      const auto shape = static_cast<std::size_t>(b.shape);
      const kit::Core core = kit::core_of(scene.shapes[shape].kind);
      bodies_.push_back({geometries_[shape].get(), make_transform(kit::pose_of(b.pose)), core.kind,
                         core.radius_of(scene.shapes[shape])});
      report_body(static_cast<int>(i), bodies_.back().transform, received);
    }
    scene_ = &scene;
    filter_ = kit::PairFilter(scene);
  }
  void unload() {
    bodies_.clear();
    geometries_.clear();
    scene_ = nullptr;
  }

  void ask(ts_question question, int a, int b, ts_answer& out, const ts_sink& sink) {
    const bool by_distance = question == TS_OVERLAP || question == TS_DISTANCE;
    const auto is_padded = [](const Placed& p) { return p.padding > 0; };
    if (!by_distance && std::any_of(bodies_.begin(), bodies_.end(), is_padded))
      throw kit::Unsupported("FCL has no padding: distances of the cores tell overlap and distance only");
    if (by_distance && are_padded(a, b) && (body(a).kind == TS_HALF_SPACE || body(b).kind == TS_HALF_SPACE))
      throw kit::Unsupported("FCL states no distance from a half-space, so none of padded bodies");
    const bool of_motions = settings_.samples > 0 || settings_.impact_tolerance > 0;
    if (question == TS_TIME_OF_IMPACT ? settings_.tolerance > 0 : of_motions)
      throw kit::Unsupported("this engine's setting does not affect this question");
    switch (question) {
      case TS_OVERLAP:
        return ask_overlap(a, b, out);
      case TS_DISTANCE:
        return ask_distance(a, b, out);
      case TS_CONTACT:
        return ask_contact(a, b, out, sink);
      case TS_TIME_OF_IMPACT:
        return ask_time(a, b, out);
      case TS_CANDIDATES:
        return run_script(*scene_, geometries_, [&](int k, int i, int j) {
          if (!filter_.drops(i, j)) sink.pair(sink.ctx, k, i, j);
        });
      case TS_SCENE_CONTACTS:
        return ask_scene(out, sink);
      case TS_SWEPT_CANDIDATES:
        throw kit::Unsupported("FCL's broad phases do not support moving bodies");
      case TS_WITHIN:
      case TS_BOUNDED_DISTANCE:
      case TS_CANDIDATES_WITHIN:
      case TS_RAY:
      case TS_CONTACT_WITHIN:
        break;
    }
    throw kit::Unsupported("unknown question");
  }

 private:
  const Placed& body(int i) const { return bodies_[static_cast<std::size_t>(i)]; }

  bool are_padded(int a, int b) const { return body(a).padding > 0 || body(b).padding > 0; }

  // Padded bodies overlap if their cores are near enough.
  void ask_overlap(int a, int b, ts_answer& out) {
    if (!are_padded(a, b)) {
      kit::set_overlap(out, overlap(body(a), body(b), settings_));
      out.claimed_tolerance = overlap_tolerance(settings_);
      return;
    }
    const Distance d = distance(body(a), body(b), settings_);
    out.claimed_tolerance = d.claimed_tolerance;
    kit::set_overlap(out, d.overlap || (d.distance && *d.distance <= 0));
  }

  void ask_distance(int a, int b, ts_answer& out) {
    const Distance d = distance(body(a), body(b), settings_);
    out.claimed_tolerance = d.claimed_tolerance;
    if (d.overlap) kit::set_overlap(out, true);
    if (!d.distance) return;
    kit::set_distance(out, *d.distance);
    if (d.points) kit::set_points(out, (*d.points)[0], (*d.points)[1]);
  }

  void ask_contact(int a, int b, ts_answer& out, const ts_sink& sink) {
    const Contact c = contact(body(a), body(b), settings_);
    out.claimed_tolerance = c.claimed_tolerance;
    kit::set_overlap(out, c.overlap);
    if (!c.overlap) return;
    kit::set_normal(out, c.normal);
    kit::set_depth(out, c.depth);
    for (const Point& p : c.points)
      sink.point(sink.ctx, p.position.data(), kit::depth_along(c.normal, p.normal, p.depth));
  }

  void ask_time(int a, int b, ts_answer& out) {
    const ts_body& one = scene_->bodies[a];
    const ts_body& two = scene_->bodies[b];
    const auto t = time_of_impact(body(a), kit::pose_of(one.pose), kit::motion_of(one), body(b),
                                  kit::pose_of(two.pose), kit::motion_of(two), settings_);
    out.claimed_tolerance =
        impact_tolerance(body(a), kit::motion_of(one), body(b), kit::motion_of(two), settings_);
    if (t) kit::set_toi(out, *t);
  }

  // As in a user's callback: collide each pair that the manager proposes, keep the deepest contact.
  void ask_scene(ts_answer& out, const ts_sink& sink) {
    all_pairs(*scene_, geometries_, [&](int a, int b) {
      if (filter_.drops(a, b)) return;
      const Contact c = contact(body(a), body(b), settings_);
      if (c.overlap) sink.contact(sink.ctx, a, b, c.normal.data(), c.depth);
      out.claimed_tolerance = std::max(out.claimed_tolerance, c.claimed_tolerance);
    });
  }

  Settings settings_;
  const ts_scene* scene_ = nullptr;
  std::vector<Geometry> geometries_;
  std::vector<Placed> bodies_;
  kit::PairFilter filter_;
};

}  // namespace
}  // namespace touchstone::fcl_adapter

TS_PLUGIN(touchstone::fcl_adapter::Engine)
