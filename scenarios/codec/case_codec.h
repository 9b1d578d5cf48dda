// JSON form of a case: {"touchstone_case": 1, "id", "description", "source", "family", "scene": {…},
// "queries": […], "expect": {…}, "invalid_numbers": {…}}. Only the version and the scene are required. A
// scene is valid JSON and denotes closed sets; "invalid_numbers" ({"/bodies/2/pose/translation/0": "NaN"},
// also "Infinity", "-Infinity" and negative half extents) then inserts numbers that do neither, for
// candidates queries only.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "scenarios/value/case.h"
#include "scenarios/value/expectation.h"

namespace touchstone {

/// A case with additional data for people and tests.
struct StoredCase {
  Case c;
  std::string description, source;
  Expectation expect;
  bool operator==(const StoredCase&) const = default;
};

/// The queries for a scene that has none. Two bodies: overlap, distance and contact of (0, 1), time of impact
/// when one moves, and candidates when there is a script. Otherwise: candidates and scene contacts and, when
/// a body moves, swept candidates and the time of impact of the first `most_impacts_asked` pairs that may
/// meet (moving_pairs.h).
std::vector<Query> default_queries(const Scene& scene);

nlohmann::ordered_json case_to_json(const Case& c);
nlohmann::ordered_json stored_case_to_json(const StoredCase& s);
/// Throws InputError "place: JSON path: reason". Validates the scene and checks that each pair query names
/// two different bodies.
Case case_from_json(const nlohmann::ordered_json& j, const std::string& place = "");
StoredCase stored_case_from_json(const nlohmann::ordered_json& j, const std::string& place = "");

/// Reads a case file, or a bare scene file with default_queries. The id defaults to the file's name.
Case load_case(const std::filesystem::path& file);
StoredCase load_stored_case(const std::filesystem::path& file);

/// Text with one body, step or query per line.
std::string to_text(const StoredCase& s);
void save_case(const StoredCase& s, const std::filesystem::path& file);

namespace scenarios {
/// All *.json files of a directory, sorted by name.
std::vector<StoredCase> load_corpus(const std::filesystem::path& directory);
}  // namespace scenarios

}  // namespace touchstone
