// Triangle meshes from files (OBJ, STL, PLY, … whatever assimp reads). assimp holds coordinates in float32:
// what it read is the mesh, exactly; digits of the file beyond float32 are lost before we see them.
#pragma once

#include <filesystem>

#include "core/shape/triangle_mesh.h"

namespace touchstone {

struct MeshImport {
  bool join_vertices = true;  // vertices of equal coordinates become one; order of first appearance
};

/// All triangles of the file, polygons triangulated, in file order. Points and lines are left out. Throws
/// InputError "file: reason": not there, not readable as a mesh, cut off, no triangles, a coordinate that is
/// not finite.
TriangleMesh load_mesh(const std::filesystem::path& file, const MeshImport& options = {});

}  // namespace touchstone
