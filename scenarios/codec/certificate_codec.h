// Certificates as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "scenarios/value/certificate.h"

namespace touchstone {

nlohmann::ordered_json to_json(const Certificate& c);
/// Reads what to_json wrote. Throws InputError when it is not a certificate.
Certificate certificate_from_json(const nlohmann::ordered_json& j);

nlohmann::ordered_json to_json(const ImpactCertificate& c);
/// Reads what to_json wrote. Throws InputError when it is not an impact certificate.
ImpactCertificate impact_certificate_from_json(const nlohmann::ordered_json& j);

}  // namespace touchstone
