#include "fuzz/certify/bodies.h"

#include "fuzz/generate/family.h"
#include "fuzz/generate/numbers.h"

namespace touchstone::fuzz {
namespace {

bool is_unbounded(const Scene& s, int body) { return kind_of(s.shape_of(body)) == ShapeKind::half_space; }

// A subject of floats is asked in floats: what it cannot hold says nothing of its broad phase.
void round_to(Scalar scalar, Case& c) {
  if (scalar == Scalar::float64) return;
  for (double* x : numbers(c)) *x = nearest(*x, scalar);
  renew(c);
}

// The ground is put in only where it is what is asked about.
void of_family(const Draw& d, std::uint64_t index, std::string_view family, bool grounded, Case& out) {
  out.scene = make_case(d.seed, index, family).scene;
  Scene& s = out.scene;
  for (Body& b : s.bodies) b.motion.reset();
  if (s.script.empty()) insert_all(s), step_query(s);
  if (!grounded)
    std::erase_if(s.script,
                  [&](const Step& step) { return step.op != Step::Op::query && is_unbounded(s, step.body); });
  out.queries = {{Question::candidates, -1, -1}};
  round_to(d.scalar, out);
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

void family_tiles(const Draw& d, std::uint64_t i, Case& out) { of_family(d, i, "tiles", false, out); }
void family_errands(const Draw& d, std::uint64_t i, Case& out) { of_family(d, i, "errands", false, out); }
void family_script(const Draw& d, std::uint64_t i, Case& out) { of_family(d, i, "script", false, out); }
void family_throng(const Draw& d, std::uint64_t i, Case& out) { of_family(d, i, "throng", false, out); }
void family_crowd(const Draw& d, std::uint64_t i, Case& out) { of_family(d, i, "crowd", false, out); }

void grounded(const Draw& d, std::uint64_t index, Case& out) {
  of_family(d, index, "tiles", true, out);
  Scene& s = out.scene;
  for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i)
    if (is_unbounded(s, i)) return;
  Body ground;
  ground.shape = static_cast<int>(s.shapes.size());
  ground.is_static = true;
  ground.pose.translation = s.bodies[0].pose.translation;
  s.shapes.push_back(HalfSpace{Vec3::UnitZ(), 0});
  s.bodies.push_back(std::move(ground));
  s.script.insert(s.script.begin(), {Step::Op::insert, static_cast<int>(s.bodies.size()) - 1, std::nullopt});
}

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
  round_to(d.scalar, out);
}

}  // namespace touchstone::fuzz
