// Exact JSON of what engines answered: doubles shortest-round-trip, NaN and infinities as the strings "nan",
// "inf", "-inf".
#pragma once

#include <nlohmann/json.hpp>

#include "scenarios/value/observation.h"

namespace touchstone::fuzz {

using Json = nlohmann::ordered_json;

Json number(double x);
/// The elements of an array, with commas between. Strings are quoted as in JSON: ours hold no quotes.
std::string csv_cells(const Json& cells);
Json vector(const Vec3& v);
Json to_json(const Observation& o);
Json to_json(const ReceivedScene& r);

}  // namespace touchstone::fuzz
