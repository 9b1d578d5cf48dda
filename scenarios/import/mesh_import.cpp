#include "scenarios/import/mesh_import.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/input_error.h"
#include "scenarios/codec/scene_codec.h"

namespace touchstone {
namespace {

struct Collector {
  const std::string& file;
  MeshImport options;
  TriangleMesh mesh;
  std::map<std::array<double, 3>, int> seen;

  int index_of(const Vec3& p) {
    const int next = static_cast<int>(mesh.vertices.size());
    if (options.join_vertices) {
      // + 0.0 folds -0 into 0, so that equal coordinates have equal keys.
      const auto [it, is_new] = seen.try_emplace({p.x() + 0.0, p.y() + 0.0, p.z() + 0.0}, next);
      if (!is_new) return it->second;
    }
    mesh.vertices.push_back(p);
    return next;
  }

  void add(const aiMesh& part, const aiMatrix4x4& to_root) {
    std::vector<int> index(part.mNumVertices);
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      const aiVector3D v = to_root.IsIdentity() ? part.mVertices[i] : to_root * part.mVertices[i];
      if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
        throw InputError(file,
                         "vertex " + std::to_string(i) + " has a coordinate that is not finite in float32");
      index[i] = index_of(Vec3(v.x, v.y, v.z));
    }
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines
      std::array<int, 3> t{};
      for (unsigned k = 0; k < 3; ++k) {
        if (face.mIndices[k] >= part.mNumVertices)
          throw InputError(file, "face " + std::to_string(f) + " names vertex " +
                                     std::to_string(face.mIndices[k]) + " of " +
                                     std::to_string(part.mNumVertices));
        t[k] = index[face.mIndices[k]];
      }
      mesh.triangles.push_back(t);
    }
  }
};

// Every instance of a mesh in the scene, with its name and its transform.
template <class F>
void for_each_instance(const aiScene& scene, const aiNode& node, const aiMatrix4x4& to_parent, const F& f) {
  const aiMatrix4x4 to_root = to_parent * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) f(*scene.mMeshes[node.mMeshes[i]], node, to_root);
  for (unsigned i = 0; i < node.mNumChildren; ++i) for_each_instance(scene, *node.mChildren[i], to_root, f);
}

// A binary STL file has a facet count; a file with fewer facets is truncated. assimp reports this only for
// some lengths.
void check_binary_stl(const std::string& file, const std::string& bytes) {
  if (bytes.size() < 84 || bytes.compare(0, 5, "solid") == 0) return;
  std::uint32_t count = 0;
  for (unsigned i = 0; i < 4; ++i)
    count |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[80 + i])) << (8 * i);
  const std::uint64_t need = 84 + std::uint64_t{50} * count;
  if (bytes.size() < need)
    throw InputError(file, "is cut off: " + std::to_string(count) + " facets need " + std::to_string(need) +
                               " bytes, the file has " + std::to_string(bytes.size()));
}

// Some readers of assimp never stop at the end of a damaged file (5.2.5: a PLY header without its end).
class EndingStream final : public Assimp::IOStream {
 public:
  explicit EndingStream(std::unique_ptr<Assimp::IOStream> of) : of_(std::move(of)) {}
  std::size_t Read(void* to, std::size_t size, std::size_t count) override {
    const std::size_t n = of_->Read(to, size, count);
    if (n == 0 && size * count > 0 && ++reads_past_end_ > most_reads_past_end)
      throw std::runtime_error("the reader does not stop at the end of the file");
    return n;
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override { return of_->Seek(offset, origin); }
  std::size_t Tell() const override { return of_->Tell(); }
  std::size_t FileSize() const override { return of_->FileSize(); }
  void Flush() override {}

 private:
  static constexpr int most_reads_past_end = 1000;  // readers that stop need one or two
  std::unique_ptr<Assimp::IOStream> of_;
  int reads_past_end_ = 0;
};

// A mesh file may name others. This opens regular files of one folder, and nothing outside it.
class FolderFiles final : public Assimp::DefaultIOSystem {
 public:
  explicit FolderFiles(const std::filesystem::path& file) {
    std::error_code ec;
    folder_ = std::filesystem::canonical(file, ec).parent_path();
  }
  bool Exists(const char* file) const override { return is_inside(file); }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    const bool reads = std::string_view(mode).find_first_of("wa+") == std::string_view::npos;
    if (!reads || !is_inside(file)) return nullptr;
    std::unique_ptr<Assimp::IOStream> stream(DefaultIOSystem::Open(file, mode));
    return stream ? new EndingStream(std::move(stream)) : nullptr;  // assimp closes it
  }

 private:
  bool is_inside(const char* file) const {
    std::error_code ec;
    const std::filesystem::path f = std::filesystem::canonical(file, ec);
    if (ec || !std::filesystem::is_regular_file(f, ec)) return false;
    return std::mismatch(folder_.begin(), folder_.end(), f.begin(), f.end()).first == folder_.end();
  }
  std::filesystem::path folder_;
};

}  // namespace

std::string lower_extension(const std::filesystem::path& file) {
  std::string s = file.extension().string();
  for (char& c : s) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return s;
}

namespace {

// Refers to the importer, which owns it.
const aiScene& read_scene(Assimp::Importer& importer, const std::filesystem::path& path,
                          const MeshImport& options) {
  const std::string file = path.string();
  // Reading the file ourselves first gives path errors (missing, directory, too large, empty) a uniform form.
  const std::string bytes = read_file(path);
  if (bytes.empty()) throw InputError(file, "is empty");
  if (lower_extension(path) == ".stl") check_binary_stl(file, bytes);
  importer.SetIOHandler(new FolderFiles(path));  // the importer deletes it
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, options.keep_up_axis);
  const aiScene* scene = importer.ReadFile(file, aiProcess_Triangulate);
  if (scene && scene->mRootNode) return *scene;
  std::string reason = importer.GetErrorString();
  if (reason.find("bad_alloc") != std::string::npos) reason = "it asks for more memory than is allowed";
  for (char& c : reason)
    if (c == '\n' || c == '\r') c = ' ';
  throw InputError(file, "cannot be read as a mesh: " + (reason.empty() ? "no reason given" : reason));
}

std::vector<MeshPart> read_whole(const std::filesystem::path& path, const MeshImport& options) {
  const std::string file = path.string();
  Assimp::Importer importer;
  const aiScene& scene = read_scene(importer, path, options);
  Collector collector{file, options, {}, {}};
  for_each_instance(
      scene, *scene.mRootNode, aiMatrix4x4(),
      [&](const aiMesh& m, const aiNode&, const aiMatrix4x4& to_root) { collector.add(m, to_root); });
  return {{"", std::move(collector.mesh)}};
}

std::vector<MeshPart> read_parts(const std::filesystem::path& path, const MeshImport& options) {
  const std::string file = path.string();
  Assimp::Importer importer;
  const aiScene& scene = read_scene(importer, path, options);
  std::vector<MeshPart> parts;
  for_each_instance(scene, *scene.mRootNode, aiMatrix4x4(),
                    [&](const aiMesh& m, const aiNode& node, const aiMatrix4x4& to_root) {
                      Collector collector{file, options, {}, {}};
                      collector.add(m, to_root);
                      parts.push_back({node.mName.C_Str(), std::move(collector.mesh)});
                    });
  return parts;
}

// ---- between the process of the reader and this one: both are this program

template <class T>
void put(std::string& to, const T* from, std::size_t count) {
  to.append(reinterpret_cast<const char*>(from), count * sizeof(T));
}

template <class T>
void put_list(std::string& to, const T& list) {
  const std::size_t count = list.size();
  put(to, &count, 1);
  put(to, list.data(), count);
}

template <class T>
void take_list(std::string_view& from, T& list) {
  std::size_t count = 0;
  std::memcpy(&count, from.data(), sizeof count);
  from.remove_prefix(sizeof count);
  list.resize(count);
  const std::size_t bytes = count * sizeof(list[0]);
  if (bytes > 0) std::memcpy(static_cast<void*>(list.data()), from.data(), bytes);
  from.remove_prefix(bytes);
}

using Reader = std::vector<MeshPart> (*)(const std::filesystem::path&, const MeshImport&);

// assimp crashes on some damaged files, and never ends on others. Parts without triangles are left out.
std::vector<MeshPart> read_in_child(Reader reader, const std::filesystem::path& path,
                                    const MeshImport& options) {
  const std::string bytes = in_child_process(path.string(), [&] {
    std::string out;
    for (const MeshPart& p : reader(path, options)) {
      if (p.mesh.triangles.empty()) continue;
      put_list(out, p.name);
      put_list(out, p.mesh.vertices);
      put_list(out, p.mesh.triangles);
    }
    return out;
  });
  std::vector<MeshPart> parts;
  for (std::string_view rest = bytes; !rest.empty();) {
    MeshPart& p = parts.emplace_back();
    take_list(rest, p.name);
    take_list(rest, p.mesh.vertices);
    take_list(rest, p.mesh.triangles);
  }
  if (parts.empty()) throw InputError(path.string(), "has no triangles");
  return parts;
}

}  // namespace

TriangleMesh load_mesh(const std::filesystem::path& path, const MeshImport& options) {
  return std::move(read_in_child(&read_whole, path, options).front().mesh);
}

std::vector<MeshPart> load_mesh_parts(const std::filesystem::path& path, const MeshImport& options) {
  return read_in_child(&read_parts, path, options);
}

}  // namespace touchstone
