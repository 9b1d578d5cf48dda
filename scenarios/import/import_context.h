// What every reader of robots and worlds shares: the user's options, the folders from which files may be
// read, and the list of what could not be represented.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/shape/shape.h"
#include "scenarios/import/xml.h"

namespace touchstone {

struct ImportOptions {
  std::string srdf;                 // file; empty: none
  std::vector<std::string> joints;  // "NAME=VALUE"
  std::string state;                // "GROUP/STATE", or a keyframe
  std::string trajectory;           // CSV file; empty: none
  std::string trajectory_text;      // that is taken in place of the file's, if it is not empty
  std::vector<std::filesystem::path> package_paths;
  bool lenient = false;
  bool convex_meshes = false;
  double padding = 0;  // added to every shape
};

/// Something in a file that was left out.
struct ImportNote {
  std::string place, reason;
};

class ImportContext {
 public:
  explicit ImportContext(const ImportOptions& options) : options_(options) {}
  const ImportOptions& options() const { return options_; }

  /// Throws InputError, or with --lenient keeps a note.
  void refuse(const std::string& place, const std::string& reason);
  void refuse(const XmlElement& e, const std::string& reason);
  const std::vector<ImportNote>& notes() const { return notes_; }

  /// The file that `uri` names: below `folder` for a relative path, below a package's folder for
  /// "package://NAME/…" and "model://NAME/…". A package is a folder of that name, or one whose package.xml
  /// states it, directly in a folder of --package-path, or that folder itself. Throws InputError at `place`
  /// for absolute paths, other URLs,
  /// "..", links that lead out of these folders, and files that do not exist.
  std::filesystem::path resolve(const std::string& uri, const std::filesystem::path& folder,
                                const std::string& place) const;

  /// The triangles of a mesh file (OBJ, STL, PLY, COLLADA, glTF) times `scale` per axis, in double
  /// arithmetic; a scale that mirrors reverses the triangles. With `convex`, or if the user asked for it,
  /// their hull.
  Shape mesh(const std::filesystem::path& file, const Vec3& scale, bool convex, const std::string& place);

 private:
  std::filesystem::path in_package(const std::string& rest, const std::string& place) const;
  const ImportOptions& options_;
  std::vector<ImportNote> notes_;
  std::map<std::string, TriangleMesh> meshes_;
};

/// True for the endings of mesh files that `ImportContext::mesh` reads.
bool is_mesh_file(const std::filesystem::path& file);

}  // namespace touchstone
