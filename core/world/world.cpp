#include "core/world/world.h"

#include "core/broad/body_box.h"

namespace touchstone {
namespace {

bool counts(const Scene& s, const BodyPair& p) {
  const bool both_static = s.bodies[static_cast<std::size_t>(p.first)].is_static &&
                           s.bodies[static_cast<std::size_t>(p.second)].is_static;
  return !both_static && !is_filtered(s, p.first, p.second);
}

// The swept box when the body moves and still stands at its own pose; a script that moves it sets poses, not
// motions.
Aabb box_of(const Scene& s, int body, const std::optional<Pose>& pose) {
  const Body& b = s.bodies[static_cast<std::size_t>(body)];
  if (b.motion && !pose) return broad::swept_box(s.shape_of(body), b.pose, *b.motion);
  return broad::body_box(s.shape_of(body), pose.value_or(b.pose));
}

std::vector<BodyPair> filtered(const Scene& s, broad::BroadPhase& broad_phase) {
  std::vector<broad::IdPair> all;
  broad_phase.pairs(all);
  std::vector<BodyPair> kept;
  for (const auto& [a, b] : all)
    if (counts(s, {a, b})) kept.emplace_back(a, b);
  return kept;
}

}  // namespace

std::vector<std::vector<BodyPair>> candidate_pairs(const Scene& s, broad::BroadPhase& broad_phase) {
  std::vector<std::vector<BodyPair>> result;
  for (const Step& step : effective_script(s)) {
    switch (step.op) {
      case Step::Op::insert:
        broad_phase.insert(step.body, box_of(s, step.body, step.pose));
        break;
      case Step::Op::move:
        broad_phase.move(step.body, box_of(s, step.body, step.pose));
        break;
      case Step::Op::remove:
        broad_phase.remove(step.body);
        break;
      case Step::Op::query:
        result.push_back(filtered(s, broad_phase));
        break;
    }
  }
  return result;
}

std::vector<WorldContact> world_contacts(const Scene& s, broad::BroadPhase& broad_phase) {
  for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i)
    broad_phase.insert(i, broad::body_box(s.shape_of(i), s.bodies[static_cast<std::size_t>(i)].pose));
  std::vector<WorldContact> result;
  for (const BodyPair& p : filtered(s, broad_phase)) {
    const auto placed = [&](int i) {
      return PlacedShape{&s.shape_of(i), s.bodies[static_cast<std::size_t>(i)].pose};
    };
    ContactAnswer c = contact(placed(p.first), placed(p.second));
    if (c.outcome != Outcome::answered || c.overlap) result.push_back({p, std::move(c)});
  }
  return result;
}

}  // namespace touchstone
