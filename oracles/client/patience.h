// Decides when to stop querying an engine. The decision depends on counts of answers, never on a clock, so
// that the same questions always stop at the same one.
#pragma once

#include <string>

namespace touchstone {

class Patience {
 public:
  /// Consecutive questions that timed out.
  static constexpr int most_time_outs_in_a_row = 32;
  /// Questions on which the engine waited without using the CPU: each costs seconds, and a slow machine is no
  /// explanation.
  static constexpr int most_blocked = 4;

  void note_answer() { in_a_row_ = 0; }
  void note_time_out(bool blocked) {
    blocked_ += blocked;
    if (++in_a_row_ == most_time_outs_in_a_row)
      end("set aside: timed out " + std::to_string(in_a_row_) + " times in a row");
    if (blocked_ == most_blocked)
      end("set aside: waited " + std::to_string(blocked_) + " times without using the CPU until time was up");
  }
  void end(const std::string& why) {
    if (left()) why_ = why;
  }
  bool left() const { return why_.empty(); }
  const std::string& why() const { return why_; }

 private:
  int in_a_row_ = 0, blocked_ = 0;
  std::string why_;
};

}  // namespace touchstone
