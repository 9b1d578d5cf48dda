#include "core/broad/wide_tree.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "core/broad/key_sort.h"
#include "core/broad/node_split.h"

namespace touchstone::broad {
namespace {

constexpr int bits_per_axis = 10;
// A group with this few boxes left is dissolved: a search pays as much for its entry as for that of a full
// one.
constexpr std::size_t few_left = 4;
// Cap on a side in the cost, so that the sum is finite.
constexpr double longest_side = 1e30;

// Only an order: a centre that is NaN or outside the range of the sample costs only speed.
std::uint32_t morton(const KeyBox& b, const SceneStats& s) {
  std::uint32_t code = 0;
  for (int k = 0; k < 3; ++k) {
    const double centre = (static_cast<double>(value_of(b.lo[k])) + value_of(b.hi[k])) / 2;
    const double extent = s.high[k] - s.low[k];
    const double t = extent > 0 ? (centre - s.low[k]) / extent * (1 << bits_per_axis) : 0;
    const double in = t > 0 ? std::min(t, (1 << bits_per_axis) - 1.0) : 0;
    code |= spread_bits(static_cast<std::uint32_t>(in)) << k;
  }
  return code;
}

template <class Visit>
void each_bit(std::uint32_t mask, Visit visit) {
  for (; mask != 0; mask &= mask - 1) visit(static_cast<std::size_t>(std::countr_zero(mask)));
}

}  // namespace

// ---- nodes

std::uint32_t WideTree::add_group(std::size_t level) {
  Level& l = levels_[level];
  if (!l.free.empty()) {
    const std::uint32_t g = l.free.back();
    l.free.pop_back();
    return g;
  }
  l.parent.push_back(0);
  l.used.push_back(0);
  l.entries.resize(l.parent.size() * width);
  for (std::size_t i = l.entries.size - width; i < l.entries.size; ++i) l.entries.put(i, KeyBox{}, 0, 0);
  return static_cast<std::uint32_t>(l.parent.size() - 1);
}

// Adds a level above the root, with the old root as its only entry.
void WideTree::add_root() {
  levels_.emplace_back();
  add_group(top());
  levels_.back().used[0] = 1;
  put(top(), 0, union_of(top() - 1, 0), 0);
}

// Updates the back-pointer of what is stored at `entry`.
void WideTree::link(std::size_t level, std::size_t entry) {
  const std::uint32_t code = levels_[level].entries.code[entry];
  (level == 0 ? position_[code & slot_mask] : levels_[level - 1].parent[code]) =
      static_cast<std::uint32_t>(entry);
}

void WideTree::put(std::size_t level, std::size_t entry, const KeyBox& box, std::uint32_t code) {
  levels_[level].entries.put(entry, box, code, 0);
  link(level, entry);
}

KeyBox WideTree::box_of(std::size_t level, std::size_t entry) const {
  KeyBox b;
  const BoxColumns& e = levels_[level].entries;
  for (int k = 0; k < 3; ++k) {
    b.lo[k] = e.lo[k][entry];
    b.hi[k] = e.hi[k][entry];
  }
  return b;
}

// Unused entries are empty boxes, which do not change the union.
KeyBox WideTree::union_of(std::size_t level, std::size_t group) const {
  KeyBox b;
  const BoxColumns& e = levels_[level].entries;
  for (int k = 0; k < 3; ++k) {
    std::int32_t lo = no_key, hi = -no_key;
    for (std::size_t i = group * width; i < (group + 1) * width; ++i) {
      lo = std::min(lo, e.lo[k][i]);
      hi = std::max(hi, e.hi[k][i]);
    }
    b.lo[k] = lo;
    b.hi[k] = hi;
  }
  return b;
}

void WideTree::unite_above(std::size_t level, std::size_t group) {
  for (; level < top(); ++level) {
    const std::uint32_t entry = levels_[level].parent[group];
    levels_[level + 1].entries.put(entry, union_of(level, group), static_cast<std::uint32_t>(group), 0);
    group = entry / width;
  }
}

// ---- insertion and removal

void WideTree::add(std::size_t level, std::size_t group, const KeyBox& box, std::uint32_t code) {
  if (levels_[level].used[group] == width) {
    split(level, group, box, code);
    return;
  }
  put(level, end_of(level, group), box, code);
  ++levels_[level].used[group];
  unite_above(level, group);
}

void WideTree::split(std::size_t level, std::size_t group, const KeyBox& box, std::uint32_t code) {
  NodeEntry all[width + 1];
  for (std::size_t i = 0; i < width; ++i)
    all[i] = {box_of(level, group * width + i), levels_[level].entries.code[group * width + i]};
  all[width] = {box, code};
  const std::size_t left = split_node(all);
  if (level == top()) add_root();
  const std::uint32_t fresh = add_group(level);
  for (std::size_t i = 0; i < width; ++i) levels_[level].entries.put(group * width + i, KeyBox{}, 0, 0);
  for (std::size_t i = 0; i <= width; ++i)
    put(level, i < left ? group * width + i : fresh * width + i - left, all[i].box, all[i].code);
  levels_[level].used[group] = static_cast<std::uint8_t>(left);
  levels_[level].used[fresh] = static_cast<std::uint8_t>(width + 1 - left);
  unite_above(level, group);
  add(level + 1, levels_[level].parent[group] / width, union_of(level, fresh), fresh);
}

void WideTree::add_box(const KeyBox& box, std::uint32_t code) {
  std::size_t group = 0;
  for (std::size_t level = top(); level > 0; --level) {
    std::size_t best = group * width;
    Growth least = growth(box_of(level, best), box);
    for (std::size_t i = best + 1; i < end_of(level, group); ++i) {
      const Growth g = growth(box_of(level, i), box);
      if (g < least) {
        least = g;
        best = i;
      }
    }
    group = levels_[level].entries.code[best];
  }
  add(0, group, box, code);
}

void WideTree::insert(const BoxStore& store, BoxStore::Slot s) {
  if (position_.size() < store.slots()) position_.resize(store.slots(), nowhere);
  if (levels_.empty()) {
    levels_.emplace_back();
    add_group(0);
  }
  add_box(store.keys()[s], plain_code(store, s));
  ++boxes_;
}

void WideTree::take_out(std::size_t level, std::size_t entry) {
  const std::size_t group = entry / width, last = end_of(level, group) - 1;
  if (entry != last) put(level, entry, box_of(level, last), levels_[level].entries.code[last]);
  levels_[level].entries.put(last, KeyBox{}, 0, 0);
  if (--levels_[level].used[group] == 0 && level < top()) {
    levels_[level].free.push_back(static_cast<std::uint32_t>(group));
    take_out(level + 1, levels_[level].parent[group]);
  } else {
    unite_above(level, group);
  }
}

void WideTree::dissolve(std::size_t group) {
  NodeEntry left[few_left];
  const std::size_t n = levels_[0].used[group];
  for (std::size_t i = 0; i < n; ++i)
    left[i] = {box_of(0, group * width + i), levels_[0].entries.code[group * width + i]};
  for (std::size_t i = n; i-- > 0;) take_out(0, group * width + i);
  for (std::size_t i = 0; i < n; ++i) add_box(left[i].box, left[i].code);
}

void WideTree::remove(BoxStore::Slot s) {
  const std::size_t entry = position_[s], group = entry / width;
  position_[s] = nowhere;
  if (--boxes_ == 0) {
    levels_.clear();
    return;
  }
  take_out(0, entry);
  const std::size_t left = levels_[0].used[group];
  if (left > 0 && left <= few_left && boxes_ > left) dissolve(group);
}

// ---- building and refitting

void WideTree::build(const BoxStore& store, bool fixed, const SceneStats& stats) {
  std::vector<KeyedSlot> order, scratch;
  for (BoxStore::Slot s = 0; s < store.slots(); ++s)
    if (store.is_present(s) && store.is_fixed(s) == fixed)
      order.push_back({morton(store.keys()[s], stats), s});
  sort_by_key(order, scratch);
  levels_.clear();
  boxes_ = order.size();
  built_cost_ = 0;
  position_.assign(order.empty() ? 0 : store.slots(), nowhere);
  if (order.empty()) return;
  std::size_t n = order.size();
  do {
    Level& l = levels_.emplace_back();
    const std::size_t groups = (n + width - 1) / width;
    l.entries.resize(groups * width);
    for (int k = 0; k < 3; ++k) {
      std::fill_n(l.entries.lo[k].begin(), groups * width, no_key);
      std::fill_n(l.entries.hi[k].begin(), groups * width, -no_key);
    }
    l.parent.resize(groups);
    l.used.assign(groups, width);
    l.used.back() = static_cast<std::uint8_t>(n - (groups - 1) * width);
    for (std::size_t i = 0; i < n; ++i) {
      l.entries.code[i] = top() == 0 ? plain_code(store, order[i].slot) : static_cast<std::uint32_t>(i);
      link(top(), i);
    }
    n = groups;
  } while (n > 1);
  refit(store);
  built_cost_ = cost();
}

void WideTree::refit(const BoxStore& store) {
  if (levels_.empty()) return;
  Level& boxes = levels_[0];
  for (std::size_t g = 0; g < boxes.used.size(); ++g)
    for (std::size_t i = g * width; i < end_of(0, g); ++i)
      boxes.entries.put(i, store.keys()[boxes.entries.code[i] & slot_mask], boxes.entries.code[i], 0);
  for (std::size_t l = 0; l < top(); ++l)
    for (std::size_t g = 0; g < levels_[l].used.size(); ++g)
      if (levels_[l].used[g] > 0)
        levels_[l + 1].entries.put(levels_[l].parent[g], union_of(l, g), static_cast<std::uint32_t>(g), 0);
}

void WideTree::refit_one(const BoxStore& store, BoxStore::Slot s) {
  const std::size_t entry = position_[s], group = entry / width;
  const KeyBox& box = store.keys()[s];
  const std::uint32_t code = levels_[0].entries.code[entry];
  if (top() > 0 && !inside(box, box_of(1, levels_[0].parent[group]))) {
    remove(s);
    if (levels_.empty()) {
      levels_.emplace_back();
      add_group(0);
    }
    add_box(box, code);
    ++boxes_;
    return;
  }
  levels_[0].entries.put(entry, box, code, 0);
  unite_above(0, group);
}

// The mark is the highest flag of a code; the other flags are always set (pair_kernels.h).
void WideTree::mark(BoxStore::Slot s, bool on) {
  std::uint32_t& code = levels_[0].entries.code[position_[s]];
  code = on ? code | 0x80000000U : code & ~0x80000000U;
}

double WideTree::cost() const {
  if (levels_.size() < 2) return 0;
  double sum = 0;
  for (std::size_t g = 0; g < levels_[1].used.size(); ++g)
    for (std::size_t i = g * width; i < end_of(1, g); ++i)
      for (int k = 0; k < 3; ++k) {
        const BoxColumns& e = levels_[1].entries;
        sum += std::min(static_cast<double>(value_of(e.hi[k][i])) - value_of(e.lo[k][i]), longest_side);
      }
  return sum / static_cast<double>(boxes_);
}

// ---- searching

void WideTree::marked_partners(const BoxStore& store, BoxStore::Slot s, PairSink& sink) {
  if (size() == 0) return;
  probe_.resize(1);
  probe_.put(0, store.keys()[s], plain_code(store, s) & ~0x80000000U, 0);
  if (top() == 0)
    scan_range(probe_, 0, levels_[0].entries, 0, end_of(0, 0), sink);
  else
    each_bit(overlap_mask_16(probe_, 0, levels_[top()].entries, 0),
             [&](std::size_t j) { query(probe_, 0, top(), j, sink); });
}

// Pairs within a group and in its subtrees.
void WideTree::self(std::size_t level, std::size_t group, Turn& turn, PairSink& sink) const {
  if (turn.parts > 1 && level <= turn.task_level) {
    if (!turn.mine()) return;
    Turn whole;
    self(level, group, whole, sink);
    return;
  }
  const BoxColumns& e = levels_[level].entries;
  const std::size_t begin = group * width, end = end_of(level, group);
  for (std::size_t i = begin; i < end; ++i) {
    if (level == 0) {
      scan_range(e, i, e, i + 1, end, sink);
      continue;
    }
    self(level - 1, e.code[i], turn, sink);
    const std::uint32_t later = ~((std::uint32_t{2} << (i - begin)) - 1);
    each_bit(overlap_mask_16(e, i, e, begin) & later, [&](std::size_t j) {
      if (turn.mine()) cross(level, i, *this, level, begin + j, sink);
    });
  }
}

// Entry a of this tree overlaps entry b of the other; descends into the higher of the two.
void WideTree::cross(std::size_t level, std::size_t a, const WideTree& other, std::size_t other_level,
                     std::size_t b, PairSink& sink) const {
  if (level == 0) {
    other.query(levels_[0].entries, a, other_level, b, sink);
  } else if (level >= other_level) {
    const std::size_t begin = child(level, a);
    each_bit(overlap_mask_16(other.levels_[other_level].entries, b, levels_[level - 1].entries, begin),
             [&](std::size_t i) { cross(level - 1, begin + i, other, other_level, b, sink); });
  } else {
    const std::size_t begin = other.child(other_level, b);
    each_bit(overlap_mask_16(levels_[level].entries, a, other.levels_[other_level - 1].entries, begin),
             [&](std::size_t j) { cross(level, a, other, other_level - 1, begin + j, sink); });
  }
}

// Entry `box` of `from` against the boxes below entry b of a level of this tree.
void WideTree::query(const BoxColumns& from, std::size_t box, std::size_t level, std::size_t b,
                     PairSink& sink) const {
  if (level == 0) {
    scan_range(from, box, levels_[0].entries, b, b + 1, sink);
    return;
  }
  const std::size_t begin = child(level, b);
  const BoxColumns& e = levels_[level - 1].entries;
  if (level == 1)
    scan_range(from, box, e, begin, end_of(0, begin / width), sink);
  else
    each_bit(overlap_mask_16(from, box, e, begin),
             [&](std::size_t j) { query(from, box, level - 1, begin + j, sink); });
}

void WideTree::self_pairs(PairSink& sink) const {
  if (size() < 2) return;
  const std::size_t parts = sink.parts(size());
  sink.in_parts(parts, [&](std::size_t p, PairSink& out) {
    Turn turn = turn_of(parts, p);
    self(top(), 0, turn, out);
  });
}

void WideTree::pairs_with(const WideTree& other, PairSink& sink) const {
  if (size() == 0 || other.size() == 0) return;
  const std::size_t parts = sink.parts(size() + other.size());
  sink.in_parts(parts, [&](std::size_t p, PairSink& out) {
    Turn turn = turn_of(parts, p);
    for (std::size_t a = 0; a < end_of(top(), 0); ++a)
      each_bit(overlap_mask_16(levels_[top()].entries, a, other.levels_[other.top()].entries, 0),
               [&](std::size_t b) {
                 if (turn.mine()) cross(top(), a, other, other.top(), b, out);
               });
  });
}

// ---- inspection

void WideTree::validate() const {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
  };
  std::size_t boxes = 0;
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    const Level& level = levels_[l];
    std::size_t used = 0;
    for (std::size_t g = 0; g < level.used.size(); ++g) {
      require(level.used[g] <= width, "tree: a node has too many children");
      used += level.used[g] > 0 ? 1 : 0;
      for (std::size_t i = g * width; i < (g + 1) * width; ++i) {
        const KeyBox b = box_of(l, i);
        if (i >= end_of(l, g)) {
          require(b.lo[0] == no_key && b.hi[0] == -no_key, "tree: an unused entry is not empty");
          continue;
        }
        const std::uint32_t code = level.entries.code[i];
        require((l == 0 ? position_[code & slot_mask] : levels_[l - 1].parent[code]) == i,
                "tree: a back-pointer is wrong");
        boxes += l == 0 ? 1 : 0;
        if (l < top())
          require(inside(b, box_of(l + 1, level.parent[g])), "tree: a node does not hold its child");
        if (l > 0) require(levels_[l - 1].used[code] > 0, "tree: a child is empty");
      }
    }
    require(used + level.free.size() == level.used.size(), "tree: a node is lost");
  }
  require(levels_.empty() || levels_.back().used.size() == 1, "tree: more than one root");
  require(boxes == boxes_, "tree: a box is lost");
}

void WideTree::picture(std::vector<std::vector<Aabb>>& nodes) const {
  if (levels_.empty()) return;
  if (nodes.size() < levels_.size()) nodes.resize(levels_.size());
  for (std::size_t l = 0; l < levels_.size(); ++l)
    for (std::size_t g = 0; g < levels_[l].used.size(); ++g) {
      if (levels_[l].used[g] == 0) continue;
      const KeyBox b = union_of(l, g);
      nodes[l].push_back({Vec3(value_of(b.lo[0]), value_of(b.lo[1]), value_of(b.lo[2])),
                          Vec3(value_of(b.hi[0]), value_of(b.hi[1]), value_of(b.hi[2]))});
    }
}

std::size_t WideTree::memory_bytes() const {
  std::size_t sum = levels_.capacity() * sizeof(Level) + position_.capacity() * sizeof(std::uint32_t) +
                    probe_.memory_bytes();
  for (const Level& l : levels_)
    sum += l.entries.memory_bytes() + (l.parent.capacity() + l.free.capacity()) * sizeof(std::uint32_t) +
           l.used.capacity();
  return sum;
}

}  // namespace touchstone::broad
