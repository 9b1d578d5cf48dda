#include "scenarios/import/real_scene.h"

#include <algorithm>
#include <cmath>

#include "core/base/input_error.h"
#include "scenarios/import/pose_algebra.h"
#include "scenarios/import/text_lines.h"
#include "scenarios/text/printable.h"

namespace touchstone {
namespace {

using Row = std::span<const double>;

Vec3 vec3_of(Row row, std::size_t first) { return {row[first], row[first + 1], row[first + 2]}; }
Pose pose_of(Row row) { return {vec3_of(row, 0), {row[3], row[4], row[5], row[6]}}; }

Vec3 shortest_rotation(const Quat& from, const Quat& to) {
  const Quat f = normalized(from);
  Quat d = normalized(to) * Quat{-f.x, -f.y, -f.z, f.w};
  if (d.w < 0) d = {-d.x, -d.y, -d.z, -d.w};
  const Vec3 v(d.x, d.y, d.z);
  const double sine = v.stableNorm();
  return sine > 0 ? Vec3(v * (2 * std::atan2(sine, d.w) / sine)) : Vec3::Zero();
}

struct BodyStep {
  Pose start, end;
  Motion motion;
};

Motion motion_of_geom(const BodyStep& step, const Pose& geom) {
  Motion m = step.motion;
  if (!geom.translation.isZero(0))
    m.linear = compose(step.end, geom).translation - compose(step.start, geom).translation;
  return m;
}

void require_frame(const RealScene& s, int f) {
  if (f < 0 || f >= s.frame_count())
    throw InputError(s.name,
                     "frame " + std::to_string(f) + " is outside 0.." + std::to_string(s.frame_count() - 1));
}

Row row(const RealScene& s, int f, std::size_t body) {
  return s.poses.row(static_cast<std::size_t>(f), body);
}

Pose pose_at_frame(const RealScene& s, std::size_t body, int f) {
  return s.bodies[body].is_static ? s.bodies[body].pose : pose_of(row(s, f, body));
}

// The geoms of recorded body i are the scene's bodies from first[i] on.
std::vector<int> first_geom(const RealScene& s) {
  std::vector<int> first{0};
  for (const RealBody& b : s.bodies) first.push_back(first.back() + static_cast<int>(b.geoms.size()));
  return first;
}

std::vector<BodyPair> ignored_geoms(const RealScene& s) {
  const std::vector<int> first = first_geom(s);
  std::vector<BodyPair> r;
  for (auto [a, b] : s.ignored) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    for (int ga = first[i]; ga < first[i + 1]; ++ga)
      for (int gb = first[j]; gb < first[j + 1]; ++gb) r.emplace_back(ga, gb);
  }
  std::sort(r.begin(), r.end());
  return r;
}

std::optional<BodyStep> step_of(const RealScene& s, std::size_t body, int f) {
  if (s.bodies[body].is_static) return std::nullopt;
  BodyStep step;
  step.start = pose_at_frame(s, body, f);
  if (s.has_velocities()) {
    const Row r = row(s, f, body);
    step.motion = {vec3_of(r, 7) * real_scene_time_step, vec3_of(r, 10) * real_scene_time_step};
    step.end = pose_at(step.start, step.motion, 1);
    return step;
  }
  if (!s.is_followed(f)) return std::nullopt;
  step.end = pose_at_frame(s, body, f + 1);
  step.motion = {step.end.translation - step.start.translation,
                 shortest_rotation(step.start.rotation, step.end.rotation)};
  return step;
}

void check_rotations(const RealScene& s, const std::string& file) {
  for (std::size_t f = 0; f < s.poses.shape[0]; ++f)
    for (std::size_t b = 0; b < s.poses.shape[1]; ++b) {
      const Quat q = pose_of(s.poses.row(f, b)).rotation;
      if (q.x == 0 && q.y == 0 && q.z == 0 && q.w == 0)
        throw InputError(file,
                         "frame " + std::to_string(f) + ", body " + std::to_string(b) + ": zero quaternion");
    }
}

// "frame,window,label,sim_frame,time" or "frame,segment,kind": the first three columns have the same meaning.
std::vector<RealFrame> read_frames(const std::filesystem::path& file, int count) {
  TextLines in(file, ',');
  in.need("a header");
  if (in.token(0) != "frame" || in.token_count() < 3) in.fail("expected a header frame,<segment>,<label>");
  std::vector<RealFrame> frames;
  while (in.next()) {
    if (in.integer(0) != static_cast<int>(frames.size()))
      in.fail("frames must be numbered from 0 without gaps");
    frames.push_back({in.integer(1), printable(in.token(2))});
  }
  if (static_cast<int>(frames.size()) != count)
    in.fail("has " + std::to_string(frames.size()) + " frames, scene.txt announces " + std::to_string(count));
  return frames;
}

}  // namespace

bool RealScene::is_followed(int f) const {
  return f >= 0 && f + 1 < frame_count() &&
         frames[static_cast<std::size_t>(f)].segment == frames[static_cast<std::size_t>(f) + 1].segment;
}

Scene RealScene::frame(int f) const {
  require_frame(*this, f);
  Scene scene;
  scene.name = name + "/" + std::to_string(f);
  scene.shapes = shapes;
  scene.ignored = ignored_geoms(*this);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const RealBody& b = bodies[i];
    const Pose pose = pose_at_frame(*this, i, f);
    const bool many = b.geoms.size() > 1;
    for (std::size_t k = 0; k < b.geoms.size(); ++k) {
      Body body;
      body.name = many ? b.name + "#" + std::to_string(k) : b.name;
      body.shape = b.geoms[k].shape;
      body.pose = compose(pose, b.geoms[k].in_body);
      body.is_static = b.is_static;
      body.group = many ? static_cast<int>(i) : -1;
      scene.bodies.push_back(std::move(body));
    }
  }
  return scene;
}

Scene RealScene::frame_with_motion(int f) const {
  Scene scene = frame(f);
  std::size_t next = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::optional<BodyStep> step = step_of(*this, i, f);
    for (const RealGeom& g : bodies[i].geoms) {
      if (step) scene.bodies[next].motion = motion_of_geom(*step, g.in_body);
      ++next;
    }
  }
  return scene;
}

Scene RealScene::script(int first, int last) const {
  Scene scene = frame(first);
  require_frame(*this, last);
  scene.name = name + "/" + std::to_string(first) + "-" + std::to_string(last);
  const int count = static_cast<int>(scene.bodies.size());
  for (int b = 0; b < count; ++b) scene.script.push_back({Step::Op::insert, b, std::nullopt});
  scene.script.push_back({});
  for (int f = first + 1; f <= last; ++f) {
    int geom = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      for (const RealGeom& g : bodies[i].geoms) {
        if (!bodies[i].is_static)
          scene.script.push_back({Step::Op::move, geom, compose(pose_at_frame(*this, i, f), g.in_body)});
        ++geom;
      }
    scene.script.push_back({});
  }
  return scene;
}

RealScene load_real_scene(const std::filesystem::path& directory) {
  RealSceneText text = read_real_scene_text(directory / "scene.txt");
  RealScene s = std::move(text.scene);
  const std::filesystem::path file = directory / "frames.npy";
  s.poses = load_npy3(file);
  const std::array<std::size_t, 3> expected{static_cast<std::size_t>(text.frames),
                                            static_cast<std::size_t>(text.moving),
                                            static_cast<std::size_t>(text.columns)};
  if (s.poses.shape != expected)
    throw InputError(file.string(), "its shape is not the one that scene.txt announces");
  check_rotations(s, file.string());
  s.frames = read_frames(directory / "frames.csv", text.frames);
  return s;
}

}  // namespace touchstone
