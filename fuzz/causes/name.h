// A sentence for a cause: what is wrong, where, and what makes it vanish.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fuzz/causes/respond.h"
#include "reports/record/causes.h"

namespace touchstone::fuzz {

/// The intervention that says most about the cause among those that make the fault vanish: its name.
/// "fragile" when nearly all do, "steady" when none does, "" when nothing was asked.
std::string main_reason(const Responses& r, FaultStage stage, const std::vector<OtherEngine>& others = {});

/// What it means, with the numbers of interventions: "vanishes when scaled by 1024: an absolute tolerance".
std::string describe_reason(const std::string& reason, const Responses& r,
                            const std::vector<OtherEngine>& others);

/// The size of the error, if it follows one law: "0.5 times the true value", "off by 0.04 at any scale"; else
/// empty.
std::string describe_law(std::span<const ErrorLaw> laws);

/// What a name says of a fault.
struct NamedFault {
  Severity severity = Severity::relation;
  Symptom symptom;
  std::string fault;                        // the most frequent of that severity
  std::string failure;                      // words of a failure: "crashed at distance-inl.h:177"
  std::vector<std::string> routes, shapes;  // sorted
  bool is_of_one_question = true;           // false: other questions show the fault as well
};
/// "Contacts are not minimal (two boxes)".
std::string describe_fault(const NamedFault& s);

}  // namespace touchstone::fuzz
