#include "reports/chart/chart.h"

#include <sys/utsname.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

namespace touchstone::fuzz {
namespace {

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("model name"))
      if (const auto colon = line.find(": "); colon != std::string::npos) return line.substr(colon + 2);
  return "unknown";
}

std::string today() {
  char text[32];
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::strftime(text, sizeof text, "%Y-%m-%d", &utc);
  return text;
}

}  // namespace

Machine this_machine() {
  Machine m;
  m.processor = processor();
  m.cores = std::thread::hardware_concurrency();
  m.date = today();
  utsname u{};
  if (uname(&u) == 0) m.system = std::string(u.sysname) + " " + u.release + " " + u.machine;
#ifdef __clang__
  m.compiler = __VERSION__;  // includes the compiler's name
#elif defined(__GNUC__)
  m.compiler = "GCC " __VERSION__;
#endif
  double load[1] = {0};
  if (getloadavg(load, 1) == 1) m.load = load[0];
  return m;
}

}  // namespace touchstone::fuzz
