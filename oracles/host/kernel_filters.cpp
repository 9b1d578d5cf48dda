// Landlock and seccomp through raw system calls, so that neither their libraries nor recent headers are
// needed.
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>

#if __has_include(<linux/seccomp.h>) && (defined(__x86_64__) || defined(__aarch64__))
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#define TOUCHSTONE_SECCOMP 1
#endif

#include "oracles/host/sandbox.h"

namespace touchstone::host {
namespace {

// System calls added since 2018 have the same number on every architecture.
constexpr long sys_landlock_create_ruleset = 444, sys_landlock_add_rule = 445,
               sys_landlock_restrict_self = 446;

struct Ruleset {
  std::uint64_t files, network, scopes;
};
struct __attribute__((packed)) PathRule {
  std::uint64_t allowed;
  std::int32_t parent;
};

enum Access : std::uint64_t {
  write_file = 1U << 1,
  // Creating and removing files and directories of every kind.
  change_directories = 0x1ff0U,
  refer = 1U << 13,     // version 2
  truncate_ = 1U << 14  // version 3
};
constexpr std::uint64_t tcp = 3;              // bind and connect, version 4
constexpr std::uint64_t sockets_signals = 3;  // abstract Unix sockets and signals to outside, version 6

std::uint64_t all_writing(long version) {
  std::uint64_t a = write_file | change_directories;
  if (version >= 2) a |= refer;
  if (version >= 3) a |= truncate_;
  return a;
}

void allow(int rules, const char* path, std::uint64_t access) {
  const int fd = open(path, O_PATH | O_CLOEXEC);
  if (fd < 0) return;
  const PathRule rule{access, fd};
  syscall(sys_landlock_add_rule, rules, 1, &rule, 0);
  close(fd);
}

// Devices that store nothing, and GPUs, which engines may compute on.
constexpr const char* devices[] = {"/dev/null",      "/dev/zero",       "/dev/full",       "/dev/random",
                                   "/dev/urandom",   "/dev/tty",        "/dev/dri",        "/dev/kfd",
                                   "/dev/nvidiactl", "/dev/nvidia-uvm", "/dev/nvidia0",    "/dev/nvidia1",
                                   "/dev/nvidia2",   "/dev/nvidia3",    "/dev/nvidia-caps"};

}  // namespace

bool limit_writing_by_landlock(const std::string& scratch) {
  const long version = syscall(sys_landlock_create_ruleset, nullptr, 0, 1);
  if (version < 1) return false;
  Ruleset wanted{all_writing(version), version >= 4 ? tcp : 0, version >= 6 ? sockets_signals : 0};
  // An older kernel refuses a longer structure unless the fields that it does not know are zero.
  const int rules = static_cast<int>(syscall(sys_landlock_create_ruleset, &wanted, sizeof wanted, 0));
  if (rules < 0) return false;
  allow(rules, scratch.c_str(), wanted.files);
  for (const char* d : devices) allow(rules, d, wanted.files & (write_file | truncate_));
  const bool done = syscall(sys_landlock_restrict_self, rules, 0) == 0;
  close(rules);
  return done;
}

#ifdef TOUCHSTONE_SECCOMP

// Without socket() no connection is possible, neither TCP nor to a Unix socket in the file system.
// socketpair() stays, because language runtimes use it to talk to their own children. io_uring could bypass
// the filter, and programs manage without it. Access to other processes' memory is denied.
bool forbid_sockets() {
#if defined(__x86_64__)
  constexpr std::uint32_t architecture = AUDIT_ARCH_X86_64, other_calls = 0x40000000;  // x32
#else
  constexpr std::uint32_t architecture = AUDIT_ARCH_AARCH64, other_calls = 0xffffffff;
#endif
  constexpr std::uint32_t denied = SECCOMP_RET_ERRNO | EACCES, absent = SECCOMP_RET_ERRNO | ENOSYS;
  constexpr std::uint16_t load = BPF_LD | BPF_W | BPF_ABS, equal = BPF_JMP | BPF_JEQ | BPF_K,
                          at_least = BPF_JMP | BPF_JGE | BPF_K, end = BPF_RET | BPF_K;
  constexpr std::uint32_t io_uring_setup = 425;
  sock_filter program[] = {
      {load, 0, 0, offsetof(seccomp_data, arch)},
      {equal, 1, 0, architecture},
      {end, 0, 0, absent},
      {load, 0, 0, offsetof(seccomp_data, nr)},
      {at_least, 6, 0, other_calls},
      {equal, 6, 0, SYS_socket},
      {equal, 5, 0, SYS_ptrace},
      {equal, 4, 0, SYS_process_vm_writev},
      {equal, 3, 0, SYS_process_vm_readv},
      {equal, 1, 0, io_uring_setup},
      {end, 0, 0, SECCOMP_RET_ALLOW},
      {end, 0, 0, absent},
      {end, 0, 0, denied},
  };
  sock_fprog filter{sizeof program / sizeof *program, program};
  return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

#else

bool forbid_sockets() { return false; }

#endif

}  // namespace touchstone::host
