// From single answers to rows of the chart: counts, quantiles, soundness, the Pareto front.
#pragma once

#include <map>

#include "reports/record/chart.h"
#include "scenarios/value/judgement.h"

namespace touchstone::fuzz {

/// One answer of one engine.
struct ChartSample {
  std::string engine, question, regime, pair, scale;
  std::uint64_t bodies = 0;
  Judgement judgement;
  std::vector<double> ns;  // by round
};

class ChartRows {
 public:
  /// Counts in the row of all, and in those of its regime, scale, pair, regime × scale and pair × regime.
  void add(const ChartSample& s);
  std::vector<ChartRow> rows() const;

 private:
  struct Cell {
    ChartRow counts;
    std::vector<double> errors;
    std::vector<std::vector<double>> ns;  // by query, by round
  };
  ChartRow finished(const Cell& c) const;
  std::map<std::vector<std::string>, Cell> cells_;
};

/// Nearest rank; 0 of nothing. Sorts.
double quantile(std::vector<double>& values, double q);

/// Marks the sound rows of each group (question, regime, pair, scale, bodies) that nobody sound dominates in
/// median time, error p99 and largest error (candidates: precision), and as ties those of them that somebody
/// as accurate is as fast as, within noise.
void mark_fronts(std::vector<ChartRow>& rows);

}  // namespace touchstone::fuzz
