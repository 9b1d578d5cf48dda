#include "oracles/client/worker_session.h"

#include <fmt/format.h>

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <map>
#include <mutex>
#include <tuple>
#include <vector>

#include "oracles/client/watchdog.h"

namespace touchstone {
namespace {

constexpr int output_wait_ms = 50;

/// Waits briefly for output of the worker on either stream.
void wait_for_output(WorkerProcess& worker) {
  pollfd fds[2] = {{worker.answers_fd(), POLLIN, 0}, {worker.errors_fd(), POLLIN, 0}};
  poll(fds, 2, output_wait_ms);
  if (worker.errors_fd() >= 0) worker.drain_errors();
}

protocol::Hello of_this_build(protocol::Hello hello) {
  if (hello.built_from != message_id())
    throw ProgramMismatch(
        "touchstone-host",
        fmt::format("was built from other sources ({}) than this program ({}): build both again",
                    hello.built_from, message_id()));
  return hello;
}

protocol::Hello await_hello(WorkerSession& s, const std::string& place, const WorkerLimits& limits) {
  Watchdog watchdog(limits);
  watchdog.progress(*s.process);
  for (;;) {
    throw_if_stopped(limits);
    const ReadResult r = read_available(s.process->answers_fd(), s.frames);
    try {
      if (const auto frame = s.frames.next()) {
        if (frame->type != protocol::Type::hello) throw protocol::Malformed("unexpected type of message");
        return of_this_build(protocol::decode_hello(frame->payload));
      }
    } catch (const protocol::Malformed& e) {
      throw InputError(place,
                       std::string("the worker's first message is not a hello of this build: ") + e.what());
    }
    if (r == ReadResult::closed) {
      s.process->ends_within(death_wait_seconds);
      throw InputError(place, "the worker died while loading it: " + s.process->end().detail);
    }
    if (const auto verdict = watchdog.check(*s.process, Watchdog::Phase::starting))
      throw InputError(place, "the worker was terminated: " + verdict->why);
    if (r == ReadResult::nothing_yet) wait_for_output(*s.process);
  }
}

}  // namespace

ReadResult read_available(int fd, protocol::FrameReader& frames) {
  char buffer[1 << 16];
  for (;;) {
    const ssize_t n = read(fd, buffer, sizeof buffer);
    if (n > 0) {
      frames.append(buffer, static_cast<std::size_t>(n));
      return ReadResult::some;
    }
    if (n == 0) return ReadResult::closed;
    if (errno == EINTR) continue;
    return errno == EAGAIN ? ReadResult::nothing_yet : ReadResult::closed;
  }
}

namespace {

constexpr int memcheck_exit = 99;  // of a process in which Valgrind found an error

// The program that runs the worker, with its arguments; empty: the system.
std::vector<std::string> runner_of(const WorkerLimits& limits) {
  if (limits.memcheck.empty()) return limits.run_with;
  // Uninitialised values are detected by Engine::run_again instead; dynamic loaders are full of them.
  std::vector<std::string> runner{limits.memcheck};
  for (const char* option : {"--quiet", "--undef-value-errors=no", "--exit-on-first-error=yes"})
    runner.emplace_back(option);
  runner.push_back(fmt::format("--error-exitcode={}", memcheck_exit));
  return runner;
}

WorkerSession start_fork_server(const std::filesystem::path& host, const std::filesystem::path& plugin,
                                const std::string& argument, const WorkerLimits& limits, bool native) {
  const std::string place = plugin.string();
  const bool is_command = place.starts_with("pipe:");
  std::error_code error;
  if (!is_command && !std::filesystem::is_regular_file(plugin, error))
    throw InputError(place, "there is no such plug-in file");
  // An absolute path, because the dynamic linker searches elsewhere for a name without a slash.
  std::vector<std::string> arguments{is_command ? place : std::filesystem::absolute(plugin).string()};
  const std::vector<std::string> runner = runner_of(limits);
  const bool sandbox = limits.sandbox && runner.empty();
  if (!argument.empty() || sandbox) arguments.push_back(argument);
  std::unique_ptr<ScratchDirectory> scratch;
  if (sandbox) {
    scratch = std::make_unique<ScratchDirectory>();
    arguments.push_back(scratch->path());
    arguments.push_back(std::to_string(limits.resident_bytes));
  }
  if (!runner.empty()) {
    arguments.insert(arguments.begin(), host.string());
    arguments.insert(arguments.begin(), runner.begin() + 1, runner.end());
  }
  WorkerSession s;
  s.process = std::make_shared<WorkerProcess>(runner.empty() ? host : std::filesystem::path(runner.front()),
                                              arguments, std::move(scratch), native);
  s.hello = await_hello(s, place, limits);
  if (!s.hello.error.empty()) throw InputError(place, s.hello.error);
  return s;
}

}  // namespace

WorkerSession start_fork_server(const std::filesystem::path& host, const std::filesystem::path& plugin,
                                const std::string& argument, const WorkerLimits& limits) {
  return start_fork_server(host, plugin, argument, limits, /*native=*/false);
}

std::shared_ptr<const WorkerSession> share_native_fork_server(const std::filesystem::path& host,
                                                              const std::filesystem::path& library,
                                                              const WorkerLimits& limits) {
  // Everything that determines how the fork server is started.
  using Key =
      std::tuple<pid_t, std::string, std::string, bool, std::uint64_t, std::string, std::vector<std::string>>;
  static std::mutex guard;
  static std::map<Key, std::weak_ptr<const WorkerSession>> fork_servers;
  const std::lock_guard lock(guard);
  auto& kept = fork_servers[{getpid(), host.string(), library.string(), limits.sandbox, limits.resident_bytes,
                             limits.memcheck, limits.run_with}];
  auto fork_server = kept.lock();
  if (!fork_server || fork_server->process->has_ended())
    kept = fork_server =
        std::make_shared<const WorkerSession>(start_fork_server(host, library, "", limits, /*native=*/true));
  return fork_server;
}

WorkerSession start_worker(const WorkerSession& fork_server, const std::filesystem::path& plugin,
                           const WorkerLimits& limits, const WorkerProcess::Native* native) {
  WorkerSession s;
  s.process = std::make_shared<WorkerProcess>(fork_server.process, native);
  s.hello = await_hello(s, plugin.string(), limits);
  if (!s.hello.error.empty()) throw InputError(plugin.string(), s.hello.error);
  return s;
}

}  // namespace touchstone
