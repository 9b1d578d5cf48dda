// Engines that `engines --install` compiles: what is said about them before, and what they answer afterwards.
#include <bit>
#include <cstdint>
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

namespace {

// The records of an MCAP file: an opcode, a length, fields. Strings and byte lists are preceded by their
// length.
class McapFile {
 public:
  McapFile() : bytes_("\x89MCAP0\r\n") { record(1, text("") + text("test")); }
  std::string end() {
    record(0x0f, number(0, 4));
    record(2, number(0, 8) + number(0, 8) + number(0, 4));
    return bytes_ + "\x89MCAP0\r\n";
  }
  void channel(const std::string& schema, const std::string& encoding) {
    record(3, number(1, 2) + text(schema) + text("ros2msg") + text(""));
    record(4, number(1, 2) + number(1, 2) + text("/joint_states") + text(encoding) + text(""));
  }
  void message(std::uint64_t ns, const std::string& data) {
    record(5, number(1, 2) + number(0, 4) + number(ns, 8) + number(ns, 8) + data);
  }
  static std::string number(std::uint64_t value, int size) {
    std::string s;
    for (int i = 0; i < size; ++i) s += static_cast<char>(value >> (8 * i) & 0xffU);
    return s;
  }
  static std::string text(const std::string& s) { return number(s.size(), 4) + s; }

 private:
  void record(int opcode, const std::string& content) {
    bytes_ += static_cast<char>(opcode) + number(content.size(), 8) + content;
  }
  std::string bytes_;
};

// One joint in the encoding of ROS 2: time, an empty frame name, names, positions, no velocities, no efforts.
std::string joint_state(const std::string& name, double position) {
  std::string s = McapFile::number(0, 8) + McapFile::number(1, 4) + std::string(1, '\0');
  const auto align = [&](std::size_t n) { s.resize((s.size() + n - 1) / n * n); };
  align(4);
  s += McapFile::number(1, 4) + McapFile::number(name.size() + 1, 4) + name + '\0';
  align(4);
  s += McapFile::number(1, 4);
  align(8);
  s += McapFile::number(std::bit_cast<std::uint64_t>(position), 8) + McapFile::number(0, 8);
  return std::string("\0\1\0\0", 4) + s;
}

std::string recording() {
  McapFile f;
  f.channel("sensor_msgs/msg/JointState", "cdr");
  f.message(2'000'000'000, joint_state("slide", 0.1));
  f.message(1'000'000'000, joint_state("j2", 0.25));
  f.message(3'000'000'000, joint_state("j2", 1.2));
  return f.end();
}

}  // namespace

TEST_CASE("a trajectory in an MCAP recording, whose reader is named where it is missing",
          "[optional_engines]") {
  const std::string arm =
      "import " TS_SOURCE_DIR "/tests/scenarios/import/files/arm.urdf -o scene.json --trajectory ";
  const Workspace w("mcap");
  w.write("t.mcap", recording());
  const Run none = w.touchstone(arm + "t.mcap", "TOUCHSTONE_NPM=" + (w.dir / "none").string());
  CHECK(none.code == 2);
  if (has_command("node"))
    CHECK(has(none.err, "t.mcap: is read by packages of npm that are not installed: npm install --prefix"));
  else
    CHECK(has(none.err, "node: is not installed"));
  CHECK(has(w.touchstone(arm + "missing.mcap").err, "missing.mcap: no such file"));

  const char* chosen = std::getenv("TOUCHSTONE_NPM");
  const auto npm = chosen ? std::filesystem::path(chosen) : std::filesystem::path(TS_BINARY_DIR) / "npm";
  for (const char* package : {"core", "support"})
    if (!has_command("node") ||
        !std::filesystem::exists(npm / "node_modules/@mcap" / package / "package.json"))
      return skip("@mcap/core and @mcap/support are not installed in " + npm.string());
  w.write("t.csv", "time,j2,slide\n1,0.25,0.1\n2,1.2,0.1\n");
  REQUIRE(w.touchstone(arm + "t.csv").code == 0);
  const std::string expected = read_all(w.dir / "scene.json");
  const Run read = w.touchstone(arm + "t.mcap");
  INFO(read.out << read.err);
  REQUIRE(read.code == 0);
  CHECK(read_all(w.dir / "scene.json") == expected);
  CHECK(has(read.out, "steps"));

  const auto said = [&](const std::string& bytes) {
    w.write("bad.mcap", bytes);
    const Run r = w.touchstone(arm + "bad.mcap");
    CHECK(r.code == 2);
    return r.err;
  };
  CHECK(has(said("x"), "bad.mcap: "));
  CHECK(has(said(recording().substr(0, 150)), "bad.mcap: "));
  McapFile empty;
  CHECK(has(said(empty.end()), "bad.mcap: has no joint states"));
  McapFile unknown;
  unknown.channel("sensor_msgs/msg/JointState", "cdr");
  unknown.message(1, joint_state("no_such_joint", 1));
  CHECK(has(said(unknown.end()), "no_such_joint"));
  McapFile cut;
  cut.channel("sensor_msgs/msg/JointState", "cdr");
  cut.message(1, joint_state("j2", 1).substr(0, 20));
  CHECK(has(said(cut.end()), "a message ends too early"));
}
