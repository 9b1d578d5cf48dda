// The libFuzzer entry, driven by hand: its seeds, random bytes, and an engine that lies.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "fuzz/libfuzzer/decode.h"
#include "scenarios/random/family.h"
#include "tests/mutants/lying_engine.h"
#include "tests/support/catch.h"

using namespace touchstone;
using Bytes = std::vector<std::uint8_t>;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

std::vector<Bytes> seeds() {
  std::vector<Bytes> r;
  for (const auto& e : std::filesystem::directory_iterator(TS_SOURCE_DIR "/fuzz/libfuzzer/seeds")) {
    std::ifstream in(e.path(), std::ios::binary);
    r.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return r;
}

// True when judging the bytes ends the process by abort().
bool aborts(const Bytes& bytes, const EnginePtr& engine) {
  const pid_t child = fork();
  if (child == 0) {
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    signal(SIGABRT, SIG_DFL);
    if (!std::freopen("/dev/null", "w", stderr)) _exit(2);
    fuzz::judge_bytes(bytes, engine);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT;
}

}  // namespace

TEST_CASE("the entry finds no fault of the core in its seeds, which cover every family",
          "[libfuzzer][core]") {
  std::set<std::string> families;
  for (const Bytes& b : seeds()) {
    const auto c = fuzz::decode(b);
    REQUIRE(c);
    families.insert(c->family);
    CHECK(LLVMFuzzerTestOneInput(b.data(), b.size()) == 0);
  }
  CHECK(families.size() == fuzz::families().size());
}

TEST_CASE("any bytes decode to a case or to nothing, and always to the same", "[libfuzzer]") {
  Rng rng(5);
  std::size_t cases = 0, changed = 0;
  for (int i = 0; i < 400; ++i) {
    std::vector<fuzz::Change> changes(rng.below(4));
    for (auto& c : changes) c = fuzz::random_change(rng);
    const auto family = static_cast<std::uint8_t>(rng.below(8));
    const std::uint64_t seed = rng.next();
    const Bytes bytes = fuzz::encode(family, seed, changes);
    const auto c = fuzz::decode(bytes);
    CHECK(c == fuzz::decode(bytes));
    if (!c) continue;
    ++cases;
    CHECK_NOTHROW(validate(c->scene));
    changed += *c != *fuzz::decode(fuzz::encode(family, seed, {}));
    if (i % 4 == 0) CHECK(LLVMFuzzerTestOneInput(bytes.data(), bytes.size()) == 0);
  }
  INFO(cases << " of 400 are cases, " << changed << " of them changed");
  CHECK(cases > 250);
  CHECK(changed > 100);
  CHECK_FALSE(fuzz::decode(Bytes(8)));
  CHECK(LLVMFuzzerTestOneInput(nullptr, 0) == 0);
}

TEST_CASE("a change that steers to a gap of zero makes bodies touch", "[libfuzzer][mutate]") {
  Case c;
  c.scene.shapes = {Box{Vec3(1, 1, 1)}};
  c.scene.bodies.resize(2);
  c.scene.bodies[1].pose.translation = Vec3(7, 0.25, 0);
  fuzz::Change steer{0, static_cast<std::uint8_t>(fuzz::Change::Kind::steer), 0};
  REQUIRE(fuzz::apply(steer, c));
  CHECK(c.scene.bodies[1].pose.translation.x() == 2);
}

TEST_CASE("the entry aborts on a wrong engine", "[libfuzzer][mutants]") {
  for (const auto& m : mutants::mutants()) {
    if (m.name != "depth_halved" && m.name != "declines_large") continue;
    std::size_t aborted = 0;
    for (std::uint64_t seed = 0; seed < 8; ++seed)
      aborted += aborts(fuzz::encode(3, seed, {}), mutants::make_lying_engine(m));
    INFO(m.name);
    CHECK(aborted > 0);
  }
}
