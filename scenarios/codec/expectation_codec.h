// JSON form of an Expectation, the "expect" of a case.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "scenarios/codec/json_reader.h"
#include "scenarios/value/expectation.h"

namespace touchstone::scenarios {

nlohmann::ordered_json to_json(const Expectation& e);  // an empty object when nothing is expected
Expectation read_expectation(const JsonReader& r);

}  // namespace touchstone::scenarios
