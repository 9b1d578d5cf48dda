#include "oracles/host/sandbox.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <linux/capability.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace touchstone::host {
namespace {

constexpr rlim_t scratch_bytes = rlim_t{256} << 20;  // per file, and in total if it is a tmpfs
constexpr rlim_t most_descriptors = 1024, most_processes = 512;
// Private memory may be twice the limit on resident memory, which the harness watches. Address space costs
// nothing and may be much larger.
constexpr rlim_t data_factor = 2, address_factor = 16;

void limit(decltype(RLIMIT_CORE) what, rlim_t most) {
  rlimit now{};
  if (getrlimit(what, &now) != 0) return;
  now.rlim_max = std::min(now.rlim_max, most);
  now.rlim_cur = std::min(now.rlim_cur, now.rlim_max);
  setrlimit(what, &now);
}

/// Before Linux 5.14 the limit counted all processes of the user, who may have many.
bool counts_processes_by_namespace() {
  utsname u{};
  int major = 0, minor = 0;
  return uname(&u) == 0 && std::sscanf(u.release, "%d.%d", &major, &minor) == 2 &&
         (major > 5 || (major == 5 && minor >= 14));
}

bool is_sanitized() { return dlsym(RTLD_DEFAULT, "__asan_init") || dlsym(RTLD_DEFAULT, "__tsan_init"); }

std::string set_limits(const SandboxWish& wish, const Apart& apart) {
  std::string text = "files of 256 MiB, " + std::to_string(most_descriptors) + " descriptors";
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, scratch_bytes);
  limit(RLIMIT_NOFILE, most_descriptors);
  if (apart.user_namespace && geteuid() != 0 && counts_processes_by_namespace()) {
    limit(RLIMIT_NPROC, most_processes);
    text += ", " + std::to_string(most_processes) + " processes";
  }
  if (wish.memory_bytes == 0 || is_sanitized()) return text;
  limit(RLIMIT_DATA, data_factor * wish.memory_bytes);
  // Programs with a JIT compiler reserve more address space than any sensible limit allows.
  if (!wish.is_command) limit(RLIMIT_AS, address_factor * wish.memory_bytes);
  return text + ", " + std::to_string(data_factor * wish.memory_bytes >> 20) + " MiB of private memory";
}

struct MountAttributes {
  std::uint64_t set, clear, propagation, user_namespace;
};

/// Creates a private mount namespace: everything read-only, and a small tmpfs on the scratch directory.
bool make_read_only(const std::string& scratch) {
  constexpr long sys_mount_setattr = 442;
  constexpr unsigned recursive = 0x8000;
  constexpr std::uint64_t read_only = 1;
  if (unshare(CLONE_NEWNS) != 0) return false;
  if (mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return false;
  const MountAttributes wanted{read_only, 0, 0, 0};
  const std::string options = "mode=0700,size=" + std::to_string(scratch_bytes);
  // The scratch directory comes first: if mounting it fails, the directory itself must stay writable.
  if (mount("touchstone", scratch.c_str(), "tmpfs", MS_NOSUID | MS_NODEV, options.c_str()) != 0) return false;
  if (syscall(sys_mount_setattr, AT_FDCWD, "/", recursive, &wanted, sizeof wanted) != 0) return false;
  const MountAttributes writable{0, read_only, 0, 0};
  return syscall(sys_mount_setattr, AT_FDCWD, scratch.c_str(), 0, &writable, sizeof writable) == 0;
}

/// Drops all capabilities, except that a harness run by root keeps root's right to read other users' files.
void drop_capabilities() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct had[2] = {}, kept[2] = {};
  syscall(SYS_capget, &header, had);
  if (geteuid() == 0) {
    kept[0].permitted = had[0].permitted & (1U << CAP_DAC_READ_SEARCH);
    kept[0].effective = kept[0].permitted;
  }
  syscall(SYS_capset, &header, kept);
}

void go_to(const SandboxWish& wish) {
  setenv("TMPDIR", wish.scratch.c_str(), 1);
  if (!wish.is_command && chdir(wish.scratch.c_str()) != 0)
    std::perror(("touchstone-host: " + wish.scratch).c_str());
}

std::string describe(bool mounts, bool landlock, bool sockets, const Apart& apart) {
  std::string files = mounts && landlock ? "read-only by mounts and Landlock"
                      : mounts           ? "read-only by mounts"
                      : landlock         ? "read-only by Landlock"
                                         : "NOT protected";
  return "files " + files + "; network " + (sockets ? "closed by seccomp" : "NOT closed") + "; processes " +
         (apart.pid_namespace ? "in a PID namespace" : "below a subreaper");
}

}  // namespace

Sandbox enter_sandbox(const SandboxWish& wish) {
  const Apart apart = supervise(wish.scratch);
  const std::string limits = set_limits(wish, apart);
  const bool mounts = apart.may_mount && make_read_only(wish.scratch);
  if (apart.may_mount) unshare(CLONE_NEWIPC);
  drop_capabilities();
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  const bool landlock = limit_writing_by_landlock(wish.scratch);
  const bool sockets = forbid_sockets();
  go_to(wish);
  return {describe(mounts, landlock, sockets, apart) + "; at most " + limits, apart};
}

}  // namespace touchstone::host
