// The causes of a campaign as files: DIR/causes.json, and one directory per cause for the engine's
// developers.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "reports/record/causes.h"

namespace touchstone::fuzz {

/// The causes in DIR/causes.json if they are of the campaign's state with this digest (`digest` in
/// reports/record/result.h); empty when the file is missing or is of another state: the causes must be found
/// first. Throws InputError naming the file when it is damaged.
std::optional<Causes> stored_causes(const std::filesystem::path& campaign_directory,
                                    const std::string& digest);
/// Whether there is such a file, of whatever state.
bool has_causes(const std::filesystem::path& campaign_directory);
/// Writes DIR/causes.json. Throws InputError; then the old file stays.
void store_causes(const std::filesystem::path& campaign_directory, const Causes& causes);

/// The finding that the shown case of a cause is: what `shrink`, `reproduce` and `check` take from
/// finding.json. Throws InputError unless it has a case and a plain key of its engine.
Json finding_json_of(const Cause& c);

enum class Written { now, before, no_case };

/// Writes DIR/<id>/: case.json, the shown case; finding.json; certificate.json for `touchstone check`, if
/// there is one; issue.md, if `issue` is given; reproduce.cpp (reproduce.jsonl for a command behind a pipe),
/// or no_reproducer.txt with the reason why there is none. The directory is built under another name and then
/// renamed, so an existing one is complete and is left alone. Throws InputError.
Written write_cause(const std::filesystem::path& directory, const Cause& c,
                    const std::function<std::string(const Cause&)>& issue);

}  // namespace touchstone::fuzz
