#include "cli/library_commits.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "cli/adapter_build.h"
#include "cli/command.h"
#include "cli/logged_command.h"
#include "core/base/hash.h"
#include "core/base/input_error.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* installed_stamp = "installed";  // written when the library is complete
constexpr const char* log_name = "build.log";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// In English, because its answers are read.
Words git_in(const fs::path& repository, const Words& arguments) {
  Words words{"env", "LC_ALL=C", "git", "-C", repository.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

// Everything that an adapter is compiled from.
std::string kit_hash(const std::string& adapter) {
  std::vector<fs::path> files;
  for (const char* folder : {"core/math", "oracles/abi"})
    for (const auto& entry : fs::directory_iterator(kit_folder() / folder))
      if (entry.path().extension() == ".h") files.push_back(entry.path());
  for (const auto& entry : fs::recursive_directory_iterator(kit_folder() / "oracles" / adapter))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  Hasher h;
  for (const fs::path& file : files) h.add(read_file(file));
  return fmt::format("{:016x}", h.value());
}

// The folder with the CMakeLists.txt: the source itself, or its folder Build.
fs::path cmake_folder(const fs::path& source) {
  for (const char* below : {"", "Build"})
    if (fs::exists(source / below / "CMakeLists.txt")) return source / below;
  throw CommandFailed("this commit has no CMakeLists.txt");
}

void run_or_fail(const Words& words, const fs::path& log, const std::string& what) {
  if (!run_logged(words, log))
    throw CommandFailed(fmt::format("{}:\n{}full log: {}", what, reasons_in(log, "fatal: "), log.string()));
}

}  // namespace

fs::path default_library_cache() {
  const char* chosen = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  fs::path cache = chosen ? chosen : "";
  if (!cache.is_absolute()) cache = fs::path(home ? home : "") / ".cache";
  return cache / "touchstone/libraries";
}

LibraryCommits::LibraryCommits(LibrarySource source) : source_(std::move(source)) {
  require_program("git", "to read the history of a library");
  require_adapter(source_.adapter);
  if (source_.cache.empty()) source_.cache = default_library_cache();
  source_.cache = fs::absolute(source_.cache);
  create_folder(source_.cache);
  log_ = source_.cache / fmt::format("git-{}.log", getpid());
  write_file(log_, "");
  if (!run_captured(git_in(source_.repository, {"rev-parse", "--git-dir"}), log_).succeeded)
    throw InputError("--source " + source_.repository.string(),
                     "is not a git repository:\n" + reasons_in(log_, "fatal: "));
}

std::string LibraryCommits::hash_of(const std::string& revision) const {
  const Captured r = run_captured(
      git_in(source_.repository, {"rev-parse", "--verify", "--end-of-options", revision + "^{commit}"}),
      log_);
  if (!r.succeeded) throw InputError("commit " + revision, "is not in " + source_.repository.string());
  return r.out;
}

std::string LibraryCommits::line_of(const std::string& commit) const {
  return output_of(
      git_in(source_.repository, {"show", "-s", "--date=short", "--format=%h %ad %an: %s", commit}), log_);
}

fs::path LibraryCommits::folder_of(const std::string& commit) const {
  const std::string tree = output_of(git_in(source_.repository, {"rev-parse", commit + "^{tree}"}), log_);
  Hasher h;
  for (const std::string& option : source_.cmake_options) h.add(option);
  h.add(read_file(kit_folder() / "oracles" / source_.adapter / "library.cmake"));
  return source_.cache / fmt::format("{}-{}-{:08x}", source_.adapter, tree, h.value() & 0xffffffff);
}

// git archive leaves submodules out: theirs come from their own repositories, where these are checked out.
void LibraryCommits::export_tree(const fs::path& repository, const std::string& commit,
                                 const fs::path& to) const {
  create_folder(to);
  const fs::path tar = to.string() + ".tar";
  output_of(git_in(repository, {"archive", "--format=tar", "-o", tar.string(), commit}), log_);
  output_of({"tar", "-x", "-f", tar.string(), "-C", to.string()}, log_);
  fs::remove(tar);
  for (const std::string& line : lines_of(output_of(git_in(repository, {"ls-tree", "-r", commit}), log_))) {
    if (!line.starts_with("160000 ")) continue;
    const auto tab = line.find('\t');
    const std::string hash = line.substr(tab - 40, 40), path = line.substr(tab + 1);
    export_tree(repository / path, hash, to / path);
  }
}

void LibraryCommits::build_library(const std::string& commit, const fs::path& folder) const {
  std::error_code none;
  fs::remove_all(folder, none);
  create_folder(folder);
  const fs::path source = folder / "source", build = folder / "build", log = folder / log_name;
  write_file(log, "");
  export_tree(source_.repository, commit, source);
  const fs::path values = kit_folder() / "oracles" / source_.adapter / "library.cmake";
  Words configure{"cmake",
                  "-C",
                  values.string(),
                  "-S",
                  cmake_folder(source).string(),
                  "-B",
                  build.string(),
                  "-DCMAKE_BUILD_TYPE=Release",
                  "-DCMAKE_POSITION_INDEPENDENT_CODE=ON",
                  "-DCMAKE_INSTALL_PREFIX=" + (folder / "prefix").string()};
  configure.insert(configure.end(), source_.cmake_options.begin(), source_.cmake_options.end());
  run_or_fail(configure, log, "CMake does not configure the library");
  const std::string jobs = std::to_string(processor_count());
  run_or_fail({"cmake", "--build", build.string(), "--parallel", jobs}, log, "the library does not build");
  run_or_fail({"cmake", "--install", build.string()}, log, "the library does not install");
  fs::remove_all(source, none);
  fs::remove_all(build, none);
  write_file(folder / installed_stamp, commit + "\n");
}

std::vector<fs::path> LibraryCommits::plugins_at(const std::string& commit) {
  require_program("cmake", "to build libraries (Debian: cmake)");
  const fs::path folder = folder_of(commit), adapter = folder / ("adapter-" + kit_hash(source_.adapter));
  if (fs::exists(folder / installed_stamp)) {
    ++reused_;
  } else {
    build_library(commit, folder);
    ++built_;
  }
  return build_adapter({source_.adapter, folder / "prefix", adapter, folder / log_name});
}

fs::path LibraryCommits::start_bisection(const std::string& good, const std::string& bad) const {
  const fs::path clone = source_.cache / fmt::format("bisection-{}", getpid());
  std::error_code none;
  fs::remove_all(clone, none);
  output_of({"git", "clone", "--quiet", "--shared", "--no-checkout",
             fs::absolute(source_.repository).string(), clone.string()},
            log_);
  output_of(git_in(clone, {"bisect", "start", "--no-checkout", bad, good}), log_);
  return clone;
}

std::string LibraryCommits::next_commit(const fs::path& clone) const {
  return output_of(git_in(clone, {"rev-parse", "BISECT_HEAD"}), log_);
}

bool LibraryCommits::tell(const fs::path& clone, const std::string& commit, Verdict verdict,
                          Found& found) const {
  const char* const word = verdict == Verdict::good ? "good" : verdict == Verdict::bad ? "bad" : "skip";
  const Captured r = run_captured(git_in(clone, {"bisect", word, commit}), log_);
  for (const std::string& line : lines_of(r.out))
    if (line.ends_with(" is the first bad commit")) {
      found.first_bad = line.substr(0, line.find(' '));
      return true;
    }
  if (r.succeeded) return false;
  // git bisect ends with an error when only skipped commits are left, and lists them.
  for (const std::string& line : lines_of(r.out))
    if (line.size() == commit.size() && line.find_first_not_of("0123456789abcdef") == std::string::npos)
      found.suspects.push_back(line);
  if (!found.suspects.empty()) return true;
  throw CommandFailed(
      fmt::format("git bisect failed:\n{}full log: {}", reasons_in(log_, "fatal: "), log_.string()));
}

}  // namespace touchstone::cli
