// Engine cards as JSON.
#pragma once

#include <string>

#include "scenarios/value/engine_card.h"

namespace touchstone {

/// Throws InputError when a field is missing or of the wrong type.
EngineCard card_from_json(const std::string& text);
std::string to_json_text(const EngineCard& card);

}  // namespace touchstone
