#include "tests/mutants/lying_engine.h"

#include <cmath>
#include <limits>

#include "oracles/core/core_engine.h"

namespace touchstone::mutants {
namespace {

class LyingEngine final : public Engine {
 public:
  explicit LyingEngine(const Mutant& m) : lie_(m.lie), card_(core_.card()) { card_.name = m.name; }
  const EngineCard& card() const override { return card_; }
  std::vector<CaseObservations> run(std::span<const Case> cases) override {
    auto result = core_.run(cases);
    for (std::size_t i = 0; i < cases.size(); ++i)
      for (std::size_t k = 0; k < cases[i].queries.size(); ++k)
        lie_(cases[i], cases[i].queries[k], result[i].answers[k]);
    return result;
  }

 private:
  CoreEngine core_;
  Lie lie_;
  EngineCard card_;
};

bool is(const Query& q, Question question) { return q.question == question; }

void deny_shallow(const Case&, const Query& q, Observation& o) {
  if (is(q, Question::contact) && o.overlap.value_or(false) && o.depth.value_or(1) < 0.01)
    o = Observation{Outcome::answered, "", false, {}, {}, {}, {}, {}, {}, {}, {}, 0, 0};
}
void claim_near(const Case&, const Query& q, Observation& o) {
  if (is(q, Question::overlap) && o.overlap) o.overlap = true;
}
void absolute_epsilon(const Case&, const Query& q, Observation& o) {
  if (is(q, Question::distance) && o.distance) *o.distance += 1e-6;
}
void witness_swapped(const Case&, const Query& q, Observation& o) {
  if (is(q, Question::distance) && o.witness) std::swap((*o.witness)[0], (*o.witness)[1]);
}
void normal_flipped(const Case&, const Query& q, Observation& o) {
  if (is(q, Question::contact) && o.normal) *o.normal = -*o.normal;
}
void normal_zero(const Case&, const Query& q, Observation& o) {
  if (is(q, Question::contact) && o.normal) o.normal->setZero();
}
void normal_local(const Case& c, const Query& q, Observation& o) {
  if (is(q, Question::contact) && o.normal)
    *o.normal =
        rotation_matrix(c.scene.bodies[static_cast<std::size_t>(q.a)].pose.rotation).transpose() * *o.normal;
}
void normal_second_best(const Case& c, const Query& q, Observation& o) {
  if (!is(q, Question::contact) || !o.normal || !o.depth) return;
  // The line of centres with a depth that does separate along it: valid, not minimal.
  const Vec3 line = c.scene.bodies[1].pose.translation - c.scene.bodies[0].pose.translation;
  if (line.norm() < 1e-6) return;
  o.normal = line.normalized();
  o.depth = 100;
}
void depth_halved(const Case&, const Query& q, Observation& o) {
  if (is(q, Question::contact) && o.depth) *o.depth /= 2;
}
void depth_doubled(const Case&, const Query& q, Observation& o) {
  if (is(q, Question::contact) && o.depth) *o.depth *= 2;
}
void point_off(const Case&, const Query& q, Observation& o) {
  if (is(q, Question::contact) && !o.manifold.empty()) o.manifold[0].position += Vec3::Constant(10);
}
void impact_late(const Case&, const Query& q, Observation& o) {
  if (is(q, Question::time_of_impact) && o.toi && *o.toi > 0) *o.toi = std::min(1.0, *o.toi + 0.02);
}
void impact_early(const Case&, const Query& q, Observation& o) {
  if (is(q, Question::time_of_impact) && o.toi) *o.toi *= 0.9;
}
void impact_denied(const Case&, const Query& q, Observation& o) {
  if (is(q, Question::time_of_impact)) o.toi.reset();
}
void impact_invented(const Case&, const Query& q, Observation& o) {
  if (is(q, Question::time_of_impact) && !o.toi) o.toi = 0.5;
}
void pair_dropped(const Case&, const Query& q, Observation& o) {
  if (is(q, Question::candidates) && !o.candidate_pairs.empty() && !o.candidate_pairs.back().empty())
    o.candidate_pairs.back().pop_back();
}
void pair_stale(const Case& c, const Query& q, Observation& o) {
  if (is(q, Question::candidates) && !o.candidate_pairs.empty())
    o.candidate_pairs.back().emplace_back(0, static_cast<int>(c.scene.bodies.size()));
}
void contact_dropped(const Case&, const Query& q, Observation& o) {
  if (is(q, Question::scene_contacts) && !o.contacts.empty()) o.contacts.pop_back();
}
void not_a_number(const Case&, const Query& q, Observation& o) {
  if (is(q, Question::distance) && o.distance) o.distance = std::numeric_limits<double>::quiet_NaN();
}
void cap_as_failure(const Case&, const Query& q, Observation& o) {
  if (is(q, Question::contact)) o = Observation{}, o.outcome = Outcome::not_converged;
}

}  // namespace

std::vector<Mutant> mutants() {
  return {
      {"deny_shallow", "missed", "shallow", deny_shallow},
      {"claim_near", "ghost", "separate", claim_near},
      {"absolute_epsilon", "distance_off", "tiny", absolute_epsilon},
      {"witness_swapped", "witness_off", "separate", witness_swapped},
      {"normal_flipped", "infeasible", "shallow", normal_flipped},
      {"normal_zero", "normal_not_unit", "shallow", normal_zero},
      {"normal_local", "infeasible", "shallow", normal_local},
      {"normal_second_best", "not_minimal", "deep", normal_second_best},
      {"depth_halved", "infeasible", "shallow", depth_halved},
      {"depth_doubled", "depth_excess", "shallow", depth_doubled},
      {"point_off", "point_off", "shallow", point_off},
      {"impact_late", "late", "translate", impact_late},
      {"impact_early", "early", "translate", impact_early},
      {"impact_denied", "missed", "spin", impact_denied},
      {"impact_invented", "ghost", "spin", impact_invented},
      {"pair_dropped", "missed", "crowd", pair_dropped},
      {"pair_stale", "stale", "script", pair_stale},
      {"contact_dropped", "missed", "crowd", contact_dropped},
      {"not_a_number", "no_number", "separate", not_a_number},
      {"cap_as_failure", "not_converged", "near", cap_as_failure},
  };
}

EnginePtr make_lying_engine(const Mutant& m) { return std::make_unique<LyingEngine>(m); }

}  // namespace touchstone::mutants
