// A case argument is a case or scene file, a finding's directory (its case.json), the name of a scenario, or
// the name of a case in the corpus (scenarios/corpus), with or without "corpus/".
#pragma once

#include <string>

#include "scenarios/codec/case_codec.h"

namespace touchstone::cli {

/// Throws InputError when it is none of them.
StoredCase case_argument(const std::string& text);

/// The directory of a recorded scene (scene.txt, frames.npy).
bool is_recording(const std::string& text);

}  // namespace touchstone::cli
