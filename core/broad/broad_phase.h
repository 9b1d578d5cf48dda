// The broad phase: takes boxes with ids, returns pairs of ids.
//
// Guarantee, the same for every algorithm in the catalog: pairs() reports exactly the pairs of closed double
// boxes that overlap, touching and infinite boxes included, but not the pairs of two static boxes.
// Internally, boxes are held as floats rounded outward (float_key.h explains why no pair is lost). The boxes
// of body_box.h contain the exact bodies, so every pair of overlapping bodies is reported. Pairs are sorted
// by id, each once; the same state gives the same bytes, whatever happened before.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/math/aabb.h"

namespace touchstone::broad {

/// Why an operation was refused. A refused operation does not change the state.
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

/// Two fixed boxes are not a pair. A fixed box may be moved, but is expected to move rarely.
enum class Mobility { moving, fixed };

struct BoxUpdate {
  int id = 0;
  Aabb box;
};

/// The data structures that the last pairs() used, for drawing. Any part may be empty.
struct Structure {
  struct Grid {
    int along = 0;  // axis of the columns
    double origin[3] = {}, cell[3] = {1, 1, 1};
    long count[3] = {1, 1, 1};  // number of cells; border cells extend to infinity
  };
  int sweep_axis = -1;
  std::vector<Grid> grids;               // finest first
  std::vector<std::vector<Aabb>> nodes;  // nodes of trees, by level, lowest first
};

class BroadPhase {
 public:
  virtual ~BroadPhase() = default;
  /// These throw Refused. A box must satisfy lo <= hi on each axis (infinities allowed). An id is any int and
  /// may be present once.
  virtual void insert(int id, const Aabb& box, Mobility mobility) = 0;
  void insert(int id, const Aabb& box) { insert(id, box, Mobility::moving); }
  virtual void move(int id, const Aabb& box) = 0;
  virtual void remove(int id) = 0;
  /// Applies the moves in order; the last one of an id counts. When one is refused, none is applied.
  virtual void update(std::span<const BoxUpdate> moves) = 0;
  /// All overlapping pairs except fixed–fixed, sorted, each once.
  virtual void pairs(std::vector<IdPair>& out) = 0;
  /// Throws std::logic_error naming the broken invariant.
  virtual void validate() const = 0;
  /// Memory in use, scratch included.
  virtual std::size_t memory_bytes() const = 0;
  /// A description of what the last pairs() did, for instance which method was chosen and why.
  virtual std::string explain() const = 0;
  virtual Structure structure() const = 0;
};

using BroadPhasePtr = std::unique_ptr<BroadPhase>;

/// How pairs() does its work. The options do not affect the result, which is the same byte for byte.
/// Parallel: the search of every method and the sorting of its pairs. On the caller's thread only: updates,
/// the building of orders, cells and trees, and, in incremental_sweep and bounding_volume_hierarchy, queries
/// in which few boxes have changed. The structures are not thread-safe: no two calls at the same time.
struct Options {
  int threads = 1;                        // maximum, including the caller's; 1: no thread is ever started
  std::size_t min_work_per_part = 16384;  // boxes or pairs that make it worth starting a thread
};

/// Throws Refused when the box has a NaN or is inverted.
void require_box(int id, const Aabb& box);

/// Contains a box that moves in a straight line from one to the other: lower ends move linearly, so each is
/// at least the smaller of its two end values. No arithmetic, so no rounding.
inline Aabb swept(const Aabb& from, const Aabb& to) {
  Aabb box = from;
  box.extend(to);
  return box;
}

}  // namespace touchstone::broad
