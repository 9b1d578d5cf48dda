// libccd 2.1: overlap and contact of convex bodies, by GJK + EPA and by MPR.
//
// As shipped: CCD_INIT only, so max_iterations is unlimited and a search that cycles never ends. Tuned: 1e-10
// for both tolerances and at most 1000 iterations; a search that uses them all is reported as not_converged,
// which the library itself cannot report. So that a chart shows a method as a curve, there are also
// libccd-gjk@1e-2 and so on (the same with that tolerance) and libccd-gjk-iterations@16 (default tolerances
// and that limit).
#include <limits>

#include "core/math/roundoff.h"
#include "oracles/abi/plugin_kit.h"
#include "oracles/libccd/object.h"

namespace touchstone::libccd {
namespace {

constexpr unsigned long tuned_iterations = 1000;
constexpr int out_of_memory = -2;  // returned by ccdGJKPenetration and ccdMPRPenetration
struct Setting {
  const char* name;
  bool mpr;
  double tolerance = 0;  // 0: as shipped
  const char* text = "";
  unsigned long iterations = 0;  // 0: tuned_iterations if there is a tolerance, otherwise as shipped
};
#ifndef TOUCHSTONE_SWEEP
// The tuned tolerance is far below the default, 1e-4, and above the rounding of doubles.
constexpr Setting settings[] = {{"libccd-gjk", false},
                                {"libccd-gjk-tuned", false, 1e-10, "1e-10"},
                                {"libccd-mpr", true},
                                {"libccd-mpr-tuned", true, 1e-10, "1e-10"}};
#else
// The values in the names.
constexpr Setting settings[] = {
    {"libccd-gjk@1e-2", false, 1e-2, "1e-2"},         {"libccd-mpr@1e-2", true, 1e-2, "1e-2"},
    {"libccd-gjk@1e-6", false, 1e-6, "1e-6"},         {"libccd-mpr@1e-6", true, 1e-6, "1e-6"},
    {"libccd-gjk@1e-8", false, 1e-8, "1e-8"},         {"libccd-mpr@1e-8", true, 1e-8, "1e-8"},
    {"libccd-gjk-iterations@8", false, 0, "", 8},     {"libccd-mpr-iterations@8", true, 0, "", 8},
    {"libccd-gjk-iterations@16", false, 0, "", 16},   {"libccd-mpr-iterations@16", true, 0, "", 16},
    {"libccd-gjk-iterations@32", false, 0, "", 32},   {"libccd-mpr-iterations@32", true, 0, "", 32},
    {"libccd-gjk-iterations@128", false, 0, "", 128}, {"libccd-mpr-iterations@128", true, 0, "", 128}};
#endif
// The library states no version; 2.1 is Debian's.
#ifndef TOUCHSTONE_OWN_BUILD
constexpr const char* version = "2.1";
#else
constexpr const char* version = "";
#endif
static_assert(sizeof(ccd_real_t) == sizeof(double),
              "the adapter needs libccd in doubles: configure it with ENABLE_DOUBLE_PRECISION");
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

constexpr const char* source =
    "ccd/ccd.h: epa_tolerance and mpr_tolerance (default 1e-4) are the only accuracy that libccd states";

std::string calls_of(const Setting& s) {
  return s.mpr ? "ccdMPRIntersect and ccdMPRPenetration" : "ccdGJKIntersect and ccdGJKPenetration";
}

std::string limits_of(const Setting& s) {
  const std::string tolerances = s.mpr ? "mpr_tolerance" : "epa_tolerance and dist_tolerance";
  if (s.tolerance > 0) return tolerances + " " + s.text + ", max_iterations 1000";
  if (s.iterations > 0) return "CCD_INIT defaults, max_iterations " + std::to_string(s.iterations);
  return "CCD_INIT defaults, unlimited iterations";
}

class Engine {
 public:
  static std::vector<kit::CardText> cards() {
    std::vector<kit::CardText> cards;
    for (const Setting& s : settings)
      cards.push_back({s.name, "libccd", version, calls_of(s) + "; " + limits_of(s), double_roundoff,
                       kit::oracle_tau_factor, source});
    for (kit::CardText& c : cards) c.more_shapes = kit::padded_shapes;
    return cards;
  }

  explicit Engine(unsigned index) : mpr_(settings[index].mpr) {
    const Setting& s = settings[index];
    CCD_INIT(&ccd_);
    ccd_.support1 = ccd_.support2 = support;
    ccd_.center1 = ccd_.center2 = center;
    if (s.iterations > 0) ccd_.max_iterations = s.iterations;
    if (s.tolerance > 0) {
      ccd_.max_iterations = tuned_iterations;
      ccd_.epa_tolerance = ccd_.mpr_tolerance = ccd_.dist_tolerance = s.tolerance;
    }
  }

  void load(const ts_scene& scene, const ts_received& received) {
    for (std::size_t i = 0; i < scene.shape_count; ++i)
      received.shape(received.ctx, static_cast<int>(i), scene.shapes[i].size, scene.shapes[i].vertices,
                     scene.shapes[i].vertex_count);
    for (std::size_t i = 0; i < scene.body_count; ++i) {
      const Pose pose = kit::pose_of(scene.bodies[i].pose);
      objects_.push_back(
          {&scene.shapes[scene.bodies[i].shape], rotation_matrix(pose.rotation), pose.translation});
      const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = objects_.back().rotation;
      received.body(received.ctx, static_cast<int>(i), rows.data(), pose.translation.data());
    }
  }
  void unload() { objects_.clear(); }

  void ask(ts_question question, int a, int b, ts_answer& out, const ts_sink& sink) {
    if (question != TS_OVERLAP && question != TS_CONTACT)
      throw kit::Unsupported("libccd answers overlap and contact of two bodies only");
    const Object& one = objects_[static_cast<std::size_t>(a)];
    const Object& two = objects_[static_cast<std::size_t>(b)];
    for (const Object* o : {&one, &two})
      if (!has_support(*o->shape)) throw kit::Unsupported("libccd takes bounded convex bodies only");
    one.support_calls = 0;
    out.claimed_tolerance = mpr_ ? ccd_.mpr_tolerance : ccd_.epa_tolerance;
    if (question == TS_OVERLAP)
      kit::set_overlap(
          out, mpr_ ? ccdMPRIntersect(&one, &two, &ccd_) != 0 : ccdGJKIntersect(&one, &two, &ccd_) != 0);
    else
      contact(one, two, out, sink);
    if (one.support_calls > ccd_.max_iterations) {
      out.outcome = TS_NOT_CONVERGED;
      out.has = 0;
      kit::set_detail(out, "used all " + std::to_string(ccd_.max_iterations) + " iterations");
    }
  }

 private:
  // depth, dir and pos start as NaN: ccdGJKPenetration may return "hit" without writing any of them.
  void contact(const Object& one, const Object& two, ts_answer& out, const ts_sink& sink) {
    ccd_real_t depth = nan_value;
    ccd_vec3_t dir, pos;
    ccdVec3Set(&dir, nan_value, nan_value, nan_value);
    ccdVec3Set(&pos, nan_value, nan_value, nan_value);
    const int result = mpr_ ? ccdMPRPenetration(&one, &two, &ccd_, &depth, &dir, &pos)
                            : ccdGJKPenetration(&one, &two, &ccd_, &depth, &dir, &pos);
    if (result == out_of_memory) throw std::runtime_error("libccd could not allocate memory");
    kit::set_overlap(out, result == 0);
    if (result != 0) return;
    kit::set_normal(out, Vec3(dir.v[0], dir.v[1], dir.v[2]));
    kit::set_depth(out, depth);
    const double point[3] = {pos.v[0], pos.v[1], pos.v[2]};
    sink.point(sink.ctx, point, depth);
  }

  bool mpr_;
  ccd_t ccd_;
  std::vector<Object> objects_;
};

}  // namespace
}  // namespace touchstone::libccd

TS_PLUGIN(touchstone::libccd::Engine)
