// What a command takes for a case: a case or scene file, a finding's directory (its case.json), or a
// scenario's name.
#pragma once

#include <string>

#include "scenarios/case_codec.h"

namespace touchstone::cli {

/// Throws InputError when it is none of them.
StoredCase case_argument(const std::string& text);

}  // namespace touchstone::cli
