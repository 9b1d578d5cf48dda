// Animals that reach outside: files, network, processes, memory.
#include <arpa/inet.h>
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/zoo/zoo.h"

namespace touchstone::zoo {
namespace {

void write_file(const char* path) {
  const int fd = open(path, O_WRONLY | O_CREAT, 0644);
  if (fd < 0) return;
  if (write(fd, "was here", 8) < 0) std::perror(path);
  close(fd);
}

void connect_tcp() {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const char* port = std::getenv("TOUCHSTONE_ZOO_PORT");
  to.sin_port = htons(static_cast<std::uint16_t>(port ? std::atoi(port) : 1));
  if (connect(fd, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0) sleep(1);
  close(fd);
}

void connect_by_name() {
  const int fd = socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un to{};
  to.sun_family = AF_UNIX;
  std::snprintf(to.sun_path, sizeof to.sun_path, "%s", victim("socket"));
  if (connect(fd, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0) sleep(1);
  close(fd);
}

// As root of its own namespace it may mount, but not undo the mounts that it was given.
void remount_and_write() {
  if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return;
  mount(nullptr, "/", nullptr, MS_REMOUNT | MS_BIND, nullptr);
  mount(nullptr, victim("."), nullptr, MS_REMOUNT | MS_BIND, nullptr);
  write_file(victim("after a remount"));
}

void remove_working_directory() {
  std::error_code ignored;
  for (const auto& e : std::filesystem::directory_iterator(".", ignored))
    std::filesystem::remove_all(e.path(), ignored);
}

void fill_scratch() {
  const std::string block(1 << 20, 'x');
  signal(SIGXFSZ, SIG_IGN);
  const int fd = open("full", O_WRONLY | O_CREAT, 0600);
  for (int i = 0; i < 400 && write(fd, block.data(), block.size()) > 0; ++i) {
  }
  close(fd);
}

void write_scratch_or_abort() {
  write_file("mine");
  if (access("mine", R_OK) != 0) std::abort();
}

void start_children(int n, void (*be)()) {
  for (int i = 0; i < n; ++i)
    if (fork() == 0) {
      take_mark();
      be();
      _exit(0);
    }
}

void leave_deaf_daemon() {
  if (fork() != 0) return;
  take_mark();
  setsid();
  prctl(PR_SET_PDEATHSIG, 0);
  for (int s = 1; s < 32; ++s) signal(s, SIG_IGN);
  sleep_for_ever();
}

void leave_descriptors() {
  for (int i = 0; i < 5000; ++i)
    if (open("/dev/null", O_RDONLY) < 0) return;
}

}  // namespace

void take_mark() {
  const char* mark = std::getenv("TOUCHSTONE_ZOO_MARK");
  prctl(PR_SET_NAME, mark ? mark : "zoo");
}

const char* victim(const char* name) {
  static std::string path;
  const char* directory = std::getenv("TOUCHSTONE_ZOO_VICTIM");
  path = std::string(directory ? directory : "/nonexistent") + "/" + name;
  return path.c_str();
}

void eat_memory() {
  std::vector<char*> blocks;
  for (;;) {
    char* const block = static_cast<char*>(std::malloc(1 << 20));
    if (!block) continue;
    std::memset(block, 1, 1 << 20);
    blocks.push_back(block);
  }
}

void leave_daemon() {
  if (fork() != 0) return;
  setsid();
  if (fork() != 0) _exit(0);
  take_mark();
  sleep_for_ever();
}

#define ANIMAL(name, ...)                                 \
  Animal {                                                \
    name, [](ts_answer*, const ts_sink*) { __VA_ARGS__; } \
  }

const Animal reaches[] = {
    ANIMAL("makes_a_file", write_file(victim("made"))),
    ANIMAL("changes_a_file", write_file(victim("file"))),
    ANIMAL("empties_a_file", if (truncate(victim("file"), 0) != 0) return ),
    ANIMAL("removes_a_file", unlink(victim("file"))),
    ANIMAL("renames_a_file", const std::string to = victim("renamed");
           std::rename(victim("file"), to.c_str())),
    ANIMAL("opens_a_file_to_all", chmod(victim("file"), 0777)),
    ANIMAL("makes_a_directory", mkdir(victim("directory"), 0755)),
    ANIMAL("makes_a_link", if (symlink("/etc/passwd", victim("link")) != 0) return ),
    ANIMAL("makes_a_fifo", mkfifo(victim("fifo"), 0644)),
    ANIMAL("removes_the_working_directory", remove_working_directory()),
    ANIMAL("writes_its_scratch", write_scratch_or_abort()),
    ANIMAL("fills_its_scratch", fill_scratch()),
    ANIMAL("goes_to_the_root", if (chdir("/") != 0) return ),
    ANIMAL("remounts", remount_and_write()),
    ANIMAL("connects_by_tcp", connect_tcp()),
    ANIMAL("connects_by_name", connect_by_name()),
    ANIMAL("follows_its_parent", ptrace(PTRACE_ATTACH, getppid(), nullptr, nullptr)),
    ANIMAL("leaves_a_child", start_children(1, sleep_for_ever)),
    ANIMAL("leaves_fifty_children", start_children(50, sleep_for_ever)),
    ANIMAL("leaves_a_daemon", leave_daemon()),
    ANIMAL("leaves_a_deaf_daemon", leave_deaf_daemon()),
    ANIMAL("leaves_a_daemon_and_dies", leave_daemon(); std::abort()),
    ANIMAL("leaves_a_command", if (std::system("sleep 1000 &") != 0) return ),
    ANIMAL("eats_memory", eat_memory()),
    ANIMAL("eats_memory_in_a_child", start_children(1, eat_memory); sleep_for_ever()),
    ANIMAL("asks_for_all_memory", volatile std::size_t all = std::size_t{1} << 60;
           if (!std::malloc(all)) throw 1),
    ANIMAL("leaves_descriptors", leave_descriptors()),
};
const std::size_t reach_count = std::size(reaches);

}  // namespace touchstone::zoo
