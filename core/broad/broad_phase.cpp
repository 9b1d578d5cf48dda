#include "core/broad/broad_phase.h"

#include <algorithm>

#include "core/broad/box_set.h"

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
      return name + " is present already";
    case Refusal::id_absent:
      return name + " is not present";
  }
  return name;
}

}  // namespace

Refused::Refused(Refusal w, int i) : std::invalid_argument(describe(w, i)), why(w), id(i) {}

void require_box(int id, const Aabb& box) {
  if (box.lo.hasNaN() || box.hi.hasNaN()) throw Refused(Refusal::nan_box, id);
  if (!(box.lo.array() <= box.hi.array()).all()) throw Refused(Refusal::inverted_box, id);
}

std::vector<BoxSet::Entry>::iterator BoxSet::find(int id) {
  return std::lower_bound(entries_.begin(), entries_.end(), id,
                          [](const Entry& e, int i) { return e.id < i; });
}

void BoxSet::insert(int id, const Aabb& box) {
  require_box(id, box);
  const auto at = find(id);
  if (at != entries_.end() && at->id == id) throw Refused(Refusal::id_present, id);
  entries_.insert(at, {id, box});
}

void BoxSet::move(int id, const Aabb& box) {
  require_box(id, box);
  const auto at = find(id);
  if (at == entries_.end() || at->id != id) throw Refused(Refusal::id_absent, id);
  at->box = box;
}

void BoxSet::remove(int id) {
  const auto at = find(id);
  if (at == entries_.end() || at->id != id) throw Refused(Refusal::id_absent, id);
  entries_.erase(at);
}

void BoxSet::validate() const {
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    require_box(entries_[i].id, entries_[i].box);
    if (i > 0 && !(entries_[i - 1].id < entries_[i].id)) throw std::logic_error("box set: ids out of order");
  }
}

}  // namespace touchstone::broad
