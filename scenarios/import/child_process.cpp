#include "scenarios/import/mesh_import.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>

#include "core/base/input_error.h"

namespace touchstone {
namespace {

constexpr rlim_t cpu_seconds = 60;
// A few numbers of a file may ask for any amount of memory.
constexpr rlim_t memory_bytes = rlim_t{8} << 30;
constexpr char succeeded = 'r', refused = 'e';  // first byte of what the child writes

void write_all(int to, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = write(to, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;  // the parent is gone
    done += static_cast<std::size_t>(n);
  }
}

std::string read_all(int from) {
  std::string bytes;
  char part[1 << 16];
  for (;;) {
    const ssize_t n = read(from, part, sizeof part);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return bytes;
    bytes.append(part, static_cast<std::size_t>(n));
  }
}

// Beyond what the process has already. A sanitizer maps terabytes at its start.
void limit_memory() {
  rlim_t pages = 0;
  if (!(std::ifstream("/proc/self/statm") >> pages)) return;
  const rlim_t most = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + memory_bytes;
  const rlimit memory{most, most};
  setrlimit(RLIMIT_AS, &memory);
}

[[noreturn]] void work_and_end(int to, const std::function<std::string()>& work) {
  for (const int s : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGXCPU, SIGPROF, SIGTERM, SIGINT})
    std::signal(s, SIG_DFL);
  const rlimit time{cpu_seconds, cpu_seconds + 1}, no_core{0, 0};
  setrlimit(RLIMIT_CPU, &time);
  limit_memory();
  setrlimit(RLIMIT_CORE, &no_core);
  if (const int null = open("/dev/null", O_WRONLY); null >= 0) dup2(null, STDERR_FILENO);
  std::string out;
  try {
    out = succeeded + work();
  } catch (const InputError& e) {
    out = refused + e.reason();
  } catch (const std::exception& e) {
    out = refused + std::string(e.what());
  }
  write_all(to, out);
  _exit(0);
}

std::string ending(int status) {
  if (!WIFSIGNALED(status)) return "ended without a result";
  if (WTERMSIG(status) == SIGXCPU)
    return "did not end within " + std::to_string(cpu_seconds) + " s of CPU time";
  return std::string("crashed (") + strsignal(WTERMSIG(status)) + ")";
}

}  // namespace

std::string in_child_process(const std::string& file, const std::function<std::string()>& work) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    throw InputError(file, std::string("cannot be read: ") + std::strerror(errno));
  const pid_t child = fork();
  if (child == 0) work_and_end(ends[1], work);
  close(ends[1]);
  std::string bytes;
  if (child > 0) bytes = read_all(ends[0]);
  close(ends[0]);
  if (child < 0) throw InputError(file, std::string("cannot be read: ") + std::strerror(errno));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || bytes.empty()) throw InputError(file, "its reader " + ending(status));
  if (bytes[0] == refused) throw InputError(file, bytes.substr(1));
  return bytes.substr(1);
}

}  // namespace touchstone
