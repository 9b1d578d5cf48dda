// Asks engines of one path about each other's cases. Two findings with equal responses may still have two
// causes, if two engines show them: then each is right where the other is wrong. Of findings of one engine
// this says nothing, because it shows both.
#pragma once

#include <vector>

#include "fuzz/causes/engine_pool.h"
#include "fuzz/causes/group.h"

namespace touchstone::fuzz {

/// Divides groups whose engines do not show the fault in each other's cases, each with about the same error.
/// Only where the responses of one cause are equal as a rule (is_exact): elsewhere a case near a boundary
/// shows a fault in one engine and not in another by chance. Members whose own case shows nothing stay with
/// the first part.
std::vector<Group> told_apart(std::vector<Group> groups, const GroupInput& in, EnginePool& pool);

}  // namespace touchstone::fuzz
