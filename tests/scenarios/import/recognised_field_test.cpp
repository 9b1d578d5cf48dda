// Which meshes are passed to engines as height fields.
#include "oracles/abi/height_field.h"

#include <limits>
#include <vector>

#include "core/math/rng.h"
#include "scenarios/codec/scene_codec.h"
#include "scenarios/import/height_field.h"
#include "scenarios/value/height_surface.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

TriangleMesh hills(std::size_t rows, std::size_t columns, double dx, double dy) {
  return centred_height_surface(rows, columns, dx, dy, [](std::size_t r, std::size_t c) {
    return 0.25 * static_cast<double>((3 * r + c) % 4);
  });
}

}  // namespace

TEST_CASE("the height fields of scenes are recognised, with cells of any size") {
  Rng rng(1);
  for (int i = 0; i < 2000; ++i) {
    const std::size_t rows = 2 + rng.below(40), columns = 2 + rng.below(40);
    const double dx = rng.binary_scale(-30, 20), dy = rng.uniform(0.001, 1000);
    const auto f = kit::height_field_of(hills(rows, columns, dx, dy));
    REQUIRE(f);
    CHECK(f->rows == rows);
    CHECK(f->columns == columns);
    CHECK(f->cell[0] == Approx(dx).epsilon(1e-14));
    CHECK(f->cell[1] == Approx(dy).epsilon(1e-14));
  }
}

TEST_CASE("a scene's height_field is the mesh that is recognised") {
  const Scene s = scene_from_text(
      R"({"touchstone_scene": 1, "shapes": [{"type": "height_field", "cell": [0.1, 0.3],
          "heights": [[0, 1, 0.5], [2, 0, 0.25]]}], "bodies": [{"shape": 0}]})",
      "s");
  const auto f = kit::height_field_of(*triangles_if(s.shapes[0]));
  REQUIRE(f);
  CHECK((f->rows == 2 && f->columns == 3));
  CHECK(f->cell[0] == Approx(0.1).epsilon(1e-14));
  CHECK(f->cell[1] == Approx(0.3).epsilon(1e-14));
}

TEST_CASE("so are those of imported files") {
  const HeightGrid grid{3, 7, {0, 1, 0.5F, 0.25F, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0.125F, 1, 1, 0}};
  const auto f = kit::height_field_of(surface_of(grid, 1.7, 0.3, 0.9));
  REQUIRE(f);
  CHECK((f->rows == 3 && f->columns == 7));
  CHECK(f->cell[0] == Approx(3.4 / 6).epsilon(1e-14));
}

TEST_CASE("no other mesh is taken for a height field") {
  const TriangleMesh good = hills(3, 4, 0.5, 0.25);
  REQUIRE(kit::height_field_of(good));
  const auto refused = [&](auto change) {
    TriangleMesh m = good;
    change(m);
    return !kit::height_field_of(m);
  };
  CHECK(refused([](TriangleMesh& m) { m.triangles.pop_back(); }));
  CHECK(refused([](TriangleMesh& m) { std::swap(m.triangles[3], m.triangles[4]); }));
  CHECK(refused([](TriangleMesh& m) { std::swap(m.triangles[2][0], m.triangles[2][1]); }));
  CHECK(refused([](TriangleMesh& m) { m.vertices[5].x() += 1e-9; }));
  CHECK(refused([](TriangleMesh& m) { m.vertices[11].y() -= 1e-9; }));
  CHECK(refused([](TriangleMesh& m) { m.vertices.emplace_back(0, 0, 0); }));
  CHECK(refused([](TriangleMesh& m) {
    for (Vec3& v : m.vertices) v.x() += 0.125;  // not centred
  }));
  CHECK(refused([](TriangleMesh& m) {
    for (Vec3& v : m.vertices) v.x() = v.x() < -0.5 ? v.x() - 0.125 : v.x();  // uneven
  }));
  CHECK(refused([](TriangleMesh& m) {
    for (Vec3& v : m.vertices) v.x() = -v.x();
  }));
  CHECK(refused([](TriangleMesh& m) {
    for (Vec3& v : m.vertices) v.y() = 0;
  }));
  CHECK(refused([](TriangleMesh& m) { m.vertices[6].z() = std::numeric_limits<double>::infinity(); }));
  CHECK_FALSE(kit::height_field_of(TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}));
  CHECK_FALSE(kit::height_field_of(
      TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}}));
}
