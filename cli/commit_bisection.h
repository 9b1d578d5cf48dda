// `bisect commit --source`: which commit of an engine's library a finding came with.
#pragma once

#include <string>
#include <vector>

#include "cli/case_argument.h"
#include "oracles/client/worker_limits.h"

namespace touchstone::cli {

struct CommitOptions {
  std::string source;  // repository of the library
  std::string commit = "HEAD", good, bad = "HEAD";
  std::vector<std::string> cmake_options;
  std::string cache;
};

/// Exit codes of `git bisect run`: 0 good, 1 bad, 125 skip, and above 127 to end the bisection.
inline constexpr int exit_skip = 125, exit_abort = 128;

/// Without `good`: the answer for one commit, as an exit code of `git bisect run`; what is wrong with the
/// command line itself ends with exit_abort. With it: the search between `good` and `bad`; 0 when the commit
/// is found, 3 when it cannot be.
int bisect_commits(const FindingArgument& finding, const CommitOptions& options, const WorkerLimits& limits);

}  // namespace touchstone::cli
