// Converts a Scene to the C ABI's form, and what a plug-in reports through the ABI's callbacks to the
// project's own types.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/math/aabb.h"
#include "core/math/pose.h"
#include "core/scene/scene.h"
#include "core/shape/shape.h"
#include "oracles/abi/touchstone_engine.h"
#include "scenarios/value/observation.h"

namespace touchstone {

/// Calls f(name, numbers, count) for each field of one or three numbers, in the order of the shape's table:
/// its place in ts_shape::size. `S` is Shape or const Shape.
template <class S, class F>
void for_each_size(S& shape, F&& f) {
  std::visit(
      [&](auto& s) {
        for_each_field(s, [&](auto name, auto& v, Domain) {
          using V = std::decay_t<decltype(v)>;
          if constexpr (std::is_same_v<V, double>) f(name, &v, std::size_t{1});
          if constexpr (std::is_same_v<V, Vec3>) f(name, v.data(), std::size_t{3});
        });
      },
      shape);
}

/// The shape that a plug-in describes; nothing if the description is not valid.
std::optional<Shape> shape_from(const ts_shape& t);

/// The shape as the ABI describes it. Points into the shape; the vertices are copied to `vertices`, which
/// must outlive the result.
ts_shape shape_to(const Shape& s, std::vector<double>& vertices);
ts_pose pose_to(const Pose& p);

/// Owns the arrays that `view()` points into; the scene itself must outlive it.
class PluginScene {
 public:
  /// `with_boxes`: also the boxes of the steps.
  explicit PluginScene(const Scene& scene, bool with_boxes = false);
  PluginScene(const PluginScene&) = delete;
  PluginScene& operator=(const PluginScene&) = delete;
  const ts_scene& view() const { return view_; }

 private:
  ts_scene view_{};
  std::vector<ts_shape> shapes_;
  std::vector<ts_body> bodies_;
  std::vector<ts_step> steps_;
  std::vector<ts_aabb> boxes_;
  std::vector<std::int32_t> ignored_;
  std::vector<std::vector<double>> vertices_;
};

/// Collects what a plug-in reports as received. Reports about shapes or bodies that do not exist, and invalid
/// shapes, are dropped and counted.
class ReceivedCollector {
 public:
  explicit ReceivedCollector(const Scene& scene);
  ts_received callbacks();
  ReceivedScene take() { return std::move(received_); }
  int rejected() const { return rejected_; }

  void shape(int index, const double* size, const double* vertices, std::size_t vertex_count);
  void other_shape(int index, const ts_shape& held);
  void body(int index, const double* matrix, const double* translation);

 private:
  const Scene& scene_;
  ReceivedScene received_;
  int rejected_ = 0;
};

/// As an answer is before the engine fills it in.
ts_answer blank_answer();

/// Collects one answer: the ABI's record, and the lists that come through the sink.
class AnswerCollector {
 public:
  AnswerCollector(int body_count, int query_step_count);
  ts_sink callbacks();
  ts_answer& answer() { return answer_; }
  void add_point(const double position[3], double depth, std::optional<std::uint64_t> id = std::nullopt);
  /// The answer as an observation; a malformed answer (unknown outcome, nonexistent body) becomes
  /// `invalid_answer`.
  Observation take(Question question);

 private:
  bool is_pair(int a, int b) const { return a >= 0 && b >= 0 && a < bodies_ && b < bodies_ && a != b; }
  int bodies_;
  ts_answer answer_;
  Observation seen_;
  const char* fault_ = nullptr;
};

/// Rounded outward; infinite for a half-space. Exact up to the last rounding if the rotation is the identity.
/// A shape of negative or NaN sizes gives a box whose upper side is below its lower one, or NaN.
Aabb outer_box(const Shape& shape, const Pose& pose);

}  // namespace touchstone
