// replay --expected and --write-expected: compares the failures of all replayed cases with those in a file.
#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <string>
#include <vector>

#include "oracles/abi/engine.h"
#include "reports/record/expected.h"
#include "reports/record/result.h"

namespace touchstone::cli {

struct ExpectedOptions {
  std::string file, write, junit;
  bool strict = false;
  bool given() const { return !file.empty() || !write.empty(); }
};
void add_expected(CLI::App& app, ExpectedOptions& to);

class ExpectedFailures {
 public:
  /// Reads the file. `subject`: the only engine that counts; empty: all. Throws InputError, also when a file
  /// to be written cannot be.
  ExpectedFailures(const ExpectedOptions& o, std::string subject);

  /// Judges the engines' answers to a case, and takes what relations found in it.
  void add(const Case& c, std::span<const EnginePtr> engines, std::span<const CaseObservations> observations,
           const fuzz::CampaignResult& related);

  /// Arguments that could not be replayed.
  struct Bad {
    std::vector<std::string> arguments;
    fuzz::Json errors;  // with the reasons
    int code = 0;       // the exit code if there are any
  };
  /// Prints the comparison and the last line, and writes the files; if there are bad arguments, nothing is
  /// recorded. Returns the exit code.
  int finish(const Bad& bad, bool json) const;

 private:
  bool counts(const std::string& engine) const { return subject_.empty() || engine == subject_; }
  std::string subject_words() const { return subject_.empty() ? "all engines" : subject_; }
  int verdict(const fuzz::ExpectedComparison& c, const Bad& bad, bool json) const;

  ExpectedOptions options_;
  std::string subject_;
  std::vector<fuzz::ExpectedFailure> expected_;
  fuzz::ShownFailures shown_;
};

}  // namespace touchstone::cli
