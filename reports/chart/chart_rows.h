// Turns single answers into rows of the chart: counts, quantiles, soundness, the Pareto front.
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
  std::vector<double> ns;  // by round; empty: not the engine's own
};

class ChartRows {
 public:
  /// Counts the sample in the overall row and in those of its regime, scale, pair, regime × scale and pair ×
  /// regime.
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

/// Nearest rank; 0 if empty. Reorders `values`.
double quantile(std::vector<double>& values, double q);

/// In each group (question, regime, pair, scale, bodies), marks as front the sound rows that no sound row
/// dominates in median time, error p99 and largest error (candidates: precision). Of these, marks as ties the
/// rows for which another row is as accurate and, within noise, as fast.
void mark_fronts(std::vector<ChartRow>& rows);

}  // namespace touchstone::fuzz
