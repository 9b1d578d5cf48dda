#include "tests/second_referee/limited_run.h"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <new>
#include <system_error>

namespace touchstone::second_referee {
namespace {

[[noreturn]] void no(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

class SharedProgress {
 public:
  SharedProgress() {
    void* at = mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (at == MAP_FAILED) no("mmap");
    progress_ = new (at) Progress;
  }
  SharedProgress(const SharedProgress&) = delete;
  SharedProgress& operator=(const SharedProgress&) = delete;
  ~SharedProgress() { munmap(progress_, sizeof(Progress)); }
  Progress& operator*() const { return *progress_; }

 private:
  Progress* progress_ = nullptr;
};

// CPU time of this process; SIGVTALRM ends it.
void allow(double seconds) {
  itimerval t{};
  t.it_value.tv_sec = static_cast<time_t>(seconds);
  t.it_value.tv_usec = static_cast<suseconds_t>(std::ceil(std::fmod(seconds, 1) * 999999));
  if (setitimer(ITIMER_VIRTUAL, &t, nullptr) != 0) no("setitimer");
}

// In the child. The memory for `told.so_far` is the parent's copy, so what it prints must be flushed here.
void go_on(std::uint64_t pairs, const Limits& limits, const Compare& compare, const Told& told,
           Progress& progress) {
  const rlimit memory{limits.bytes, limits.bytes};
  if (setrlimit(RLIMIT_AS, &memory) != 0) no("setrlimit");
  while (progress.next < pairs) {
    allow(limits.cpu_seconds);
    progress.stage = Stage::preparing;
    compare(progress.next, progress);
    ++progress.next;
    if (progress.next % told.every == 0) told.so_far(progress);
    std::fflush(stdout);
  }
}

// One child, from the next pair to the end or to the pair that ends it; its wait status.
int run_child(std::uint64_t pairs, const Limits& limits, const Compare& compare, const Told& told,
              Progress& progress) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) no("fork");
  if (child == 0) {
    int code = 0;
    try {
      go_on(pairs, limits, compare, told, progress);
    } catch (const std::exception& e) {
      std::fprintf(stderr, "%s\n", e.what());
      code = 1;
    }
    std::fflush(nullptr);
    _exit(code);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) no("waitpid");
  return status;
}

std::string ending(int status, const Limits& limits) {
  char text[80];
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGVTALRM)
    std::snprintf(text, sizeof text, "no answer in %g CPU seconds", limits.cpu_seconds);
  else if (WIFSIGNALED(status))
    std::snprintf(text, sizeof text, "ended by signal %d", WTERMSIG(status));
  else
    std::snprintf(text, sizeof text, "ended with exit code %d", WEXITSTATUS(status));
  return text;
}

}  // namespace

const char* to_string(Stage s) {
  switch (s) {
    case Stage::preparing:
      return "the making of the pair";
    case Stage::referee:
      return "the referee";
    case Stage::cgal:
      return "CGAL";
  }
  return "?";
}

Count run_limited(std::uint64_t pairs, const Limits& limits, const Compare& compare, const Told& told) {
  const SharedProgress shared;
  Progress& progress = *shared;
  while (progress.next < pairs) {
    const int status = run_child(pairs, limits, compare, told, progress);
    if (progress.next >= pairs) break;
    ++(progress.stage == Stage::cgal ? progress.count.cgal_lost : progress.count.referee_lost);
    told.lost(progress.next, progress.stage, ending(status, limits));
    ++progress.next;
  }
  return progress.count;
}

}  // namespace touchstone::second_referee
