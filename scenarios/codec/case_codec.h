// JSON form of a case: {"touchstone_case": 1, "id", "description", "source", "family", "scene": {…},
// "queries": […], "expect": {…}, "odd_numbers": {…}}. Only the version and the scene are required. A scene is
// valid JSON and denotes closed sets; "odd_numbers" ({"/bodies/2/pose/translation/0": "NaN"}, also
// "Infinity", "-Infinity" and negative half extents) puts into it afterwards what does neither, for
// candidates alone.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "scenarios/value/case.h"
#include "scenarios/value/expectation.h"

namespace touchstone {

/// A case with what people and tests want to know beside it.
struct StoredCase {
  Case c;
  std::string description, source;
  Expectation expect;
  bool operator==(const StoredCase&) const = default;
};

/// What is asked of a scene that comes without questions. Two bodies: overlap, distance, contact of (0, 1),
/// and time of impact when one moves; otherwise, or when there is a script, candidates; scene contacts when
/// there are more bodies; when one of these moves, the time of impact of the first `most_impacts_asked` pairs
/// that may meet (moving_pairs.h).
std::vector<Query> default_queries(const Scene& scene);

nlohmann::ordered_json case_to_json(const Case& c);
nlohmann::ordered_json stored_case_to_json(const StoredCase& s);
/// Throws InputError "place: JSON path: reason". Validates the scene and that each query names two different
/// bodies.
Case case_from_json(const nlohmann::ordered_json& j, const std::string& place = "");
StoredCase stored_case_from_json(const nlohmann::ordered_json& j, const std::string& place = "");

/// Reads a case file, or a bare scene file with default_queries. The id defaults to the file's name.
Case load_case(const std::filesystem::path& file);
StoredCase load_stored_case(const std::filesystem::path& file);

/// Bodies, steps and queries one a line.
std::string to_text(const StoredCase& s);
void save_case(const StoredCase& s, const std::filesystem::path& file);

namespace scenarios {
/// All *.json of a directory, by name.
std::vector<StoredCase> load_corpus(const std::filesystem::path& directory);
}  // namespace scenarios

}  // namespace touchstone
