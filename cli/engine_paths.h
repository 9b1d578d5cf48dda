// What is known about the catalogued engines beyond their cards: which of them share code, which routine a
// library chooses for two shapes, and which engines differ in one respect.
#pragma once

#include <string>

#include "fuzz/causes/classes.h"

namespace touchstone::cli {

fuzz::EngineKnowledge catalogued_knowledge();

/// The library of an engine path, or of the first of "a, b": "FCL" for "fcl-libccd"; what is given itself for
/// engines outside the catalogue.
std::string library_of(const std::string& path);

}  // namespace touchstone::cli
