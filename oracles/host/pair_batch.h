// Questions of one kind about pairs from several scenes, as arrays for ts_plugin::ask_many.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "oracles/abi/plugin_scene.h"
#include "oracles/abi/touchstone_engine.h"
#include "scenarios/value/observation.h"

namespace touchstone::host {

class PairBatch {
 public:
  explicit PairBatch(Question question) : question_(question) {}
  /// The scene and the collector must outlive the batch.
  void add(const Scene& scene, const Query& query, ReceivedCollector& received);
  bool empty() const { return pairs_.empty(); }
  /// The answers in the order of add(). Empty if the engine threw or reported about a pair that is not there:
  /// then the questions are to be asked one by one.
  std::vector<Observation> ask(const ts_plugin& plugin, ts_engine* engine);

 private:
  struct Pair {
    const Scene* scene;
    Query query;
    ReceivedCollector* received;
    int body(std::int32_t which) const { return which == 0 ? query.a : query.b; }
    int shape(std::int32_t which) const { return scene->bodies[static_cast<std::size_t>(body(which))].shape; }
  };
  /// The number of the shape in the arrays; that of an equal shape at the same place of the previous pair.
  std::int32_t number_of(const Shape& shape, const Shape* previous, std::int32_t number);
  void add_motion(const Body& body, std::vector<double>& to);
  ts_batch view() const;
  ts_batch_sink callbacks();
  /// Null, and noted, if it does not exist.
  const Pair* pair(std::size_t i, std::int32_t which);

  Question question_;
  std::vector<Pair> pairs_;
  std::vector<ts_shape> shapes_;
  std::deque<std::vector<double>> vertices_;  // that shapes_ points into
  std::vector<std::int32_t> shape_a_, shape_b_;
  std::vector<ts_pose> pose_a_, pose_b_;
  std::vector<double> motion_a_, motion_b_;
  bool moves_ = false, names_strangers_ = false;
  std::vector<AnswerCollector> answers_;
};

}  // namespace touchstone::host
