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
  const char *gjk, *mpr;
  double tolerance;  // 0: as shipped
  const char* text;
  unsigned long iterations = 0;  // 0: tuned_iterations if there is a tolerance, otherwise as shipped
};
#ifndef TOUCHSTONE_SWEEP
// The tuned tolerance is far below the default, 1e-4, and above the rounding of doubles.
constexpr Setting rows[] = {{"libccd-gjk", "libccd-mpr", 0, ""},
                            {"libccd-gjk-tuned", "libccd-mpr-tuned", 1e-10, "1e-10"}};
#else
// The values in the names.
constexpr Setting rows[] = {{"libccd-gjk@1e-2", "libccd-mpr@1e-2", 1e-2, "1e-2"},
                            {"libccd-gjk@1e-6", "libccd-mpr@1e-6", 1e-6, "1e-6"},
                            {"libccd-gjk@1e-8", "libccd-mpr@1e-8", 1e-8, "1e-8"},
                            {"libccd-gjk-iterations@8", "libccd-mpr-iterations@8", 0, "", 8},
                            {"libccd-gjk-iterations@16", "libccd-mpr-iterations@16", 0, "", 16},
                            {"libccd-gjk-iterations@32", "libccd-mpr-iterations@32", 0, "", 32},
                            {"libccd-gjk-iterations@128", "libccd-mpr-iterations@128", 0, "", 128}};
#endif
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

constexpr const char* source =
    "ccd/ccd.h: epa_tolerance and mpr_tolerance (default 1e-4) are the only accuracy that libccd states";

class Engine {
 public:
  static std::vector<kit::CardText> cards() {
    std::vector<kit::CardText> cards;
    const auto add = [&](const char* name, const std::string& calls, const std::string& tolerances,
                         const Setting& r) {
      const std::string how = r.tolerance > 0 ? tolerances + " " + r.text + ", max_iterations 1000"
                              : r.iterations > 0
                                  ? "CCD_INIT defaults, max_iterations " + std::to_string(r.iterations)
                                  : "CCD_INIT defaults, unlimited iterations";
      cards.push_back(
          {name, "libccd", "2.1", calls + "; " + how, double_roundoff, kit::oracle_tau_factor, source});
    };
    for (const Setting& r : rows) {
      add(r.gjk, "ccdGJKIntersect and ccdGJKPenetration", "epa_tolerance and dist_tolerance", r);
      add(r.mpr, "ccdMPRIntersect and ccdMPRPenetration", "mpr_tolerance", r);
    }
    return cards;
  }

  explicit Engine(unsigned index) : mpr_(index % 2 == 1) {
    CCD_INIT(&ccd_);
    ccd_.support1 = ccd_.support2 = support;
    ccd_.center1 = ccd_.center2 = center;
    if (const auto limit = rows[index / 2].iterations; limit > 0) ccd_.max_iterations = limit;
    if (const double tolerance = rows[index / 2].tolerance; tolerance > 0) {
      ccd_.max_iterations = tuned_iterations;
      ccd_.epa_tolerance = ccd_.mpr_tolerance = ccd_.dist_tolerance = tolerance;
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
