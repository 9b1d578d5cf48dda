// Shared by the core's engines: the card, the core's answers as observations, and their timing.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/input_error.h"
#include "core/impact/impact.h"
#include "core/narrow/bounded.h"
#include "core/narrow/gradient.h"
#include "core/world/world.h"
#include "oracles/abi/measure.h"
#include "oracles/abi/native_engine.h"

namespace touchstone {

/// The card of an engine that computes in double.
EngineCard core_card(std::string_view name, std::string settings);

void store(const OverlapAnswer& answer, Observation& o);
void store(const DistanceAnswer& answer, Observation& o);
/// With the gradient by the pose of B, unless the pair overlaps and one is a mesh.
void store(const DistanceAnswer& answer, const PlacedShape& a, const PlacedShape& b, Observation& o);
void store(const WithinAnswer& answer, Observation& o);
void store(const BoundedDistanceAnswer& answer, Observation& o);
/// Of a ray: the time, and the normal unless the ray starts inside.
void store_ray(const ImpactAnswer& answer, Observation& o);
/// `manifold` is answer.manifold, or a reduced one.
void store(const ContactAnswer& answer, const Manifold& manifold, Observation& o);
/// `unsupported`: the number of pairs that were left out.
void store(const std::vector<PairContact>& contacts, long unsupported, Observation& o);

/// Calls the member of `asked` that answers the query, e.g. asked.distance(q, o).
template <class Asked>
void answer_by_question(Asked& asked, const Query& q, Observation& o) {
  switch (q.question) {
    case Question::overlap:
      return asked.overlap(q, o);
    case Question::distance:
      return asked.distance(q, o);
    case Question::contact:
      return asked.contact(q, o);
    case Question::time_of_impact:
      return asked.time_of_impact(q, o);
    case Question::candidates:
      return asked.candidates(o);
    case Question::scene_contacts:
      return asked.scene_contacts(o);
    case Question::swept_candidates:
      return asked.swept_candidates(o);
    case Question::within:
      return asked.within(q, o);
    case Question::bounded_distance:
      return asked.bounded_distance(q, o);
    case Question::candidates_within:
      return asked.candidates_within(o);
    case Question::ray:
      return asked.ray(q, o);
    case Question::contact_within:
      return asked.contact_within(q, o);
  }
}

/// `ask(o)` fills in the answer; its time is recorded, and exceptions become outcomes.
template <class Ask>
Observation timed_answer(Ask&& ask) {
  Observation o;
  const auto start = std::chrono::steady_clock::now();
  try {
    ask(o);
  } catch (const InputError& e) {
    o = no_answer(Outcome::invalid_input, e.what());
  } catch (const std::exception& e) {
    o = no_answer(Outcome::threw, e.what());
  }
  o.elapsed_ns = std::chrono::nanoseconds(std::chrono::steady_clock::now() - start).count();
  return o;
}

/// The same, with repetitions for the timing as described in measure.h.
template <class Ask>
Observation measured_answer(std::int64_t measure, Ask&& ask) {
  Observation o = timed_answer(ask);
  if (measure == 0 || o.outcome != Outcome::answered) return o;
  Observation again;
  o.elapsed_ns = least_mean_ns(o.elapsed_ns, measure, [&] {
    again.manifold.clear();
    ask(again);
  });
  return o;
}

}  // namespace touchstone
