#include "fuzz/causes/symptom.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/base/input_error.h"
#include "core/base/outcome.h"
#include "fuzz/judge/relation.h"
#include "oracles/abi/last_words.h"
#include "scenarios/text/printable.h"

namespace touchstone::fuzz {
namespace {

std::optional<Fault> fault_named(std::string_view name) {
  const auto at = std::find(fault_names.begin(), fault_names.end(), name);
  if (at == fault_names.end()) return std::nullopt;
  return static_cast<Fault>(at - fault_names.begin());
}

struct FaultRow {
  Fault fault;
  FaultStage stage;
  Severity severity;
};
constexpr FaultRow fault_rows[] = {
    {Fault::missed, FaultStage::verdict, Severity::missed},
    {Fault::ghost, FaultStage::verdict, Severity::ghost},
    {Fault::distance_off, FaultStage::distance, Severity::distance},
    {Fault::witness_off, FaultStage::points, Severity::witness},
    {Fault::normal_not_unit, FaultStage::depth, Severity::infeasible},
    {Fault::infeasible, FaultStage::depth, Severity::infeasible},
    {Fault::not_minimal, FaultStage::depth, Severity::not_minimal},
    {Fault::depth_excess, FaultStage::depth, Severity::not_minimal},
    {Fault::point_off, FaultStage::points, Severity::witness},
    {Fault::point_depth, FaultStage::points, Severity::witness},
    {Fault::incomplete, FaultStage::points, Severity::witness},
    {Fault::late, FaultStage::time, Severity::time},
    {Fault::early, FaultStage::time, Severity::time},
    {Fault::stale, FaultStage::verdict, Severity::ghost},
    {Fault::unstable, FaultStage::state, Severity::unstable},
    {Fault::no_number, FaultStage::failure, Severity::infeasible},
    {Fault::inner_edge, FaultStage::depth, Severity::not_minimal},
    {Fault::bound_off, FaultStage::distance, Severity::distance},
    {Fault::gradient_off, FaultStage::points, Severity::witness},
    {Fault::failed, FaultStage::failure, Severity::crash},
};
static_assert(std::size(fault_rows) == fault_names.size());

const FaultRow& row_of(Fault f) { return fault_rows[static_cast<std::size_t>(f)]; }

// A missed overlap and a ghost come from opposite errors: no other faults of one stage are so unlike.
bool is_distinct(Fault f) { return stage_of(f) == FaultStage::verdict || f == Fault::no_number; }

}  // namespace

FaultStage stage_of(Fault f) { return row_of(f).stage; }

Question folded(Question q) { return q == Question::scene_contacts ? Question::contact : q; }

Symptom symptom_of(const Finding& f) {
  const auto question = question_from_string(f.question);
  if (!question) throw InputError(f.key(), "has an unknown question: " + printable(f.question));
  if (is_relation(f.fault)) return {folded(*question), FaultStage::contradiction, f.fault};
  const auto fault = fault_named(f.fault);
  if (!fault) return {folded(*question), FaultStage::failure, f.fault};
  return {folded(*question), stage_of(*fault), is_distinct(*fault) ? f.fault : ""};
}

Severity severity_of(const Finding& f) {
  if (is_relation(f.fault)) return Severity::relation;
  if (const auto fault = fault_named(f.fault)) return row_of(*fault).severity;
  if (f.fault.starts_with(to_string(Outcome::timed_out))) return Severity::hang;
  // The engine says itself that it has no answer.
  for (const Outcome declines : {Outcome::not_converged, Outcome::invalid_input})
    if (f.fault.starts_with(to_string(declines))) return Severity::declined;
  return Severity::crash;
}

bool shows(const Symptom& s, Question question, const FaultReport& fault, const Judgement& j,
           const Observation& o) {
  if (folded(question) != s.question) return false;
  if (fault.fault != Fault::failed)
    return stage_of(fault.fault) == s.stage &&
           s.detail == (is_distinct(fault.fault) ? to_string(fault.fault) : "");
  if (s.stage != FaultStage::failure) return false;
  const std::string outcome(to_string(j.outcome));
  return s.detail == (o.site.empty() ? outcome : fmt::format("{}_{}", outcome, site_word(o.site)));
}

}  // namespace touchstone::fuzz
