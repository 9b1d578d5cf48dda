// Triangle meshes from files (OBJ, STL, PLY, … whatever assimp reads). assimp stores coordinates in float32:
// the mesh is exactly what assimp read, and digits of the file beyond float32 are lost before that.
#pragma once

#include <filesystem>
#include <functional>
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

// Work on a hostile file in a process of its own: a reader that is not ours may crash or never end.

/// What `work` returns in a forked child. An InputError that it throws is thrown here, with its place and
/// reason. Throws InputError about `file` when the child ends by a signal, or has used a minute of CPU time,
/// or cannot be started. What the child writes to stderr is lost.
std::string in_child_process(const std::string& file, const std::function<std::string()>& work);

}  // namespace touchstone
