// One lie, as a row.
#pragma once

#include <functional>
#include <string_view>

#include "scenarios/value/observation.h"

namespace touchstone::mutants {

/// Changes the core's answer in place. May keep state between calls: every engine has its own copy.
using Lie = std::function<void(const Case&, const Query&, Observation&)>;

struct Mutant {
  std::string_view name;
  std::string_view fault;   // name of the fault that the judge must find
  std::string_view family;  // a family of cases where it shows
  std::string_view line;    // what is wrong with it, for readers
  Lie lie;
  bool repeats = true;           // false: its answers depend on earlier questions
  bool reads_unwritten = false;  // its lie is the content of unwritten memory
  /// Lies of one symptom give the same kind of wrong answer, from other triggers or faults. May be empty.
  std::string_view symptom = "";
};

}  // namespace touchstone::mutants
