#include "cli/installed.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "core/base/input_error.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::cli {
namespace {

bool is_package_name(const std::string& s) {
  return !s.empty() && s[0] != '-' && std::all_of(s.begin(), s.end(), [](unsigned char c) {
    return std::islower(c) || std::isdigit(c) || c == '+' || c == '-' || c == '.';
  });
}

std::string contents_of(const std::filesystem::path& file) {
  require_regular_file(file);
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

std::vector<DebianPackage> packages_in(const std::filesystem::path& file) {
  std::vector<DebianPackage> all;
  std::istringstream in(contents_of(file));
  for (std::string line; std::getline(in, line);) {
    const std::size_t space = std::min(line.find(' '), line.size());
    DebianPackage p{line.substr(0, space), line.substr(std::min(space + 1, line.size()))};
    if (!is_package_name(p.name)) throw InputError(file.string(), p.name + " is not the name of a package");
    all.push_back(std::move(p));
  }
  return all;
}

bool has_dpkg() { return !program_on_path("dpkg-query").empty(); }

bool is_installed(const std::string& package) {
  const std::string command =
      "dpkg-query -W -f '${Status}' " + package + " 2>/dev/null | grep -q 'ok installed'";
  return std::system(command.c_str()) == 0;
}

std::string program_on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::stringstream directories(path ? path : "");
  for (std::string directory; std::getline(directories, directory, ':');)
    if (const std::string file = directory + "/" + name;
        !directory.empty() && access(file.c_str(), X_OK) == 0)
      return file;
  return "";
}

}  // namespace touchstone::cli
