// When an engine is asked no more. It goes by counts of answers, never by a clock, so that the same questions
// end at the same one.
#pragma once

#include <string>

namespace touchstone {

class Patience {
 public:
  /// Questions without an answer in time, one after another.
  static constexpr int most_time_outs_in_a_row = 32;
  /// Questions in which the engine waited and used no CPU: each costs seconds, and no machine is too slow.
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
