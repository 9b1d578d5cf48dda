// A temporary directory for a test that runs the program as a user does.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace touchstone::test {

struct Run {
  int code = -1;
  std::string out, err;
};

std::string read_all(const std::filesystem::path& p);
/// With its end of line.
std::string last_line(const std::string& text);

struct Workspace {
  std::filesystem::path dir;
  explicit Workspace(const std::string& name);
  ~Workspace();
  std::filesystem::path write(const std::string& name, const std::string& text) const;
  /// `before`: a command prefix, such as timeout.
  Run touchstone(const std::string& args, const std::string& before = "") const;
  /// Runs a shell command line in the directory. Code -1: ended by a signal.
  Run run(const std::string& line) const;
};

}  // namespace touchstone::test
