// The boxes that are present, sorted by id: the part that algorithms which rebuild per query have in common.
#pragma once

#include <span>
#include <vector>

#include "core/broad/broad_phase.h"

namespace touchstone::broad {

class BoxSet {
 public:
  struct Entry {
    int id;
    Aabb box;
  };
  void insert(int id, const Aabb& box);
  void move(int id, const Aabb& box);
  void remove(int id);
  std::span<const Entry> entries() const { return entries_; }
  void validate() const;

 private:
  std::vector<Entry>::iterator find(int id);
  std::vector<Entry> entries_;
};

}  // namespace touchstone::broad
