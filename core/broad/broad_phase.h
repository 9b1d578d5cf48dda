// The broad phase: boxes with names in, pairs of names out. Conservative by contract: every pair of closed
// boxes that overlap is reported, touching included, infinite boxes included.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/math/aabb.h"

namespace touchstone::broad {

/// Why an operation was refused. The state is as before; nothing else is lost.
enum class Refusal { nan_box, inverted_box, id_present, id_absent };

class Refused : public std::invalid_argument {
 public:
  Refused(Refusal why, int id);
  Refusal why;
  int id;
};

struct IdPair {
  int first = 0, second = 0;  // first < second
  auto operator<=>(const IdPair&) const = default;
};

class BroadPhase {
 public:
  virtual ~BroadPhase() = default;
  /// Throw Refused. A box must satisfy lo <= hi in each axis (infinities allowed); ids are any int, present
  /// once.
  virtual void insert(int id, const Aabb& box) = 0;
  virtual void move(int id, const Aabb& box) = 0;
  virtual void remove(int id) = 0;
  /// All overlapping pairs, sorted, each once.
  virtual void pairs(std::vector<IdPair>& out) = 0;
  /// Throws std::logic_error naming the broken invariant.
  virtual void validate() const = 0;
};

using BroadPhasePtr = std::unique_ptr<BroadPhase>;

/// Throws Refused when the box is no closed box.
void require_box(int id, const Aabb& box);

}  // namespace touchstone::broad
