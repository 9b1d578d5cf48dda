// What a finding shows, with all that varies between cases of one bug left out: its symptom. Keys are folded
// into classes by engine path, symptom and route.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>

#include "reports/record/causes.h"
#include "reports/record/result.h"
#include "scenarios/value/case.h"
#include "scenarios/value/judgement.h"

namespace touchstone::fuzz {

/// Kinds of faults, in the order of the stages of a collision detector: a later one may follow from an
/// earlier one, never the reverse.
enum class FaultStage : std::uint8_t {
  failure,
  state,
  verdict,
  distance,
  depth,
  points,
  time,
  contradiction
};
inline constexpr auto fault_stage_names = std::to_array<std::string_view>(
    {"failure", "state", "verdict", "distance", "depth", "points", "time", "contradiction"});
static_assert(fault_stage_names.size() == static_cast<std::size_t>(FaultStage::contradiction) + 1);
constexpr std::string_view to_string(FaultStage s) { return fault_stage_names[static_cast<std::size_t>(s)]; }

FaultStage stage_of(Fault f);

/// Contacts of a scene are contacts of its pairs, found by the same code.
Question folded(Question q);

struct Symptom {
  Question question = Question::overlap;  // folded
  FaultStage stage = FaultStage::failure;
  /// Of a failure, how it fails and where ("crashed_distance-inl_h_177"); of a verdict, its fault; of a
  /// contradiction, the relation.
  std::string detail;
  auto operator<=>(const Symptom&) const = default;
};

/// Throws InputError when the question is unknown. A fault that is neither a fault of judgement.h nor a
/// relation is a failure, named by its outcome.
Symptom symptom_of(const Finding& f);
Severity severity_of(const Finding& f);

/// True when the fault, found in an answer to the question, is of the symptom.
bool shows(const Symptom& s, Question question, const FaultReport& fault, const Judgement& j,
           const Observation& o);

}  // namespace touchstone::fuzz
