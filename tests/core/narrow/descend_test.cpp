// The search for a least depth that forms a curve or a surface: its parts, and both ways in which it ends.
#include "core/narrow/extended/descend.h"
#include "tests/core/narrow/convex_pair.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::test;
namespace extended = touchstone::narrow::extended;
using extended::EpaResult;
using extended::EpaStatus;

namespace {

EpaResult<Wide> explored(const ExtendedPair& p, int budget) {
  const auto g = extended::gjk<Wide>(p.a, p.b, p.tolerance(), p.touching(), 2000);
  REQUIRE((g.status == narrow::GjkStatus::enclosed || g.status == narrow::GjkStatus::touching));
  const auto e = extended::Epa<Wide>(p.a, p.b, p.size, p.tolerance()).run(g, budget);
  REQUIRE(e.status == EpaStatus::explored);
  return e;
}

struct Known {
  const char* name;
  ConvexPair pair;
  double depth;
};

std::vector<Known> rings() {
  const Shape drum = Cylinder{1, 5}, rod = Cylinder{0.5, 4};
  return {{"concentric balls", pair_at(Ellipsoid{{1, 1, 1}}, Ellipsoid{{2, 2, 2}}, {0, 0, 0}), 3},
          {"coaxial drums", pair_at(drum, rod, {0, 0, 1}), 1.5},
          {"concentric spheroids of one axis", pair_at(Ellipsoid{{1, 1, 3}}, Ellipsoid{{2, 2, 5}}, {0, 0, 0}),
           3}};
}

}  // namespace

TEST_CASE("descend: minimum of a function of one variable, smooth, with a kink, at an end, constant",
          "[narrow][descend]") {
  const auto least = [](Wide lo, Wide hi, auto&& f) {
    const auto [x, fx] = extended::detail::least_between<Wide>(lo, hi, 0, f);
    CHECK(fx == f(x));
    return std::pair{static_cast<double>(x), static_cast<double>(fx)};
  };
  // x is only resolved to the root of the resolution of f.
  const auto parabola = least(-1, 3, [](Wide x) { return Wide((x - 1) * (x - 1) + 2); });
  CHECK(parabola.first == Approx(1).epsilon(1e-9));
  CHECK(parabola.second == Approx(2).epsilon(1e-18));
  const auto kink = least(-1, 4, [](Wide x) { return x < 1 ? Wide(2 - x) : Wide(3 * x - 2); });
  CHECK(kink.first == Approx(1).epsilon(1e-15));
  CHECK(kink.second == Approx(1).epsilon(1e-15));
  const auto end = least(2, 3, [](Wide x) { return x; });
  CHECK(end.second == Approx(2).epsilon(1e-15));
  int calls = 0;
  const auto constant = least(0, 1, [&](Wide) {
    ++calls;
    return Wide(7);
  });
  CHECK(constant.second == 7);
  CHECK(calls <= 4);  // no interval is worth halving
  // An expectation of noise ends the search early, within the noise.
  const auto rough =
      extended::detail::least_between<Wide>(-1, 3, Wide(0.5), [](Wide x) { return Wide(x * x); });
  CHECK(static_cast<double>(rough.second) <= 0.5);
}

TEST_CASE("descend: the axis of a round core", "[narrow][descend]") {
  const auto axis = [](const Shape& s) {
    return on_core(convex_body<Wide>(s), [](const auto& core) { return core.round_axis(); });
  };
  CHECK(axis(Capsule{1, 2}) == 2);
  CHECK(axis(Cylinder{1, 2}) == 2);
  CHECK(axis(Cone{1, 2}) == 2);
  CHECK(axis(Box{{1, 1, 2}}) == -1);
  CHECK(axis(Sphere{1}) == -1);
  // Of an ellipsoid, the axis across the two lengths that differ least.
  CHECK(axis(Ellipsoid{{5, 2, 2.1}}) == 0);
  CHECK(axis(Ellipsoid{{2, 5, 2.1}}) == 1);
  CHECK(axis(Ellipsoid{{2, 2.1, 5}}) == 2);
}

TEST_CASE("descend: the least height over all meridians", "[narrow][descend]") {
  // Drums with a common axis: 1.5 across it, 5 + 4 − 1 along it. A third of the way over, along it is less.
  const Shape drum = Cylinder{1, 5}, rod = Cylinder{0.5, 4};
  for (const auto& [z, depth] : {std::pair{1.0, 1.5}, std::pair{8.0, 1.0}}) {
    const ExtendedPair p(pair_at(drum, rod, {0, 0, z}));
    const auto [n, h] =
        extended::detail::MeridianSearch<Wide>(p.a, p.b, WideVec(WideVec::UnitZ()), p.size).least();
    CHECK(static_cast<double>(h) == Approx(depth).epsilon(1e-15));
    CHECK(static_cast<double>(n.norm()) == Approx(1).epsilon(1e-15));
    CHECK(std::abs(static_cast<double>(n.z())) == Approx(z > 5 ? 1 : 0).margin(1e-8));
  }
}

TEST_CASE("descend: rings and spheres of minima close at the depth, with points that far apart",
          "[narrow][descend]") {
  for (const Known& k : rings()) {
    INFO(k.name);
    const ExtendedPair p(k.pair);
    const Wide tolerance = p.tolerance();
    auto e = explored(p, 60);
    const Wide proven = e.lower;
    extended::descend<Wide>(e, p.a, p.b, p.size, tolerance);
    REQUIRE(e.status == EpaStatus::closed);
    CHECK(static_cast<double>(e.upper) == Approx(k.depth).epsilon(1e-14));
    CHECK(e.lower == proven);  // what is proven for all directions is not claimed beyond
    CHECK(static_cast<double>((e.a - e.b).norm()) == Approx(k.depth).epsilon(1e-14));
    CHECK((e.a - e.b - e.normal * e.upper).cast<double>().norm() <= 1e-6);
  }
}

TEST_CASE("descend: without points of the required accuracy it stays explored, with the same bounds",
          "[narrow][descend]") {
  for (const Known& k : rings()) {
    INFO(k.name);
    const ExtendedPair p(k.pair);
    auto e = explored(p, 60);
    extended::descend<Wide>(e, p.a, p.b, p.size, Wide(-1));
    CHECK(e.status == EpaStatus::explored);
    CHECK(static_cast<double>(e.upper) == Approx(k.depth).epsilon(1e-14));
  }
}

TEST_CASE("descend: a proximal step of bodies that are apart is broken", "[narrow][descend]") {
  const ExtendedPair p(pair_at(Ellipsoid{{1, 1, 1}}, Ellipsoid{{1, 1, 1}}, {3, 0, 0}));
  // The height along x is −1: the step moves B away by a share of it, and they still do not meet.
  const auto step =
      extended::detail::proximal<Wide>(WideVec(WideVec::UnitX()), Wide(0.5), p.a, p.b, p.size, p.tolerance());
  CHECK(step.status == EpaStatus::broken);
  CHECK(step.upper == std::numeric_limits<Wide>::infinity());
}
