// Motions that begin in contact and end it at once: an impact at the start of the step, as it is defined, but
// some engines report impacts of bodies that approach each other only, and say so.
#pragma once

#include "reports/record/result.h"

namespace touchstone::fuzz {

/// True when the bodies of the question overlap or touch at the start and move apart along the normal there,
/// faster than their turning can bring a point of them back; or slide along each other. Never of a mesh, each
/// of whose triangles has a normal of its own.
bool parts_from_start(const Case& c, const Query& q);

/// The same of every time of impact that the case asks for.
bool parts_from_start(const Case& c);

/// True of an impact denied, when this holds for every case that is kept as its example.
bool is_of_parting_bodies(const Finding& f);

}  // namespace touchstone::fuzz
