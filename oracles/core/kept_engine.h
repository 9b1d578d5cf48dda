// The core as used by a program that queries repeatedly, with acceleration structures and caches. Pairs use
// hull graphs, mesh trees and the cached state of a previous step; motions and scenes use StepWorld;
// candidate pairs use the broad phases of the catalog in turn; manifolds have at most four points. Every
// answer depends only on the case: the previous step is synthetic, and nothing is kept between cases.
#pragma once

#include <memory>

#include "oracles/abi/native_engine.h"

namespace touchstone {

std::unique_ptr<NativeEngine> make_kept_engine();

}  // namespace touchstone
