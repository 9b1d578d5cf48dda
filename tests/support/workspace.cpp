#include "tests/support/workspace.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

namespace touchstone::test {

std::string read_all(const std::filesystem::path& p) {
  std::ifstream f(p, std::ios::binary);
  return {std::istreambuf_iterator<char>(f), {}};
}

std::string last_line(const std::string& text) {
  if (text.size() < 2) return text;
  const auto before = text.rfind('\n', text.size() - 2);
  return text.substr(before == std::string::npos ? 0 : before + 1);
}

Workspace::Workspace(const std::string& name)
    : dir(std::filesystem::temp_directory_path() / ("touchstone-" + name + "-" + std::to_string(getpid()))) {
  std::filesystem::remove_all(dir);
  std::filesystem::create_directories(dir);
}

Workspace::~Workspace() { std::filesystem::remove_all(dir); }

std::filesystem::path Workspace::write(const std::string& name, const std::string& text) const {
  std::ofstream(dir / name) << text;
  return dir / name;
}

Run Workspace::touchstone(const std::string& args, const std::string& before) const {
  return run(before + " " TS_BINARY_DIR "/bin/touchstone " + args);
}

Run Workspace::run(const std::string& line) const {
  const std::string command = "cd " + dir.string() + " && (" + line + ") >" + (dir / "out.txt").string() +
                              " 2>" + (dir / "err.txt").string() + " </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_all(dir / "out.txt"), read_all(dir / "err.txt")};
}

}  // namespace touchstone::test
