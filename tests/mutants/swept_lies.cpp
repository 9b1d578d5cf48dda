// Lies about the candidates of a step: the right answer for bodies that move in another way.
#include "core/broad/catalog.h"
#include "core/world/world.h"
#include "tests/mutants/pair.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

using Change = void (*)(Scene&, int body, Motion&);

Lie for_motion(Change change) {
  return [change](const Case& c, const Query& q, Observation& o) {
    if (!asks(q, Question::swept_candidates) || o.outcome != Outcome::answered) return;
    Scene s = c.scene;
    for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i)
      if (auto& m = s.bodies[static_cast<std::size_t>(i)].motion) change(s, i, *m);
    const auto phase = broad::make_broad_phase("automatic");
    o.candidate_pairs = {swept_candidate_pairs(s, *phase)};
  };
}

void at_rest(Scene&, int, Motion& m) { m = {}; }
void no_travel(Scene&, int, Motion& m) { m.linear.setZero(); }
void no_turn(Scene&, int, Motion& m) { m.angular.setZero(); }
void not_along_z(Scene&, int, Motion& m) { m.linear.z() = 0; }
void half_the_way(Scene&, int, Motion& m) { m.linear *= 0.5; }
void other_way(Scene&, int, Motion& m) { m.linear = -m.linear; }
void travel_clamped(Scene&, int, Motion& m) {
  if (m.linear.norm() > 16) m.linear *= 16 / m.linear.norm();
}
// Uses the end pose and ignores the path to it.
void at_the_end(Scene& s, int i, Motion& m) {
  s.bodies[static_cast<std::size_t>(i)].pose.translation += m.linear;
  m.linear.setZero();
}
void first_rests(Scene&, int i, Motion& m) {
  if (i == 0) m = {};
}

void ghost_body(const Case& c, const Query& q, Observation& o) {
  if (asks(q, Question::swept_candidates) && !o.candidate_pairs.empty())
    o.candidate_pairs[0].emplace_back(0, static_cast<int>(c.scene.bodies.size()));
}

}  // namespace

std::vector<Mutant> swept_lies() {
  return {
      {"swept_at_rest", "missed", "swarm", "bodies do not move during the step", for_motion(at_rest)},
      {"swept_no_travel", "missed", "swarm", "bodies turn and do not travel", for_motion(no_travel)},
      {"swept_no_turn", "missed", "swarm", "bodies travel and do not turn", for_motion(no_turn)},
      {"swept_not_along_z", "missed", "swarm", "nothing travels along z", for_motion(not_along_z)},
      {"swept_half_the_way", "missed", "swarm", "only half of the step", for_motion(half_the_way)},
      {"swept_other_way", "missed", "swarm", "bodies travel the other way", for_motion(other_way)},
      {"swept_travel_clamped", "missed", "swarm", "bodies travel by at most 16", for_motion(travel_clamped)},
      {"swept_end_only", "missed", "swarm", "only the boxes at the end of the step", for_motion(at_the_end)},
      {"swept_first_rests", "missed", "swarm", "the first body does not move", for_motion(first_rests)},
      {"swept_ghost_body", "stale", "swarm", "a pair with a body that does not exist", ghost_body},
  };
}

}  // namespace touchstone::mutants
