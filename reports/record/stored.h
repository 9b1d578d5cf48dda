// Results read back from files, which may be damaged or a stranger's. All that a key is made of is checked
// here: directories are named by keys. A reader knows the file and the place in it, so that errors name both.
#pragma once

#include "reports/record/result.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::fuzz {

/// A number, or one that JSON has no word for as text ("inf", "nan"). Throws InputError.
double number_from(const JsonReader& j);

/// Whether a directory may be named by its key: no longer than a name may be, and of nothing but the name of
/// an engine and words of small letters, digits, _ and -.
bool has_plain_key(const Finding& f);

/// With a plain key; the evidence may be missing. Throws InputError: a field that is missing or of another
/// type.
Finding finding_from_json(const JsonReader& j);

/// Throws InputError: as above, and a finding under another key than its own.
CampaignResult result_from_json(const JsonReader& j);
/// As result_from_json, and every finding has its evidence.
CampaignResult result_with_evidence(const JsonReader& j);

}  // namespace touchstone::fuzz
