// Triangle meshes from files (OBJ, STL, PLY, … whatever assimp reads). assimp stores coordinates in float32:
// the mesh is exactly what assimp read, and digits of the file beyond float32 are lost before that.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/shape/triangle_mesh.h"

namespace touchstone {

struct MeshImport {
  bool join_vertices = true;  // merge vertices with equal coordinates, in order of first appearance
  bool keep_up_axis = false;  // COLLADA: coordinates as written; otherwise y is made to point up
};

/// The file's ending in lower case, with its dot.
std::string lower_extension(const std::filesystem::path& file);

/// All triangles of the file in file order; polygons are triangulated, points and lines skipped. Throws
/// InputError "file: reason" when the file is missing, not readable as a mesh, truncated, has no triangles,
/// or has a coordinate that is not finite. Files that it refers to (materials, buffers) are opened only if
/// they are in its own folder or below. The file is read in a process of its own (child_process.h).
TriangleMesh load_mesh(const std::filesystem::path& file, const MeshImport& options = {});

/// One object of a file: a group of an OBJ file, a solid of an STL file, an instance of a COLLADA file.
struct MeshPart {
  std::string name;  // may be empty
  TriangleMesh mesh;
};

/// The objects of a file, in file order, those without triangles left out. Errors are those of load_mesh.
std::vector<MeshPart> load_mesh_parts(const std::filesystem::path& file, const MeshImport& options = {});

}  // namespace touchstone
