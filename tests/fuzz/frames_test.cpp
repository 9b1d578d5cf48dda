// Motions in frames: the bound of a motion, what counts as flicker, lying engines, and the core.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "core/math/rng.h"
#include "core/narrow/narrow_phase.h"
#include "fuzz/judge/flicker.h"
#include "fuzz/judge/frames.h"
#include "oracles/core/core_engine.h"
#include "reports/stability/motions.h"
#include "scenarios/handmade/scenario.h"
#include "scenarios/random/motions.h"
#include "tests/mutants/motion_lies.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

Case make_motion(const fuzz::MotionRow& row, std::uint64_t seed, int frames) {
  Rng rng(seed);
  Case c;
  row.make(rng, frames, c);
  c.family = row.name;
  c.id = std::string(row.name) + "/" + std::to_string(seed);
  return c;
}

Case scenario(std::string_view name) {
  for (const auto& s : scenarios::catalog())
    if (s.name == name) return s.make();
  FAIL("no scenario " << name);
  return {};
}

// Every body a sixteenth nearer to one wall.
Case off_centre() {
  Case c = scenario("cube_in_a_shaft");
  for (Step& s : c.scene.script)
    if (s.pose) s.pose->translation.x() += 0x1p-4;
  c.scene.bodies[1].pose.translation.x() += 0x1p-4;
  c.family = "cube_in_a_shaft_off_centre";
  return c;
}

std::vector<Case> motions_of(std::string_view name) {
  if (name == "cube_in_a_shaft") return {scenario(name)};
  if (name == "cube_in_a_shaft_off_centre") return {off_centre()};
  std::vector<Case> all;
  for (const fuzz::MotionRow& row : fuzz::motion_rows())
    for (std::uint64_t seed = 0; row.name == name && seed < 3; ++seed)
      all.push_back(make_motion(row, seed, 12));
  return all;
}

std::uint64_t found(const fuzz::MotionResult& r, std::string_view kind) {
  if (kind == "wrong") return r.wrong;
  if (kind == "state") return r.state_differs;
  for (std::size_t k = 0; k < flicker_count; ++k)
    if (flicker_names[k] == kind) return r.flickers[k];
  FAIL("no kind " << kind);
  return 0;
}

bool cannot_forget(Engine&) { return false; }

fuzz::MotionResult follow(const std::vector<Case>& motions, const EnginePtr& engine,
                          const fuzz::Forget& forget) {
  fuzz::MotionResult sum;
  for (const Case& c : motions) sum.merge(fuzz::follow(c, {&engine, 1}, forget, true).at(0));
  return sum;
}

// The number of points that clearly are corners carried along by one of the bodies, each of which must keep
// its id.
std::size_t same_points(const Scene& before, const Scene& after, const Query& q, const ContactAnswer& was,
                        const ContactAnswer& is) {
  constexpr double same = 1e-9, other = 1e-3;
  if (was.manifold.size() != is.manifold.size() || is.manifold.size() < 2) return 0;
  std::size_t n = 0;
  for (const fuzz::Carried& way : fuzz::carried(before, after, q.a, q.b))
    for (const ContactPoint& p : is.manifold) {
      const auto distance = [&](const ContactPoint& x) {
        return (way.point(x.position) - p.position).norm();
      };
      const auto near = [&](double most) {
        return std::count_if(was.manifold.begin(), was.manifold.end(),
                             [&](const ContactPoint& x) { return distance(x) <= most; });
      };
      if (near(same) != 1 || near(other) != 1) continue;
      const auto found = std::find_if(was.manifold.begin(), was.manifold.end(),
                                      [&](const ContactPoint& x) { return distance(x) <= same; });
      CHECK(found->feature == p.feature);
      ++n;
    }
  return n;
}

// A body in the ground, by default a cube with half-extents 1, and the points that an engine states of the
// contact, each as deep as the whole.
struct Sunk {
  Pose pose;
  double depth = 0;
  std::vector<Vec3> points;
  Shape shape = Box{Vec3::Ones()};
};

std::ptrdiff_t flickers_of(Flicker kind, const Sunk& before, const Sunk& after) {
  Scene scene;
  scene.shapes = {HalfSpace{Vec3::UnitZ(), 0}, before.shape};
  scene.bodies.resize(2);
  scene.bodies[1].shape = 1;
  const auto answer = [](const Sunk& body) {
    Observation o;
    o.outcome = Outcome::answered;
    o.overlap = true;
    o.normal = Vec3::UnitZ();
    o.depth = body.depth;
    for (const Vec3& p : body.points) o.manifold.push_back({p, body.depth});
    return o;
  };
  const Observation stated[2] = {answer(before), answer(after)};
  Scene scenes[2] = {scene, scene};
  scenes[0].bodies[1].pose = before.pose;
  scenes[1].bodies[1].pose = after.pose;
  fuzz::Truth was(scenes[0]), is(scenes[1]);
  const fuzz::FrameChange change =
      fuzz::change_between({was, stated[0]}, {is, stated[1]}, {Question::contact, 0, 1},
                           EngineCard{"test", "", "", "", 0x1p-53, 64, ""}, 1);
  return std::ranges::count(change.flickers, kind, &FlickerReport::flicker);
}

}  // namespace

TEST_CASE("a motion has as many frames as queries, its bodies where the script puts them", "[frames]") {
  for (const fuzz::MotionRow& row : fuzz::motion_rows()) {
    INFO(row.name);
    const Case c = make_motion(row, 1, 9);
    validate(c.scene);
    const auto frames = fuzz::frames_of(c);
    REQUIRE(frames.size() == 9);
    CHECK(frames[0].scene.bodies == c.scene.bodies);
    for (const Case& f : frames) {
      CHECK(f.scene.script.empty());
      CHECK(f.queries.size() == c.queries.size() - 1);  // without the candidates
    }
    for (std::size_t k = 1; k < frames.size(); ++k)
      CHECK(frames[k].scene.bodies.back().pose != frames[k - 1].scene.bodies.back().pose);
  }
}

TEST_CASE("a frame has no questions about bodies that are not there", "[frames]") {
  Case c = scenario("slides_off_a_table");
  c.scene.script.push_back({Step::Op::remove, 1, std::nullopt});
  c.scene.script.push_back({});
  const auto frames = fuzz::frames_of(c);
  CHECK(frames.back().queries.empty());
  CHECK(frames.front().queries.size() == 3);
}

TEST_CASE("a bound of the motion holds for widths in every direction", "[frames]") {
  Rng rng(4);
  double tightest = 0;
  for (int i = 0; i < 400; ++i) {
    const auto rows = fuzz::motion_rows();
    const Case c = make_motion(rows[rng.below(rows.size())], rng.next(), 6);
    const auto frames = fuzz::frames_of(c);
    const auto k = 1 + rng.below(frames.size() - 1);
    const Query q = c.queries[0];
    if (kind_of(c.scene.shape_of(q.a)) == ShapeKind::half_space) continue;  // a width in one direction only
    const fuzz::Truth before(frames[k - 1].scene), after(frames[k].scene);
    for (const fuzz::Carried& way : fuzz::carried(frames[k - 1].scene, frames[k].scene, q.a, q.b))
      for (int d = 0; d < 20; ++d) {
        const Vec3 n = rng.unit_vector();
        const referee::Bracket was = before.width(0, q.a, q.b, n),
                               is = after.width(0, q.a, q.b, way.turn * n);
        CHECK(std::max(is.lo - was.hi, was.lo - is.hi) <= way.change);
        if (way.change > 1e-6) tightest = std::max(tightest, std::abs(is.hi - was.hi) / way.change);
      }
  }
  CHECK(tightest > 0.9);  // the bound is not idle
  // A small shift far away, along which the bound is reached: only its roundings are left.
  Scene before = scenario("cube_in_a_shaft").scene, after = before;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 shift = rng.vector(1e-3, 1);
    before.bodies[0].pose.rotation = after.bodies[0].pose.rotation = rng.rotation();
    before.bodies[1].pose.translation = rng.vector(500, 1000);
    after.bodies[1].pose.translation = before.bodies[1].pose.translation + shift;
    const fuzz::Truth was(before), is(after);
    for (const fuzz::Carried& way : fuzz::carried(before, after, 0, 1)) {
      const Vec3 n = (before.bodies[1].pose.translation - after.bodies[1].pose.translation).normalized();
      const referee::Bracket w0 = was.width(0, 0, 1, n), w1 = is.width(0, 0, 1, way.turn * n);
      CHECK(w1.lo - w0.hi <= way.change);
    }
  }
}

TEST_CASE("a jump of the normal is true, tied or needless by what both normals need now", "[frames]") {
  const auto change = [](double x_before, double x_after, const Vec3& was, const Vec3& is) {
    Case c = scenario("cube_in_a_shaft");
    auto frames = fuzz::frames_of(c);
    frames[0].scene.bodies[1].pose.translation = Vec3(x_before, 0, 0);
    frames[1].scene.bodies[1].pose.translation = Vec3(x_after, 0, 0);
    Observation o[2];
    for (int k = 0; k < 2; ++k) {
      o[k].outcome = Outcome::answered;
      o[k].overlap = true;
      o[k].normal = k == 0 ? was : is;
    }
    fuzz::Truth before(frames[0].scene), after(frames[1].scene);
    return fuzz::change_between({before, o[0]}, {after, o[1]}, {Question::contact, 0, 1},
                                EngineCard{"test", "", "", "", 0x1p-53, 64, ""}, 1);
  };
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();
  CHECK(change(-0x1p-4, 0x1p-4, -x, x).true_switch);
  CHECK(change(-0x1p-4, 0x1p-4, -x, x).flickers.empty());
  CHECK(change(0x1p-5, 0x1p-4, x, x).flickers.empty());
  REQUIRE(change(0x1p-5, 0x1p-4, x, y).flickers.size() == 1);
  CHECK(change(0x1p-5, 0x1p-4, x, y).flickers[0].flicker == Flicker::needless);
  REQUIRE(change(0x1p-5, 0, x, y).flickers.size() == 1);
  CHECK(change(0x1p-5, 0, x, y).flickers[0].flicker == Flicker::tied);
  CHECK(change(0, 0, x, Vec3(1, 0x1p-10, 0).normalized()).flickers.empty());  // the same side
}

TEST_CASE("a point may come or go at the surface, but not below it", "[frames]") {
  // A cube sinks into the ground from one depth to another; so many of its corners are stated as points.
  const auto sunk = [](double depth, std::size_t n) {
    Sunk cube{{Vec3(0, 0, 1 - depth), {}}, depth, {}};
    for (std::size_t i = 0; i < n; ++i) cube.points.push_back(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, 0));
    return cube;
  };
  const auto counts = [&](double depth_before, double depth_after, std::size_t n_before,
                          std::size_t n_after) {
    return flickers_of(Flicker::count, sunk(depth_before, n_before), sunk(depth_after, n_after));
  };
  constexpr double step = 0x1p-10;
  CHECK(counts(0, step, 2, 4) == 0);  // two corners were above the ground and are now below it
  CHECK(counts(step, 0, 4, 2) == 0);
  CHECK(counts(0, step, 4, 2) == 1);
  CHECK(counts(step, 0, 2, 4) == 1);
  for (const auto& [before, after] : {std::pair(step / 8, step), std::pair(8 * step, 9 * step)})
    for (const std::size_t n : {1, 2, 3}) {
      CHECK(counts(before, after, n, 4) == 1);
      CHECK(counts(before, after, 4, n) == 1);
      CHECK(counts(after, before, n, 4) == 1);
      CHECK(counts(before, after, 4, 4) == 0);
    }
}

TEST_CASE("points may go with corners that rise above a threshold, but not come with them", "[frames]") {
  // A cube rocks on one edge, in the ground. The corners of the opposite edge are at this height
  // above the lower ones, before and after; all points are stated as if they were equally deep.
  const auto rocked = [](double height, std::size_t n) {
    constexpr double depth = 0.01;
    const double angle = std::asin(height / 2);
    const Quat turn{0, std::sin(angle / 2), 0, std::cos(angle / 2)};  // x sinks
    Sunk cube{{Vec3(0, 0, std::sin(angle) + std::cos(angle) - depth), turn}, depth, {}};
    for (std::size_t i = 0; i < n; ++i) cube.points.push_back(Vec3(i & 2 ? -1 : 1, i & 1 ? 1 : -1, 0));
    return cube;
  };
  const auto counts = [&](double height_before, double height_after, std::size_t n_before,
                          std::size_t n_after) {
    return flickers_of(Flicker::count, rocked(height_before, n_before), rocked(height_after, n_after));
  };
  constexpr double low = 5.0e-4, high = 5.2e-4;
  CHECK(counts(low, high, 4, 2) == 0);
  CHECK(counts(high, low, 2, 4) == 0);
  CHECK(counts(low, high, 2, 4) == 1);
  CHECK(counts(high, low, 4, 2) == 1);
  CHECK(counts(low, low, 2, 4) == 1);
  CHECK(counts(low, high, 4, 4) == 0);
}

TEST_CASE("a point may move inside the hull of the others, but not be left out of it", "[frames]") {
  constexpr double depth = 0x1p-6;
  const auto cube = [](std::vector<Vec3> points) {
    return Sunk{{Vec3(0, 0, 1 - depth), {}}, depth, std::move(points)};
  };
  const Vec3 a(-1, -1, 0), b(1, -1, 0), c(1, 1, 0), d(-1, 1, 0), inside(0.5, 0.25, 0), other(-0.5, 0, 0);
  const auto moved = [&](const Sunk& before, const Sunk& after) {
    return flickers_of(Flicker::points, before, after);
  };
  CHECK(moved(cube({a, b, c, d, inside}), cube({a, b, c, d, other})) == 0);
  CHECK(moved(cube({a, b, c, inside}), cube({a, b, d, inside})) == 1);
  CHECK(moved(cube({a, b, c, d}), cube({a, b, c, inside})) == 1);
  CHECK(moved(cube({inside}), cube({other})) == 1);
  CHECK(moved(cube({a, b}), cube({a, inside})) == 1);
}

TEST_CASE("the points of a rim may be any, as long as they span it", "[frames]") {
  constexpr double depth = 0x1p-6;
  const auto disc = [](int n, double turn) {
    Sunk s{{Vec3(0, 0, 1 - depth), {}}, depth, {}, Cylinder{1, 1}};
    for (int k = 0; k < n; ++k) {
      const double angle = turn + 2 * std::numbers::pi * k / n;
      s.points.emplace_back(std::cos(angle), std::sin(angle), 0);
    }
    return s;
  };
  const auto flickers = [](const Sunk& before, const Sunk& after) {
    return flickers_of(Flicker::count, before, after) + flickers_of(Flicker::points, before, after);
  };
  CHECK(flickers(disc(24, 0), disc(24, 0.1)) == 0);
  CHECK(flickers(disc(24, 0), disc(23, 0)) == 0);
  CHECK(flickers(disc(4, 0), disc(4, 0.5)) == 1);
  CHECK(flickers(disc(4, 0), disc(3, 0)) == 1);
  CHECK(flickers(disc(24, 0), disc(12, 0)) == 1);
  CHECK(flickers(disc(1, 0), disc(1, 3)) == 1);
}

TEST_CASE("engines that lie about motions are found, each by what it does", "[frames][mutants]") {
  const auto& lies = mutants::motion_lies();
  CHECK(lies.size() >= 8);
  std::set<std::string_view> kinds;
  for (const mutants::MotionLie& lie : lies) {
    INFO(lie.name);
    kinds.insert(lie.found);
    const EnginePtr engine = mutants::make_motion_liar(lie);
    const fuzz::MotionResult r = follow(motions_of(lie.motion), engine, mutants::forget_motion);
    CHECK(found(r, lie.found) > 0);
    if (!lie.is_wrong) CHECK(r.wrong == 0);
    CHECK(r.state_asked > 0);
    const auto shown = [&](const fuzz::MotionEvidence& e) { return e.kind == lie.found; };
    CHECK(std::any_of(r.evidence.begin(), r.evidence.end(), shown));
  }
  for (const std::string_view name : flicker_names) {
    INFO(name);
    CHECK(kinds.contains(name));
  }
}

TEST_CASE("the core keeps its normals and points where the truth does", "[frames][core]") {
  const EnginePtr core = make_core_engine();
  fuzz::MotionResult sum;
  for (const fuzz::MotionRow& row : fuzz::motion_rows()) {
    INFO(row.name);
    const fuzz::MotionResult r = follow(motions_of(row.name), core, cannot_forget);
    CHECK(r.wrong + r.failed == 0);
    CHECK(found(r, "needless") == 0);
    CHECK(found(r, "depth") == 0);
    CHECK(found(r, "verdict") == 0);
    CHECK(found(r, "count") == 0);
    CHECK(found(r, "points") == 0);
    CHECK(found(r, "ids") == 0);
    CHECK(r.changes > 0);
    sum.merge(r);
  }
  CHECK(sum.switches > 0);  // there are motions in which a normal has to jump
  const fuzz::MotionResult shaft = follow({scenario("cube_in_a_shaft")}, core, cannot_forget);
  CHECK(shaft.flicker_sum() == 0);
  const fuzz::MotionResult table = follow({scenario("slides_off_a_table")}, core, cannot_forget);
  CHECK(table.switches == 1);
  CHECK(table.flicker_sum() == 0);
}

TEST_CASE("ids of the core's points stay where the points do", "[frames][core]") {
  std::size_t compared = 0;
  for (const fuzz::MotionRow& row : fuzz::motion_rows())
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const Case c = make_motion(row, seed, 24);
      const auto frames = fuzz::frames_of(c);
      const Query q = c.queries[0];
      std::optional<ContactAnswer> was;
      for (std::size_t k = 0; k < frames.size(); ++k) {
        const Scene& s = frames[k].scene;
        const auto placed = [&](int b) {
          return PlacedShape{&s.shape_of(b), s.bodies[static_cast<std::size_t>(b)].pose};
        };
        const ContactAnswer is = contact(placed(q.a), placed(q.b));
        if (was) compared += same_points(frames[k - 1].scene, s, q, *was, is);
        was = is;
      }
    }
  CHECK(compared > 300);
}

TEST_CASE("the same seed gives the same motions", "[frames]") {
  for (const fuzz::MotionRow& row : fuzz::motion_rows())
    CHECK(make_motion(row, 5, 7) == make_motion(row, 5, 7));
}
