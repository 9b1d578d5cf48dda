#include "tests/mutants/replay.h"

#include <algorithm>

#include "scenarios/random/random_shape.h"

namespace touchstone::mutants {
namespace {

// When a body is removed, the last element of the array takes its slot.
void close_slot(std::vector<BodyHistory>& bodies, int slot, int last) {
  for (BodyHistory& b : bodies)
    if (b.pose && b.slot == last) b.slot = slot;
}

void apply(const Scene& scene, const Step& step, QueryState& s) {
  BodyHistory& b = s.bodies[static_cast<std::size_t>(step.body)];
  const Pose to = step.pose.value_or(scene.bodies[static_cast<std::size_t>(step.body)].pose);
  switch (step.op) {
    case Step::Op::insert:
      if (!b.first) b.first = to;
      b.pose = to;
      b.moves = 0;
      b.slot = s.present++;
      ++b.inserts;
      break;
    case Step::Op::move:
      b.before = b.pose, b.pose = to, ++b.moves, ++b.moves_in_frame;
      break;
    case Step::Op::remove:
      b.before = b.pose, b.pose.reset(), ++s.removals, --s.present;
      close_slot(s.bodies, b.slot, s.present);
      break;
    case Step::Op::query:
      break;
  }
}

}  // namespace

std::vector<QueryState> replay(const Scene& scene) {
  std::vector<QueryState> queries;
  QueryState now;
  now.bodies.resize(scene.bodies.size());
  for (const Step& step : effective_script(scene)) {
    if (step.op != Step::Op::query) {
      apply(scene, step, now);
      continue;
    }
    queries.push_back(now);
    ++now.query;
    for (BodyHistory& b : now.bodies) b.moves_in_frame = 0;
  }
  return queries;
}

Aabb plain_box(const Shape& shape, const Pose& pose) {
  const Mat3 to_local = rotation_matrix(pose.rotation).transpose();
  Aabb box;
  for (Eigen::Index k = 0; k < 3; ++k) {
    box.lo[k] = pose.translation[k] - fuzz::support_value(shape, -to_local.col(k));
    box.hi[k] = pose.translation[k] + fuzz::support_value(shape, to_local.col(k));
  }
  return box;
}

Lie change_list(Listed change) {
  return [change = std::move(change)](const Case& c, const Query& q, Observation& o) {
    if (q.question != Question::candidates) return;
    const auto states = replay(c.scene);
    for (std::size_t k = 0; k < o.candidate_pairs.size() && k < states.size(); ++k)
      change(c.scene, states[k], o.candidate_pairs[k]);
  };
}

Lie keep_pairs(Kept kept) {
  return change_list(
      [kept = std::move(kept)](const Scene& s, const QueryState& state, std::vector<BodyPair>& pairs) {
        std::erase_if(pairs, [&](const BodyPair& p) { return !kept(s, state, p.first, p.second); });
      });
}

Lie keep_overlapping(BoxOf box_of) {
  return keep_pairs([box_of = std::move(box_of)](const Scene& s, const QueryState& state, int a, int b) {
    return overlaps(box_of(s, state, a), box_of(s, state, b));
  });
}

}  // namespace touchstone::mutants
