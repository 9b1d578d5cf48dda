// Embree's collision detection as a broad phase: rtcCollide of a scene of boxes with itself.
#include "core/math/roundoff.h"
#include "oracles/abi/plugin_kit.h"
#include "oracles/embree/scene.h"

namespace touchstone::embree {
namespace {

struct Row {
  const char *name, *settings;
  std::unique_ptr<Scene> (*make)(RTCDevice);
};
constexpr Row rows[] = {
    {"embree", "rtcCollide of a scene with itself, one geometry, one thread; boxes rounded outward to floats",
     &make_static_scene},
    {"embree-dynamic",
     "rtcCollide of a scene with itself, RTC_SCENE_FLAG_DYNAMIC, a geometry for each body, one thread; boxes "
     "rounded "
     "outward to floats",
     &make_dynamic_scene},
};

class Engine {
 public:
  static std::vector<kit::CardText> cards() {
    std::vector<kit::CardText> all;
    for (const Row& r : rows)
      all.push_back({r.name, "Embree", RTC_VERSION_STRING, r.settings, float_roundoff, kit::oracle_tau_factor,
                     "rtcCollide: reports every pair that may intersect"});
    return all;
  }
  explicit Engine(unsigned index) : row_(rows[index]), device_(rtcNewDevice("threads=1")) {
    if (!device_) throw std::runtime_error("Embree has no device");
  }

  void load(const ts_scene& scene, const ts_received&) {
    scene_ = &scene;
    filter_ = kit::PairFilter(scene);
  }
  void unload() { scene_ = nullptr; }

  void ask(ts_question question, int, int, ts_answer&, const ts_sink& sink) {
    if (question != TS_CANDIDATES) throw kit::Unsupported("a broad phase only");
    const auto held = row_.make(device_.get());
    const auto apply = [&](const ts_step& step) {
      if (step.op == TS_REMOVE) return held->remove(step.body);
      held->put(step.body, outer_floats(kit::box_of(*scene_, step)));
    };
    kit::run_script(*scene_, apply, [&](int k) {
      for (const auto& [a, b] : held->pairs())
        if (filter_.is_reportable(a, b)) sink.pair(sink.ctx, k, a, b);
    });
  }

 private:
  const Row& row_;
  Device device_;
  const ts_scene* scene_ = nullptr;
  kit::PairFilter filter_;
};

}  // namespace
}  // namespace touchstone::embree

TS_PLUGIN(touchstone::embree::Engine)
