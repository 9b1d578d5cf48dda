// Engines for spheres that take batches. An answer that states 5 ns was given together with others, one that
// states 3 ns alone. Some misbehave when a pair's first body lies at x = 666.
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "oracles/abi/plugin_kit.h"

namespace {

using namespace touchstone;

constexpr std::uint64_t id_of_points = 17;  // of "floats"
constexpr const char* names[] = {"together",        "floats",    "dies",  "dies_together",
                                 "throws_together", "strangers", "loops", "partial"};

class Engine {
 public:
  static std::vector<kit::CardText> cards() {
    std::vector<kit::CardText> all;
    for (const char* name : names) {
      all.push_back({name, "test", "1", "", 0x1p-53, 64, ""});
      if (all.back().name == "partial") all.back().shapes = {"sphere", "box"};
    }
    return all;
  }
  explicit Engine(unsigned i) : name_(names[i]) {}

  void load(const ts_scene& scene, const ts_received& received) {
    scene_ = &scene;
    if (name_ != "floats") return;
    for (std::size_t i = 0; i < scene.shape_count; ++i) {
      const double size[4] = {as_held(scene.shapes[i].size[0]), 0, 0, 0};
      received.shape(received.ctx, static_cast<int>(i), size, nullptr, 0);
    }
    for (std::size_t i = 0; i < scene.body_count; ++i) {
      const Vec3 at = centre(scene.bodies[i].pose);
      received.body(received.ctx, static_cast<int>(i), identity, at.data());
    }
  }
  void unload() { scene_ = nullptr; }

  void ask(ts_question question, int a, int b, ts_answer& out, const ts_sink& sink) {
    const ts_body &x = scene_->bodies[a], &y = scene_->bodies[b];
    if (is_trigger(x.pose)) misbehave();
    answer(question, scene_->shapes[x.shape], x.pose, scene_->shapes[y.shape], y.pose, out,
           [&](const Vec3& p, double depth) {
             if (name_ == "floats")
               kit::report_point(sink, p, depth, id_of_points);
             else
               sink.point(sink.ctx, p.data(), depth);
           });
    out.ns = 3;
  }

  void ask_many(const ts_batch& batch, ts_answer* answers, const ts_batch_sink& sink) {
    if (name_ == "dies_together") std::abort();
    if (name_ == "throws_together") throw std::runtime_error("not together");
    if (name_ == "strangers") sink.received_body(sink.ctx, batch.count, 0, identity, identity);
    for (std::size_t i = 0; i < batch.count; ++i) {
      if (is_trigger(batch.pose_a[i])) misbehave();
      const ts_shape &a = batch.shapes[batch.shape_a[i]], &b = batch.shapes[batch.shape_b[i]];
      answer(batch.question, a, batch.pose_a[i], b, batch.pose_b[i], answers[i],
             [&](const Vec3& p, double depth) {
               if (name_ == "floats")
                 sink.named_point(sink.ctx, i, p.data(), depth, id_of_points);
               else
                 sink.point(sink.ctx, i, p.data(), depth);
             });
      answers[i].ns = 5;
      if (name_ != "floats") continue;
      for (const int body : {0, 1}) {
        const double size[4] = {as_held((body ? b : a).size[0]), 0, 0, 0};
        const Vec3 at = centre((body ? batch.pose_b : batch.pose_a)[i]);
        sink.received_shape(sink.ctx, i, body, size, nullptr, 0);
        sink.received_body(sink.ctx, i, body, identity, at.data());
      }
    }
  }

 private:
  static constexpr double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

  static bool is_trigger(const ts_pose& p) { return p.translation[0] == 666; }
  void misbehave() const {
    if (name_ == "dies") std::abort();
    while (name_ == "loops") volatile_ = volatile_ + 1;
  }
  double as_held(double x) const {
    return name_ == "floats" ? static_cast<double>(static_cast<float>(x)) : x;
  }
  Vec3 centre(const ts_pose& p) const {
    return {as_held(p.translation[0]), as_held(p.translation[1]), as_held(p.translation[2])};
  }
  template <class Point>
  void answer(int question, const ts_shape& a, const ts_pose& pose_a, const ts_shape& b,
              const ts_pose& pose_b, ts_answer& out, const Point& point) const {
    if (question == TS_TIME_OF_IMPACT || a.kind != TS_SPHERE || b.kind != TS_SPHERE) {
      out.outcome = TS_UNSUPPORTED;
      kit::set_detail(out, "spheres only");
      return;
    }
    const Vec3 from = centre(pose_a), to = centre(pose_b);
    const double gap = (to - from).norm() - as_held(a.size[0]) - as_held(b.size[0]);
    out.outcome = TS_ANSWERED;
    if (question == TS_DISTANCE) return kit::set_distance(out, gap);
    kit::set_overlap(out, gap <= 0);
    if (question != TS_CONTACT || gap > 0) return;
    const Vec3 normal = (to - from).normalized();
    kit::set_normal(out, normal);
    kit::set_depth(out, -gap);
    point(from + normal * as_held(a.size[0]), -gap);
  }

  std::string name_;
  const ts_scene* scene_ = nullptr;
  mutable volatile int volatile_ = 0;
};

}  // namespace

TS_PLUGIN(Engine)
