// Reads results from files, which may be damaged or untrusted. Every part of a key is validated here, because
// keys name directories. A reader knows the file and its position in it, so errors name both.
#pragma once

#include <optional>
#include <string>

#include "reports/record/result.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::fuzz {

/// Reads a number, or the text "inf", "-inf" or "nan", which JSON numbers cannot express. Throws InputError.
double number_from(const JsonReader& j);

/// True if the key may name a directory: short enough, and consisting only of an engine's name and words of
/// lower-case letters, digits, _ and -.
bool has_plain_key(const Finding& f);

/// The parts of a key of that engine's findings, or nullopt when it is not such a key, or not a plain one.
std::optional<Finding> finding_of_key(const std::string& engine, const std::string& key);

/// A case of a campaign, from its JSON. Throws InputError, naming the place.
Case campaign_case(const Json& j, const std::string& place);

/// Without their cases. Throws InputError if there are too many, or not in the order of their indices.
std::vector<Example> examples_from_json(const JsonReader& j);

/// Reads a finding with a plain key; the evidence and the examples may be missing, and examples have no
/// cases. Throws InputError if a field is missing or has the wrong type.
Finding finding_from_json(const JsonReader& j);

/// The parts of a finding's evidence that a result stores once, under the hash of their contents.
inline constexpr const char* documents_of_evidence[] = {"case", "received"};

/// With the cases of the examples. Throws InputError as above, and if a finding is filed under a key other
/// than its own.
CampaignResult result_from_json(const JsonReader& j);
/// The same; also throws if a finding has no evidence, or an example no case.
CampaignResult result_with_evidence(const JsonReader& j);

}  // namespace touchstone::fuzz
