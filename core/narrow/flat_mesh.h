// The contact of a convex body with a mesh where the mesh is a plane as far as the body reaches through it.
// The deepest triangle alone may be left sideways, which does not lead out of the mesh.
#pragma once

#include <optional>

#include "core/narrow/narrow_phase.h"

namespace touchstone::narrow {

/// A bounded convex body and a mesh, in either order.
bool may_be_flat(const PlacedShape& a, const PlacedShape& b);

/// `of_triangle`: the contact of the deepest triangle. The contact with the mesh's plane instead, if that
/// triangle's normal is not a face's and, at every point nearer to the body than twice the depth in the
/// plane, all triangles lie in the plane exactly and each of their edges has triangles on both sides.
/// Otherwise nullopt. Precondition: may_be_flat, and an overlap.
std::optional<ContactAnswer> contact_with_plane_of(const PlacedShape& a, const PlacedShape& b,
                                                   const ContactAnswer& of_triangle);

}  // namespace touchstone::narrow
