// The causes of a campaign as files: DIR/causes.json, and one directory per cause for the engine's
// developers.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "reports/record/causes.h"

namespace touchstone::fuzz {

/// Reads DIR/causes.json. Throws InputError naming the file when DIR does not hold a campaign, the causes are
/// missing, belong to another state of the campaign, or are damaged.
Causes load_causes(const std::filesystem::path& campaign_directory);

/// False when DIR/causes.json is missing, or that of another state of the campaign: the causes must be found
/// first. Damaged files count as there, so that load_causes states what is wrong with them.
bool has_causes(const std::filesystem::path& campaign_directory);

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
