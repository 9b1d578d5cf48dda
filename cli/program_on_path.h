// Where a program is that the user names as in a shell.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <string>

namespace touchstone::cli {

/// The first executable file of that name in the directories of $PATH; empty: there is none.
inline std::string program_on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::stringstream directories(path ? path : "");
  for (std::string directory; std::getline(directories, directory, ':');)
    if (const std::string file = directory + "/" + name;
        !directory.empty() && access(file.c_str(), X_OK) == 0)
      return file;
  return "";
}

}  // namespace touchstone::cli
