// Broad phases against brute force, and boxes against the exact bodies.
#include <algorithm>
#include <limits>

#include "core/broad/body_box.h"
#include "core/broad/catalog.h"
#include "core/world/world.h"
#include "tests/core/least_width.h"
#include "tests/core/random_pair.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::broad;
using namespace touchstone::test;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

Aabb random_box(Rng& r, bool lattice) {
  Aabb b;
  for (int k = 0; k < 3; ++k) {
    const double c = lattice ? static_cast<double>(r.below(6)) : r.uniform(0, 6);
    const double s = lattice ? static_cast<double>(r.below(3)) : r.uniform(0, 2);
    b.lo[k] = c;
    b.hi[k] = c + s;
  }
  if (r.chance(0.03)) b.lo[static_cast<long>(r.below(3))] = -inf;
  if (r.chance(0.03)) b.hi[static_cast<long>(r.below(3))] = inf;
  return b;
}

struct Placed {
  Shape shape;
  Pose pose;  // its quaternion has any length
};

Placed random_body(Rng& r) {
  Placed p{random_shape(r, static_cast<ShapeKind>(r.below(7)), r.chance(0.3)), {}};
  p.pose = {r.unit_vector() * r.binary_scale(-20, 40), r.rotation()};
  const double k = r.binary_scale(-300, 300);
  Quat& q = p.pose.rotation;
  q = {q.x * k, q.y * k, q.z * k, q.w * k};
  return p;
}

}  // namespace

TEST_CASE("every broad phase reports the pairs of brute force after inserts, moves and removals", "[broad]") {
  long pairs = 0, tests = 0;
  for (const CatalogRow& row : catalog)
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      Rng r(seed);
      const auto subject = row.make(), reference = make_brute_force();
      std::vector<int> present;
      for (int step = 0; step < 80; ++step) {
        const Aabb box = random_box(r, seed % 2 == 0);
        if (present.empty() || r.chance(0.6)) {
          subject->insert(step, box);
          reference->insert(step, box);
          present.push_back(step);
        } else if (r.chance(0.6)) {
          const int id = present[r.below(present.size())];
          subject->move(id, box);
          reference->move(id, box);
        } else {
          const auto k = static_cast<long>(r.below(present.size()));
          subject->remove(present[static_cast<std::size_t>(k)]);
          reference->remove(present[static_cast<std::size_t>(k)]);
          present.erase(present.begin() + k);
        }
        std::vector<IdPair> a, b;
        subject->pairs(a);
        reference->pairs(b);
        REQUIRE(a == b);
        REQUIRE(std::is_sorted(a.begin(), a.end()));
        subject->validate();
        pairs += static_cast<long>(a.size());
        tests += static_cast<long>(present.size() * (present.size() - 1) / 2);
      }
    }
  INFO(pairs << " pairs of " << tests);
  CHECK(pairs > tests / 50);
  CHECK(pairs < tests);
}

TEST_CASE("an invalid box is refused and nothing else is lost", "[broad]") {
  for (const CatalogRow& row : catalog) {
    const auto phase = row.make();
    const Aabb unit{Vec3::Zero(), Vec3::Ones()}, inverted{Vec3::Ones(), Vec3::Zero()};
    Aabb nan = unit;
    nan.hi.y() = std::numeric_limits<double>::quiet_NaN();
    phase->insert(1, unit);
    phase->insert(2, unit);
    CHECK_THROWS_AS(phase->insert(3, nan), Refused);
    CHECK_THROWS_AS(phase->move(2, inverted), Refused);
    CHECK_THROWS_AS(phase->insert(1, unit), Refused);
    CHECK_THROWS_AS(phase->remove(7), Refused);
    std::vector<IdPair> out;
    phase->pairs(out);
    CHECK(out == std::vector<IdPair>{{1, 2}});
    phase->validate();
  }
}

TEST_CASE("boxes contain the exact body and exceed it by a few ulps", "[broad][box]") {
  long checked = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Rng r(seed);
    const auto [shape, pose] = random_body(r);
    const Aabb box = body_box(shape, pose);
    const WideMat rot = wide_rotation(pose.rotation);
    for (int axis = 0; axis < 3; ++axis) {
      const WideVec row = rot.row(axis).transpose();
      const Wide hi = pose.translation[axis] + height_along(shape, row),
                 lo = pose.translation[axis] - height_along(shape, -row);
      CHECK(static_cast<Wide>(box.hi[axis]) >= hi);
      CHECK(static_cast<Wide>(box.lo[axis]) <= lo);
      const Wide size = abs(hi) + abs(lo) + 2;
      CHECK(box.hi[axis] - hi <= 0x1p-52L * size);
      CHECK(lo - box.lo[axis] <= 0x1p-52L * size);
      ++checked;
    }
  }
  CHECK(checked == 6000);
}

TEST_CASE("loose boxes contain ellipsoids of any size", "[broad]") {
  Rng r(17);
  for (const int e : {-1020, -700, -520, -300, 0, 300, 520, 1000})
    for (int i = 0; i < 20; ++i) {
      const double unit = std::ldexp(1.0, e);
      const Shape shape = Ellipsoid{(r.vector(0.5, 1).cwiseAbs() + Vec3::Constant(0.1)) * unit};
      const Pose pose{r.chance(0.5) ? Vec3(Vec3::Zero()) : Vec3(r.vector(0.1, 1) * unit), r.rotation()};
      const Aabb box = loose_box(shape, pose, box_size(shape)), tight = body_box(shape, pose);
      INFO("2^" << e);
      CHECK((box.lo.array() <= tight.lo.array()).all());
      CHECK((box.hi.array() >= tight.hi.array()).all());
    }
}

TEST_CASE("loose boxes contain the exact body too, at rest and in motion", "[broad][box]") {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Rng r(seed);
    const auto [shape, pose] = random_body(r);
    const Aabb box = loose_box(shape, pose, box_size(shape)), tight = body_box(shape, pose);
    const double size = box_size(shape);
    const Vec3 slack = 0x1p-45 * (pose.translation.cwiseAbs() + Vec3::Constant(size));
    const WideMat rot = wide_rotation(pose.rotation);
    for (int axis = 0; axis < 3; ++axis) {
      const WideVec row = rot.row(axis).transpose();
      CHECK(static_cast<Wide>(box.hi[axis]) >= pose.translation[axis] + height_along(shape, row));
      CHECK(static_cast<Wide>(box.lo[axis]) <= pose.translation[axis] - height_along(shape, -row));
      CHECK(box.hi[axis] <= tight.hi[axis] + slack[axis]);
      CHECK(box.lo[axis] >= tight.lo[axis] - slack[axis]);
    }
    const Motion motion{r.unit_vector() * r.binary_scale(-10, 10) * size, r.unit_vector() * r.uniform(0, 7)};
    const Aabb swept = loose_swept_box(box, pose, motion, bounding_radius(shape));
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      // pose_at rounds, so its body's box is shrunk by more than that.
      const Pose then = pose_at(pose, motion, t);
      const Aabb at_t = body_box(shape, then);
      const Vec3 rounding = 0x1p-46 * (then.translation.cwiseAbs() + motion.linear.cwiseAbs() +
                                       pose.translation.cwiseAbs() + Vec3::Constant(8 * size));
      for (int axis = 0; axis < 3; ++axis) {
        CHECK(swept.lo[axis] <= at_t.lo[axis] + rounding[axis]);
        CHECK(swept.hi[axis] >= at_t.hi[axis] - rounding[axis]);
      }
    }
  }
}

TEST_CASE("exact rational boxes: a 3-4-5 rotation by a non-unit quaternion", "[broad][box]") {
  // q = (0,0,1,2): cos = 3/5, sin = 4/5. The corner (5,5,5) goes to x = -1..7: 5·(3+4)/5 = 7 exactly.
  const Aabb box = body_box(Box{{5, 5, 5}}, {Vec3(0x1p40, 0, 0), {0, 0, 1, 2}});
  CHECK(box.hi.x() >= 0x1p40 + 7);
  CHECK(box.hi.x() <= 0x1p40 + 7 + 0x1p-11);
  CHECK(box.lo.y() <= -7);
  CHECK(box.lo.y() >= -7 - 0x1p-49);
}

TEST_CASE("a half-space is infinite except towards a face perpendicular to an axis", "[broad][box]") {
  const Aabb flat = body_box(HalfSpace{{0, 0, 2}, 3}, {Vec3(1, 2, 4), {}});
  CHECK(flat.hi.z() >= 5.5);
  CHECK(flat.hi.z() < 5.5000001);
  CHECK(flat.lo.z() == -inf);
  CHECK(flat.hi.x() == inf);
  const Aabb turned = body_box(HalfSpace{{0, 0, 2}, 3}, {Vec3(1, 2, 4), {1, 0, 0, 0}});
  CHECK(turned.lo.z() <= 2.5);
  CHECK(turned.hi.z() == inf);
  CHECK(body_box(HalfSpace{{0, 1, 2}, 3}, {}).hi.z() == inf);
}

TEST_CASE("swept boxes contain the body at all times", "[broad][box]") {
  long checked = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Rng r(seed);
    const Shape shape = random_shape(r, static_cast<ShapeKind>(r.below(7)), false);
    const Pose pose{r.unit_vector() * r.uniform(0, 100), r.rotation()};
    const double angle = std::pow(10, r.uniform(-4, 2.5));
    const Motion m{r.unit_vector() * r.uniform(0, 10),
                   r.chance(0.7) ? Vec3(r.unit_vector() * angle) : Vec3::Zero()};
    const Aabb box = swept_box(shape, pose, m);
    for (int k = 0; k <= 20; ++k) {
      const WideFrame f = wide_frame_at(pose, m, k / Wide(20));
      for (int axis = 0; axis < 3; ++axis, ++checked) {
        const WideVec row = f.rotation.row(axis).transpose();
        CHECK(static_cast<Wide>(box.hi[axis]) >= f.translation[axis] + height_along(shape, row) - 1e-14);
        CHECK(static_cast<Wide>(box.lo[axis]) <= f.translation[axis] - height_along(shape, -row) + 1e-14);
      }
    }
  }
  CHECK(checked == 300 * 21 * 3);
}

TEST_CASE("a body that rotates slightly has a swept box slightly larger than its box", "[broad][box]") {
  const Box rod{Vec3(0.1, 0.2, 4)};
  const Aabb still = body_box(rod, {}), turned = swept_box(rod, {}, {Vec3::Zero(), Vec3(0, 0, 1e-3)}),
             far = swept_box(rod, {}, {Vec3::Zero(), Vec3(0, 0, 100)});
  const double way = 1e-3 * bounding_radius(rod);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(turned.hi[axis] >= still.hi[axis]);
    CHECK(turned.hi[axis] <= still.hi[axis] + way * (1 + 1e-12));
    CHECK(far.hi[axis] >= 4.0);
    CHECK(far.hi[axis] <= bounding_radius(rod) * (1 + 1e-12));
  }
}

TEST_CASE("a scene's candidates leave out filtered and static pairs; contacts are those that overlap",
          "[world]") {
  Scene s;
  s.shapes = {Sphere{1}};
  s.bodies.resize(4);
  for (int i = 0; i < 4; ++i) s.bodies[static_cast<std::size_t>(i)].pose.translation = Vec3(1.5 * i, 0, 0);
  s.bodies[0].is_static = s.bodies[1].is_static = true;
  s.ignored = {{2, 3}};
  const auto phase = make_broad_phase("sort_and_sweep");
  CHECK(candidate_pairs(s, *phase) == std::vector<std::vector<BodyPair>>{{{1, 2}}});
  const auto fresh = make_broad_phase("brute_force");
  const SceneContacts c = scene_contacts(s, *fresh);
  REQUIRE(c.contacts.size() == 1);
  CHECK(c.contacts[0].a == 1);
  CHECK(c.contacts[0].contact.depth == Approx(0.5).margin(1e-15));
  CHECK(c.contacts[0].contact.normal.x() == Approx(1).margin(1e-15));
  CHECK(make_broad_phase("no such") == nullptr);
}
