#include "oracles/client/worker_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <functional>
#include <mutex>
#include <sstream>
#include <system_error>
#include <thread>
#include <vector>

#include "core/base/input_error.h"
#include "oracles/client/process_usage.h"
#include "oracles/client/worker_limits.h"

namespace touchstone {
namespace {

// A fork server runs no engine: only a machine in trouble makes it this slow.
constexpr int fork_server_reply_ms = 30000;
constexpr int slice_ms = 50;         // between two checks whether it can answer at all
constexpr int pipe_bytes = 1 << 18;  // fewer wake-ups; the default size works too
constexpr double orderly_end_seconds = 3;

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

void make_non_blocking(int fd) {
  const int flags = fcntl(fd, F_GETFL);
  if (flags < 0 || fcntl(fd, F_SETFL, flags | O_NONBLOCK) < 0) fail("fcntl");
}

/// Runs jobs one at a time on a thread that lives as long as the process. Never destroyed: a static
/// destructor would end the thread, and with it every worker, while other static objects may still use one.
class SpawnThread {
 public:
  static SpawnThread& instance() {
    static std::mutex guard;
    static SpawnThread* one = nullptr;
    const std::lock_guard lock(guard);
    // Threads do not survive a fork.
    if (!one || one->owner_ != getpid()) one = new SpawnThread;
    return *one;
  }
  int run(const std::function<int()>& job) {
    const std::lock_guard one_at_a_time(callers_);
    std::unique_lock lock(mutex_);
    job_ = &job;
    changed_.notify_all();
    changed_.wait(lock, [&] { return job_ == nullptr; });
    return result_;
  }

 private:
  SpawnThread() {
    std::thread([this] { loop(); }).detach();
  }
  void loop() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [&] { return job_ != nullptr; });
      result_ = (*job_)();
      job_ = nullptr;
      changed_.notify_all();
    }
  }
  const pid_t owner_ = getpid();
  std::mutex callers_, mutex_;
  std::condition_variable changed_;
  const std::function<int()>* job_ = nullptr;
  int result_ = 0;
};

struct Streams {
  int in, out, err;
};

int spawn(const std::string& program, const std::vector<std::string>& arguments, const Streams& streams,
          bool native, pid_t* pid) {
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  // The ends are above 2 (see lift), so no dup2 can hit one that is still needed.
  posix_spawn_file_actions_adddup2(&actions, streams.in, 0);
  posix_spawn_file_actions_adddup2(&actions, streams.out, 1);
  posix_spawn_file_actions_adddup2(&actions, streams.err, 2);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  // The answers of an engine that reads uninitialised memory (FCL's mesh-sphere distance and its default
  // continuous query do) would depend on what ran before. glibc is therefore told to hand out memory filled
  // with zeros, so that the same question gets the same answer (oracles/host/diagnosis.h); its thread
  // caches would bypass the filling. The core is tested for this in another way, and is timed as it runs in
  // user programs.
  char perturb[] = "MALLOC_PERTURB_=255", no_cache[] = "GLIBC_TUNABLES=glibc.malloc.tcache_count=0";
  std::vector<char*> environment;
  for (char** e = environ; *e != nullptr; ++e) environment.push_back(*e);
  if (!native) {
    environment.push_back(perturb);
    environment.push_back(no_cache);
  }
  environment.push_back(nullptr);
  const int error = posix_spawn(pid, program.c_str(), &actions, &attributes, argv.data(), environment.data());
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  return error;
}

/// Takes ownership of `fd` and returns the same open file on a descriptor above the standard streams, closed
/// on exec.
FileDescriptor lift(int fd) {
  FileDescriptor own(fd);
  if (fd > 2) return own;
  FileDescriptor high(fcntl(fd, F_DUPFD_CLOEXEC, 3));
  if (high.get() < 0) fail("fcntl(F_DUPFD_CLOEXEC)");
  return high;
}

struct TwoEnds {
  FileDescriptor ours, theirs;
};

// Makes messages carry the pid of their sender, as seen in our PID namespace rather than in the sender's.
void ask_for_senders(int fd) {
  const int yes = 1;
  if (setsockopt(fd, SOL_SOCKET, SO_PASSCRED, &yes, sizeof yes) < 0) fail("setsockopt(SO_PASSCRED)");
}

/// The pid of the sender of the single byte that every host process writes first; -1 if it does not arrive
/// within `ms`.
pid_t sender(int fd, int ms) {
  pollfd ready{fd, POLLIN, 0};
  if (poll(&ready, 1, ms) <= 0) return -1;
  char byte = 0;
  iovec body{&byte, 1};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(ucred))] = {};
  msghdr message{};
  message.msg_iov = &body;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  if (recvmsg(fd, &message, MSG_CMSG_CLOEXEC) != 1) return -1;
  const cmsghdr* const header = CMSG_FIRSTHDR(&message);
  if (!header || header->cmsg_type != SCM_CREDENTIALS) return -1;
  ucred who{};
  std::memcpy(&who, CMSG_DATA(header), sizeof who);
  return who.pid > 0 ? who.pid : -1;
}

TwoEnds make_pipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) < 0) fail("pipe2");
  TwoEnds p{lift(ends[0]), lift(ends[1])};
  make_non_blocking(p.ours.get());
  return p;
}

// A socket rather than a pipe: send() can be told not to raise SIGPIPE, which for a pipe would be a setting
// of the whole harness.
TwoEnds make_socket() {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) < 0) fail("socketpair");
  TwoEnds p{lift(ends[0]), lift(ends[1])};
  make_non_blocking(p.ours.get());
  ask_for_senders(p.ours.get());
  return p;
}

std::string signal_name(int signal) {
  const char* abbreviation = sigabbrev_np(signal);
  return abbreviation ? std::string("SIG") + abbreviation : "signal " + std::to_string(signal);
}

}  // namespace

void FileDescriptor::close() {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
}

ScratchDirectory::ScratchDirectory() {
  std::error_code error;
  std::filesystem::path pattern = std::filesystem::temp_directory_path(error) / "touchstone-XXXXXX";
  path_ = pattern.string();
  if (error || !mkdtemp(path_.data()))
    throw InputError(pattern.parent_path().string(),
                     std::string("cannot create a directory for an engine here: ") + std::strerror(errno));
}

ScratchDirectory::~ScratchDirectory() {
  std::error_code ignored;  // the supervisor removes it too
  std::filesystem::remove_all(path_, ignored);
}

WorkerProcess::WorkerProcess(const std::filesystem::path& host, const std::vector<std::string>& arguments,
                             std::unique_ptr<ScratchDirectory> scratch, bool native)
    : native_(native), scratch_(std::move(scratch)) {
  TwoEnds questions = make_socket(), answers = make_pipe(), errors = make_pipe();
  const std::string program = host.string();
  const Streams streams{questions.theirs.get(), answers.theirs.get(), errors.theirs.get()};
  const int error =
      SpawnThread::instance().run([&] { return spawn(program, arguments, streams, native, &pid_); });
  if (error != 0)
    throw InputError(program, std::string("the worker program cannot be started: ") + std::strerror(error));
  questions_ = std::move(questions.ours);
  answers_ = std::move(answers.ours);
  errors_ = std::move(errors.ours);
  open_clock();
}

WorkerProcess::WorkerProcess(std::shared_ptr<WorkerProcess> fork_server, const Native* native)
    : fork_server_(std::move(fork_server)) {
  TwoEnds questions = make_socket(), answers = make_pipe(), errors = make_pipe();
  fcntl(answers.ours.get(), F_SETPIPE_SZ, pipe_bytes);
  const std::array streams{questions.theirs.get(), answers.theirs.get(), errors.theirs.get()};
  fork_server::Request wanted{fork_server::Op::fork, native && native->buffers_answers};
  if (native) native->engine.copy(wanted.engine.data(), wanted.engine.size() - 1);
  const auto reply = fork_server_->request(wanted, &streams);
  if (!reply || reply->value <= 0) throw InputError("", "the process that loaded the plug-in has died");
  number_ = reply->value;
  pid_ = sender(questions.ours.get(), fork_server_reply_ms);
  if (pid_ <= 0) throw InputError("", "the worker died during startup");
  questions_ = std::move(questions.ours);
  answers_ = std::move(answers.ours);
  errors_ = std::move(errors.ours);
  open_clock();
}

WorkerProcess::~WorkerProcess() {
  if (pid_ > 0) end();
}

void WorkerProcess::open_clock() {
  if (clock_getcpuclockid(pid_, &clock_) != 0)
    clock_ = CLOCK_PROCESS_CPUTIME_ID;  // gone already: has_ended() tells
}

std::optional<fork_server::Reply> WorkerProcess::request(
    fork_server::Request what, const std::array<int, fork_server::descriptor_count>* with) {
  const std::lock_guard lock(mutex_);
  iovec body{&what, sizeof what};
  msghdr message{};
  message.msg_iov = &body;
  message.msg_iovlen = 1;
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof *with)] = {};
  if (with) {
    message.msg_control = control;
    message.msg_controllen = sizeof control;
    cmsghdr* const header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(sizeof *with);
    std::memcpy(CMSG_DATA(header), with->data(), sizeof *with);
  }
  if (inner_pid_ < 0) inner_pid_ = sender(questions_.get(), fork_server_reply_ms);
  std::optional<fork_server::Reply> reply;
  if (sendmsg(questions_.get(), &message, MSG_NOSIGNAL) == static_cast<ssize_t>(sizeof what))
    reply = await_reply();
  // A fork server that does not answer a request never will: its plug-in stopped it, or worse.
  if (!reply) end();
  return reply;
}

std::optional<fork_server::Reply> WorkerProcess::await_reply() {
  pollfd ready{questions_.get(), POLLIN, 0};
  for (int waited = 0; poll(&ready, 1, slice_ms) <= 0; waited += slice_ms)
    if (waited > fork_server_reply_ms || is_stuck()) return std::nullopt;
  fork_server::Reply reply{};
  if (recv(questions_.get(), &reply, sizeof reply, 0) != static_cast<ssize_t>(sizeof reply))
    return std::nullopt;
  return reply;
}

/// True if the fork server was stopped by a signal or is gone.
bool WorkerProcess::is_stuck() const {
  const ProcessUsage u = usage_of(inner_pid_);
  return u.state == 'T' || u.is_gone();
}

/// Sets reaped_ and status_ if the process has ended; if `wait`, blocks until it has.
bool WorkerProcess::reap(bool wait) {
  if (reaped_) return true;
  if (!fork_server_) return reap_child(wait);
  const auto reply =
      fork_server_->request({wait ? fork_server::Op::wait : fork_server::Op::poll, number_}, nullptr);
  reaped_ = !reply || reply->value != 0;
  // Workers die with their fork server, by SIGKILL.
  if (reaped_) status_ = reply ? reply->status : SIGKILL;
  return reaped_;
}

bool WorkerProcess::reap_child(bool wait) {
  pid_t ended = 0;
  do ended = waitpid(pid_, &status_, wait ? 0 : WNOHANG);
  while (ended < 0 && errno == EINTR);
  reaped_ = ended == pid_;
  return reaped_;
}

/// Lets the supervisor end all its descendants, and then itself.
void WorkerProcess::end_supervised() {
  kill(pid_, SIGTERM);
  if (!ends_within(orderly_end_seconds)) kill(pid_, SIGKILL);
  reap(/*wait=*/true);
}

double WorkerProcess::cpu_seconds() const {
  timespec t{};
  if (!reaped_ && clock_ != CLOCK_PROCESS_CPUTIME_ID && clock_gettime(clock_, &t) == 0)
    last_cpu_ = static_cast<double>(t.tv_sec) + seconds_per_ns * static_cast<double>(t.tv_nsec);
  return last_cpu_;
}

void WorkerProcess::drain_errors() {
  char buffer[4096];
  for (;;) {
    const ssize_t n = read(errors_.get(), buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n == 0) errors_.close();  // otherwise poll() would keep reporting the end of the stream
    if (n <= 0) return;
    error_tail_.append(buffer, static_cast<std::size_t>(n));
    if (error_tail_.size() > 2 * last_words_bytes)
      error_tail_.erase(0, error_tail_.size() - last_words_bytes);
  }
}

bool WorkerProcess::has_ended() {
  const std::lock_guard lock(mutex_);
  return reap(/*wait=*/false);
}

bool WorkerProcess::ends_within(double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  while (!has_ended()) {
    if (std::chrono::duration<double>(Clock::now() - start).count() > seconds) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  return true;
}

// Valgrind writes to the standard error that it was started with, so its messages about a worker appear in
// the fork server's.
std::string WorkerProcess::memcheck_messages_about(pid_t worker) {
  const std::lock_guard lock(mutex_);
  if (errors_.get() >= 0) drain_errors();
  const std::string mark = "==" + std::to_string(worker) + "==";
  std::istringstream all(error_tail_);
  std::string of_worker;
  for (std::string line; std::getline(all, line);)
    if (line.starts_with(mark)) of_worker += line + '\n';
  return of_worker;
}

LastWords WorkerProcess::end() {
  const std::lock_guard lock(mutex_);
  if (scratch_ && !reaped_) {
    end_supervised();
  } else if (!reaped_) {
    // A process that has ended but was not reaped keeps its pid and its status: the signals have no effect.
    kill(-pid_, SIGKILL);
    kill(pid_, SIGKILL);  // in case it has left its group
    reap(/*wait=*/true);
  } else if (!fork_server_ || !fork_server_->scratch_) {
    kill(-pid_, SIGKILL);  // its remaining children; in a sandbox the fork server has ended them
  }
  if (errors_.get() >= 0) drain_errors();
  if (fork_server_) error_tail_ += fork_server_->memcheck_messages_about(pid_);
  const bool by_signal = WIFSIGNALED(status_);
  const std::string how =
      by_signal ? signal_name(WTERMSIG(status_)) : "exit code " + std::to_string(WEXITSTATUS(status_));
  // Only for ends that print a message: the last line before a segmentation fault belongs to an earlier
  // query.
  const bool speaks = by_signal ? WTERMSIG(status_) == SIGABRT : WEXITSTATUS(status_) != 0;
  return last_words(how, error_tail_, speaks);
}

}  // namespace touchstone
