// touchstone corpus run: engines answer the corpus, the judge rules, and the score is printed by flag.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cli/chosen_engines.h"
#include "fuzz/corpus/score.h"

namespace touchstone::cli {

struct CorpusRunOptions {
  std::string directory, only, answers, junit;
  EngineChoice choice;
  bool json = false, all = false;
  WorkerLimits limits;
};

void declare_corpus_run(CLI::App& app, CorpusRunOptions& to);
int corpus_run(const CorpusRunOptions& o);

/// Answers by score (fuzz::corpus::Score).
struct CorpusCount {
  std::array<std::uint64_t, fuzz::corpus::score_names.size()> of{};
  std::uint64_t& operator[](fuzz::corpus::Score s) { return of[static_cast<std::size_t>(s)]; }
  std::uint64_t operator[](fuzz::corpus::Score s) const { return of[static_cast<std::size_t>(s)]; }
  std::uint64_t bad() const {
    return (*this)[fuzz::corpus::Score::wrong] + (*this)[fuzz::corpus::Score::failed];
  }
  std::uint64_t attempted() const { return bad() + (*this)[fuzz::corpus::Score::right]; }
};

/// Group ("question", "degeneracy", "size", "mechanism"), then flag.
using CorpusFlags = std::map<std::string, std::map<std::string, CorpusCount>>;

struct CorpusColumn {
  std::string engine;
  CorpusCount total;
  CorpusFlags flags;
};

/// Adds the scores of one case.
void add_scores(CorpusColumn& to, const fuzz::corpus::StoredCorpusCase& c,
                const std::vector<fuzz::corpus::Scored>& scores);

/// One screen: wrong and failed answers of those attempted. All mechanisms, or the ten worst.
std::string corpus_table(const std::vector<CorpusColumn>& columns, bool all);
nlohmann::ordered_json to_json(const CorpusColumn& c);

}  // namespace touchstone::cli
