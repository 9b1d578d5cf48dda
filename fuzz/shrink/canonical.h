// One form for all cases that are the same up to symmetry, scale and precision.
#pragma once

#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// Equal for two cases that differ only by: names, the order of bodies and shapes, which body of a pair is A,
/// the order of a hull's vertices, a common translation, one of the 48 signed permutations of the world's
/// axes (mirror images included), a turn of a shape's own axes that leaves the same body, lengths scaled by a
/// power of two, and numbers rounded to the 24 significant bits of float. It is the least of the images in a
/// lexicographic order: identity rotations first, then small sizes, then positive translations. To be
/// compared with other canonical forms only: it is rounded, and not the case to ask an engine about.
///
/// A translation of numbers with more than 24 bits that were rounded to float besides can escape this, as the
/// difference of rounded numbers is not the rounded difference.
///
/// Cost: 48·n! images of n bodies, and per body 48·24 comparisons of a rotation and 48 sorted copies of a
/// hull: below a millisecond for small shapes. With more than 4 bodies, a script or a number that is not
/// finite, only names are removed and numbers rounded.
Case canonical(const Case& c);

}  // namespace touchstone::fuzz
