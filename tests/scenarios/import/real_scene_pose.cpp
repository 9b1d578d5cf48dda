// The geometry of recorded scenes: composition of poses, and motion that leads from one frame to the next.
#include "core/math/rng.h"
#include "scenarios/import/fcl_motion.h"
#include "scenarios/import/real_scene.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

// Two frames of one moving body with two geoms, columns 7 or 13.
RealScene two_frames(Rng& rng, std::size_t columns) {
  RealScene s;
  s.name = "two";
  s.shapes = {Sphere{1}};
  RealBody b{"link", false, {}, {{0, Pose{}}, {0, Pose{rng.unit_vector(), rng.rotation()}}}};
  s.bodies = {b};
  s.frames = {{0, "path"}, {0, "path"}};
  s.poses.shape = {2, 1, columns};
  for (int f = 0; f < 2; ++f) {
    const Vec3 p = rng.unit_vector() * 3;
    const Quat q = rng.rotation();
    s.poses.values.insert(s.poses.values.end(), {p.x(), p.y(), p.z(), q.x, q.y, q.z, q.w});
    for (std::size_t c = 7; c < columns; ++c) s.poses.values.push_back(rng.uniform(-100, 100));
  }
  return s;
}

double distance(const Pose& a, const Pose& b) {
  return (rotation_matrix(a.rotation) - rotation_matrix(b.rotation)).norm() +
         (a.translation - b.translation).norm();
}

}  // namespace

TEST_CASE("motion from pose pairs leads every geom to its pose in the next frame", "[scene][readers]") {
  Rng rng(5);
  int checked = 0;
  double worst = 0;
  for (int i = 0; i < 500; ++i) {
    const RealScene s = two_frames(rng, 7);
    const Scene now = s.frame_with_motion(0), next = s.frame(1);
    for (std::size_t b = 0; b < 2; ++b, ++checked) {
      REQUIRE(now.bodies[b].motion);
      CHECK(now.bodies[b].motion->angular.norm() <= 3.1415926535897936);  // the shortest arc
      worst = std::max(worst,
                       distance(pose_at(now.bodies[b].pose, *now.bodies[b].motion, 1), next.bodies[b].pose));
    }
    CHECK(!s.frame_with_motion(1).bodies[0].motion);
  }
  CHECK(checked == 1000);
  CHECK(worst < 1e-13);  // coordinates up to 4: some 100 roundings of 2^-53
}

TEST_CASE("motion from recorded velocities is one sixtieth of them, and geoms stay on their body",
          "[scene][readers]") {
  Rng rng(6);
  int checked = 0;
  for (int i = 0; i < 500; ++i, ++checked) {
    const RealScene s = two_frames(rng, 13);
    const Scene now = s.frame_with_motion(1);
    const auto r = s.poses.row(1, 0);
    const Motion& m = *now.bodies[0].motion;
    CHECK(m.linear == Vec3(r[7], r[8], r[9]) * real_scene_time_step);
    CHECK(m.angular == Vec3(r[10], r[11], r[12]) * real_scene_time_step);
    const Pose a = pose_at(now.bodies[0].pose, m, 1),
               b = pose_at(now.bodies[1].pose, *now.bodies[1].motion, 1);
    const Vec3 offset_now = now.bodies[1].pose.translation - now.bodies[0].pose.translation;
    const Vec3 in_body = rotation_matrix(now.bodies[0].pose.rotation).transpose() * offset_now;
    CHECK((a.translation + rotation_matrix(a.rotation) * in_body - b.translation).norm() < 1e-13);
  }
  CHECK(checked == 500);
}

TEST_CASE("a geom at its body's origin has exactly the recorded pose", "[scene][readers]") {
  Rng rng(7);
  const RealScene s = two_frames(rng, 7);
  const auto r = s.poses.row(0, 0);
  CHECK(s.frame(0).bodies[0].pose == Pose{Vec3(r[0], r[1], r[2]), {r[3], r[4], r[5], r[6]}});
}

TEST_CASE("the quaternion of a rotation matrix reproduces the matrix", "[scene][readers]") {
  Rng rng(8);
  double worst = 0;
  int near_half_turn = 0;
  for (int i = 0; i < 2000; ++i) {
    Quat q = rng.rotation();
    if (i % 2) {
      q.w *= 1e-9;
      ++near_half_turn;
    }
    const Mat3 m = rotation_matrix(q);
    worst = std::max(worst, (rotation_matrix(quaternion_of(m)) - m).cwiseAbs().maxCoeff());
  }
  CHECK(near_half_turn == 1000);
  CHECK(worst < 4e-15);
}
