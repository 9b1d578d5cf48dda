// An engine that tells what our core tells, except for one lie. Each lie must be found by the check that it
// is made for.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "oracles/api/engine.h"

namespace touchstone::mutants {

/// Changes an answer in place.
using Lie = std::function<void(const Case&, const Query&, Observation&)>;

struct Mutant {
  std::string_view name;
  std::string_view fault;   // name of the fault that the judge must find
  std::string_view family;  // where to look for it
  Lie lie;
};

std::vector<Mutant> mutants();

EnginePtr make_lying_engine(const Mutant& m);

}  // namespace touchstone::mutants
