#include "oracles/core/core_engine.h"

#include <chrono>
#include <exception>

#include "core/broad/catalog.h"
#include "core/ccd/time_of_impact.h"
#include "core/narrow/narrow_phase.h"
#include "core/tolerance.h"
#include "core/world/world.h"

namespace touchstone {
namespace {

PlacedShape placed(const Scene& s, int i) {
  return {&s.shape_of(i), s.bodies[static_cast<std::size_t>(i)].pose};
}

MovingShape moving(const Scene& s, int i) {
  const Body& b = s.bodies[static_cast<std::size_t>(i)];
  return {&s.shape_of(i), b.pose, b.motion.value_or(Motion{})};
}

void ask_overlap(const Scene& s, const Query& q, Observation& o) {
  const OverlapAnswer r = overlap(placed(s, q.a), placed(s, q.b));
  o.outcome = r.outcome;
  o.overlap = r.overlap;
}

void ask_distance(const Scene& s, const Query& q, Observation& o) {
  const DistanceAnswer r = distance(placed(s, q.a), placed(s, q.b));
  o.outcome = r.outcome;
  o.overlap = r.distance <= 0;
  o.distance = r.distance;
  o.witness = r.witness;
}

void ask_contact(const Scene& s, const Query& q, Observation& o) {
  const ContactAnswer r = contact(placed(s, q.a), placed(s, q.b));
  o.outcome = r.outcome;
  o.overlap = r.overlap;
  if (!r.overlap) return;
  o.normal = r.normal, o.depth = r.depth;
  for (const ContactPoint& p : r.manifold) o.manifold.push_back({p.position, p.depth});
}

void ask_impact(const Scene& s, const Query& q, Observation& o) {
  const TimeOfImpact r = time_of_impact(moving(s, q.a), moving(s, q.b));
  o.outcome = r.outcome;
  if (r.hit) o.toi = r.t, o.normal = r.normal, o.witness = r.witness;
}

void ask_candidates(const Scene& s, const Query&, Observation& o) {
  const auto broad_phase = broad::make_broad_phase("sort_and_sweep");
  o.outcome = Outcome::answered;
  o.candidate_pairs = candidate_pairs(s, *broad_phase);
}

void ask_scene_contacts(const Scene& s, const Query&, Observation& o) {
  const auto broad_phase = broad::make_broad_phase("sort_and_sweep");
  o.outcome = Outcome::answered;
  for (const WorldContact& c : world_contacts(s, *broad_phase)) {
    if (c.contact.outcome != Outcome::answered && c.contact.outcome != Outcome::unsupported)
      o.outcome = c.contact.outcome;
    if (c.contact.overlap)
      o.contacts.push_back({c.bodies.first, c.bodies.second, c.contact.normal, c.contact.depth});
  }
}

constexpr void (*ask[])(const Scene&, const Query&, Observation&) = {
    ask_overlap, ask_distance, ask_contact, ask_impact, ask_candidates, ask_scene_contacts};

Observation answer(const Scene& s, const Query& q) {
  Observation o;
  const auto start = std::chrono::steady_clock::now();
  try {
    ask[static_cast<std::size_t>(q.question)](s, q, o);
  } catch (const std::exception& e) {
    o = Observation{};
    o.outcome = Outcome::threw, o.detail = e.what();
  }
  o.elapsed_ns = std::chrono::nanoseconds(std::chrono::steady_clock::now() - start).count();
  return o;
}

}  // namespace

CoreEngine::CoreEngine() {
  card_.name = "core", card_.library = "Touchstone", card_.version = "0.1.0";
  card_.settings = "sort-and-sweep broad phase; closed forms, GJK and EPA; conservative advancement";
  card_.unit_roundoff = 0x1p-53, card_.tau_factor = tolerance::core_tau_factor;
  card_.source = "claims arithmetic alone: no margin, no solver tolerance";
}

std::vector<CaseObservations> CoreEngine::run(std::span<const Case> cases) {
  std::vector<CaseObservations> result;
  for (const Case& c : cases) {
    CaseObservations o;
    for (const Query& q : c.queries) o.answers.push_back(answer(c.scene, q));
    result.push_back(std::move(o));
  }
  return result;
}

}  // namespace touchstone
