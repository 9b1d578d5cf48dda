#include "scenarios/exhaustive/suites.h"

#include "scenarios/random/family.h"
#include "scenarios/random/numbers.h"

namespace touchstone::fuzz {
namespace {

bool is_unbounded(const Scene& s, int body) { return kind_of(s.shape_of(body)) == ShapeKind::half_space; }

// A float subject gets float coordinates: what it cannot represent says nothing about its broad phase.
void round_to(Scalar scalar, Case& c) {
  if (scalar == Scalar::float64) return;
  for (double* x : numbers(c)) *x = nearest(*x, scalar);
  renew(c);
}

// The ground is included only in the cases that test it.
void of_family(const Draw& d, std::uint64_t index, std::string_view family, bool grounded, Case& out) {
  out.scene = make_case(d.seed, index, family).scene;
  Scene& s = out.scene;
  for (Body& b : s.bodies) b.motion.reset();
  if (s.script.empty()) {
    insert_all(s);
    step_query(s);
  }
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

namespace {

// Two bodies of which the first moves; the other is on its path or slightly off it.
void swept_case(const Draw& d, Body first, const Shape& other, const Vec3& at, Case& out) {
  Scene& s = out.scene;
  Body second;
  first.shape = 0;
  second.shape = 1;
  second.pose.translation = at;
  s.shapes.push_back(other);
  s.bodies = {std::move(first), std::move(second)};
  out.queries = {{Question::swept_candidates, -1, -1}};
  round_to(d.scalar, out);
}

// A ball for the first body to meet: its distance from the point `way` of the path is up to 1.6 times the
// touching distance.
void drift_case(const Draw& d, Rng& rng, const Vec3& start, const Vec3& travel, Case& out) {
  out.scene.shapes.push_back(slender(rng));
  Body first;
  first.pose = {start, rng.rotation()};
  first.motion = Motion{travel, Vec3::Zero()};
  const double radius = rng.uniform(0.05, 0.3), way = rng.uniform(0.1, 1.0);
  const Vec3 aside = rng.vector(0, 1.2);
  swept_case(d, std::move(first), Sphere{radius}, start + way * travel + aside, out);
}

}  // namespace

void drifting_on_an_axis(const Draw& d, std::uint64_t index, Case& out) {
  Rng rng = Rng::stream(d.seed + 13, index);
  const int axis = static_cast<int>(index % 3);
  const double length = rng.uniform(1, 8), sign = rng.sign();
  const Vec3 start = rng.vector(0, 2);
  drift_case(d, rng, start, Vec3::Unit(axis) * (sign * length), out);
}

void drifting(const Draw& d, std::uint64_t index, Case& out) {
  Rng rng = Rng::stream(d.seed + 14, index);
  const Vec3 start = rng.vector(0, 2), travel = rng.vector(1, 8);
  drift_case(d, rng, start, travel, out);
}

// Thousands of lengths per step, from near or far; the ball is near the path of the body's centre.
void fast_and_far(const Draw& d, std::uint64_t index, Case& out) {
  Rng rng = Rng::stream(d.seed + 15, index);
  const Vec3 from = rng.unit_vector(), along = rng.unit_vector();
  const double far = rng.binary_scale(2, 10), fast = rng.binary_scale(4, 12);
  const Vec3 start = from * far, travel = along * fast;
  drift_case(d, rng, start, travel, out);
  if (rng.chance(0.3)) out.scene.bodies[0].motion->angular = rng.vector(0.5, 40);
  round_to(d.scalar, out);
}

void turning_in_place(const Draw& d, std::uint64_t index, Case& out) {
  Rng rng = Rng::stream(d.seed + 16, index);
  out.scene.shapes.push_back(slender(rng));
  const double reach = bounding_radius(out.scene.shapes[0]);
  Body first;
  first.pose.rotation = rng.rotation();
  first.motion = Motion{Vec3::Zero(), rng.vector(0.5, 12)};
  const double radius = rng.uniform(0.02, 0.15);
  swept_case(d, std::move(first), Sphere{radius}, rng.vector(0.6 * reach, 1.1 * reach), out);
}

// The small body is somewhere in the shell through which the slender one's ends pass, so that about half
// meet.
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
  out.queries = {{Question::swept_candidates, -1, -1}};
  round_to(d.scalar, out);
}

}  // namespace touchstone::fuzz
