// Alternative methods of the core, for comparison in charts: extended precision for every pair, and
// speculative contact instead of a time of impact.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "oracles/abi/native_engine.h"

namespace touchstone {

/// core-extended, core-speculative@0.25 and so on.
std::span<const std::string_view> core_alternatives();

/// Precondition: a name of core_alternatives().
std::unique_ptr<NativeEngine> make_core_alternative(std::string_view name);

}  // namespace touchstone
