// replay of a capture (touchstone_capture.h): the recorded answers are judged without the engine; engines
// that are asked for answer the same questions beside.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fuzz/answer/stated_answer.h"
#include "oracles/abi/engine.h"

namespace touchstone::cli {

struct CaptureOptions {
  fuzz::StatedPrecision precision;
  bool json = false;
};

/// Judges the captures in order and prints what is wrong, then counts. Exit code: 1 if a recorded answer is
/// wrong, 3 if none is right, else 0; engines beside do not count. Throws InputError for a line that is no
/// query or has no answer.
int replay_captures(std::span<const std::string> files, const std::vector<EnginePtr>& beside,
                    const CaptureOptions& o);

}  // namespace touchstone::cli
