// Triangle meshes from files (OBJ, STL, PLY, … whatever assimp reads). assimp stores coordinates in float32:
// the mesh is exactly what assimp read, and digits of the file beyond float32 are lost before that.
#pragma once

#include <filesystem>

#include "core/shape/triangle_mesh.h"

namespace touchstone {

struct MeshImport {
  bool join_vertices = true;  // merge vertices with equal coordinates, in order of first appearance
};

/// All triangles of the file in file order; polygons are triangulated, points and lines skipped. Throws
/// InputError "file: reason" when the file is missing, not readable as a mesh, truncated, has no triangles,
/// or has a coordinate that is not finite.
TriangleMesh load_mesh(const std::filesystem::path& file, const MeshImport& options = {});

}  // namespace touchstone
