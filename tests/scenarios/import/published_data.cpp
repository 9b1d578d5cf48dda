// The published data that is part of the repository reads completely.
#include "scenarios/import/ccd_queries.h"
#include "scenarios/import/mesh_import.h"
#include "scenarios/import/real_scene.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

const std::filesystem::path root = TS_SOURCE_DIR "/tests/data/published";

}  // namespace

TEST_CASE("published queries read with the verdicts that were decided for them", "[scene]") {
  const std::vector<CcdQuery> queries = load_ccd_set(root / "ccd");
  std::size_t hits = 0, disagree = 0;
  for (const CcdQuery& q : queries) {
    REQUIRE(q.truth);
    hits += q.truth->collides;
    disagree += q.file_truth != q.truth->collides;
  }
  CHECK(queries.size() == 223);
  CHECK(hits == 61);
  CHECK(disagree == 0);
}

TEST_CASE("a recorded robot reads, and all its frames are valid scenes", "[scene]") {
  const RealScene s = load_real_scene(root / "scenes/kuka_lwr_box");
  CHECK(s.shapes.size() == 11);
  CHECK(s.bodies.size() == 15);
  REQUIRE(s.frame_count() == 320);
  for (int f = 0; f < s.frame_count(); ++f) CHECK_NOTHROW(validate(s.frame_with_motion(f)));
}

TEST_CASE("a published mesh reads", "[scene]") {
  const TriangleMesh m = load_mesh(root / "meshes/fcl_rob.obj");
  CHECK(m.triangles.size() > 100);
  CHECK_NOTHROW(validate(Shape(m)));
}
