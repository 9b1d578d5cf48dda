// The core as a program uses it that asks more than once: with what it may build and keep. Pairs by the
// graphs of hulls, the trees of meshes and the memory of a moment ago; motions and scenes by StepWorld;
// candidate pairs by one broad phase of the catalog after another; manifolds of at most four points. Every
// answer is a function of the case alone: the moment before is made up, and nothing is kept from case to
// case.
#pragma once

#include <memory>

#include "oracles/abi/native_engine.h"

namespace touchstone {

std::unique_ptr<NativeEngine> make_kept_engine();

}  // namespace touchstone
