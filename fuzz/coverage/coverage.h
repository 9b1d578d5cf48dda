// What random cases reach: a count for every kind of shape, size, motion, regime of contact, and for what
// engines made of them. Every value that could occur has a row, so that one that never occurs is seen.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/value/engine_card.h"
#include "scenarios/value/observation.h"

namespace touchstone::fuzz {

struct CoverageGroup {
  std::string name, line;  // `line`: what is counted, for display
  /// May it be reached at all? Values that need not occur are not listed.
  std::vector<std::string> values;
};

class Coverage {
 public:
  Coverage();
  /// Counts what the case holds. `with_truth`: also the regime of contact of its pairs, by the referee.
  void add(const Case& c, bool with_truth);
  /// Counts what an engine answered, by question and outcome, for the queries of the case.
  void add(const EngineCard& engine, const Case& c, const CaseObservations& answers);

  std::uint64_t cases() const { return cases_; }
  /// In the order of display; the rows of engines last.
  std::vector<CoverageGroup> groups() const;
  std::uint64_t count(const std::string& group, const std::string& value) const;
  /// Pairs of group and value that no case reached. Outcomes of engines are not among them.
  std::vector<std::pair<std::string, std::string>> missed() const;

 private:
  void note(std::string_view group, std::string_view value);
  void note_bodies(const Case& c);
  void note_pair(const Case& c, const Query& q);
  void note_script(const Case& c);
  void note_regime(const Case& c, const Query& q);
  void note_arithmetic(const Case& c, const Query& q);

  std::uint64_t cases_ = 0;
  std::map<std::string, std::map<std::string, std::uint64_t>> counts_;
  std::vector<std::string> engines_;
};

}  // namespace touchstone::fuzz
