// What touchstone_catch.h and touchstone_gtest.h share: whether an engine's answer is right, and why not.
#pragma once

#include <sstream>
#include <string>
#include <utility>

#include "touchstone.hpp"

namespace touchstone {

class Soundness {
 public:
  Soundness(touchstone_c::Body a, touchstone_c::Body b, touchstone_c::Precision precision)
      : a_(std::move(a)), b_(std::move(b)), precision_(precision) {}
  /// Whether no claim of the answer is wrong or left open.
  bool holds(const touchstone_c::Stated& s) const {
    return touchstone_c::judge(a_, b_, s, precision_) == TOUCHSTONE_RIGHT;
  }
  /// The ruling and the faults, as JSON.
  std::string reason(const touchstone_c::Stated& s) const {
    return touchstone_c::explain(a_, b_, s, precision_);
  }
  std::string description() const { return "is right by the definition of a gap, a normal and a depth"; }

 private:
  touchstone_c::Body a_, b_;
  touchstone_c::Precision precision_;
};

}  // namespace touchstone

namespace touchstone_c {

/// What was stated, for messages.
inline std::ostream& operator<<(std::ostream& out, const Stated& s) {
  const touchstone_stated& x = s.get();
  if (x.stated & TOUCHSTONE_STATES_OVERLAP) out << (x.overlap ? "overlap " : "no overlap ");
  if (x.stated & TOUCHSTONE_STATES_DISTANCE) out << "distance " << x.distance << " ";
  if (x.stated & TOUCHSTONE_STATES_DEPTH) out << "depth " << x.depth << " ";
  if (x.stated & TOUCHSTONE_STATES_NORMAL)
    out << "normal (" << x.normal[0] << ", " << x.normal[1] << ", " << x.normal[2] << ") ";
  if (x.stated & TOUCHSTONE_STATES_IMPACT) out << "time of impact " << x.time_of_impact << " ";
  return out;
}

}  // namespace touchstone_c
