// What the engines in this process share: queries are asked one by one, and what one throws is its answer.
#pragma once

#include <chrono>
#include <span>
#include <vector>

#include "core/base/input_error.h"
#include "oracles/api/engine.h"
#include "oracles/api/measure.h"

namespace touchstone {

/// `ask(o)` fills the answer; its time is in it.
template <class Ask>
Observation timed_answer(Ask&& ask) {
  Observation o;
  const auto start = std::chrono::steady_clock::now();
  try {
    ask(o);
  } catch (const InputError& e) {
    o = {}, o.outcome = Outcome::invalid_input, o.detail = e.what();
  } catch (const std::exception& e) {
    o = {}, o.outcome = Outcome::threw, o.detail = e.what();
  }
  o.elapsed_ns = std::chrono::nanoseconds(std::chrono::steady_clock::now() - start).count();
  return o;
}

/// The same, and asked again while measure.h says so.
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

/// `answer(scene, query)` for every query; all is received as it was sent.
template <class Answer>
std::vector<CaseObservations> answer_cases(std::span<const Case> cases, Answer&& answer) {
  std::vector<CaseObservations> all;
  all.reserve(cases.size());
  for (const Case& c : cases) {
    CaseObservations& r = all.emplace_back();
    r.received.bodies.resize(c.scene.bodies.size());
    r.received.shapes.resize(c.scene.shapes.size());
    for (const Query& q : c.queries) r.answers.push_back(answer(c.scene, q));
  }
  return all;
}

}  // namespace touchstone
