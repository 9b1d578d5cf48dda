// Exact JSON of engines' answers: doubles in the shortest form that round-trips, NaN and infinities as the
// strings "nan", "inf", "-inf".
#pragma once

#include <nlohmann/json.hpp>

#include "scenarios/value/observation.h"

namespace touchstone::fuzz {

using Json = nlohmann::ordered_json;

Json number(double x);
/// Joins the elements of an array with commas. Strings are quoted as in JSON, which is valid CSV without
/// inner quotes.
std::string csv_cells(const Json& cells);
Json vector(const Vec3& v);
Json to_json(const Observation& o);
Json to_json(const ReceivedScene& r);

}  // namespace touchstone::fuzz
