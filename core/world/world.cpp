#include "core/world/world.h"

#include "core/broad/body_box.h"
#include "core/narrow/mesh_tree.h"

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

// One tree per shape; empty unless the shape is a mesh.
std::vector<MeshTree> mesh_trees(const Scene& scene) {
  std::vector<MeshTree> trees(scene.shapes.size());
  for (std::size_t i = 0; i < trees.size(); ++i)
    if (const auto* m = std::get_if<TriangleMesh>(&scene.shapes[i])) trees[i] = build_mesh_tree(*m);
  return trees;
}

PlacedShape placed(const Scene& s, int i, const std::vector<MeshTree>& trees) {
  const MeshTree& tree = trees[static_cast<std::size_t>(body_of(s, i).shape)];
  return {&s.shape_of(i), body_of(s, i).pose, tree.nodes.empty() ? nullptr : &tree};
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

std::vector<std::vector<BodyPair>> candidate_pairs(const Scene& scene, broad::BroadPhase& phase) {
  std::vector<std::vector<BodyPair>> answers;
  for (const Step& step : effective_script(scene)) {
    const auto box = [&] {
      return broad::body_box(scene.shape_of(step.body),
                             step.pose ? *step.pose : body_of(scene, step.body).pose);
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

std::vector<BodyPair> swept_candidate_pairs(const Scene& scene, broad::BroadPhase& phase) {
  for (int i = 0; i < static_cast<int>(scene.bodies.size()); ++i)
    phase.insert(i, box_of(scene, i, body_of(scene, i).pose));
  return reported(scene, phase);
}

SceneContacts scene_contacts(const Scene& scene, broad::BroadPhase& phase) {
  for (int i = 0; i < static_cast<int>(scene.bodies.size()); ++i)
    phase.insert(i, broad::body_box(scene.shape_of(i), body_of(scene, i).pose));
  SceneContacts r;
  const auto trees = mesh_trees(scene);
  for (const auto& [a, b] : reported(scene, phase)) {
    ++r.candidates;
    ContactAnswer c = contact(placed(scene, a, trees), placed(scene, b, trees));
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
