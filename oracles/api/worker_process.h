// One worker process: touchstone-host with one plug-in, its three streams, its clock and its end. Linux.
//
// The worker dies with the harness: it asks for SIGKILL on the death of its parent *thread*, so every worker
// is spawned by one thread that lives as long as the process. It leads a process group of its own, and the
// whole group is killed with it.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <ctime>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace touchstone {

class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int fd) : fd_(fd) {}
  FileDescriptor(FileDescriptor&& o) noexcept : fd_(std::exchange(o.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& o) noexcept {
    std::swap(fd_, o.fd_);
    return *this;
  }
  ~FileDescriptor() { close(); }
  void close();
  int get() const { return fd_; }

 private:
  int fd_ = -1;
};

class WorkerProcess {
 public:
  /// Throws InputError when the host program cannot be started.
  WorkerProcess(const std::filesystem::path& host, const std::vector<std::string>& arguments);
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  pid_t pid() const { return pid_; }
  int questions_fd() const { return questions_.get(); }  // a socket, non-blocking
  int answers_fd() const { return answers_.get(); }      // non-blocking
  int errors_fd() const { return errors_.get(); }        // non-blocking

  /// CPU seconds that the whole process has used; stays at its last value once the process is gone.
  double cpu_seconds() const;
  /// 0 once the process is gone.
  std::uint64_t resident_bytes() const;

  /// Reads what the worker wrote to its standard error; only the end of it is kept.
  void drain_errors();

  /// Reaps the process if it has ended by itself.
  bool has_ended();
  /// The same, after waiting for it: a dying process closes its streams before it can be reaped.
  bool ends_within(double seconds);
  /// Kills the process if need be, reaps it, and says how it ended: "SIGSEGV", "exit code 3", and for an
  /// abort or an exit the last line of its standard error.
  std::string end();

 private:
  pid_t pid_ = -1;
  bool reaped_ = false;
  int status_ = 0;
  clockid_t clock_{};
  mutable double last_cpu_ = 0;
  FileDescriptor questions_, answers_, errors_;
  std::string error_tail_;
};

}  // namespace touchstone
