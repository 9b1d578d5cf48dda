// A glTF 2.0 file with its buffers: nodes with their transforms, and triangles of meshes. Coordinates are
// float32, as the format defines them.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/shape/triangle_mesh.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/import/import_context.h"

namespace touchstone {

/// A pose and, before it, a scaling of each axis.
struct GltfTransform {
  Pose pose;
  Vec3 scale = Vec3::Ones();
};

class GltfFile {
 public:
  /// A .gltf or .glb file. Throws InputError.
  GltfFile(const std::filesystem::path& file, const ImportContext& context);

  JsonReader root() const { return {json_, file_.string()}; }
  /// Precondition: i < count(list).
  JsonReader element(std::string_view list, std::size_t i) const;
  /// The element whose number `user` states. Throws InputError there when there is none.
  JsonReader element(std::string_view list, const JsonReader& user) const;
  std::size_t count(std::string_view list) const;

  /// By a matrix, or by translation, rotation and scale. Throws InputError for a matrix with shear.
  static GltfTransform transform_of(const JsonReader& node);
  /// outer ∘ inner. Nothing if it has shear: unequal scales around a rotation.
  static std::optional<GltfTransform> composed(const GltfTransform& outer, const GltfTransform& inner);

  /// The triangles of a mesh in its own frame, added to `to` after `transform`. Throws InputError.
  void add_triangles(const JsonReader& mesh, const GltfTransform& transform, TriangleMesh& to) const;

 private:
  struct Accessor {
    const std::string* bytes = nullptr;
    std::size_t offset = 0, stride = 0, count = 0;
    int component = 0;  // as glTF numbers the types of components
  };
  void split_binary(const std::string& bytes);
  Accessor accessor(const JsonReader& index, const std::string& type) const;
  const std::string& buffer(const JsonReader& index) const;
  std::vector<Vec3> positions(const JsonReader& index) const;
  std::vector<std::uint32_t> indices(const JsonReader& index) const;

  std::filesystem::path file_;
  const ImportContext& context_;
  nlohmann::ordered_json json_;
  std::string binary_;  // of a .glb file
  mutable std::map<std::uint64_t, std::string> buffers_;
};

}  // namespace touchstone
