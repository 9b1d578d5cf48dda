// All engines of the core by name, for the library that a worker loads.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "oracles/abi/native_engine.h"
#include "oracles/core/broad_engine.h"

namespace touchstone {

/// core, core-f32, core-kept, an alternative, or a broad phase. Null if there is no engine of that name.
std::unique_ptr<NativeEngine> make_native_core(std::string_view name);

/// The name under which a worker offers a broad phase with these boxes.
std::string native_name(std::string_view broad_phase, BroadBoxes boxes);

}  // namespace touchstone
