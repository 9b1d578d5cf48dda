// An engine's library at a commit of its git repository: exported, built by CMake, installed in a cache, and
// the adapter compiled against it. Neither the repository nor its working tree is changed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace touchstone::cli {

struct LibrarySource {
  std::filesystem::path repository;
  std::string adapter;
  std::vector<std::string> cmake_options;  // for the library, after those of oracles/ADAPTER/library.cmake
  std::filesystem::path cache;             // empty: default_library_cache()
};

/// touchstone/libraries in $XDG_CACHE_HOME (by default ~/.cache).
std::filesystem::path default_library_cache();

class LibraryCommits {
 public:
  /// Throws InputError when this is no git repository or there is no such adapter.
  explicit LibraryCommits(LibrarySource source);

  /// The full hash of a commit. Throws InputError when the repository has no such one.
  std::string hash_of(const std::string& revision) const;
  /// "1a2b3c4d 2026-11-23 Author: subject".
  std::string line_of(const std::string& commit) const;

  /// The adapter's plug-ins for the library at this commit, sorted. Libraries are kept by the hash of the
  /// commit's tree, so commits with the same files are built once. Throws CommandFailed with the log's name
  /// when the library or the adapter does not build.
  std::vector<std::filesystem::path> plugins_at(const std::string& commit);

  /// The first bad commit between `good` and `bad`, by git bisect in a clone; `verdict` is asked for each
  /// commit to be tested.
  enum class Verdict { good, bad, skip };
  struct Found {
    std::string first_bad;              // empty: only skipped commits are left
    std::vector<std::string> suspects;  // then, any of these may be it
  };
  template <class Ask>
  Found first_bad(const std::string& good, const std::string& bad, Ask&& verdict);

  int built() const { return built_; }
  int reused() const { return reused_; }

 private:
  std::filesystem::path folder_of(const std::string& commit) const;
  void export_tree(const std::filesystem::path& repository, const std::string& commit,
                   const std::filesystem::path& to) const;
  void build_library(const std::string& commit, const std::filesystem::path& folder) const;
  std::filesystem::path start_bisection(const std::string& good, const std::string& bad) const;
  std::string next_commit(const std::filesystem::path& clone) const;
  /// Returns true when the search has ended.
  bool tell(const std::filesystem::path& clone, const std::string& commit, Verdict verdict,
            Found& found) const;

  LibrarySource source_;
  std::filesystem::path log_;
  int built_ = 0, reused_ = 0;
};

template <class Ask>
LibraryCommits::Found LibraryCommits::first_bad(const std::string& good, const std::string& bad,
                                                Ask&& verdict) {
  const std::filesystem::path clone = start_bisection(good, bad);
  Found found;
  for (bool ended = false; !ended;) {
    const std::string commit = next_commit(clone);
    if (commit == bad) {  // nothing lies between the two
      found.first_bad = bad;
      break;
    }
    ended = tell(clone, commit, verdict(commit), found);
  }
  std::error_code none;
  std::filesystem::remove_all(clone, none);
  return found;
}

}  // namespace touchstone::cli
