#include "core/broad/box_store.h"

#include <algorithm>
#include <cmath>

#include "core/broad/pair_kernels.h"
#include "core/broad/release.h"

namespace touchstone::broad {
namespace {

std::string describe(Refusal why, int id) {
  const std::string name = "box " + std::to_string(id);
  switch (why) {
    case Refusal::nan_box:
      return name + " has a NaN";
    case Refusal::inverted_box:
      return name + " is inverted (lo > hi)";
    case Refusal::id_present:
      return name + " is already present";
    case Refusal::id_absent:
      return name + " is not present";
    case Refusal::too_many:
      return name + " exceeds the maximum number of boxes";
  }
  return name;
}

// Also false for a NaN.
bool is_box(const Aabb& b) {
  const int x = b.lo.x() <= b.hi.x(), y = b.lo.y() <= b.hi.y(), z = b.lo.z() <= b.hi.z();
  return (x & y & z) != 0;
}

}  // namespace

Refused::Refused(Refusal w, int i) : std::invalid_argument(describe(w, i)), why(w), id(i) {}

void require_box(int id, const Aabb& box) {
  if (is_box(box)) return;
  throw Refused(box.lo.hasNaN() || box.hi.hasNaN() ? Refusal::nan_box : Refusal::inverted_box, id);
}

void BoxStore::touch(Slot s) {
  if ((state_[s] & touched_bit) != 0) return;
  state_[s] |= touched_bit;
  make_room(touched_);
  touched_.push_back(s);
}

void BoxStore::make_room_for_one() {
  make_room(boxes_);
  make_room(keys_);
  make_room(ids_);
  make_room(state_);
  make_room(steps_);
  make_room(touched_);
}

// Called for the first id that is not its slot. The slot being filled is not present yet.
void BoxStore::use_id_index() {
  if (!identical_) return;
  identical_ = false;
  for (Slot s = 0; s < slots(); ++s)
    if (is_present(s)) index_.insert(ids_[s], s, present());
}

void BoxStore::settle() {
  if (settled_at_ == membership_) {
    trim(boxes_);
    trim(keys_);
    trim(ids_);
    trim(state_);
    trim(steps_);
    if (touched_.size() == slots()) trim(touched_);
  }
  settled_at_ = membership_;
}

void BoxStore::changed(Slot s) {
  if ((state_[s] & fixed_bit) != 0) ++fixed_changes_;
  touch(s);
}

void BoxStore::insert(int id, const Aabb& box, Mobility mobility) {
  require_box(id, box);
  if (find(id) != IdIndex::none) throw Refused(Refusal::id_present, id);
  Slot s = 0;
  if (free_.empty()) {
    if (slots() + 1 >= max_slots) throw Refused(Refusal::too_many, id);
    s = static_cast<Slot>(slots());
    if (s > 0 && ids_.back() > id) ascending_ = false;
    make_room_for_one();
    boxes_.emplace_back();
    keys_.emplace_back();
    ids_.push_back(id);
    state_.push_back(0);
    steps_.push_back(0);
  } else {
    s = free_.back();
    free_.pop_back();
    // A box that returns to its old slot preserves the order; any other may break it.
    if (ids_[s] != id) ascending_ = false;
    ids_[s] = id;
  }
  if (id != static_cast<int>(s)) use_id_index();
  if (!identical_) index_.insert(id, s, present());
  state_[s] = static_cast<std::uint8_t>((state_[s] & touched_bit) | present_bit);
  if (mobility == Mobility::fixed) {
    state_[s] |= fixed_bit;
    ++fixed_;
  }
  ++membership_;
  boxes_[s] = box;
  keys_[s] = key_box(box);
  steps_[s] = 0;
  changed(s);
}

void BoxStore::move(int id, const Aabb& box) {
  const BoxUpdate one{id, box};
  update({&one, 1});
}

void BoxStore::remove(int id) {
  const Slot s = find(id);
  if (s == IdIndex::none) throw Refused(Refusal::id_absent, id);
  if (!identical_) index_.remove(id);
  free_.push_back(s);
  if ((state_[s] & fixed_bit) != 0) {
    --fixed_;
    ++fixed_changes_;
  }
  state_[s] &= touched_bit;
  keys_[s] = KeyBox{};
  ++membership_;
  touch(s);
}

// Works in blocks, so that the slots are looked up once for both passes.
void BoxStore::update(std::span<const BoxUpdate> moves) {
  for (const BoxUpdate& m : moves) {
    require_box(m.id, m.box);
    if (find(m.id) == IdIndex::none) throw Refused(Refusal::id_absent, m.id);
  }
  constexpr std::size_t block = 256;
  Slot at[block];
  for (; !moves.empty(); moves = moves.subspan(std::min(block, moves.size()))) {
    const auto some = moves.first(std::min(block, moves.size()));
    for (std::size_t m = 0; m < some.size(); ++m) changed(at[m] = find(some[m].id));
    put_boxes(some, at, boxes_.data(), keys_.data(), steps_.data());
  }
}

void BoxStore::codes(std::vector<std::uint32_t>& out) const {
  resize_exactly(out, present());
  std::size_t n = 0;
  for (Slot s = 0; n < out.size(); ++s) {
    out[n] = s | (is_fixed(s) ? 0 : moving_flag);
    n += is_present(s) ? 1 : 0;
  }
}

void BoxStore::forget_changes() {
  for (const Slot s : touched_) state_[s] = static_cast<std::uint8_t>(state_[s] & ~touched_bit);
  touched_.clear();
}

void BoxStore::validate() const {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
  };
  std::size_t present = 0, fixed = 0;
  int last = std::numeric_limits<int>::min();
  for (Slot s = 0; s < slots(); ++s) {
    require(!identical_ || (ids_[s] == static_cast<int>(s) && ascending_),
            "box store: an id is not its slot");
    if (ascending_) require(s == 0 || ids_[s] > last, "box store: slots do not ascend");
    last = ids_[s];
    const KeyBox expected = is_present(s) ? key_box(boxes_[s]) : KeyBox{};
    require(std::ranges::equal(keys_[s].lo, expected.lo) && std::ranges::equal(keys_[s].hi, expected.hi),
            "box store: a key box is not its box rounded outward");
    if (!is_present(s)) continue;
    ++present;
    fixed += is_fixed(s) ? 1 : 0;
    require_box(ids_[s], boxes_[s]);
    require(find(ids_[s]) == s, "box store: an id does not lead to its slot");
  }
  require(present == this->present() && fixed == fixed_, "box store: a count is wrong");
}

std::size_t BoxStore::memory_bytes() const {
  return boxes_.capacity() * sizeof(Aabb) + keys_.capacity() * sizeof(KeyBox) +
         ids_.capacity() * sizeof(int) + steps_.capacity() * sizeof(float) + state_.capacity() +
         (free_.capacity() + touched_.capacity()) * sizeof(Slot) + index_.memory_bytes();
}

}  // namespace touchstone::broad
