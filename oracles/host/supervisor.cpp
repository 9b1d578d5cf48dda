#include "oracles/host/sandbox.h"

#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace touchstone::host {
namespace {

constexpr int most_rounds = 10000;  // of killing children, which may start others meanwhile

bool write_text(const char* file, const std::string& text) {
  const int fd = open(file, O_WRONLY | O_CLOEXEC);
  if (fd < 0) return false;
  const bool written = write(fd, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  close(fd);
  return written;
}

/// Maps the user and the group to themselves in the new user namespace.
bool map_ids(uid_t user, gid_t group) {
  const auto line = [](unsigned id) { return std::to_string(id) + " " + std::to_string(id) + " 1"; };
  write_text("/proc/self/setgroups", "deny");
  return write_text("/proc/self/gid_map", line(group)) && write_text("/proc/self/uid_map", line(user));
}

/// From here on, children are in new namespaces. Root gets no user namespace, in which it could read less.
Apart enter_namespaces() {
  const uid_t user = geteuid();
  const gid_t group = getegid();
  if (user == 0 && unshare(CLONE_NEWPID) == 0) return {true, false, true};
  if (unshare(CLONE_NEWUSER | CLONE_NEWPID) != 0) return {};
  return {true, true, map_ids(user, group)};
}

/// Closed one by one where the call is missing: the usual limit on a process's descriptors.
constexpr unsigned usual_descriptors = 1024;

/// Older kernels lack the call.
void close_all(unsigned first, unsigned last) {
  if (syscall(SYS_close_range, first, last, 0U) == 0) return;
  for (unsigned fd = first; fd <= last && fd < usual_descriptors; ++fd) close(static_cast<int>(fd));
}

/// Closes all descriptors if `kept` is negative.
void close_all_but(int kept) {
  if (kept > 0) close_all(0, static_cast<unsigned>(kept) - 1);
  close_all(static_cast<unsigned>(kept + 1), ~0U);
}

/// The first process of a PID namespace; when it ends, the kernel ends all others. It lives as long as the
/// other end of the pipe is open.
[[noreturn]] void run_init(int alive) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  signal(SIGCHLD, SIG_IGN);
  close_all_but(alive);
  char byte;
  while (read(alive, &byte, 1) < 0 && errno == EINTR) {
  }
  _exit(0);
}

[[noreturn]] void fail(const char* what) {
  std::perror(what);
  _exit(3);
}

/// Dies as the child did, without a core file.
[[noreturn]] void end_like(int status) {
  if (WIFEXITED(status)) _exit(WEXITSTATUS(status));
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  prctl(PR_SET_DUMPABLE, 0);
  const int how = WTERMSIG(status);
  signal(how, SIG_DFL);
  sigset_t one;
  sigemptyset(&one);
  sigaddset(&one, how);
  raise(how);
  sigprocmask(SIG_UNBLOCK, &one, nullptr);
  _exit(3);
}

sigset_t awaited_signals() {
  sigset_t s;
  sigemptyset(&s);
  sigaddset(&s, SIGCHLD);
  sigaddset(&s, SIGTERM);
  return s;
}

/// Waits until the child has ended; kills it on SIGTERM.
int wait_for(pid_t child) {
  const sigset_t awaited = awaited_signals();
  for (;;) {
    int status = 0;
    if (waitpid(child, &status, WNOHANG) == child) return status;
    if (sigwaitinfo(&awaited, nullptr) != SIGTERM) continue;
    kill(child, SIGKILL);
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
  }
}

struct Init {
  pid_t pid = -1;
  int alive = -1;  // closing it ends the process
};

[[noreturn]] void watch(pid_t child, const Init& init, const std::string& scratch) {
  close_all_but(init.alive);
  const int status = wait_for(child);
  if (init.pid > 0) {
    kill(init.pid, SIGKILL);
    while (waitpid(init.pid, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  end_others({});
  std::error_code ignored;  // the harness removes it too
  std::filesystem::remove_all(scratch, ignored);
  end_like(status);
}

Init start_init() {
  int alive[2];
  Init init;
  if (pipe2(alive, O_CLOEXEC) != 0 || (init.pid = fork()) < 0) fail("touchstone-host: init");
  if (init.pid == 0) {
    close(alive[1]);
    run_init(alive[0]);
  }
  close(alive[0]);
  init.alive = alive[1];
  return init;
}

/// False if there are no children.
bool kill_children() {
  std::ifstream list("/proc/thread-self/children");
  bool any = false;
  for (pid_t child; list >> child; any = true) kill(child, SIGKILL);
  return any;
}

}  // namespace

void end_others(const Apart& apart) {
  // In a PID namespace whose parent is outside, -1 means all its processes except the first and this one.
  if (apart.pid_namespace && getppid() == 0) {
    kill(-1, SIGKILL);
    while (waitpid(-1, nullptr, 0) > 0 || errno == EINTR) {
    }
    return;
  }
  // Orphans become children of this process, their subreaper.
  for (int round = 0; round < most_rounds && kill_children(); ++round) waitpid(-1, nullptr, 0);
}

Apart supervise(const std::string& scratch) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  const sigset_t awaited = awaited_signals();
  sigset_t before;
  sigprocmask(SIG_BLOCK, &awaited, &before);
  const Apart apart = enter_namespaces();
  const Init init = apart.pid_namespace ? start_init() : Init{};
  const pid_t child = fork();
  if (child < 0) fail("touchstone-host: fork");
  if (child > 0) watch(child, init, scratch);
  if (init.alive >= 0) close(init.alive);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  setpgid(0, 0);
  sigprocmask(SIG_SETMASK, &before, nullptr);
  return apart;
}

}  // namespace touchstone::host
