#include "fuzz/certify/bodies.h"

#include "fuzz/generate/family.h"

namespace touchstone::fuzz {
namespace {

void of_family(const Draw& d, std::uint64_t index, std::string_view family, Case& out) {
  out.scene = make_case(d.seed, index, family).scene;
  for (Body& b : out.scene.bodies) b.motion.reset();
  if (out.scene.script.empty()) insert_all(out.scene), step_query(out.scene);
  out.queries = {{Question::candidates, -1, -1}};
}

Shape slender(Rng& rng) {
  const double length = rng.uniform(0.5, 2), width = rng.uniform(0.02, 0.4);
  switch (rng.below(3)) {
    case 0:
      return Box{{width, width * rng.uniform(0.5, 1), length}};
    case 1:
      return Capsule{width, length};
    default:
      return make_hull(
          {{width, 0, -length}, {-width, width, -length}, {-width, -width, -length}, {0, 0, length}});
  }
}

}  // namespace

void family_tiles(const Draw& d, std::uint64_t i, Case& out) { of_family(d, i, "tiles", out); }
void family_errands(const Draw& d, std::uint64_t i, Case& out) { of_family(d, i, "errands", out); }
void family_script(const Draw& d, std::uint64_t i, Case& out) { of_family(d, i, "script", out); }
void family_throng(const Draw& d, std::uint64_t i, Case& out) { of_family(d, i, "throng", out); }
void family_crowd(const Draw& d, std::uint64_t i, Case& out) { of_family(d, i, "crowd", out); }

// The small body stands somewhere in the shell that the slender one's ends pass, so that about half meet.
void turning_pairs(const Draw& d, std::uint64_t index, Case& out) {
  Rng rng = Rng::stream(d.seed + 12, index);
  Scene& s = out.scene;
  s.shapes.push_back(slender(rng));
  s.shapes.push_back(Sphere{rng.uniform(0.05, 0.3)});
  Body long_one, small_one;
  long_one.pose.rotation = rng.rotation();
  Motion turn;
  turn.angular = rng.vector(0.5, 12);
  if (rng.chance(0.5)) turn.linear = rng.vector(0, 1.5);
  long_one.motion = turn;
  small_one.shape = 1;
  const double reach = bounding_radius(s.shapes[0]);
  small_one.pose.translation = rng.vector(0.5 * reach, 1.15 * reach);
  s.bodies = {long_one, small_one};
  insert_all(s), step_query(s);
  out.queries = {{Question::candidates, -1, -1}};
}

}  // namespace touchstone::fuzz
