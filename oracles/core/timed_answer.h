// Shared by the core's engines: answers are timed, and exceptions become outcomes.
#pragma once

#include <chrono>

#include "core/base/input_error.h"
#include "oracles/abi/measure.h"
#include "oracles/abi/native_engine.h"

namespace touchstone {

/// `ask(o)` fills in the answer; its time is recorded.
template <class Ask>
Observation timed_answer(Ask&& ask) {
  Observation o;
  const auto start = std::chrono::steady_clock::now();
  try {
    ask(o);
  } catch (const InputError& e) {
    o = {};
    o.outcome = Outcome::invalid_input;
    o.detail = e.what();
  } catch (const std::exception& e) {
    o = {};
    o.outcome = Outcome::threw;
    o.detail = e.what();
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
