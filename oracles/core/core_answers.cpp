#include "oracles/core/core_answers.h"

#include "core/math/roundoff.h"
#include "core/tolerance.h"

namespace touchstone {

EngineCard core_card(std::string_view name, std::string settings) {
  EngineCard card;
  card.name = name;
  card.library = "Touchstone core";
  card.version = "0.1.0";
  card.settings = std::move(settings);
  card.unit_roundoff = double_roundoff;
  card.tau_factor = tolerance::core_tau_factor;
  card.source = "core/tolerance.h: arithmetic alone, no margin";
  return card;
}

void store(const OverlapAnswer& answer, Observation& o) {
  o.outcome = answer.outcome;
  if (answer.outcome == Outcome::answered) o.overlap = answer.overlap;
}

void store(const DistanceAnswer& answer, Observation& o) {
  o.outcome = answer.outcome;
  if (answer.outcome != Outcome::answered) return;
  o.distance = answer.distance;
  o.witness = answer.witness;
  o.normal = answer.normal;
}

void store(const DistanceAnswer& answer, const PlacedShape& a, const PlacedShape& b, Observation& o) {
  store(answer, o);
  const bool surface = is_mesh(*a.shape) || is_mesh(*b.shape);
  if (answer.outcome != Outcome::answered || (surface && answer.distance <= 0)) return;
  if (const auto g = gradient(answer, b.pose.translation)) o.moment = g->moment;
}

void store(const WithinAnswer& answer, Observation& o) {
  o.outcome = answer.outcome;
  if (answer.outcome == Outcome::answered) o.overlap = answer.within;
}

void store(const BoundedDistanceAnswer& answer, Observation& o) {
  if (answer.distance) return store(*answer.distance, o);
  o.outcome = answer.outcome;
  if (answer.outcome == Outcome::answered) o.lower_bound = answer.lower_bound;
}

void store_ray(const ImpactAnswer& answer, Observation& o) {
  o.outcome = answer.outcome;
  if (answer.outcome != Outcome::answered) return;
  o.toi = answer.toi;
  o.overlap = answer.toi && *answer.toi == 0;
  if (answer.toi && *answer.toi > 0) o.normal = answer.normal_ab;
}

void store(const ContactAnswer& answer, const Manifold& manifold, Observation& o) {
  o.outcome = answer.outcome;
  if (answer.outcome != Outcome::answered) return;
  o.overlap = answer.overlap;
  if (!answer.overlap) return;
  o.normal = answer.normal;
  o.depth = answer.depth;
  for (const ContactPoint& p : manifold) {
    o.manifold.push_back({p.position, p.depth, std::nullopt});
    if (p.feature != 0) o.manifold.back().id = p.feature;
  }
}

void store(const std::vector<PairContact>& contacts, long unsupported, Observation& o) {
  for (const PairContact& c : contacts) o.contacts.push_back({c.a, c.b, c.contact.normal, c.contact.depth});
  if (unsupported > 0) o.detail = std::to_string(unsupported) + " pairs of unsupported shapes left out";
}

}  // namespace touchstone
