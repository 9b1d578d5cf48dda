// All contacts of two meshes: every pair of triangles that share a point, which contact() reports the deepest
// of.
#pragma once

#include <vector>

#include "core/narrow/collider.h"
#include "core/narrow/result.h"

namespace touchstone {

struct TriangleContact {
  std::int32_t a, b;  // indices of the triangles
  Vec3 normal;        // unit, world, A to B: moving B's triangle by `depth` along it separates the two
  double depth;       // the least
  Vec3 position;      // world: halfway between the deepest points of both
};

struct MeshContacts {
  /// `unsupported` unless both shapes are meshes; `not_converged` if some pair is, which is not listed then.
  Outcome outcome = Outcome::answered;
  std::vector<TriangleContact> contacts;  // ascending by (a, b)
};

MeshContacts mesh_contacts(const PlacedShape& a, const PlacedShape& b);

}  // namespace touchstone
