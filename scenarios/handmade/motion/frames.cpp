// Motions in frames: the queries of a script. `touchstone stability --motion NAME` judges every frame and
// what changes between them.
#include "scenarios/handmade/build.h"
#include "scenarios/handmade/lists.h"

namespace touchstone::scenarios {
namespace {

constexpr double depth = 0x1p-6;

// A stays where it is; B takes the poses in turn. The expectation is about the first.
Scenario in_frames(const std::string& name, const std::string& line, Part a, Part b,
                   const std::vector<Pose>& poses, Expectation e) {
  b.pose = poses.front();
  Scene s = scene_of(name, {std::move(a), std::move(b)});
  for (const int body : {0, 1}) s.script.push_back({Step::Op::insert, body, std::nullopt});
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (k > 0) s.script.push_back({Step::Op::move, 1, poses[k]});
    s.script.push_back({});
  }
  return scenario("motion", name, line, std::move(s), std::move(e));
}

// Over the border of a table, x = 1. The way out along x is shorter than that along z from frame 17 on, and
// never as long.
Scenario slides_off_a_table() {
  constexpr double step = 0x1p-10, start = 1.25 - 0x1p-5 - step / 2;
  constexpr int frames = 48;  // 15 of them beyond the border
  std::vector<Pose> poses;
  Expectation e = gap_is(-depth, 0, Vec3::UnitZ(), "2^-6 below the top; off the table beyond x = 1.25");
  for (int k = 0; k < frames; ++k) {
    poses.push_back(at(start + k * step, 0, 0.25 - depth));
    e.pairs_at_query.push_back(k <= 32 ? std::vector<BodyPair>{{0, 1}} : std::vector<BodyPair>{});
  }
  return in_frames("slides_off_a_table", "the normal of a sliding cube changes once, at the border",
                   {Box{Vec3(1, 1, 0.25)}, at(0, 0, -0.25), {}}, {Box{Vec3(0.25, 0.25, 0.25)}, {}, {}}, poses,
                   e);
}

// Four normals are equally good in every frame, so that none has a reason to change.
Scenario cube_in_a_shaft() {
  constexpr int frames = 12;  // short of the end of the shaft
  std::vector<Pose> poses;
  poses.reserve(frames);
  for (int k = 0; k < frames; ++k) poses.push_back(at(0, 0, k / 16.0));
  return in_frames("cube_in_a_shaft", "four best normals tie in every frame; an engine should keep one",
                   {Box{Vec3(1, 1, 4)}, {}, {}}, {Box{Vec3(0.5, 0.5, 0.5)}, {}, {}}, poses,
                   gap_is(-1.5, 0, Vec3::UnitX(), "half widths 1 + 0.5 along x and y, both signs"));
}

// The edge of the cube stays where it is, from face on face to edge on face.
Scenario cube_tips_over() {
  std::vector<Pose> poses;
  for (int k = 0; k <= 8; ++k) {
    const Quat q{0, k / 16.0, 0, 1};
    const Vec3 edge = rotation_matrix(q) * Vec3(0.5, 0, -0.5);
    poses.push_back({Vec3(0.5, 0, -depth) - edge, q});
  }
  return in_frames("cube_tips_over", "a cube tips over its edge: the normal stays, the points become two",
                   {HalfSpace{Vec3(0, 0, 1), 0}, {}, {}}, {Box{Vec3(0.5, 0.5, 0.5)}, {}, {}}, poses,
                   gap_is(-depth, 0, Vec3::UnitZ(), "its lowest face is 2^-6 below the plane"));
}

}  // namespace

List motion_frames() { return {slides_off_a_table(), cube_in_a_shaft(), cube_tips_over()}; }

}  // namespace touchstone::scenarios
