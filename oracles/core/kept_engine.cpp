#include <map>

#include "core/broad/catalog.h"
#include "core/math/roundoff.h"
#include "core/narrow/narrow_phase.h"
#include "core/world/step_world.h"
#include "oracles/core/core_answers.h"
#include "oracles/core/core_engine.h"

namespace touchstone {
namespace {

// Below the size at which a graph pays off, so that hill climbing is also tested on small hulls.
constexpr std::size_t least_graph = 12;

// The assumed displacement of a body since the previous step, relative to its size.
constexpr double previous_shift = 1.0 / 64;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Pose previous_pose(const Scene& s, int body) {
  const Pose& now = s.bodies[at(body)].pose;
  const double shift = previous_shift * extent(s.shape_of(body));
  return {now.translation + Vec3(shift, -shift / 2, shift / 4), now.rotation};
}

// The colliders of a scene, and the cached state of its pairs.
class Kept {
 public:
  explicit Kept(const Scene& s) : s_(s) {
    for (const Shape& shape : s.shapes) colliders_.emplace_back(shape, least_graph);
  }

  PlacedShape placed(int i, const Pose& pose) const {
    return colliders_[at(s_.bodies.at(at(i)).shape)].at(pose);
  }
  PlacedShape placed(int i) const { return placed(i, s_.bodies.at(at(i)).pose); }
  MovingShape moving(int i) const {
    const Body& b = s_.bodies.at(at(i));
    return colliders_[at(b.shape)].at(b.pose, b.motion.value_or(Motion{}));
  }

  PairMemory& memory(const Query& q) {
    const auto [it, is_new] = memory_.try_emplace({q.a, q.b});
    if (is_new) contact(placed(q.a), placed(q.b, previous_pose(s_, q.b)), Arithmetic::float64, &it->second);
    return it->second;
  }

 private:
  const Scene& s_;
  std::vector<Collider> colliders_;
  std::map<std::pair<int, int>, PairMemory> memory_;
};

std::unique_ptr<broad::BroadPhase> phase_in_turn(const Scene& s) {
  return broad::catalog[hash(s) % broad::catalog.size()].make();
}

Fidelity remembering() {
  Fidelity f;
  f.remember = true;
  return f;
}

struct Asked {
  const Scene& s;
  Kept& kept;

  void overlap(const Query& q, Observation& o) {
    store(touchstone::overlap(kept.placed(q.a), kept.placed(q.b), Arithmetic::float64, &kept.memory(q)), o);
  }
  void distance(const Query& q, Observation& o) {
    const PlacedShape a = kept.placed(q.a), b = kept.placed(q.b);
    store(touchstone::distance(a, b, Arithmetic::float64, &kept.memory(q)), a, b, o);
    if (o.outcome == Outcome::answered) o.unique_gradient = gradients(a, b, b.pose.translation).unique;
  }
  void contact(const Query& q, Observation& o) {
    const ContactAnswer r =
        touchstone::contact(kept.placed(q.a), kept.placed(q.b), Arithmetic::float64, &kept.memory(q));
    store(r, reduced(r), o);
  }
  // Both bodies are flagged for sweeping explicitly, so that the criterion skips nothing.
  void time_of_impact(const Query& q, Observation& o) const {
    Scene pair = extract_pair(s, q.a, q.b);
    // A world leaves out a pair of static bodies, but here the question names it.
    if (pair.bodies[0].is_static && pair.bodies[1].is_static) pair.bodies[0].is_static = false;
    StepWorld world(pair);
    for (const int body : {0, 1}) world.flag(body, true);
    const StepReport r = world.step();
    o.outcome = r.unsupported > 0 ? Outcome::unsupported : r.outcome;
    for (const PairImpact& hit : r.impacts)
      if (hit.impact.outcome == Outcome::answered) o.toi = hit.impact.toi;
  }
  void candidates(Observation& o) const {
    o.candidate_pairs = candidate_pairs(s, *phase_in_turn(s));
    o.outcome = Outcome::answered;
  }
  void swept_candidates(Observation& o) const {
    o.candidate_pairs = {swept_candidate_pairs(s, *phase_in_turn(s))};
    o.outcome = Outcome::answered;
  }
  void within(const Query& q, Observation& o) {
    store(touchstone::within(kept.placed(q.a), kept.placed(q.b), s.margin, Arithmetic::float64,
                             &kept.memory(q)),
          o);
  }
  void contact_within(const Query& q, Observation& o) {
    const ContactAnswer r = touchstone::contact_within(kept.placed(q.a), kept.placed(q.b), s.margin,
                                                       Arithmetic::float64, &kept.memory(q));
    store(r, reduced(r), o);
  }
  void bounded_distance(const Query& q, Observation& o) {
    store(touchstone::distance(kept.placed(q.a), kept.placed(q.b), s.margin, Arithmetic::float64,
                               &kept.memory(q)),
          o);
  }
  void candidates_within(Observation& o) const {
    o.candidate_pairs = candidate_pairs_within(s, *phase_in_turn(s));
    o.outcome = Outcome::answered;
  }
  void ray(const Query& q, Observation& o) {
    store_ray(touchstone::time_of_impact(kept.moving(q.a), kept.moving(q.b), ImpactDetail::contact), o);
  }
  // Reports the second of two steps; in the first, the bodies are at their previous poses. Nothing moves
  // within a step.
  void scene_contacts(Observation& o) const {
    Scene at_rest = s;
    for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i) {
      Body& b = at_rest.bodies[at(i)];
      b.motion.reset();
      if (!b.is_static) b.pose = previous_pose(s, i);
    }
    StepWorld world(at_rest, remembering());
    world.step();
    for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i)
      if (!s.bodies[at(i)].is_static) world.set(i, s.bodies[at(i)].pose, {});
    const StepReport r = world.step();
    o.outcome = r.outcome;
    store(r.contacts, r.unsupported, o);
  }
};

class KeptEngine final : public NativeEngine {
 public:
  const EngineCard& card() const override { return card_; }
  void answer(const Case& c, const Tell& tell) override {
    std::optional<Kept> kept;
    for (const Query& q : c.queries)
      tell(timed_answer([&](Observation& o) {
        if (!kept) kept.emplace(c.scene);
        Asked asked{c.scene, *kept};
        answer_by_question(asked, q, o);
      }));
  }

 private:
  EngineCard card_ = core_card(
      "core-kept",
      "as core, with hull graphs, mesh trees, cached pairs and manifolds of at most four points; motions and "
      "scenes by StepWorld; every broad phase in turn");
};

}  // namespace

std::unique_ptr<NativeEngine> make_kept_engine() { return std::make_unique<KeptEngine>(); }

}  // namespace touchstone
