// Python with the modules that a test needs: the one on the path, or Debian's, which then comes first on it.
#pragma once

#include <cstdlib>
#include <string>

namespace touchstone::test {

inline bool has_python_with(const std::string& modules) {
  const auto works = [&](const std::string& python) {
    return std::system((python + " -c 'import " + modules + "' 2>/dev/null").c_str()) == 0;
  };
  if (works("python3")) return true;
  if (!works("/usr/bin/python3")) return false;
  const char* path = std::getenv("PATH");
  setenv("PATH", ("/usr/bin:" + std::string(path != nullptr ? path : "")).c_str(), 1);
  return true;
}

}  // namespace touchstone::test
