// JSON of engine cards, certificates and expectations.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "scenarios/codec/json_reader.h"
#include "scenarios/value/certificate.h"
#include "scenarios/value/engine_card.h"
#include "scenarios/value/expectation.h"

namespace touchstone {

// Engine cards as JSON.

/// Throws InputError when a field is missing or of the wrong type.
EngineCard card_from_json(const std::string& text);
std::string to_json_text(const EngineCard& card);

// Certificates as JSON.

nlohmann::ordered_json to_json(const Certificate& c);
/// Reads what to_json wrote. Throws InputError when it is not a certificate.
Certificate certificate_from_json(const nlohmann::ordered_json& j);

nlohmann::ordered_json to_json(const ImpactCertificate& c);
/// Reads what to_json wrote. Throws InputError when it is not an impact certificate.
ImpactCertificate impact_certificate_from_json(const nlohmann::ordered_json& j);

}  // namespace touchstone

namespace touchstone::scenarios {

// JSON form of an Expectation, the "expect" of a case.

nlohmann::ordered_json to_json(const Expectation& e);  // an empty object when nothing is expected
Expectation read_expectation(const JsonReader& r);

}  // namespace touchstone::scenarios
