// What of a scene an engine held. An engine in floats has infinity for what is 1e154 in doubles, and a faulty
// plug-in may report NaN: such a body is no set, so there is no scene received to judge an answer against,
// and what is wrong about it is blamed on the representation.
#pragma once

#include "scenarios/value/observation.h"

namespace touchstone::fuzz {

/// Finite numbers, sizes of 0 or more, a normal that is not zero.
bool is_a_set(const Shape& shape);

/// What was received without the shapes and bodies that are no such sets: those count as asked.
ReceivedScene held_part(const Scene& asked, const ReceivedScene& received);

/// True when the bodies that the query is about were held: its two, or all of the scene.
bool is_held(const Scene& asked, const ReceivedScene& received, const Query& query);

}  // namespace touchstone::fuzz
