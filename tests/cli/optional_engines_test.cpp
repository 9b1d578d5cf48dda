// Engines that `engines --install` compiles: what is said about them before, and what they answer afterwards.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "oracles/routes/routes.h"
#include "tests/support/catch.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using namespace touchstone::test;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// Without the engines that the user has installed.
struct NothingInstalled : Workspace {
  NothingInstalled() : Workspace("optional") {
    if (const char* given = std::getenv(variable)) {
      was_set = true;
      before = given;
    }
    setenv(variable, (dir / "engines").c_str(), 1);
  }
  ~NothingInstalled() {
    if (was_set)
      setenv(variable, before.c_str(), 1);
    else
      unsetenv(variable);
  }
  static constexpr const char* variable = "TOUCHSTONE_ENGINES";
  bool was_set = false;
  std::string before;
};

struct Expected {
  const char *engine, *checked;
};
constexpr Expected expected[] = {
    {"dart", "dart: 7 right, 0 wrong"},
    {"dart-fcl", "dart-fcl: 12 right, 0 wrong"},
    {"dart-fcl-mesh", "dart-fcl-mesh: 8 right, 0 wrong"},
    {"dart-bullet", "dart-bullet: 14 right, 0 wrong"},
    {"dart-ode", "dart-ode: 12 right, 0 wrong"},
    {"mujoco2", "mujoco2: 14 right, 0 wrong"},
    {"embree", "embree: 2 right, 0 wrong"},
    {"embree-dynamic", "embree-dynamic: 2 right, 0 wrong"},
    {"boost-rtree", "boost-rtree: 2 right, 0 wrong"},
    {"boost-rtree-quadratic", "boost-rtree-quadratic: 2 right, 0 wrong"},
    {"boost-rtree-linear", "boost-rtree-linear: 2 right, 0 wrong"},
};

}  // namespace

TEST_CASE("optional engines say how they are installed", "[optional_engines]") {
  const NothingInstalled w;
  for (const char* name : {"dart", "dart-fcl", "boost-rtree", "mujoco2", "embree"}) {
    const Run r = w.touchstone("engines " + std::string(name));
    INFO(r.out << r.err);
    CHECK(r.code == 2);
    CHECK(has(r.err, "is not installed: ./touchstone engines --install "));
  }
  const Run list = w.touchstone("engines");
  CHECK(has(list.out, "absent: engines --install dart compiles it"));
  CHECK(has(list.out, "against Debian's libdart-dev"));
}

TEST_CASE("the packages of optional engines are known before anything is installed", "[optional_engines]") {
  const NothingInstalled w;
  const Run packages = w.touchstone("engines --install dart-fcl,embree,rapier --debian-packages");
  INFO(packages.out << packages.err);
  CHECK(packages.code == 0);
  for (const char* name : {"libdart-dev", "libdart-collision-ode-dev", "libembree-dev", "nodejs", "npm"})
    CHECK(has(packages.out, name));
  CHECK_FALSE(has(packages.out, "libmujoco-dev"));
  CHECK_FALSE(std::filesystem::exists(w.dir / "engines"));
}

TEST_CASE("installing an unknown engine, or without a compiler, is refused", "[optional_engines]") {
  const NothingInstalled w;
  const Run unknown = w.touchstone("engines --install newton9");
  INFO(unknown.out << unknown.err);
  CHECK(unknown.code == 2);
  CHECK(has(unknown.err, "boost, dart, embree, mujoco2"));
  const Run bare =
      w.run("PATH=" + w.dir.string() + " " TS_BINARY_DIR "/bin/touchstone engines --install embree");
  INFO(bare.out << bare.err);
  CHECK(bare.code == 2);
  CHECK(has(bare.err, "cmake"));
  CHECK(has(bare.err, "embree needs the Debian packages libembree-dev"));
}

TEST_CASE("optional engines that are installed use the interface correctly", "[optional_engines][optional]") {
  const Workspace w("installed");
  std::size_t checked = 0;
  for (const Expected& e : expected) {
    if (w.touchstone("engines " + std::string(e.engine)).code != 0) {
      std::printf("left out: %s is not installed (touchstone engines --install)\n", e.engine);
      continue;
    }
    const Run r = w.touchstone("engines --check " + std::string(e.engine));
    INFO(r.out << r.err);
    CHECK(r.code == 0);
    CHECK(has(r.out, e.checked));
    ++checked;
  }
  if (checked == 0) skip("no optional engine is installed");
}

TEST_CASE("Boost's R-trees keep every pair of boxes", "[optional_engines][certify][optional]") {
  const Workspace w("rtree");
  if (w.touchstone("engines boost-rtree").code != 0) return skip("boost is not installed");
  for (const char* tree : {"boost-rtree", "boost-rtree-quadratic", "boost-rtree-linear"}) {
    const Run r = w.touchstone("certify --level boxes --limit 40 --subject " + std::string(tree));
    INFO(r.out << r.err);
    CHECK(r.code == 0);
    CHECK(has(r.out, "boxes certified"));
  }
}

TEST_CASE("routes of optional engines are those of their libraries", "[optional_engines]") {
  using namespace touchstone;
  using touchstone::routes::Pair;
  const Pair balls{Question::contact, ShapeKind::sphere, ShapeKind::sphere};
  const Pair boxes{Question::contact, ShapeKind::box, ShapeKind::box};
  const Pair cylinder{Question::distance, ShapeKind::cylinder, ShapeKind::sphere};
  CHECK(routes::route_of("dart", balls) == "sphere-sphere");
  CHECK(routes::route_of("dart-fcl", cylinder) == "mesh");
  CHECK(routes::route_of("dart-fcl", {Question::distance, ShapeKind::sphere, ShapeKind::box}) == "sphere");
  CHECK(routes::route_of("dart-fcl-mesh", balls) == "mesh");
  CHECK(routes::route_of("dart-bullet", boxes) == routes::route_of("bullet-sim", boxes));
  CHECK(routes::route_of("dart-ode", cylinder) == routes::route_of("ode", cylinder));
  CHECK(routes::route_of("mujoco2", balls) == "closed form");
  CHECK(routes::route_of("mujoco2", cylinder) == "libccd");
  CHECK(routes::route_of("mujoco2", {Question::contact, ShapeKind::half_space, ShapeKind::hull}) ==
        "half-space");
}
