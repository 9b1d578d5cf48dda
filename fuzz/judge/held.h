// Which part of a scene an engine could represent. An engine in floats has infinity for 1e154 in doubles, and
// a faulty plug-in may report NaN: such a body is not a set, so there is no received scene to judge an answer
// against, and its faults are blamed on the representation.
#pragma once

#include "scenarios/value/observation.h"

namespace touchstone::fuzz {

/// Whether the numbers are finite, the sizes >= 0 and the normal not zero.
bool is_a_set(const Shape& shape);

/// The received scene without the shapes and bodies that are not plausible sets: those count as given.
ReceivedScene held_part(const Scene& asked, const ReceivedScene& received);

/// Whether the bodies of the query were held: its two, or all of the scene.
bool is_held(const Scene& asked, const ReceivedScene& received, const Query& query);

}  // namespace touchstone::fuzz
