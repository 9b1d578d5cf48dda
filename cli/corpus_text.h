// The score of engines on the corpus, by flag.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "fuzz/corpus/score.h"

namespace touchstone::cli {

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
