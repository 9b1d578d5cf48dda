#include "oracles/core/core_engine.h"

#include <chrono>
#include <exception>

#include "core/base/input_error.h"
#include "core/broad/catalog.h"
#include "core/ccd/impact.h"
#include "core/narrow/narrow_phase.h"
#include "core/tolerance.h"
#include "core/world/world.h"

namespace touchstone {
namespace {

constexpr std::string_view broad_phase_name = "automatic";

const Body& body_of(const Scene& s, int i) { return s.bodies[static_cast<std::size_t>(i)]; }
PlacedShape placed(const Scene& s, int i) { return {&s.shape_of(i), body_of(s, i).pose}; }
MovingShape moving(const Scene& s, int i) {
  return {&s.shape_of(i), body_of(s, i).pose, body_of(s, i).motion.value_or(Motion{})};
}

void require_bodies(const Scene& s, const Query& q) {
  if (!is_pair_question(q.question)) return;
  const int n = static_cast<int>(s.bodies.size());
  for (int i : {q.a, q.b})
    if (i < 0 || i >= n) throw InputError("query", "body " + std::to_string(i) + " is no body of the scene");
}

void ask_overlap(const Scene& s, const Query& q, Observation& o) {
  const OverlapAnswer r = overlap(placed(s, q.a), placed(s, q.b));
  o.outcome = r.outcome;
  if (r.outcome == Outcome::answered) o.overlap = r.overlap;
}

void ask_distance(const Scene& s, const Query& q, Observation& o) {
  const DistanceAnswer r = distance(placed(s, q.a), placed(s, q.b));
  o.outcome = r.outcome;
  if (r.outcome != Outcome::answered) return;
  o.distance = r.distance, o.witness = r.witness, o.normal = r.normal;
}

void ask_contact(const Scene& s, const Query& q, Observation& o) {
  const ContactAnswer r = contact(placed(s, q.a), placed(s, q.b));
  o.outcome = r.outcome;
  if (r.outcome != Outcome::answered) return;
  o.overlap = r.overlap;
  if (!r.overlap) return;
  o.normal = r.normal, o.depth = r.depth;
  for (const ContactPoint& p : r.manifold) o.manifold.push_back({p.position, p.depth});
}

void ask_impact(const Scene& s, const Query& q, Observation& o) {
  const ImpactAnswer r = time_of_impact(moving(s, q.a), moving(s, q.b));
  o.outcome = r.outcome;
  if (r.outcome == Outcome::answered) o.toi = r.toi;
  if (r.outcome == Outcome::not_converged)
    o.detail = "no contact before t = " + std::to_string(r.clear_until);
}

void ask_candidates(const Scene& s, Observation& o) {
  const auto phase = broad::make_broad_phase(broad_phase_name);
  o.candidate_pairs = candidate_pairs(s, *phase);
  o.outcome = Outcome::answered;
}

void ask_scene_contacts(const Scene& s, Observation& o) {
  const auto phase = broad::make_broad_phase(broad_phase_name);
  const SceneContacts r = scene_contacts(s, *phase);
  o.outcome = r.outcome;
  for (const PairContact& c : r.contacts) o.contacts.push_back({c.a, c.b, c.contact.normal, c.contact.depth});
  if (r.unsupported > 0) o.detail = std::to_string(r.unsupported) + " pairs of unsupported shapes left out";
}

void ask(const Scene& s, const Query& q, Observation& o) {
  require_bodies(s, q);
  switch (q.question) {
    case Question::overlap:
      return ask_overlap(s, q, o);
    case Question::distance:
      return ask_distance(s, q, o);
    case Question::contact:
      return ask_contact(s, q, o);
    case Question::time_of_impact:
      return ask_impact(s, q, o);
    case Question::candidates:
      return ask_candidates(s, o);
    case Question::scene_contacts:
      return ask_scene_contacts(s, o);
  }
}

Observation observe(const Scene& s, const Query& q) {
  Observation o;
  const auto start = std::chrono::steady_clock::now();
  try {
    ask(s, q, o);
  } catch (const InputError& e) {
    o = {}, o.outcome = Outcome::invalid_input, o.detail = e.what();
  } catch (const std::exception& e) {
    o = {}, o.outcome = Outcome::threw, o.detail = e.what();
  }
  o.elapsed_ns =
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - start).count();
  return o;
}

}  // namespace

CoreEngine::CoreEngine() {
  card_.name = "core";
  card_.library = "Touchstone core";
  card_.version = "0.1.0";
  card_.settings = "GJK and EPA in extended precision, closed forms, conservative advancement; broad phase " +
                   std::string(broad_phase_name);
  card_.unit_roundoff = 0x1p-53;
  card_.tau_factor = tolerance::core_tau_factor;
  card_.source = "core/tolerance.h: arithmetic alone, no margin";
}

std::vector<CaseObservations> CoreEngine::run(std::span<const Case> cases) {
  std::vector<CaseObservations> all;
  all.reserve(cases.size());
  for (const Case& c : cases) {
    CaseObservations& r = all.emplace_back();
    r.received.bodies.resize(c.scene.bodies.size());
    r.received.shapes.resize(c.scene.shapes.size());
    for (const Query& q : c.queries) r.answers.push_back(observe(c.scene, q));
  }
  return all;
}

EnginePtr make_core_engine() { return std::make_unique<CoreEngine>(); }

}  // namespace touchstone
