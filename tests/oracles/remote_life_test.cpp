// The life cycle of worker processes: killed from outside, outliving threads, dying with the harness, leaving
// nothing behind.
#include <dirent.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <fstream>
#include <memory>
#include <thread>

#include "oracles/abi/protocol.h"
#include "oracles/client/worker_session.h"
#include "tests/oracles/remote_fixture.h"
#include "tests/support/catch.h"
#include "tests/support/workspace.h"

using namespace touchstone;
using namespace touchstone::testing;
using namespace std::chrono_literals;

namespace {

int open_descriptors() {
  int n = 0;
  DIR* const dir = opendir("/proc/self/fd");
  while (readdir(dir)) ++n;
  closedir(dir);
  return n;
}

/// A zombie counts as gone: reaping an orphan is not our job.
bool is_alive(pid_t pid) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  if (!std::getline(stat, text)) return false;
  const auto after_name = text.rfind(')');
  return after_name == std::string::npos || text.substr(after_name + 2, 1) != "Z";
}

/// The fourth field of stat, after the name in parentheses.
pid_t parent_of(pid_t pid) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  std::getline(stat, text);
  const auto after_name = text.rfind(')');
  return after_name == std::string::npos ? -1 : std::atoi(text.c_str() + after_name + 4);
}

bool dies_eventually(pid_t pid) {
  for (int i = 0; i < 3000 && is_alive(pid); ++i) std::this_thread::sleep_for(10ms);
  return !is_alive(pid);
}

void kill_with_fork_server(pid_t worker) {
  const pid_t fork_server = parent_of(worker);
  REQUIRE(fork_server > 1);
  REQUIRE(fork_server != getpid());
  for (const pid_t pid : {fork_server, worker}) kill(pid, SIGKILL);
  REQUIRE(dies_eventually(worker));
}

}  // namespace

TEST_CASE("kill -9 of the worker in the middle of a run costs the running query", "[oracles][remote]") {
  RemoteEngine engine(bad_spec("slow"));
  const auto cases = make_cases(30, -1);
  const pid_t pid = engine.worker_pid();
  std::thread killer([pid] {
    std::this_thread::sleep_for(100ms);
    kill(pid, SIGKILL);
  });
  const auto results = engine.run(cases);
  killer.join();
  int good = 0, killed = 0;
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const Observation& o = results[i].answers[k];
      good += is_good(o, static_cast<int>(i), cases[i].queries[k]);
      killed += o.outcome == Outcome::crashed && o.detail.find("SIGKILL") != std::string::npos;
    }
  // A kill while a scene is being loaded costs that scene's three queries.
  CHECK((killed == 1 || killed == 3));
  CHECK(good + killed == 90);
  CHECK(engine.restarts() == 1);
}

TEST_CASE("a worker that died between two runs is replaced without loss", "[oracles][remote]") {
  RemoteEngine engine(bad_spec("good"));
  const auto cases = make_cases(3, -1);
  engine.run(cases);
  kill(engine.worker_pid(), SIGKILL);
  while (is_alive(engine.worker_pid())) std::this_thread::sleep_for(1ms);
  const auto results = engine.run(cases);
  CHECK(is_good(results[0].answers[0], 0, cases[0].queries[0]));
  CHECK(is_good(results[2].answers[2], 2, cases[2].queries[2]));
}

TEST_CASE("the death of the fork server is survived too", "[oracles][remote]") {
  RemoteEngine engine(bad_spec("slow"));
  const auto cases = make_cases(30, -1);
  const pid_t fork_server = parent_of(engine.worker_pid());
  REQUIRE(fork_server > 1);
  REQUIRE(fork_server != getpid());
  std::thread killer([fork_server] {
    std::this_thread::sleep_for(100ms);
    kill(fork_server, SIGKILL);
  });
  const auto results = engine.run(cases);
  killer.join();
  int good = 0, killed = 0;
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      good += is_good(results[i].answers[k], static_cast<int>(i), cases[i].queries[k]);
      killed += results[i].answers[k].outcome == Outcome::crashed;
    }
  CHECK((killed == 1 || killed == 3));
  CHECK(good + killed == 90);
}

TEST_CASE("a host that was rebuilt during a run ends the run and is no failure of the engine",
          "[oracles][remote]") {
  const test::Workspace w("rebuilt-host");
  const auto write_host = [&](const std::string& command) {
    w.write("new-host", "#!/bin/sh\nexec " + command + "\n");
    std::filesystem::permissions(w.dir / "new-host", std::filesystem::perms::owner_all);
    std::filesystem::rename(w.dir / "new-host", w.dir / "host");
  };
  write_host(host_path().string() + " \"$@\"");
  RemoteEngine engine({w.dir / "host", plugin_path("ts_bad_behaviours"), "good", {}});
  const auto cases = make_cases(3, -1);
  REQUIRE(is_good(engine.run(cases)[0].answers[0], 0, cases[0].queries[0]));

  std::string hello;
  protocol::append(hello, protocol::Hello{{"{}"}, 0, "", "none", false, "0123456789abcdef"});
  w.write("hello", hello);
  write_host("cat " + (w.dir / "hello").string());
  kill_with_fork_server(engine.worker_pid());
  CHECK_THROWS_AS(engine.run(cases), ProgramMismatch);
}

TEST_CASE("a plug-in that was changed during a run ends the run and is no failure of the engine",
          "[oracles][remote]") {
  const test::Workspace w("changed-plugin");
  const std::filesystem::path plugin = w.dir / "mine.so";
  std::filesystem::copy_file(plugin_path("ts_bad_behaviours"), plugin);
  RemoteEngine engine({host_path(), plugin, "good", {}});
  const auto cases = make_cases(3, -1);
  REQUIRE(is_good(engine.run(cases)[0].answers[0], 0, cases[0].queries[0]));
  kill_with_fork_server(engine.worker_pid());
  REQUIRE(is_good(engine.run(cases)[0].answers[0], 0, cases[0].queries[0]));  // not changed: goes on
  kill_with_fork_server(engine.worker_pid());
  std::filesystem::copy_file(plugin, w.dir / "new.so");
  std::ofstream(w.dir / "new.so", std::ios::app) << "more";
  std::filesystem::rename(w.dir / "new.so", plugin);
  CHECK_THROWS_AS(engine.run(cases), ProgramMismatch);
}

TEST_CASE("workers outlive the thread that created them", "[oracles][remote]") {
  std::unique_ptr<RemoteEngine> engine;
  std::thread([&] { engine = std::make_unique<RemoteEngine>(bad_spec("good")); }).join();
  std::this_thread::sleep_for(50ms);
  const auto cases = make_cases(3, -1);
  const auto results = engine->run(cases);
  CHECK(is_good(results[0].answers[0], 0, cases[0].queries[0]));
  CHECK(engine->restarts() == 0);
}

TEST_CASE("a worker dies with the harness, even in the middle of an endless query", "[oracles][remote]") {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t harness = fork();
  if (harness == 0) {
    RemoteSpec spec = bad_spec("loops");
    spec.limits.query_cpu_seconds = spec.limits.wall_seconds = 1000;
    RemoteEngine engine(spec);
    const pid_t worker = engine.worker_pid();
    if (write(ends[1], &worker, sizeof worker) != sizeof worker) _exit(1);
    engine.run(make_cases(3, 0));
    _exit(0);
  }
  pid_t worker = 0;
  REQUIRE(read(ends[0], &worker, sizeof worker) == sizeof worker);
  std::this_thread::sleep_for(100ms);
  CHECK(is_alive(worker));
  kill(harness, SIGKILL);
  waitpid(harness, nullptr, 0);
  CHECK(dies_eventually(worker));
  close(ends[0]);
  close(ends[1]);
}

TEST_CASE("restarts and destruction leave no process and no descriptor behind", "[oracles][remote]") {
  RemoteEngine(bad_spec("good"));  // allocates whatever is created once
  const int before = open_descriptors();
  {
    RemoteEngine engine(bad_spec("segfaults"));
    std::vector<Case> cases;
    for (int i = 0; i < 10; ++i) cases.push_back(make_case(i, true));
    engine.run(cases);
    CHECK(engine.restarts() == 10);
  }
  CHECK(open_descriptors() == before);
  errno = 0;
  CHECK(waitpid(-1, nullptr, WNOHANG) == -1);
  CHECK(errno == ECHILD);
}

TEST_CASE("engines in several threads at once do not interfere", "[oracles][remote]") {
  std::vector<int> good(4, 0);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < good.size(); ++t)
    threads.emplace_back([&good, t] {
      RemoteEngine engine(bad_spec(t % 2 ? "segfaults" : "good"));
      const auto cases = make_cases(50, 20);
      const auto results = engine.run(cases);
      for (std::size_t i = 0; i < cases.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
          good[t] += is_good(results[i].answers[k], static_cast<int>(i), cases[i].queries[k]);
    });
  for (auto& t : threads) t.join();
  CHECK(good == std::vector<int>{150, 149, 150, 149});
}
