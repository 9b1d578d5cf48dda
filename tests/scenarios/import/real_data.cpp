// The recorded and published data, when present, reads completely and has the counts that its inventory
// states.
#include <set>

#include "scenarios/import/broadphase_sets.h"
#include "scenarios/import/ccd_queries.h"
#include "scenarios/import/fcl_motion.h"
#include "scenarios/import/hull_zoo.h"
#include "scenarios/import/mesh_import.h"
#include "scenarios/import/real_scene.h"
#include "tests/support/catch.h"
#include "tests/support/shared_data.h"
#include "tests/support/skip.h"

using namespace touchstone;

namespace {

const std::filesystem::path data_root = test::shared_data();

struct Expected {
  const char* name;
  std::size_t shapes, bodies, moving;
  int frames;
  std::size_t columns;
};

constexpr Expected scenes[] = {{"debris_drift", 929, 1200, 1200, 40, 13},
                               {"husky_house", 476, 549, 5, 240, 7},
                               {"kuka_lwr_box", 11, 15, 8, 320, 7},
                               {"kuka_lwr_cell", 7, 65, 64, 240, 7},
                               {"panda_bookshelf_small_0", 14, 19, 11, 316, 7},
                               {"panda_bookshelf_small_1", 14, 19, 11, 236, 7},
                               {"panda_bookshelf_small_2", 14, 19, 11, 252, 7},
                               {"panda_table", 18, 23, 11, 320, 7},
                               {"pile_mixed", 865, 1005, 1000, 100, 13},
                               {"stack_smash", 10, 604, 603, 90, 13}};

}  // namespace

TEST_CASE("every recorded scene can be read, and its first and last frames are valid", "[scene][data]") {
  if (!std::filesystem::exists(data_root)) return test::skip(data_root.string() + " is absent");
  int checked = 0;
  for (const Expected& e : scenes) {
    INFO(e.name);
    const RealScene s = load_real_scene(data_root / "scenes" / e.name);
    CHECK(!s.name.empty());
    CHECK(s.shapes.size() == e.shapes);
    CHECK(s.bodies.size() == e.bodies);
    CHECK(s.poses.shape[1] == e.moving);
    CHECK(s.frame_count() == e.frames);
    CHECK(s.poses.shape[2] == e.columns);
    for (int f : {0, s.frame_count() - 1}) {
      const Scene scene = s.frame_with_motion(f);
      CHECK_NOTHROW(validate(scene));
      CHECK(scene.bodies.size() >= e.bodies);
      std::size_t in_motion = 0;
      for (const Body& b : scene.bodies) {
        in_motion += b.motion.has_value();
        CHECK((!b.motion || !b.is_static));
      }
      CHECK((in_motion == 0) == (!s.has_velocities() && !s.is_followed(f)));
    }
    const Scene script = s.script(0, 2);
    CHECK_NOTHROW(validate(script));
    int queries = 0;
    for (const Step& step : script.script) queries += step.op == Step::Op::query;
    CHECK(queries == 3);
    ++checked;
  }
  CHECK(checked == 10);
}

TEST_CASE("the hull zoo and the point clouds are read completely", "[scene][data]") {
  if (!std::filesystem::exists(data_root)) return test::skip(data_root.string() + " is absent");
  const auto zoo = load_hull_zoo(data_root / "hulls");
  CHECK(zoo.size() == 647);
  std::set<std::string> categories;
  int solid = 0;
  for (const ZooHull& h : zoo) {
    categories.insert(h.category);
    const Hull hull = make_hull(h.vertices);
    solid += hull.dimension == 3;
  }
  CHECK(categories.size() > 8);
  CHECK(solid == 647);  // the zoo is certified strictly convex, however thin
  CHECK(load_point_clouds(data_root / "hulls" / "jolt_clouds.bin").size() == 3377);
}

TEST_CASE("the continuous-collision queries are read exactly, with their truth", "[scene][data]") {
  if (!std::filesystem::exists(data_root)) return test::skip(data_root.string() + " is absent");
  const auto queries = load_ccd_set(data_root / "ccd");
  CHECK(queries.size() == 7418);
  int hits = 0, published = 0, agree = 0;
  for (const CcdQuery& q : queries) {
    REQUIRE(q.truth);
    hits += q.truth->collides;
    published += q.truth->source_truth.has_value();
    agree += q.truth->collides == q.file_truth;
  }
  CHECK(hits == 191 + 1245);
  CHECK(published == 4443 + 191);
  CHECK(agree == 7418);
}

TEST_CASE("the broad-phase sets, meshes and two-body motions are read completely", "[scene][data]") {
  if (!std::filesystem::exists(data_root)) return test::skip(data_root.string() + " is absent");
  const auto boxes = load_aabbs(data_root / "broadphase" / "bullet_32006GPUAABBs.csv");
  CHECK(boxes.size() == 32006);
  const Scene box_scene = scene_of_boxes(boxes);
  CHECK_NOTHROW(validate(box_scene));
  const auto atoms = load_atoms(data_root / "broadphase" / "atoms_1bhl.csv");
  CHECK(atoms.size() == 1101);
  const Scene atom_scene = scene_of_atoms(atoms);
  CHECK_NOTHROW(validate(atom_scene));
  CHECK(atom_scene.shapes.size() < 10);

  CHECK(load_mesh(data_root / "meshes" / "fcl_env.obj").triangles.size() == 2180);
  CHECK(load_mesh(data_root / "meshes" / "fcl_rob.obj").triangles.size() == 216);
  CHECK(load_mesh(data_root / "meshes" / "mbm_mug.stl").vertices.size() == 2395);
  CHECK(load_mesh(data_root / "meshes" / "bullet_torus.obj").triangles.size() >= 576);

  const FclMotion a = load_fcl_motion(data_root / "fcl_motions" / "manyframes_model1");
  CHECK(a.frame_count() == 501);
  CHECK(a.mesh_a.triangles.size() == 3322);
  CHECK(a.mesh_b.triangles.size() == 3564);
  CHECK_NOTHROW(validate(a.frame(500)));
  const FclMotion b = load_fcl_motion(data_root / "fcl_motions" / "model1_scenario1");
  CHECK(b.frame_count() == 2);
  for (const FclFrame& f : b.frames)
    CHECK((rotation_matrix(quaternion_of(f.a.matrix)) - f.a.matrix).cwiseAbs().maxCoeff() < 2e-6);
}
