#include "oracles/host/fork_server.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "oracles/abi/fork_server_protocol.h"

namespace touchstone::host {
namespace {

using Descriptors = std::array<int, fork_server::descriptor_count>;

constexpr int high_descriptor = 100;
constexpr int fallback_descriptor = 10;  // under a low limit (ulimit -n 64)

/// False when there are no more requests.
bool receive(int fd, fork_server::Request& request, Descriptors& descriptors) {
  descriptors.fill(-1);
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(Descriptors))] = {};
  iovec body{&request, sizeof request};
  msghdr message{};
  message.msg_iov = &body;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  ssize_t n = 0;
  do n = recvmsg(fd, &message, MSG_CMSG_CLOEXEC);
  while (n < 0 && errno == EINTR);
  if (n != static_cast<ssize_t>(sizeof request)) return false;
  const cmsghdr* const header = CMSG_FIRSTHDR(&message);
  if (header && header->cmsg_type == SCM_RIGHTS && header->cmsg_len == CMSG_LEN(sizeof(Descriptors)))
    std::memcpy(descriptors.data(), CMSG_DATA(header), sizeof(Descriptors));
  return true;
}

std::string directory_of_worker(const ForkServer& server) { return server.scratch + "/worker"; }

void go_to_own_directory(const ForkServer& server) {
  if (server.scratch.empty() || server.is_shared) return;
  const std::string own = directory_of_worker(server);
  if (mkdir(own.c_str(), 0700) != 0 || (!server.keeps_working_directory && chdir(own.c_str()) != 0))
    std::perror(("touchstone-host: " + own).c_str());
  setenv("TMPDIR", own.c_str(), 1);
}

void clean_up_after_worker(const ForkServer& server) {
  if (server.scratch.empty() || server.is_shared) return;
  end_others(server.apart);
  std::error_code ignored;  // the next worker's mkdir reports a failure
  std::filesystem::remove_all(directory_of_worker(server), ignored);
}

[[noreturn]] void become_worker(const ForkServer& server, const Descriptors& d, pid_t parent,
                                const fork_server::Request& request,
                                const std::function<void(WorkerStreams)>& work) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(0);  // the parent died before the line above
  setpgid(0, 0);
  announce_pid(d[0]);
  if (dup2(d[2], 2) < 0 || dup2(2, 1) < 0) _exit(3);
  close(d[2]);
  const WorkerStreams streams{duplicate_high(d[0]), duplicate_high(d[1]), request.pid != 0,
                              request.engine.data()};
  if (streams.questions < 0 || streams.answers < 0) _exit(3);
  close(d[0]);
  close(d[1]);
  go_to_own_directory(server);
  work(streams);
  // Without destructors: a plug-in's exit handlers may hang.
  _exit(0);
}

// Under qemu-user 7.2, the child of fork() can loop for ever in the C library's list of threads' stacks,
// which _Fork() leaves alone. The fork server has one thread.
pid_t fork_once() {
#if defined(__aarch64__) && defined(__GLIBC__) && __GLIBC_PREREQ(2, 34)
  return _Fork();
#else
  return fork();
#endif
}

fork_server::Reply answer(const ForkServer& server, const fork_server::Request& request, const Descriptors& d,
                          const std::function<void(WorkerStreams)>& work) {
  if (request.op == fork_server::Op::fork) {
    const pid_t parent = getpid();
    const pid_t pid = d[0] < 0 ? -1 : fork_once();
    if (pid == 0) {
      close(server.control_fd);
      become_worker(server, d, parent, request, work);
    }
    if (pid > 0) setpgid(pid, pid);  // parent and child both do this, so it is set whichever runs first
    for (int fd : d)
      if (fd >= 0) close(fd);
    return {pid, 0};
  }
  int status = 0;
  pid_t ended = 0;
  do ended = waitpid(request.pid, &status, request.op == fork_server::Op::wait ? 0 : WNOHANG);
  while (ended < 0 && errno == EINTR);
  // The call also fails if a plug-in's SIGCHLD handler has reaped the child.
  const bool gone = ended == request.pid || ended < 0;
  if (gone) clean_up_after_worker(server);
  return {gone, status};
}

}  // namespace

int duplicate_high(int fd) {
  int high = fcntl(fd, F_DUPFD_CLOEXEC, high_descriptor);
  if (high < 0) high = fcntl(fd, F_DUPFD_CLOEXEC, fallback_descriptor);
  return high;
}

void announce_pid(int fd) {
  const char byte = 0;
  send(fd, &byte, 1, MSG_NOSIGNAL);
}

void run_fork_server(const ForkServer& fork_server, const std::function<void(WorkerStreams)>& work) {
  for (;;) {
    fork_server::Request request{};
    Descriptors descriptors;
    if (!receive(fork_server.control_fd, request, descriptors)) _exit(0);
    const fork_server::Reply reply = answer(fork_server, request, descriptors, work);
    if (send(fork_server.control_fd, &reply, sizeof reply, MSG_NOSIGNAL) !=
        static_cast<ssize_t>(sizeof reply))
      _exit(0);
  }
}

}  // namespace touchstone::host
