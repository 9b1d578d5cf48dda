#include "scenarios/handmade/build.h"

#include "scenarios/codec/case_codec.h"

namespace touchstone::scenarios {

Scene scene_of(const std::string& name, std::vector<Part> parts) {
  Scene s;
  s.name = name;
  for (Part& p : parts) {
    Body b;
    b.shape = static_cast<int>(s.shapes.size());
    b.pose = p.pose;
    b.motion = p.motion;
    b.is_static = !is_convex(kind_of(p.shape));
    s.shapes.push_back(std::move(p.shape));
    s.bodies.push_back(std::move(b));
  }
  return s;
}

Scenario scenario(std::string folder, std::string name, std::string line, Scene scene, Expectation expect) {
  Case c;
  c.id = folder + "/" + name;
  c.family = "scenario";
  scene.name = name;
  c.queries = default_queries(scene);
  c.scene = std::move(scene);
  return {std::move(name), std::move(folder), std::move(line), [c = std::move(c)] { return c; },
          std::move(expect)};
}

Scenario pair(std::string folder, std::string name, std::string line, Part a, Part b, Expectation expect) {
  Scene s = scene_of(name, {std::move(a), std::move(b)});
  return scenario(std::move(folder), std::move(name), std::move(line), std::move(s), std::move(expect));
}

Expectation gap_is(double value, double tolerance, const Vec3& normal, std::string reason) {
  Expectation e;
  if (value > tolerance) e.overlap = false;
  if (value <= -tolerance) e.overlap = true;  // with tolerance 0, touching counts as well
  e.gap = {value, tolerance};
  e.normal = normal;
  e.reason = std::move(reason);
  return e;
}

Expectation hit_at(double time, double tolerance, std::string reason) {
  Expectation e;
  e.impact = {true, time, tolerance};
  e.reason = std::move(reason);
  return e;
}

Expectation no_hit(std::string reason) {
  Expectation e;
  e.impact = {false, 0, 0};
  e.reason = std::move(reason);
  return e;
}

Expectation counts(int all, std::optional<int> boxes, int overlapping, std::string reason) {
  Expectation e;
  e.all_pairs = all;
  e.box_pairs = boxes;
  e.overlapping_pairs = overlapping;
  e.reason = std::move(reason);
  return e;
}

}  // namespace touchstone::scenarios
