#include "core/broad/wide_tree.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "core/broad/morton.h"

namespace touchstone::broad {
namespace {

constexpr int bits_an_axis = 10;

// Only an order: a centre that is no number, or out of the sample's range, costs speed alone.
std::uint32_t morton(const KeyBox& b, const SceneStats& s) {
  std::uint32_t code = 0;
  for (int k = 0; k < 3; ++k) {
    const double centre = (static_cast<double>(value_of(b.lo[k])) + value_of(b.hi[k])) / 2;
    const double extent = s.high[k] - s.low[k];
    const double t = extent > 0 ? (centre - s.low[k]) / extent * (1 << bits_an_axis) : 0;
    const double in = t > 0 ? std::min(t, (1 << bits_an_axis) - 1.0) : 0;
    code |= spread_bits(static_cast<std::uint32_t>(in)) << k;
  }
  return code;
}

template <class Visit>
void each_bit(std::uint32_t mask, Visit visit) {
  for (; mask != 0; mask &= mask - 1) visit(static_cast<std::size_t>(std::countr_zero(mask)));
}

}  // namespace

void WideTree::build(const BoxStore& store, bool fixed, const SceneStats& stats) {
  order_.clear();
  for (BoxStore::Slot s = 0; s < store.slots(); ++s)
    if (store.is_present(s) && store.is_fixed(s) == fixed)
      order_.push_back({morton(store.keys()[s], stats), s});
  sort_by_key(order_, scratch_);
  std::size_t needed = 1;
  for (std::size_t n = order_.size(); n > 1; n = (n + width - 1) / width) ++needed;
  levels_.resize(needed);
  levels_[0].resize(order_.size());
  position_.resize(store.slots());
  for (std::size_t i = 0; i < order_.size(); ++i) {
    levels_[0].code[i] = plain_code(store, order_[i].slot);
    position_[order_[i].slot] = static_cast<std::uint32_t>(i);
  }
  refit(store);
  built_reach_ = reach();
}

void WideTree::refit(const BoxStore& store) {
  levels_[0].gather(store, 0);
  unite();
}

void WideTree::unite_node(std::size_t level, std::size_t node) {
  const BoxColumns& below = levels_[level - 1];
  for (int k = 0; k < 3; ++k) {
    // Entries beyond the end are empty boxes, which change no union.
    std::int32_t lo = no_key, hi = -no_key;
    for (std::size_t j = node * width; j < (node + 1) * width; ++j)
      lo = std::min(lo, below.lo[k][j]), hi = std::max(hi, below.hi[k][j]);
    levels_[level].lo[k][node] = lo, levels_[level].hi[k][node] = hi;
  }
}

void WideTree::unite() {
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    levels_[l].resize((levels_[l - 1].size + width - 1) / width);
    for (std::size_t i = 0; i < levels_[l].size; ++i) unite_node(l, i);
  }
}

void WideTree::refit_one(const BoxStore& store, BoxStore::Slot s) {
  std::size_t node = position_[s];
  levels_[0].put(node, store.keys()[s], levels_[0].code[node], 0);
  for (std::size_t l = 1; l < levels_.size(); ++l) node /= width, unite_node(l, node);
}

// The mark is the highest flag of a code: all set otherwise (pair_kernels.h).
void WideTree::mark(BoxStore::Slot s, bool on) {
  std::uint32_t& code = levels_[0].code[position_[s]];
  code = on ? code | 0x80000000U : code & ~0x80000000U;
}

void WideTree::marked_partners(const BoxStore& store, BoxStore::Slot s, PairSink& sink) {
  if (size() == 0) return;
  probe_.resize(1);
  probe_.put(0, store.keys()[s], plain_code(store, s) & ~0x80000000U, 0);
  query(probe_, 0, levels_.size() - 1, 0, sink);
}

double WideTree::reach() const {
  if (levels_.size() < 2) return 0;
  double sum = 0;
  for (int k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < levels_[1].size; ++i) {
      const double d = static_cast<double>(value_of(levels_[1].hi[k][i])) - value_of(levels_[1].lo[k][i]);
      sum += std::min(d, 1e30);
    }
  return sum;
}

void WideTree::self(std::size_t level, std::size_t a, PairSink& sink) const {
  if (level == 0) return;
  const BoxColumns& below = levels_[level - 1];
  const std::size_t begin = a * width, end = end_of(level, a);
  for (std::size_t i = begin; i < end; ++i) {
    if (level == 1) {
      scan_range(below, i, below, i + 1, end, sink);
      continue;
    }
    self(level - 1, i, sink);
    const std::uint32_t later = ~((std::uint32_t{2} << (i - begin)) - 1);
    each_bit(overlap_mask_16(below, i, below, begin) & later,
             [&](std::size_t j) { cross(level - 1, i, *this, level - 1, begin + j, sink); });
  }
}

// Entry a of this tree overlaps entry b of the other; the higher of the two is opened.
void WideTree::cross(std::size_t level, std::size_t a, const WideTree& other, std::size_t other_level,
                     std::size_t b, PairSink& sink) const {
  if (level == 0) {
    other.query(levels_[0], a, other_level, b, sink);
  } else if (level >= other_level) {
    each_bit(overlap_mask_16(other.levels_[other_level], b, levels_[level - 1], a * width),
             [&](std::size_t i) { cross(level - 1, a * width + i, other, other_level, b, sink); });
  } else {
    each_bit(overlap_mask_16(levels_[level], a, other.levels_[other_level - 1], b * width),
             [&](std::size_t j) { cross(level, a, other, other_level - 1, b * width + j, sink); });
  }
}

// Entry `box` of `from` against the boxes below entry b of a level of this tree.
void WideTree::query(const BoxColumns& from, std::size_t box, std::size_t level, std::size_t b,
                     PairSink& sink) const {
  if (level == 0) {
    scan_range(from, box, levels_[0], b, b + 1, sink);
  } else if (level == 1) {
    scan_range(from, box, levels_[0], b * width, end_of(1, b), sink);
  } else {
    each_bit(overlap_mask_16(from, box, levels_[level - 1], b * width),
             [&](std::size_t j) { query(from, box, level - 1, b * width + j, sink); });
  }
}

void WideTree::self_pairs(PairSink& sink) const {
  if (size() > 1) self(levels_.size() - 1, 0, sink);
}

void WideTree::pairs_with(const WideTree& other, PairSink& sink) const {
  if (size() > 0 && other.size() > 0) cross(levels_.size() - 1, 0, other, other.levels_.size() - 1, 0, sink);
}

void WideTree::validate() const {
  for (std::size_t l = 1; l < levels_.size(); ++l)
    for (std::size_t j = 0; j < levels_[l - 1].size; ++j)
      for (int k = 0; k < 3; ++k)
        if (levels_[l].lo[k][j / width] > levels_[l - 1].lo[k][j] ||
            levels_[l].hi[k][j / width] < levels_[l - 1].hi[k][j])
          throw std::logic_error("tree: a node does not hold its child");
  if (!levels_.empty() && levels_.back().size > 1) throw std::logic_error("tree: more than one root");
}

void WideTree::picture(std::vector<std::vector<Aabb>>& nodes) const {
  if (nodes.size() + 1 < levels_.size()) nodes.resize(levels_.size() - 1);
  for (std::size_t l = 1; l < levels_.size(); ++l)
    for (std::size_t i = 0; i < levels_[l].size; ++i) {
      Aabb b;
      for (int k = 0; k < 3; ++k)
        b.lo[k] = value_of(levels_[l].lo[k][i]), b.hi[k] = value_of(levels_[l].hi[k][i]);
      nodes[l - 1].push_back(b);
    }
}

std::size_t WideTree::memory_bytes() const {
  std::size_t sum = (order_.capacity() + scratch_.capacity()) * sizeof(KeyedSlot) +
                    position_.capacity() * sizeof(std::uint32_t) + probe_.memory_bytes();
  for (const BoxColumns& l : levels_) sum += l.memory_bytes();
  return sum;
}

}  // namespace touchstone::broad
