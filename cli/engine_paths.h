// What is known about the catalogued engines beyond their cards: which of them share code, which routine a
// library chooses for two shapes, and which engines differ in one respect.
#pragma once

#include "fuzz/causes/classes.h"

namespace touchstone::cli {

fuzz::EngineKnowledge catalogued_knowledge();

}  // namespace touchstone::cli
