// How a query ended. Every exit of every algorithm and engine is one of these. Reaching an iteration cap is
// not_converged; it is never reported as a number or as "no hit" (truth.md §3).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace touchstone {

enum class Outcome : std::uint8_t {
  answered,
  unsupported,     // the engine has no such query for these shapes
  not_converged,   // an iteration cap or a stall, reported as such
  invalid_input,   // refused with a reason
  threw,           // a C++ exception left the engine
  crashed,         // signal, abort, exit, memory limit, or bytes on the pipe that are not an answer
  timed_out,       // watchdog
  invalid_answer,  // names a body, shape, pair or outcome that does not exist
  not_asked        // the engine was set aside after too many timeouts
};

inline constexpr auto outcome_names =
    std::to_array<std::string_view>({"answered", "unsupported", "not_converged", "invalid_input", "threw",
                                     "crashed", "timed_out", "invalid_answer", "not_asked"});
static_assert(outcome_names.size() == static_cast<std::size_t>(Outcome::not_asked) + 1);

constexpr std::string_view to_string(Outcome o) { return outcome_names[static_cast<std::size_t>(o)]; }

constexpr std::optional<Outcome> outcome_from_string(std::string_view s) {
  for (std::size_t i = 0; i < outcome_names.size(); ++i)
    if (outcome_names[i] == s) return static_cast<Outcome>(i);
  return std::nullopt;
}

/// The engine gave no answer: not a failure, and nothing to judge.
constexpr bool was_not_attempted(Outcome o) { return o == Outcome::unsupported || o == Outcome::not_asked; }
/// The outcome says more about the machine than about the engine.
constexpr bool depends_on_time(Outcome o) { return o == Outcome::timed_out || o == Outcome::not_asked; }

}  // namespace touchstone
