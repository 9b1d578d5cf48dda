// The boxes that are present, in slots that stay the same as long as a box is present, and the changes since
// the last query. Shared by all algorithms.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/broad/broad_phase.h"
#include "core/broad/float_key.h"
#include "core/broad/id_index.h"

namespace touchstone::broad {

class BoxStore {
 public:
  using Slot = std::uint32_t;
  /// Slots are 29 bits: three bits of a code are flags (pair_kernels.h).
  static constexpr std::size_t max_slots = std::size_t{1} << 29;

  void insert(int id, const Aabb& box, Mobility mobility);
  void move(int id, const Aabb& box);
  void remove(int id);
  void update(std::span<const BoxUpdate> moves);

  std::size_t slots() const { return boxes_.size(); }
  std::size_t present() const { return boxes_.size() - free_.size(); }
  /// By slot. A free slot holds a key box that overlaps nothing.
  std::span<const KeyBox> keys() const { return keys_; }
  std::span<const Aabb> boxes() const { return boxes_; }
  bool is_present(Slot s) const { return (state_[s] & present_bit) != 0; }
  bool is_fixed(Slot s) const { return (state_[s] & fixed_bit) != 0; }
  int id(Slot s) const { return ids_[s]; }
  /// The largest change of a coordinate in the box's last move; 0 for a box that was just inserted.
  float last_step(Slot s) const { return steps_[s]; }
  std::size_t fixed() const { return fixed_; }

  /// The present slots in order, with moving_flag (pair_kernels.h) set for moving boxes.
  void codes(std::vector<std::uint32_t>& out) const;

  /// Slots inserted, moved or removed since forget_changes(), each once.
  std::span<const Slot> touched() const { return touched_; }
  /// The number of insertions and removals so far.
  std::uint64_t membership() const { return membership_; }
  /// The number of changes of fixed boxes so far, insertions and removals included.
  std::uint64_t fixed_changes() const { return fixed_changes_; }
  void forget_changes();
  /// Call at each query. Releases memory once boxes are no longer inserted and removed.
  void settle();

  /// True when ids ascend with slots, so that pairs sorted by slot are sorted by id.
  bool slots_ascend() const { return ascending_; }
  /// True when each id equals its slot.
  bool ids_are_slots() const { return identical_; }

  void validate() const;
  std::size_t memory_bytes() const;

 private:
  static constexpr std::uint8_t touched_bit = 1, present_bit = 2, fixed_bit = 4;
  void touch(Slot s);
  void make_room_for_one();
  void use_id_index();
  void changed(Slot s);
  Slot find(int id) const {
    if (!identical_) return index_.find(id);
    const auto s = static_cast<Slot>(id);
    return s < slots() && is_present(s) ? s : IdIndex::none;
  }
  std::vector<Aabb> boxes_;
  std::vector<KeyBox> keys_;
  std::vector<int> ids_;
  std::vector<float> steps_;
  std::vector<std::uint8_t> state_;
  std::vector<Slot> free_, touched_;
  IdIndex index_;  // used when some id is not its slot
  std::size_t fixed_ = 0;
  std::uint64_t membership_ = 0, fixed_changes_ = 0, settled_at_ = 0;
  bool ascending_ = true, identical_ = true;
};

}  // namespace touchstone::broad
