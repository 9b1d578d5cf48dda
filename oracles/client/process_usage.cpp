#include "oracles/client/process_usage.h"

#include <dirent.h>
#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace touchstone {
namespace {

constexpr std::size_t most_processes = 4096;

std::string contents(const std::string& file) {
  std::string text;
  const int fd = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return text;
  char buffer[4096];
  for (ssize_t n = 0; (n = read(fd, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(n));
  close(fd);
  return text;
}

// The kernel lists children per thread.
void append_children(pid_t pid, std::vector<pid_t>& out) {
  const std::string tasks = "/proc/" + std::to_string(pid) + "/task";
  DIR* const directory = opendir(tasks.c_str());
  if (!directory) return;
  while (const dirent* entry = readdir(directory)) {
    if (entry->d_name[0] == '.') continue;
    const std::string list = contents(tasks + "/" + entry->d_name + "/children");
    int used = 0, child = 0;
    for (const char* at = list.c_str(); std::sscanf(at, "%d%n", &child, &used) == 1; at += used)
      out.push_back(child);
  }
  closedir(directory);
}

char joint_state(char a, char b) {
  if (a == '?' || a == 'Z') return b;
  if (b == '?' || b == 'Z') return a;
  if (a == 'R' || a == 'D' || b == 'R' || b == 'D') return 'R';
  return a == b ? a : 'S';
}

void add(ProcessUsage& sum, const ProcessUsage& u) {
  sum.cpu_seconds += u.cpu_seconds;
  sum.resident_bytes += u.resident_bytes;
  sum.processes += u.processes;
  sum.state = joint_state(sum.state, u.state);
}

}  // namespace

ProcessUsage usage_of(pid_t pid) {
  const std::string text = contents("/proc/" + std::to_string(pid) + "/stat");
  const auto after_name = text.rfind(')');
  if (after_name == std::string::npos) return {};
  ProcessUsage u;
  unsigned long user = 0, kernel = 0;
  long user_of_children = 0, kernel_of_children = 0, pages = 0;
  // Fields 3, 14 to 17 and 24 of proc(5).
  const int n = std::sscanf(text.c_str() + after_name + 1,
                            " %c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %lu %lu %ld %ld %*d %*d %*d %*d %*u "
                            "%*u %ld",
                            &u.state, &user, &kernel, &user_of_children, &kernel_of_children, &pages);
  if (n != 6) return {};
  static const double tick = 1.0 / static_cast<double>(sysconf(_SC_CLK_TCK));
  static const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  u.cpu_seconds = tick * (static_cast<double>(user + kernel) +
                          static_cast<double>(user_of_children + kernel_of_children));
  u.resident_bytes = static_cast<std::uint64_t>(pages) * page;
  u.processes = u.state == 'Z' ? 0 : 1;
  return u;
}

ProcessUsage usage_of_tree(pid_t root, bool with_root) {
  ProcessUsage sum;
  std::vector<pid_t> all{root};
  for (std::size_t i = 0; i < all.size() && all.size() < most_processes; ++i) {
    if (i > 0 || with_root) add(sum, usage_of(all[i]));
    append_children(all[i], all);
  }
  return sum;
}

}  // namespace touchstone
