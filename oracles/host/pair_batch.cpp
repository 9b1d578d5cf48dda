#include "oracles/host/pair_batch.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace touchstone::host {

std::int32_t PairBatch::number_of(const Shape& shape, const Shape* previous, std::int32_t number) {
  if (previous && *previous == shape) return number;
  vertices_.emplace_back();
  shapes_.push_back(shape_to(shape, vertices_.back()));
  return static_cast<std::int32_t>(shapes_.size()) - 1;
}

void PairBatch::add_motion(const Body& body, std::vector<double>& to) {
  const Motion m = body.motion.value_or(Motion{});
  moves_ |= body.motion.has_value();
  to.insert(to.end(),
            {m.linear.x(), m.linear.y(), m.linear.z(), m.angular.x(), m.angular.y(), m.angular.z()});
}

void PairBatch::add(const Scene& scene, const Query& query, ReceivedCollector& received) {
  const Body& a = scene.bodies[static_cast<std::size_t>(query.a)];
  const Body& b = scene.bodies[static_cast<std::size_t>(query.b)];
  const auto last = [&](std::int32_t which) -> const Shape* {
    if (pairs_.empty()) return nullptr;
    return &pairs_.back().scene->shapes[static_cast<std::size_t>(pairs_.back().shape(which))];
  };
  const Shape *last_a = last(0), *last_b = last(1);
  shape_a_.push_back(number_of(scene.shape_of(query.a), last_a, last_a ? shape_a_.back() : 0));
  shape_b_.push_back(number_of(scene.shape_of(query.b), last_b, last_b ? shape_b_.back() : 0));
  pose_a_.push_back(pose_to(a.pose));
  pose_b_.push_back(pose_to(b.pose));
  if (question_ == Question::time_of_impact) {
    add_motion(a, motion_a_);
    add_motion(b, motion_b_);
  }
  pairs_.push_back({&scene, query, &received});
}

ts_batch PairBatch::view() const {
  return {static_cast<std::int32_t>(question_),
          0,
          pairs_.size(),
          shapes_.data(),
          shapes_.size(),
          shape_a_.data(),
          shape_b_.data(),
          pose_a_.data(),
          pose_b_.data(),
          moves_ ? motion_a_.data() : nullptr,
          moves_ ? motion_b_.data() : nullptr};
}

const PairBatch::Pair* PairBatch::pair(std::size_t i, std::int32_t which) {
  if (i < pairs_.size() && (which == 0 || which == 1)) return &pairs_[i];
  names_strangers_ = true;
  return nullptr;
}

// noexcept: an exception must not travel through a plug-in written in C.
ts_batch_sink PairBatch::callbacks() {
  return {this,
          [](void* ctx, std::size_t i, const double position[3], double depth) noexcept {
            auto& batch = *static_cast<PairBatch*>(ctx);
            if (batch.pair(i, 0)) batch.answers_[i].add_point(position, depth);
          },
          [](void* ctx, std::size_t i, std::int32_t which, const double size[4], const double* vertices,
             std::size_t n) noexcept {
            if (const Pair* p = static_cast<PairBatch*>(ctx)->pair(i, which))
              p->received->shape(p->shape(which), size, vertices, n);
          },
          [](void* ctx, std::size_t i, std::int32_t which, const ts_shape* held) noexcept {
            if (const Pair* p = static_cast<PairBatch*>(ctx)->pair(i, which))
              p->received->other_shape(p->shape(which), *held);
          },
          [](void* ctx, std::size_t i, std::int32_t which, const double matrix[9],
             const double translation[3]) noexcept {
            if (const Pair* p = static_cast<PairBatch*>(ctx)->pair(i, which))
              p->received->body(p->body(which), matrix, translation);
          },
          [](void* ctx, std::size_t i, const double position[3], double depth, std::uint64_t id) noexcept {
            auto& batch = *static_cast<PairBatch*>(ctx);
            if (batch.pair(i, 0)) batch.answers_[i].add_point(position, depth, id);
          }};
}

std::vector<Observation> PairBatch::ask(const ts_plugin& plugin, ts_engine* engine) {
  using Clock = std::chrono::steady_clock;
  const std::size_t n = pairs_.size();
  answers_.assign(n, AnswerCollector(2, 0));
  std::vector<ts_answer> answers(n, blank_answer());
  const ts_batch batch = view();
  const ts_batch_sink sink = callbacks();
  const auto start = Clock::now();
  try {
    plugin.ask_many(engine, &batch, answers.data(), &sink);
  } catch (...) {
    return {};
  }
  const std::int64_t took = std::chrono::nanoseconds(Clock::now() - start).count();
  if (names_strangers_) return {};
  std::vector<Observation> all;
  all.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::int64_t stated = answers[i].ns;
    answers_[i].answer() = answers[i];
    all.push_back(answers_[i].take(question_));
    all.back().elapsed_ns = stated > 0 ? std::min(stated, took) : took / static_cast<std::int64_t>(n);
  }
  return all;
}

}  // namespace touchstone::host
