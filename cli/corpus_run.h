// touchstone corpus run: engines answer the corpus, the judge rules, and the score is printed by flag.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "cli/chosen_engines.h"

namespace touchstone::cli {

struct CorpusRunOptions {
  std::string directory, only, answers, junit;
  EngineChoice choice;
  bool json = false, all = false;
  WorkerLimits limits;
};

void declare_corpus_run(CLI::App& app, CorpusRunOptions& to);
int corpus_run(const CorpusRunOptions& o);

}  // namespace touchstone::cli
