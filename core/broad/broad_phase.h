// The broad phase: boxes with names in, pairs of names out.
//
// Guarantee, the same for every algorithm in the catalog: pairs() reports exactly the pairs of closed double
// boxes that overlap, touching included, infinite boxes included, but not the pairs of two static boxes.
// Inside, boxes are held as floats rounded outward (float_key.h: why nothing is lost). With the boxes of
// body_box.h, which contain the exact bodies, every pair of bodies that overlaps is therefore reported.
// Sorted by id, each pair once; the same state gives the same bytes, whatever happened before.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/math/aabb.h"

namespace touchstone::broad {

/// Why an operation was refused. The state is as before; nothing else is lost.
enum class Refusal { nan_box, inverted_box, id_present, id_absent, too_many };

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

/// Two fixed boxes are no pair. A fixed box may be moved; it is only expected to move seldom.
enum class Mobility { moving, fixed };

struct BoxUpdate {
  int id = 0;
  Aabb box;
};

/// What the last pairs() was done with, for pictures: any part may be empty.
struct Structure {
  struct Grid {
    int along = 0;  // axis of the columns
    double origin[3] = {}, cell[3] = {1, 1, 1};
    long count[3] = {1, 1, 1};  // cells; those at the border extend to infinity
  };
  int sweep_axis = -1;
  std::vector<Grid> grids;               // finest first
  std::vector<std::vector<Aabb>> nodes;  // of trees, by level, lowest first
};

class BroadPhase {
 public:
  virtual ~BroadPhase() = default;
  /// Throw Refused. A box must satisfy lo <= hi in each axis (infinities allowed); ids are any int, present
  /// once.
  virtual void insert(int id, const Aabb& box, Mobility mobility) = 0;
  void insert(int id, const Aabb& box) { insert(id, box, Mobility::moving); }
  virtual void move(int id, const Aabb& box) = 0;
  virtual void remove(int id) = 0;
  /// Moves in order, the last one of an id counts. When one is refused, none is made.
  virtual void update(std::span<const BoxUpdate> moves) = 0;
  /// All overlapping pairs but fixed–fixed, sorted, each once.
  virtual void pairs(std::vector<IdPair>& out) = 0;
  /// Throws std::logic_error naming the broken invariant.
  virtual void validate() const = 0;
  /// Memory held, scratch included.
  virtual std::size_t memory_bytes() const = 0;
  /// What the last pairs() did, in words, for instance which method was chosen and why.
  virtual std::string explain() const = 0;
  virtual Structure structure() const = 0;
};

using BroadPhasePtr = std::unique_ptr<BroadPhase>;

/// How pairs() does its work; what it reports is the same, byte for byte, whatever is said here. Parallel:
/// the search of every method and the sorting of its pairs. On the caller's thread alone: the updates, the
/// building of orders, cells and trees, and, of incremental_sweep and bounding_volume_hierarchy, queries in
/// which few boxes have changed. The structures have one owner still: no two calls at the same time.
struct Options {
  int threads = 1;                   // at most; the caller's counts. 1: no thread is ever started
  std::size_t least_a_part = 16384;  // boxes or pairs for which a thread is worth starting
};

/// Throws Refused when the box is no closed box.
void require_box(int id, const Aabb& box);

/// Contains a box that moves in a straight line from one to the other: lower ends move linearly, so that each
/// is at least the lesser of its two ends; no arithmetic, no rounding.
inline Aabb swept(const Aabb& from, const Aabb& to) {
  Aabb box = from;
  box.extend(to);
  return box;
}

}  // namespace touchstone::broad
