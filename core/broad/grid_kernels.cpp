#include "core/broad/grid_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/broad/grid_kernels.cpp"
#include <hwy/foreach_target.h>  // includes this file once for each kind of processor
#include <hwy/highway.h>

#include "core/broad/pack_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace touchstone::broad::HWY_NAMESPACE {
namespace {

using I = hn::ScalableTag<std::int32_t>;
using V = hn::Vec<I>;
using M = hn::Mask<I>;

// value_of of float_key.h.
template <class D, class Keys>
HWY_INLINE hn::Vec<hn::RebindToFloat<D>> values(D d, Keys key) {
  const auto negative = hn::ShiftRight<31>(key);
  const auto size = hn::Sub(hn::Xor(key, negative), negative);
  return hn::BitCast(hn::RebindToFloat<D>(),
                     hn::Or(size, hn::And(negative, hn::Set(d, std::numeric_limits<std::int32_t>::min()))));
}

template <class D, class Keys, class Floats>
HWY_INLINE auto cells(D d, Keys key, Floats origin, Floats scale, Floats last) {
  const hn::RebindToFloat<D> f;
  const auto t = hn::Mul(hn::Sub(values(d, key), origin), scale);
  return hn::ConvertTo(d, hn::Min(hn::Max(t, hn::Zero(f)), last));
}

struct BoxCells {
  alignas(16) std::int32_t lo[4], hi[4];
};

#if HWY_TARGET == HWY_SCALAR
using Four = const std::int32_t*;
HWY_INLINE Four four(const std::int32_t* at) { return at; }
HWY_INLINE void store_four(Four from, std::int32_t* to) { std::copy_n(from, 3, to); }
HWY_INLINE void cells_of(const GridShape& s, const KeyBox& b, BoxCells& c) {
  const I d;
  const hn::RebindToFloat<I> f;
  for (int k = 0; k < 3; ++k) {
    const auto origin = hn::Load(f, s.origin + k), scale = hn::Load(f, s.scale + k),
               last = hn::Load(f, s.last + k);
    c.lo[k] = hn::GetLane(cells(d, hn::Load(d, b.lo + k), origin, scale, last));
    c.hi[k] = hn::GetLane(cells(d, hn::Load(d, b.hi + k), origin, scale, last));
  }
}
#else
using I4 = hn::FixedTag<std::int32_t, 4>;
using Four = hn::Vec<I4>;
HWY_INLINE Four four(const std::int32_t* at) { return hn::Load(I4(), at); }
HWY_INLINE void store_four(Four from, std::int32_t* to) { hn::Store(from, I4(), to); }
HWY_INLINE void cells_of(const GridShape& s, const KeyBox& b, BoxCells& c) {
  const I4 d;
  const hn::RebindToFloat<I4> f;
  const auto origin = hn::Load(f, s.origin), scale = hn::Load(f, s.scale), last = hn::Load(f, s.last);
  hn::Store(cells(d, four(b.lo), origin, scale, last), d, c.lo);
  hn::Store(cells(d, four(b.hi), origin, scale, last), d, c.hi);
}
#endif

CellRange range_of(const GridShape& s, const KeyBox& b) {
  BoxCells c;
  cells_of(s, b, c);
  const int axes[3] = {s.axis_u, s.axis_v, s.axis_w};
  CellRange r{};
  for (int k = 0; k < 3; ++k) {
    r.lo[k] = static_cast<std::uint32_t>(c.lo[axes[k]]);
    r.hi[k] = static_cast<std::uint32_t>(c.hi[axes[k]]);
  }
  return r;
}

// A box meets one column, two or (rarely) four. The number cannot be predicted, so the second column is
// always visited, with weight 0 or 1.
std::size_t file(const GridShape& s, const KeyBox* boxes, const std::uint32_t* codes, std::size_t n,
                 Filed* filed, std::vector<std::uint32_t>& too_large, std::uint32_t* count) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i) {
    BoxCells c;
    cells_of(s, boxes[codes[i] & slot_mask], c);
    const auto u = static_cast<std::uint32_t>(c.lo[s.axis_u]), v = static_cast<std::uint32_t>(c.lo[s.axis_v]),
               w = static_cast<std::uint32_t>(c.lo[s.axis_w]);
    const std::uint32_t more_u = static_cast<std::uint32_t>(c.hi[s.axis_u]) - u,
                        more_v = static_cast<std::uint32_t>(c.hi[s.axis_v]) - v,
                        more_w = static_cast<std::uint32_t>(c.hi[s.axis_w]) - w;
    if (HWY_UNLIKELY(((more_u | more_v) > 1) | (more_w > s.max_cells))) {
      too_large.push_back(codes[i]);
      continue;
    }
    const std::uint32_t at = s.place(u, v, w);
    filed[kept++] = {at, column_name(u, v) | more_u << 30 | more_v << 31, codes[i]};
    ++count[at];
    count[s.place(u + more_u, v + more_v, w)] += more_u | more_v;
    if ((more_u & more_v) != 0) {
      ++count[s.place(u + 1, v, w)];
      ++count[s.place(u, v + 1, w)];
    }
  }
  return kept;
}

HWY_INLINE void put(GridEntry& e, Four lo, Four hi, std::uint32_t code, std::uint32_t column) {
  store_four(lo, e.lo);
  store_four(hi, e.hi);
  e.code = code;
  e.column = column;
}

void write(const GridShape& s, const KeyBox* boxes, const Filed* filed, std::size_t n, std::uint32_t* next,
           GridEntry* entries, std::size_t nowhere) {
  constexpr std::uint32_t u_owner = 0x80000000, v_owner = 0x40000000;
  for (std::size_t i = 0; i < n; ++i) {
    const Filed f = filed[i];
    const KeyBox& b = boxes[f.code & slot_mask];
    const auto lo = four(b.lo), hi = four(b.hi);
    const std::uint32_t more_u = f.column >> 30 & 1, more_v = f.column >> 31, column = f.column & 0x3fffffff;
    put(entries[next[f.place]++], lo, hi, f.code | u_owner | v_owner, column);
    const std::uint32_t across = (f.place + more_u * s.stride_u + more_v * s.stride_v) & s.mask;
    const std::uint32_t weight = more_u | more_v, at = next[across];
    next[across] = at + weight;
    put(entries[weight != 0 ? at : nowhere], lo, hi, f.code | (more_u ^ 1) << 31 | (more_v ^ 1) << 30,
        column + column_name(more_u, more_v));
    if ((more_u & more_v) != 0) {
      put(entries[next[(f.place + s.stride_u) & s.mask]++], lo, hi, f.code | v_owner,
          column + column_name(1, 0));
      put(entries[next[(f.place + s.stride_v) & s.mask]++], lo, hi, f.code | u_owner,
          column + column_name(0, 1));
    }
  }
}

// One entry per lane, in columns.
struct Block {
  V lo[3], hi[3], code, column;
  explicit HWY_INLINE Block(const GridEntry* e) {
    const I d;
    const auto* p = reinterpret_cast<const std::int32_t*>(e);
#if HWY_TARGET == HWY_SCALAR
    for (int k = 0; k < 3; ++k) {
      lo[k] = hn::Load(d, p + k);
      hi[k] = hn::Load(d, p + 4 + k);
    }
    code = hn::Load(d, p + 3);
    column = hn::Load(d, p + 7);
#else
    // Halves of entries: even ones are lower ends with codes, odd ones upper ends with columns.
    V a[4], b[4];
    hn::LoadInterleaved4(d, p, a[0], a[1], a[2], a[3]);
    hn::LoadInterleaved4(d, p + 4 * hn::Lanes(d), b[0], b[1], b[2], b[3]);
    for (int k = 0; k < 3; ++k) {
      lo[k] = hn::ConcatEven(d, b[k], a[k]);
      hi[k] = hn::ConcatOdd(d, b[k], a[k]);
    }
    code = hn::ConcatEven(d, b[3], a[3]);
    column = hn::ConcatOdd(d, b[3], a[3]);
#endif
  }
};

// One box, broadcast to all lanes.
struct Probe {
  V lo[3], hi[3], code, column;
  HWY_INLINE M overlaps(const V* b_lo, const V* b_hi) const {
    M apart = hn::Or(hn::Gt(b_lo[0], hi[0]), hn::Gt(lo[0], b_hi[0]));
    for (int k = 1; k < 3; ++k) apart = hn::Or(apart, hn::Or(hn::Gt(b_lo[k], hi[k]), hn::Gt(lo[k], b_hi[k])));
    return hn::Not(apart);
  }
  // With a margin of two keys on each side of each axis the doubles certainly overlap (float_key.h).
  HWY_INLINE M doubtful(const V* b_lo, const V* b_hi) const {
    const I d;
    const V two = hn::Set(d, 2);
    M m = hn::FirstN(d, 0);
    for (int k = 0; k < 3; ++k)
      m = hn::Or(m, hn::Or(hn::Gt(b_lo[k], hn::Sub(hi[k], two)), hn::Gt(hn::Add(lo[k], two), b_hi[k])));
    return m;
  }
  HWY_INLINE M counts(V b_code, V b_column) const {
    const I d;
    const V flags = hn::Set(d, static_cast<std::int32_t>(owner_flags | moving_flag));
    return hn::And(hn::Eq(b_column, column), hn::Eq(hn::And(hn::Or(b_code, code), flags), flags));
  }
};

// Keeps the sink's columns in registers while pairs are written.
class Writer {
 public:
  explicit HWY_INLINE Writer(PairSink& sink) : sink_(sink) { open(); }
  HWY_INLINE ~Writer() { sink_.n = n_; }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  HWY_INLINE void reserve(std::size_t more) {
    if (HWY_LIKELY(n_ + more <= room_)) return;
    sink_.n = n_;
    sink_.reserve(more);
    open();
  }
  HWY_INLINE void emit(V theirs_coded, V mine_coded, M m) {
    const I d;
    const V mask = hn::Set(d, static_cast<std::int32_t>(slot_mask));
    const V theirs = hn::And(theirs_coded, mask), mine = hn::And(mine_coded, mask);
    const Packer pack(m);
    hn::StoreU(pack(hn::Min(theirs, mine)), d, first_ + n_);
    hn::StoreU(pack(hn::Max(theirs, mine)), d, second_ + n_);
    n_ += pack.count();
  }

 private:
  HWY_INLINE void open() {
    first_ = reinterpret_cast<std::int32_t*>(sink_.first.data());
    second_ = reinterpret_cast<std::int32_t*>(sink_.second.data());
    n_ = sink_.n;
    room_ = sink_.first.size();
  }
  PairSink& sink_;
  std::int32_t *first_ = nullptr, *second_ = nullptr;
  std::size_t n_ = 0, room_ = 0;
};

HWY_NOINLINE void emit_doubtful(PairSink& sink, V theirs, V mine, M m) {
  const I d;
  HWY_ALIGN std::uint32_t other[hn::MaxLanes(I())], self[hn::MaxLanes(I())];
  const V mask = hn::Set(d, static_cast<std::int32_t>(slot_mask));
  const Packer pack(m);
  hn::Store(pack(hn::And(theirs, mask)), d, reinterpret_cast<std::int32_t*>(other));
  hn::Store(hn::And(mine, mask), d, reinterpret_cast<std::int32_t*>(self));
  for (std::size_t k = 0; k < pack.count(); ++k)
    sink.doubtful.push_back({std::min(self[0], other[k]), std::max(self[0], other[k])});
}

// A range of the entries, in columns.
struct SweepScratch {
  std::vector<std::int32_t> lo[3], hi[3];
  std::vector<std::uint32_t> code, column, end;
  void fit(std::size_t n) {
    if (end.size() >= n) return;
    for (int k = 0; k < 3; ++k) {
      lo[k].resize(n + n / 2);
      hi[k].resize(n + n / 2);
    }
    code.resize(n + n / 2);
    column.resize(n + n / 2);
    end.resize(n + n / 2);
  }
};

// Transposes entries [from, to) and appends them to the scratch, which holds [base, from).
HWY_INLINE void transpose(const GridEntry* entries, std::size_t base, std::size_t from, std::size_t to,
                          SweepScratch& s) {
  const I d;
  for (std::size_t i = from; i < to; i += hn::Lanes(d)) {
    const Block b(entries + i);
    const std::size_t at = i - base;
    for (int k = 0; k < 3; ++k) {
      hn::StoreU(b.lo[k], d, &s.lo[k][at]);
      hn::StoreU(b.hi[k], d, &s.hi[k][at]);
    }
    hn::StoreU(b.code, d, reinterpret_cast<std::int32_t*>(&s.code[at]));
    hn::StoreU(b.column, d, reinterpret_cast<std::int32_t*>(&s.column[at]));
  }
}

// Computes where the cells end that each box of [base, base + n) reaches. Returns the largest.
HWY_INLINE std::size_t find_ends(const GridShape& g, const std::uint32_t* begin, std::size_t n,
                                 SweepScratch& s) {
  const I d;
  const hn::RebindToFloat<I> f;
  const auto origin = hn::Set(f, g.origin[g.axis_w]), scale = hn::Set(f, g.scale[g.axis_w]),
             last = hn::Set(f, g.last[g.axis_w]);
  const V su = hn::Set(d, static_cast<std::int32_t>(g.stride_u)),
          sv = hn::Set(d, static_cast<std::int32_t>(g.stride_v)),
          mask = hn::Set(d, static_cast<std::int32_t>(g.mask)), low = hn::Set(d, (1 << column_bits) - 1);
  HWY_ALIGN std::uint32_t reach[hn::MaxLanes(I())];
  std::size_t most = 0;
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
    const V from = cells(d, hn::LoadU(d, &s.lo[g.axis_w][i]), origin, scale, last);
    const V to = cells(d, hn::LoadU(d, &s.hi[g.axis_w][i]), origin, scale, last);
    const V column = hn::LoadU(d, reinterpret_cast<const std::int32_t*>(&s.column[i]));
    const V place = hn::And(
        hn::Add(hn::Add(hn::Mul(hn::ShiftRight<column_bits>(column), su), hn::Mul(hn::And(column, low), sv)),
                from),
        mask);
    hn::Store(hn::Add(place, hn::Sub(to, from)), d, reinterpret_cast<std::int32_t*>(reach));
    const std::size_t here = std::min(n - i, hn::Lanes(d));
    for (std::size_t k = 0; k < here; ++k) {
      const std::uint32_t end = begin[reach[k] + 1];
      s.end[i + k] = end;
      most = std::max<std::size_t>(most, end);
    }
  }
  return most;
}

enum class Care { none, notice, decide };

// For Care::notice, false when a pair was in doubt.
template <Care care>
HWY_INLINE bool sweep_chunk(const SweepScratch& s, std::size_t base, std::size_t n, PairSink& sink) {
  const I d;
  const std::size_t lanes = hn::Lanes(d);
  const std::int32_t *const lo_x = s.lo[0].data(), *const lo_y = s.lo[1].data(), *const lo_z = s.lo[2].data(),
                            *const hi_x = s.hi[0].data(), *const hi_y = s.hi[1].data(),
                            *const hi_z = s.hi[2].data();
  const auto* const codes = reinterpret_cast<const std::int32_t*>(s.code.data());
  const auto* const columns = reinterpret_cast<const std::int32_t*>(s.column.data());
  M in_doubt = hn::FirstN(d, 0);
  Writer out(sink);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t end = s.end[i] - base;
    const Probe p{{hn::Set(d, lo_x[i]), hn::Set(d, lo_y[i]), hn::Set(d, lo_z[i])},
                  {hn::Set(d, hi_x[i]), hn::Set(d, hi_y[i]), hn::Set(d, hi_z[i])},
                  hn::Set(d, codes[i]),
                  hn::Set(d, columns[i])};
    out.reserve(end - i + lanes);
    for (std::size_t j = i + 1; j < end; j += lanes) {
      const V lo[3] = {hn::LoadU(d, lo_x + j), hn::LoadU(d, lo_y + j), hn::LoadU(d, lo_z + j)};
      const V hi[3] = {hn::LoadU(d, hi_x + j), hn::LoadU(d, hi_y + j), hn::LoadU(d, hi_z + j)};
      const V code = hn::LoadU(d, codes + j), column = hn::LoadU(d, columns + j);
      const M hit = hn::And(hn::And(hn::FirstN(d, end - j), p.counts(code, column)), p.overlaps(lo, hi));
      if constexpr (care == Care::none) {
        out.emit(code, p.code, hit);
      } else {
        const M doubt = hn::And(hit, p.doubtful(lo, hi));
        if constexpr (care == Care::decide) {
          out.emit(code, p.code, hn::AndNot(doubt, hit));
          if (!hn::AllFalse(d, doubt)) emit_doubtful(sink, code, p.code, doubt);
        } else {
          out.emit(code, p.code, hit);
          in_doubt = hn::Or(in_doubt, doubt);
        }
      }
    }
  }
  return hn::AllFalse(d, in_doubt);
}

// Works in chunks, so that the columns stay in the L1 cache. Doubt is rare when coordinates are arbitrary: a
// chunk in which it occurs is swept again with Care::decide.
void sweep(const GridShape& g, const GridEntry* entries, const std::uint32_t* begin, std::size_t first,
           std::size_t last, Doubt doubt, PairSink& sink) {
  constexpr std::size_t chunk = 256, padding = 64;
  SweepScratch s;
  for (std::size_t base = first; base < last; base += chunk) {
    const std::size_t n = std::min(chunk, last - base);
    s.fit(chunk + padding);
    transpose(entries, base, base, base + n, s);
    const std::size_t most = find_ends(g, begin, n, s);
    if (most > base + n) {
      s.fit(most - base + padding);
      transpose(entries, base, base + n, most, s);
    }
    const std::size_t before = sink.n;
    if (doubt == Doubt::report) {
      sweep_chunk<Care::none>(s, base, n, sink);
    } else if (!sweep_chunk<Care::notice>(s, base, n, sink)) {
      sink.n = before;
      sweep_chunk<Care::decide>(s, base, n, sink);
    }
  }
}

void scan(const KeyBox& box, std::uint32_t code, std::uint32_t column, const GridEntry* entries,
          std::size_t first, std::size_t last, Doubt doubt, PairSink& sink) {
  const I d;
  const std::size_t lanes = hn::Lanes(d);
  Probe p;
  for (int k = 0; k < 3; ++k) {
    p.lo[k] = hn::Set(d, box.lo[k]);
    p.hi[k] = hn::Set(d, box.hi[k]);
  }
  p.code = hn::Set(d, static_cast<std::int32_t>(code));
  p.column = hn::Set(d, static_cast<std::int32_t>(column));
  const V owner = hn::Set(d, static_cast<std::int32_t>(owner_flags));
  Writer out(sink);
  out.reserve(last - first + lanes);
  for (std::size_t j = first; j < last; j += lanes) {
    const Block b(entries + j);
    M in = hn::FirstN(d, last - j);
    if (column == any_column) in = hn::And(in, hn::Eq(hn::And(b.code, owner), owner));
    const M hit = hn::And(hn::And(in, p.counts(b.code, column == any_column ? p.column : b.column)),
                          p.overlaps(b.lo, b.hi));
    const M unsure = doubt == Doubt::report ? hn::FirstN(d, 0) : hn::And(hit, p.doubtful(b.lo, b.hi));
    out.emit(b.code, p.code, hn::AndNot(unsure, hit));
    if (!hn::AllFalse(d, unsure)) emit_doubtful(sink, b.code, p.code, unsure);
  }
}

}  // namespace
}  // namespace touchstone::broad::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace touchstone::broad {

HWY_EXPORT(range_of);
HWY_EXPORT(file);
HWY_EXPORT(write);
HWY_EXPORT(sweep);
HWY_EXPORT(scan);

CellRange cell_range(const GridShape& shape, const KeyBox& box) {
  return HWY_DYNAMIC_DISPATCH(range_of)(shape, box);
}

void file_boxes(const GridShape& shape, const KeyBox* boxes, const std::vector<std::uint32_t>& codes,
                std::vector<Filed>& filed, std::vector<std::uint32_t>& too_large, std::uint32_t* count) {
  filed.resize(codes.size());
  filed.resize(
      HWY_DYNAMIC_DISPATCH(file)(shape, boxes, codes.data(), codes.size(), filed.data(), too_large, count));
}

void write_entries(const GridShape& shape, const KeyBox* boxes, const std::vector<Filed>& filed,
                   std::uint32_t* next, GridEntry* entries, std::size_t nowhere) {
  HWY_DYNAMIC_DISPATCH(write)(shape, boxes, filed.data(), filed.size(), next, entries, nowhere);
}

void sweep_entries(const GridShape& shape, const GridEntry* entries, const std::uint32_t* begin,
                   std::size_t first, std::size_t last, Doubt doubt, PairSink& sink) {
  HWY_DYNAMIC_DISPATCH(sweep)(shape, entries, begin, first, last, doubt, sink);
}

void scan_entries(const KeyBox& box, std::uint32_t code, std::uint32_t column, const GridEntry* entries,
                  std::size_t first, std::size_t last, Doubt doubt, PairSink& sink) {
  HWY_DYNAMIC_DISPATCH(scan)(box, code, column, entries, first, last, doubt, sink);
}

}  // namespace touchstone::broad
#endif
