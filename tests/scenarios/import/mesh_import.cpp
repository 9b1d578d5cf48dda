// Meshes from files: geometry as written, or a reason for refusing the file.
#include "scenarios/import/mesh_import.h"

#include <cstring>

#include "core/shape/shape.h"
#include "tests/scenarios/import/expect_error.h"
#include "tests/scenarios/import/temp_dir.h"

using namespace touchstone;
using test::contains;
using test::refusal;

namespace {

constexpr const char* cube_obj =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

double area(const TriangleMesh& m) {
  double sum = 0;
  for (const auto& [i, j, k] : m.triangles) {
    const Vec3 &a = m.vertices[static_cast<std::size_t>(i)], &b = m.vertices[static_cast<std::size_t>(j)],
               &c = m.vertices[static_cast<std::size_t>(k)];
    sum += (b - a).cross(c - a).norm() / 2;
  }
  return sum;
}

std::string binary_stl(std::uint32_t facets) {
  std::string s(80, ' ');
  s.append(reinterpret_cast<const char*>(&facets), 4);
  for (std::uint32_t i = 0; i < facets; ++i) {
    const float f[12] = {
        0, 0, 1, 0, 0, static_cast<float>(i), 1, 0, static_cast<float>(i), 0, 1, static_cast<float>(i)};
    s.append(reinterpret_cast<const char*>(f), sizeof f).append(2, '\0');
  }
  return s;
}

}  // namespace

TEST_CASE("a cube of quads becomes twelve triangles on eight vertices", "[scene][mesh]") {
  const test::TempDir dir;
  const TriangleMesh m = load_mesh(dir.write("cube.obj", cube_obj));
  CHECK(m.vertices.size() == 8);
  CHECK(m.triangles.size() == 12);
  CHECK(area(m) == 6);
  validate(Shape(m));
}

TEST_CASE("a binary STL keeps its facets, joined or not", "[scene][mesh]") {
  const test::TempDir dir;
  const auto file = dir.write("three.stl", binary_stl(3));
  const TriangleMesh joined = load_mesh(file), loose = load_mesh(file, {.join_vertices = false});
  CHECK(joined.vertices.size() == 9);
  CHECK(loose.triangles.size() == 3);
  CHECK(area(loose) == 1.5);
  CHECK(area(joined) == 1.5);
  const auto twice = dir.write("twice.stl", [] {
    std::string s = binary_stl(2);
    s.replace(84 + 50, 50, s.substr(84, 50));
    return s;
  }());
  CHECK(load_mesh(twice).vertices.size() == 3);
  CHECK(load_mesh(twice, {.join_vertices = false}).vertices.size() == 6);
}

TEST_CASE("a file that is not a mesh is refused with name and reason", "[scene][mesh][bad-input]") {
  const test::TempDir dir;
  const auto said = [](const std::filesystem::path& f) {
    const std::string s = refusal([&] { load_mesh(f); });
    CHECK(contains(s, f.string()));
    return s;
  };
  CHECK(contains(said(dir.path() / "none.obj"), "no such file"));
  CHECK(contains(said(dir.path()), "is a directory"));
  CHECK(contains(said(dir.write("empty.obj", "")), "is empty"));
  CHECK(said(dir.write("text.obj", "this is no mesh at all\nreally\n")) != "(accepted)");
  CHECK(said(dir.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n")) != "(accepted)");
  CHECK(said(dir.write("line.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n")) != "(accepted)");
  CHECK(said(dir.write("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n")) != "(accepted)");
  CHECK(contains(said(dir.write("huge.obj", "v 1e300 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")), "not finite"));
  // assimp reads such a header for ever.
  CHECK(
      contains(said(dir.write("endless.ply",
                              "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                              "property float z\nend_heade\n0 0 0\n1 0 0\n0 1 0\n")),
               "does not stop at the end of the file"));
  // assimp ends the process on faces without corners.
  CHECK(
      contains(said(dir.write("faceless.ply",
                              "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                              "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                              "end_header\n0 0 0\n1 0 0\n0 1 0\n0\n")),
               "its reader crashed (Aborted)"));
  CHECK(contains(said(dir.write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")), "not finite"));
}

TEST_CASE("a file that asks for terabytes is refused", "[scene][mesh][bad-input]") {
  const test::TempDir dir;
  const auto file = dir.write("list.ply",
                              "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                              "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                              "end_header\n0 0 0\n1 0 0\n0 1 0\n999999999993 0 1 2\n");
  const std::string s = refusal([&] { load_mesh(file); });
  CHECK(contains(s, file.string()));
  // A sanitizer ends the reader instead.
  CHECK((contains(s, "more memory than is allowed") || contains(s, "ended without a result")));
}

TEST_CASE("a truncated binary STL is refused at every length", "[scene][mesh][bad-input]") {
  const test::TempDir dir;
  const std::string whole = binary_stl(4);
  int refused = 0, tried = 0;
  for (std::size_t n = 0; n < whole.size(); n += 7, ++tried)
    refused += refusal([&] { load_mesh(dir.write("cut.stl", whole.substr(0, n))); }) != "(accepted)";
  CHECK(tried > 30);
  CHECK(refused == tried);
  CHECK_NOTHROW(load_mesh(dir.write("cut.stl", whole)));
}
