#include "scenarios/import/import_context.h"

#include <algorithm>
#include <array>
#include <optional>
#include <system_error>

#include "core/base/input_error.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/import/mesh_import.h"
#include "scenarios/text/printable.h"

namespace touchstone {
namespace {

namespace fs = std::filesystem;

bool has_parent_step(const fs::path& p) {
  return std::any_of(p.begin(), p.end(), [](const fs::path& part) { return part == ".."; });
}

// True when the file, with links followed, is in the folder or below it.
bool is_below(const fs::path& file, const fs::path& folder) {
  std::error_code ec;
  const fs::path f = fs::canonical(file, ec);
  if (ec) return false;
  const fs::path d = fs::canonical(folder.empty() ? fs::path(".") : folder, ec);
  if (ec) return false;
  return std::mismatch(d.begin(), d.end(), f.begin(), f.end()).first == d.end();
}

// The name in the folder's package.xml; empty without one.
std::string stated_name(const fs::path& folder) {
  std::error_code ec;
  const fs::path file = folder / "package.xml";
  if (!fs::exists(file, ec) || !is_below(file, folder)) return "";
  require_regular_file(file);
  const XmlFile xml(file);
  const auto name = xml.root().child("name");
  return name ? name->text() : "";
}

// The folder itself, or the first one in it by name, whose package.xml states the package.
std::optional<fs::path> folder_that_states(const std::string& package, const fs::path& dir) {
  std::vector<fs::path> folders{dir};
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(dir, ec))
    if (entry.is_directory(ec) && is_below(entry.path(), dir)) folders.push_back(entry.path());
  std::sort(folders.begin() + 1, folders.end());
  const auto it = std::find_if(folders.begin(), folders.end(),
                               [&](const fs::path& folder) { return stated_name(folder) == package; });
  return it == folders.end() ? std::nullopt : std::optional(*it);
}

std::string quoted_name(const std::string& uri) {
  constexpr std::size_t most = 200;
  std::string r = cut_utf8(printable(uri), most);
  r.insert(r.begin(), '"');
  r.push_back('"');
  return r;
}

fs::path checked_below(const fs::path& folder, const fs::path& relative, const std::string& uri,
                       const std::string& place) {
  const fs::path file = folder / relative;
  std::error_code ec;
  if (!fs::exists(file, ec))
    throw InputError(place, quoted_name(uri) + ": there is no file " + printable(file.string()));
  if (!is_below(file, folder))
    throw InputError(place, quoted_name(uri) + " leads out of the folder " + printable(folder.string()) +
                                "; files are read from the file's own folder and --package-path only");
  try {
    require_regular_file(file);
  } catch (const InputError& e) {
    throw InputError(place, e.what());
  }
  return file;
}

}  // namespace

bool is_mesh_file(const fs::path& file) {
  static constexpr auto known =
      std::to_array<std::string_view>({".obj", ".stl", ".ply", ".dae", ".gltf", ".glb"});
  return std::find(known.begin(), known.end(), lower_extension(file)) != known.end();
}

void ImportContext::refuse(const std::string& place, const std::string& reason) {
  if (!options_.lenient) throw InputError(place, reason);
  notes_.push_back({place, reason});
}

void ImportContext::refuse(const XmlElement& e, const std::string& reason) {
  refuse(e.place(), e.said(reason));
}

fs::path ImportContext::in_package(const std::string& rest, const std::string& place) const {
  const std::size_t slash = rest.find('/');
  const std::string package = rest.substr(0, slash);
  if (slash == std::string::npos || package.empty() || slash + 1 == rest.size())
    throw InputError(place, quoted_name(rest) + " names no file in a package");
  const fs::path inside = rest.substr(slash + 1);
  if (package == ".." || has_parent_step(inside) || inside.is_absolute())
    throw InputError(place, quoted_name(rest) + " must not lead out of its package");
  for (const fs::path& dir : options_.package_paths) {
    std::error_code ec;
    const fs::path named = dir / package;
    if (fs::is_directory(named, ec) && is_below(named, dir)) return checked_below(named, inside, rest, place);
    const fs::path own = fs::canonical(dir, ec);
    if (!ec && own.filename() == package) return checked_below(dir, inside, rest, place);
  }
  for (const fs::path& dir : options_.package_paths)
    if (const auto stated = folder_that_states(package, dir))
      return checked_below(*stated, inside, rest, place);
  throw InputError(place, "package " + printable(package) +
                              " is in none of the folders given by --package-path DIR (the folder that "
                              "holds it, or the package itself)");
}

fs::path ImportContext::resolve(const std::string& uri, const fs::path& folder,
                                const std::string& place) const {
  for (const std::string_view scheme : {"package://", "model://"})
    if (uri.starts_with(scheme)) return in_package(uri.substr(scheme.size()), place);
  if (uri.find("://") != std::string::npos)
    throw InputError(place, quoted_name(uri) + ": only package://, model:// and relative paths are read");
  const fs::path relative = uri;
  if (uri.empty() || uri.find('\0') != std::string::npos) throw InputError(place, "names no file");
  if (relative.is_absolute())
    throw InputError(place, quoted_name(uri) + " is an absolute path; only relative paths are read");
  if (has_parent_step(relative)) throw InputError(place, quoted_name(uri) + " must not contain \"..\"");
  return checked_below(folder.empty() ? fs::path(".") : folder, relative, uri, place);
}

Shape ImportContext::mesh(const fs::path& file, const Vec3& scale, bool convex, const std::string& place) {
  if (!is_mesh_file(file))
    throw InputError(place, printable(file.filename().string()) +
                                ": meshes are read from obj, stl, ply, dae, gltf and glb");
  const auto [it, is_new] = meshes_.try_emplace(file.string());
  if (is_new) try {
      MeshImport how;
      how.keep_up_axis = true;
      it->second = load_mesh(file, how);
    } catch (const InputError& e) {
      meshes_.erase(it);
      if (e.place() == place) throw;  // the mesh is what was asked for
      throw InputError(place, e.what());
    }
  TriangleMesh mesh = it->second;
  for (Vec3& v : mesh.vertices) v = v.cwiseProduct(scale);
  if (scale.prod() < 0)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  Shape shape =
      convex || options_.convex_meshes ? Shape(make_hull(std::move(mesh.vertices))) : Shape(std::move(mesh));
  try {
    validate(shape);
  } catch (const InputError& e) {
    throw InputError(place, e.what());
  }
  return shape;
}

}  // namespace touchstone
