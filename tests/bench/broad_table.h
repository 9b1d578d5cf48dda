// What the bench of broad phases measures, and its tables.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace touchstone::bench {

struct BroadRow {
  std::string scene, method, note;
  int n = 0;
  /// Of each frame, in the order of the frames; a round's frames follow those of the round before.
  std::vector<double> frame_ms;
  int rounds = 0;
  std::size_t pairs = 0, reported = 0, bytes = 0;
  bool wrong = false, answers = true;

  /// Mean frame of the best round: what others' work on the machine adds is left out, a structure's own
  /// alternation between cheap and dear frames is not.
  double mean_ms() const;
  double quantile_ms(double q) const;
};

/// One line a method, cells apart; ratios to our automatic choice.
std::string broad_text(const std::vector<BroadRow>& rows);
/// Floors: automatic against the best peer, the better plain competitor, the bound and our best fixed method;
/// growth.
std::string broad_summary(const std::vector<BroadRow>& rows);
std::string broad_csv(const std::vector<BroadRow>& rows);
std::string broad_json(const std::vector<BroadRow>& rows);

}  // namespace touchstone::bench
