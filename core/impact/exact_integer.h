// Arbitrary-precision integers, with only the operations that the exact decision of deforming primitives
// needs.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace touchstone::impact {

class Integer {
 public:
  Integer() = default;
  explicit Integer(std::int64_t x) : negative_(x < 0) {
    if (x != 0) limbs_ = {x < 0 ? ~static_cast<std::uint64_t>(x) + 1 : static_cast<std::uint64_t>(x)};
  }

  int sign() const { return limbs_.empty() ? 0 : (negative_ ? -1 : 1); }
  Integer operator-() const {
    Integer r = *this;
    r.negative_ = !negative_;
    return r;
  }
  Integer abs() const {
    Integer r = *this;
    r.negative_ = false;
    return r;
  }

  Integer operator+(const Integer& o) const {
    if (negative_ == o.negative_) return make(negative_, sum(limbs_, o.limbs_));
    const int order = compare_sizes(limbs_, o.limbs_);
    if (order == 0) return Integer();
    return order > 0 ? make(negative_, difference(limbs_, o.limbs_))
                     : make(o.negative_, difference(o.limbs_, limbs_));
  }
  Integer operator-(const Integer& o) const { return *this + -o; }

  Integer operator*(const Integer& o) const {
    if (limbs_.empty() || o.limbs_.empty()) return Integer();
    Limbs r(limbs_.size() + o.limbs_.size(), 0);
    for (std::size_t i = 0; i < limbs_.size(); ++i) {
      std::uint64_t carry = 0;
      for (std::size_t j = 0; j < o.limbs_.size(); ++j) {
        const U128 t = static_cast<U128>(limbs_[i]) * o.limbs_[j] + r[i + j] + carry;
        r[i + j] = static_cast<std::uint64_t>(t);
        carry = static_cast<std::uint64_t>(t >> 64);
      }
      r[i + o.limbs_.size()] = carry;
    }
    return make(negative_ != o.negative_, std::move(r));
  }

  /// this · 2^bits.
  Integer shifted(unsigned bits) const {
    if (limbs_.empty()) return *this;
    const unsigned whole = bits / 64, part = bits % 64;
    Limbs r(limbs_.size() + whole + 1, 0);
    for (std::size_t i = 0; i < limbs_.size(); ++i) {
      r[i + whole] |= limbs_[i] << part;
      if (part != 0) r[i + whole + 1] |= limbs_[i] >> (64 - part);
    }
    return make(negative_, std::move(r));
  }

 private:
  using Limbs = std::vector<std::uint64_t>;  // least significant first; the last one is not zero
  __extension__ using U128 = unsigned __int128;

  static Integer make(bool negative, Limbs limbs) {
    while (!limbs.empty() && limbs.back() == 0) limbs.pop_back();
    Integer r;
    r.negative_ = negative && !limbs.empty();
    r.limbs_ = std::move(limbs);
    return r;
  }
  static int compare_sizes(const Limbs& a, const Limbs& b) {
    if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
    for (std::size_t i = a.size(); i-- > 0;)
      if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
    return 0;
  }
  static Limbs sum(const Limbs& a, const Limbs& b) {
    Limbs r(std::max(a.size(), b.size()) + 1, 0);
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < r.size(); ++i) {
      const U128 t = static_cast<U128>(i < a.size() ? a[i] : 0) + (i < b.size() ? b[i] : 0) + carry;
      r[i] = static_cast<std::uint64_t>(t);
      carry = static_cast<std::uint64_t>(t >> 64);
    }
    return r;
  }
  // Precondition: a >= b.
  static Limbs difference(const Limbs& a, const Limbs& b) {
    Limbs r(a.size(), 0);
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const U128 t = static_cast<U128>(a[i]) - (i < b.size() ? b[i] : 0) - borrow;
      r[i] = static_cast<std::uint64_t>(t);
      borrow = static_cast<std::uint64_t>(t >> 64) & 1;
    }
    return r;
  }

  bool negative_ = false;
  Limbs limbs_;
};

}  // namespace touchstone::impact
