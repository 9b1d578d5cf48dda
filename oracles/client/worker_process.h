// A process of the host program: its three streams, its CPU clock and its termination. Linux.
//
// There are two kinds. A fork server is spawned by the harness and loads a plug-in. A worker is forked by a
// fork server, which is several times cheaper than loading the plug-in's libraries again after every crash.
// Both die with the harness: each requests SIGKILL on the death of its parent *thread*, so every fork server
// is spawned by one thread that lives as long as the harness. Each leads its own process group, and the whole
// group is killed with it. In a sandbox (oracles/host/sandbox.h) the spawned process is a supervisor, which
// ends whatever the fork server leaves behind.
#pragma once

#include <sys/types.h>

#include <array>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "oracles/abi/fork_server_protocol.h"
#include "oracles/abi/last_words.h"

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

/// A private directory, removed by the destructor.
class ScratchDirectory {
 public:
  /// Throws InputError if it cannot be created.
  ScratchDirectory();
  ~ScratchDirectory();
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

class WorkerProcess {
 public:
  /// The settings of a worker that runs a native engine (oracles/host/serve.h).
  struct Native {
    std::string engine;
    bool buffers_answers = false;  // it may buffer its answers for a moment
  };

  /// A fork server, for native engines or others, in a sandbox if `scratch` is given. Throws InputError if
  /// the host program cannot be started.
  WorkerProcess(const std::filesystem::path& host, const std::vector<std::string>& arguments,
                std::unique_ptr<ScratchDirectory> scratch, bool native = false);
  /// A worker of the given fork server. Throws InputError when the fork server is gone.
  explicit WorkerProcess(std::shared_ptr<WorkerProcess> fork_server, const Native* native = nullptr);
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  pid_t pid() const { return pid_; }
  /// For a worker: the fork server's pid, which adopts what the worker leaves behind; -1 if the fork server
  /// has other workers too.
  pid_t parent_pid() const { return fork_server_ && !fork_server_->native_ ? fork_server_->inner_pid_ : -1; }
  int questions_fd() const { return questions_.get(); }  // a socket, non-blocking
  int answers_fd() const { return answers_.get(); }      // non-blocking
  int errors_fd() const { return errors_.get(); }        // non-blocking

  /// CPU seconds used by the whole process; keeps its last value once the process is gone.
  double cpu_seconds() const;
  /// Reads what the worker wrote to its standard error, and keeps only the end.
  void drain_errors();

  /// Reaps the process if it has ended by itself. For a worker this is a request to the fork server, which
  /// takes tens of microseconds.
  bool has_ended();
  /// The same, but waits: a dying process closes its streams before it can be reaped.
  bool ends_within(double seconds);
  /// Kills the process if necessary, reaps it, and reports how and where it ended.
  LastWords end();

 private:
  /// Sends one request to this fork server; nothing if it is gone or does not reply.
  std::optional<fork_server::Reply> request(fork_server::Request what,
                                            const std::array<int, fork_server::descriptor_count>* with);
  std::optional<fork_server::Reply> await_reply();
  bool reap(bool wait);
  bool reap_child(bool wait);
  void end_supervised();
  bool is_stuck() const;
  std::string memcheck_messages_about(pid_t worker);
  void open_clock();

  // A fork server for native engines is used by several threads.
  std::recursive_mutex mutex_;
  bool native_ = false;
  std::shared_ptr<WorkerProcess> fork_server_;
  std::unique_ptr<ScratchDirectory> scratch_;
  pid_t pid_ = -1;
  pid_t inner_pid_ = -1;      // for a fork server: the process that loads the plug-in, once it has reported
  std::int32_t number_ = -1;  // for a worker: its pid as the fork server sees it (differs in a PID namespace)
  bool reaped_ = false;
  int status_ = 0;
  clockid_t clock_{};
  mutable double last_cpu_ = 0;
  FileDescriptor questions_, answers_, errors_;
  std::string error_tail_;
};

}  // namespace touchstone
