// The core in a worker: the same answers as in process, and a death that costs one answer.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "core/base/input_error.h"
#include "oracles/abi/protocol.h"
#include "oracles/core/core_engine.h"
#include "scenarios/random/family.h"
#include "tests/oracles/remote_fixture.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::testing;

namespace {

RemoteSpec native_spec(const std::string& library, const std::string& engine,
                       const WorkerLimits& limits = {}) {
  return {host_path(), plugin_path(library), engine, limits, make_native_core(engine)->card()};
}

/// Every bit except the time taken.
std::string bits_of(Observation o) {
  o.elapsed_ns = 0;
  std::string bytes;
  protocol::append(bytes, protocol::AnswerMessage{0, 0, o});
  return bytes + o.site;
}

void check_same(const std::vector<CaseObservations>& there, const std::vector<CaseObservations>& here) {
  REQUIRE(there.size() == here.size());
  for (std::size_t i = 0; i < here.size(); ++i) {
    INFO("case " << i);
    CHECK(there[i].received == here[i].received);
    REQUIRE(there[i].answers.size() == here[i].answers.size());
    for (std::size_t q = 0; q < here[i].answers.size(); ++q)
      CHECK(bits_of(there[i].answers[q]) == bits_of(here[i].answers[q]));
  }
}

struct Variable {
  const char* name;
  Variable(const char* n, const std::string& value) : name(n) { setenv(n, value.c_str(), 1); }
  ~Variable() { unsetenv(name); }
};

struct Death {
  const char *how, *detail, *site;
  Outcome outcome = Outcome::crashed;
};

}  // namespace

TEST_CASE("the core's answers are the same bits in a worker as in process", "[oracles][native]") {
  std::vector<Case> cases;
  for (std::uint64_t i = 0; i < 160; ++i) cases.push_back(fuzz::make_case(5, i));
  Case empty_script = make_case(1, false);
  empty_script.queries = {{Question::candidates, -1, -1}, {Question::scene_contacts, -1, -1}};
  cases.push_back(empty_script);
  for (const char* name : {"core", "core-f32", "core-kept", "core-extended", "automatic", "exact:grid"}) {
    INFO("engine " << name);
    RemoteEngine there(native_spec("touchstone_core", name));
    CHECK(there.worker_pid() == -1);  // no worker is started before the first query
    check_same(there.run(cases), make_native_core(name)->run(cases));
    CHECK(there.restarts() == 0);
  }
}

TEST_CASE("the core's library is not a plug-in", "[oracles][native]") {
  for (const char* name : {"", "core"})
    CHECK_THROWS_AS(RemoteEngine(RemoteSpec{host_path(), plugin_path("touchstone_core"), name, {}}),
                    InputError);
}

TEST_CASE("a death of the core costs one answer, whatever its cause", "[oracles][native]") {
  const char* const site = "libts_dying_core:touchstone::dies_in_the_core";
  const Death deaths[] = {{"segv", "SIGSEGV", site},
                          {"abort", "SIGABRT", site},
                          {"loop", "CPU time", "", Outcome::timed_out},
                          {"wait", "waits", "", Outcome::timed_out},
#ifndef TS_ADDRESS_SANITIZER  // it needs terabytes of address space, so there is no limit
                          {"memory", "memory limit", ""},
#endif
                          {"exit", "exit code 0", ""},
                          {"throw", "thrown by an engine of the core", "", Outcome::threw}};
  const auto cases = make_cases(12, 7);
  const auto good = make_native_core("core")->run(cases);
  for (const Death& death : deaths) {
    INFO(death.how);
    const Variable how("TS_DYING_CORE", death.how);
    WorkerLimits limits = short_limits(std::string(death.how) == "wait");
    if (std::string(death.how) == "memory") limits.query_cpu_seconds = 60;
    RemoteEngine engine(native_spec("ts_dying_core", "core", limits));
    auto all = engine.run(cases);
    auto expected = good;
    Observation& o = all[7].answers[2];
    CHECK(o.outcome == death.outcome);
    CHECK(o.detail.find(death.detail) != std::string::npos);
    CHECK(o.site == death.site);
    expected[7].answers[2] = o;
    check_same(all, expected);
    CHECK(engine.restarts() == (o.outcome == Outcome::threw ? 0 : 2));
    check_same(engine.run(std::span(cases).first(7)), {good.begin(), good.begin() + 7});
  }
}

TEST_CASE("a death that does not repeat is charged to the first answer that was lost", "[oracles][native]") {
  const auto file = std::filesystem::temp_directory_path() / ("touchstone-died-" + std::to_string(getpid()));
  std::filesystem::remove(file);
  const Variable how("TS_DYING_CORE", "once"), died("TS_DIED", file.string());
  WorkerLimits limits = short_limits();
  limits.sandbox = false;  // it writes its file
  RemoteEngine engine(native_spec("ts_dying_core", "core", limits));
  const auto cases = make_cases(12, 7);
  const auto all = engine.run(cases);
  std::filesystem::remove(file);
  int crashed = 0;
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (const Observation& o : all[i].answers)
      if (o.outcome == Outcome::crashed) {
        ++crashed;
        CHECK(i <= 7);
        CHECK(o.detail.find("did not recur when asked again") != std::string::npos);
        CHECK(o.site == "libts_dying_core:touchstone::dies_in_the_core");
      } else {
        CHECK(o.outcome == Outcome::answered);
      }
  CHECK(crashed == 1);
  CHECK(engine.restarts() == 1);
}
