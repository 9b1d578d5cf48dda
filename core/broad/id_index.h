// The slot of an id. Small non-negative ids, the usual case, cost one load; other ids use a hash map.
#pragma once

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace touchstone::broad {

class IdIndex {
 public:
  static constexpr std::uint32_t none = 0xffffffff;

  std::uint32_t find(int id) const {
    if (static_cast<std::size_t>(id) < low_.size() && id >= 0) return low_[static_cast<std::size_t>(id)];
    if (far_.empty()) return none;
    const auto at = far_.find(id);
    return at == far_.end() ? none : at->second;
  }
  /// `present` bounds the table: at most 8 entries per box, so that sparse ids do not cost memory.
  void insert(int id, std::uint32_t slot, std::size_t present) {
    if (id >= 0 && static_cast<std::size_t>(id) < std::max(low_.size(), 1024 + 8 * present)) {
      if (static_cast<std::size_t>(id) >= low_.size()) grow(static_cast<std::size_t>(id) + 1);
      low_[static_cast<std::size_t>(id)] = slot;
    } else {
      far_[id] = slot;
    }
  }
  void remove(int id) {
    if (id >= 0 && static_cast<std::size_t>(id) < low_.size())
      low_[static_cast<std::size_t>(id)] = none;
    else
      far_.erase(id);
  }
  std::size_t memory_bytes() const {
    return low_.capacity() * sizeof(std::uint32_t) + far_.size() * 40 + far_.bucket_count() * 8;
  }

 private:
  // Ids that the table now covers leave the map, so that each id has one place.
  void grow(std::size_t size) {
    const std::size_t room = std::max(size, low_.size() * 5 / 4);
    low_.reserve(room);
    low_.resize(room, none);
    for (auto it = far_.begin(); it != far_.end();) {
      const bool covered = it->first >= 0 && static_cast<std::size_t>(it->first) < low_.size();
      if (covered) low_[static_cast<std::size_t>(it->first)] = it->second;
      it = covered ? far_.erase(it) : std::next(it);
    }
  }
  std::vector<std::uint32_t> low_;
  std::unordered_map<int, std::uint32_t> far_;
};

}  // namespace touchstone::broad
