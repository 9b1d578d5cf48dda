// A process of the host program, its three streams, its clock and its end. Linux.
//
// There are two kinds. A fork server is spawned by the harness and loads a plug-in; a worker is forked by a
// fork server, which is several times cheaper than loading the plug-in's libraries again after every crash.
// Both die with the harness: each asks for SIGKILL on the death of its parent *thread*, so every fork server
// is spawned by one thread that lives as long as the harness. Each leads a process group of its own, and the
// whole group is killed with it. With a sandbox (oracles/host/sandbox.h) a fork server has a supervisor,
// which is the process that is spawned, and ends whatever it leaves behind.
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

/// A directory of its own, removed at the end.
class ScratchDirectory {
 public:
  /// Throws InputError when it cannot be made.
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
  /// What of a worker is not as in any other: it runs a native engine (oracles/host/native.h).
  struct Native {
    std::string engine;
    bool keeps_back = false;  // answers, for a moment
  };

  /// A fork server, within a sandbox when `scratch` is given, for native engines or others. Throws InputError
  /// when the host program cannot be started.
  WorkerProcess(const std::filesystem::path& host, const std::vector<std::string>& arguments,
                std::unique_ptr<ScratchDirectory> scratch, bool native = false);
  /// A worker of that fork server. Throws InputError when the fork server is gone.
  explicit WorkerProcess(std::shared_ptr<WorkerProcess> fork_server, const Native* native = nullptr);
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  pid_t pid() const { return pid_; }
  /// Of a worker: the process that forked it and no other, which adopts what it leaves behind; -1: there are
  /// others.
  pid_t parent_pid() const { return fork_server_ && !fork_server_->native_ ? fork_server_->inner_pid_ : -1; }
  int questions_fd() const { return questions_.get(); }  // a socket, non-blocking
  int answers_fd() const { return answers_.get(); }      // non-blocking
  int errors_fd() const { return errors_.get(); }        // non-blocking

  /// CPU seconds that the whole process has used; stays at its last value once the process is gone.
  double cpu_seconds() const;
  /// Reads what the worker wrote to its standard error; only the end of it is kept.
  void drain_errors();

  /// Reaps the process if it has ended by itself. Of a worker this is a question to the fork server: tens of
  /// microseconds.
  bool has_ended();
  /// The same, after waiting for it: a dying process closes its streams before it can be reaped.
  bool ends_within(double seconds);
  /// Kills the process if need be, reaps it, and says how it ended and where.
  LastWords end();

 private:
  /// One request to this fork server; nothing when it is gone or silent.
  std::optional<fork_server::Reply> request(fork_server::Request what,
                                            const std::array<int, fork_server::descriptor_count>* with);
  std::optional<fork_server::Reply> await_reply();
  bool reap(bool wait);
  bool reap_child(bool wait);
  void end_supervised();
  bool is_stuck() const;
  std::string said_by_memcheck_of(pid_t worker);
  void open_clock();

  // A fork server for native engines is asked from several threads.
  std::recursive_mutex mutex_;
  bool native_ = false;
  std::shared_ptr<WorkerProcess> fork_server_;
  std::unique_ptr<ScratchDirectory> scratch_;
  pid_t pid_ = -1;
  pid_t inner_pid_ = -1;      // of a fork server: the process that loads the plug-in, once it has said so
  std::int32_t number_ = -1;  // of a worker, as its fork server knows it: another than pid_ in a namespace
  bool reaped_ = false;
  int status_ = 0;
  clockid_t clock_{};
  mutable double last_cpu_ = 0;
  FileDescriptor questions_, answers_, errors_;
  std::string error_tail_;
};

}  // namespace touchstone
