// What the broad-phase benchmark measures, and its tables.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace touchstone::bench {

struct BroadRow {
  std::string scene, method, note;
  int n = 0;
  /// One entry per frame, in order; the frames of a round follow those of the round before.
  std::vector<double> frame_ms;
  int rounds = 0;
  std::size_t pairs = 0, reported = 0, bytes = 0;
  bool wrong = false, answers = true;

  /// Mean frame of the best round. This leaves out the load of other processes, but not a structure's own
  /// alternation between cheap and expensive frames.
  double mean_ms() const;
  double quantile_ms(double q) const;
};

/// One line per method, cells separated; ratios to our automatic choice.
std::string broad_text(const std::vector<BroadRow>& rows);
/// Floors: our automatic choice against the better plain competitor, the lower bound and our best fixed
/// method; growth.
std::string broad_summary(const std::vector<BroadRow>& rows);
std::string broad_csv(const std::vector<BroadRow>& rows);
std::string broad_json(const std::vector<BroadRow>& rows);

}  // namespace touchstone::bench
