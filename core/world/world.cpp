#include "core/world/world.h"

#include "core/broad/body_box.h"
#include "core/narrow/collider.h"

namespace touchstone {
namespace {

const Body& body_of(const Scene& s, int i) { return s.bodies[static_cast<std::size_t>(i)]; }

std::vector<BodyPair> reported(const Scene& scene, broad::BroadPhase& phase) {
  std::vector<broad::IdPair> all;
  phase.pairs(all);
  std::vector<BodyPair> kept;
  for (const broad::IdPair& p : all)
    if (is_reported(scene, p.first, p.second)) kept.emplace_back(p.first, p.second);
  return kept;
}

// One for each shape. A graph does not pay for the few contacts of one scene.
std::vector<Collider> colliders_of(const Scene& scene) {
  std::vector<Collider> all;
  all.reserve(scene.shapes.size());
  for (const Shape& s : scene.shapes) all.emplace_back(s, Collider::no_graph);
  return all;
}

}  // namespace

bool is_reported(const Scene& scene, int a, int b) {
  return !(body_of(scene, a).is_static && body_of(scene, b).is_static) && !is_filtered(scene, a, b);
}

Aabb box_of(const Scene& scene, int body, const Pose& pose) {
  const auto& motion = body_of(scene, body).motion;
  return motion ? broad::swept_box(scene.shape_of(body), pose, *motion)
                : broad::body_box(scene.shape_of(body), pose);
}

namespace {

// `changed` makes of a body's box the one that the broad phase gets.
template <class Changed>
std::vector<std::vector<BodyPair>> run_script(const Scene& scene, broad::BroadPhase& phase,
                                              Changed&& changed) {
  std::vector<std::vector<BodyPair>> answers;
  for (const Step& step : effective_script(scene)) {
    const auto box = [&] {
      return changed(broad::body_box(scene.shape_of(step.body),
                                     step.pose ? *step.pose : body_of(scene, step.body).pose));
    };
    switch (step.op) {
      case Step::Op::insert:
        phase.insert(step.body, box());
        break;
      case Step::Op::move:
        phase.move(step.body, box());
        break;
      case Step::Op::remove:
        phase.remove(step.body);
        break;
      case Step::Op::query:
        answers.push_back(reported(scene, phase));
        break;
    }
  }
  return answers;
}

}  // namespace

std::vector<std::vector<BodyPair>> candidate_pairs(const Scene& scene, broad::BroadPhase& phase) {
  return run_script(scene, phase, [](const Aabb& box) { return box; });
}

std::vector<std::vector<BodyPair>> candidate_pairs_within(const Scene& scene, broad::BroadPhase& phase) {
  return run_script(scene, phase, [&](const Aabb& box) { return widened(box, scene.margin / 2); });
}

std::vector<BodyPair> swept_candidate_pairs(const Scene& scene, broad::BroadPhase& phase) {
  for (int i = 0; i < static_cast<int>(scene.bodies.size()); ++i)
    phase.insert(i, box_of(scene, i, body_of(scene, i).pose));
  return reported(scene, phase);
}

SceneContacts scene_contacts(const Scene& scene, broad::BroadPhase& phase) {
  for (int i = 0; i < static_cast<int>(scene.bodies.size()); ++i)
    phase.insert(i, broad::body_box(scene.shape_of(i), body_of(scene, i).pose));
  SceneContacts r;
  const std::vector<Collider> colliders = colliders_of(scene);
  const auto placed = [&](int i) {
    return colliders[static_cast<std::size_t>(body_of(scene, i).shape)].at(body_of(scene, i).pose);
  };
  for (const auto& [a, b] : reported(scene, phase)) {
    ++r.candidates;
    ContactAnswer c = contact(placed(a), placed(b));
    if (c.outcome == Outcome::unsupported) {
      ++r.unsupported;
      continue;
    }
    if (c.outcome != Outcome::answered) r.outcome = c.outcome;
    if (c.overlap) r.contacts.push_back({a, b, std::move(c)});
  }
  return r;
}

}  // namespace touchstone
