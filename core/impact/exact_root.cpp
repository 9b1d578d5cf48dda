#include "core/impact/exact_root.h"

#include <cmath>
#include <limits>

namespace touchstone::impact {
namespace {

using Poly = IntegerPolynomial;

const Poly& one() {
  static const Poly p({Integer(1)});
  return p;
}

// Minus the remainder of a by b, times a positive number: each step multiplies by |lead(b)|.
Poly negated_remainder(const Poly& a, const Poly& b) {
  std::vector<Integer> r = a.coefficients();
  const Integer scale = b.lead().abs();
  while (r.size() > b.degree()) {
    const Integer top = b.lead().sign() > 0 ? r.back() : -r.back();
    const std::size_t shift = r.size() - 1 - b.degree();
    for (Integer& x : r) x = x * scale;
    for (std::size_t i = 0; i <= b.degree(); ++i) r[i + shift] = r[i + shift] - top * b.coefficients()[i];
    r.pop_back();
  }
  for (Integer& x : r) x = -x;
  return Poly(std::move(r));
}

int changes_at(const SignSequence& s, const Integer& numerator, unsigned bits) {
  int last = 0, changes = 0;
  for (const Poly& p : s) {
    const int sign = p.sign_at(numerator, bits);
    if (sign == 0) continue;
    changes += last != 0 && sign != last;
    last = sign;
  }
  return changes;
}

// Splits at an interior point that is not a root of p; p has at most four roots, and five points are tried.
struct Cut {
  DyadicInterval left, right;
};
Cut split(const Poly& p, const DyadicInterval& i) {
  const Integer lo = i.lo.shifted(3), width = i.hi - i.lo;
  Integer at;
  for (const int eighths : {4, 3, 5, 2, 6}) {
    at = lo + width * Integer(eighths);
    if (p.sign_at(at, i.bits + 3) != 0) break;
  }
  return {{lo, at, i.bits + 3}, {at, i.hi.shifted(3), i.bits + 3}};
}

bool narrow_enough(const DyadicInterval& i) {
  return ((i.hi - i.lo).shifted(50) - Integer(1).shifted(i.bits)).sign() <= 0;
}

void isolate(const Poly& p, const SignSequence& sturm, const DyadicInterval& i, int count,
             std::vector<DyadicInterval>& out) {
  if (count == 0) return;
  if (count == 1) {
    out.push_back(i);
    return;
  }
  const Cut halves = split(p, i);
  const int left = tarski_sum(sturm, halves.left);
  isolate(p, sturm, halves.left, left, out);
  isolate(p, sturm, halves.right, count - left, out);
}

// Sign of a polynomial of degree <= 2 over a whole interval if its three Bernstein coefficients have the same
// sign; otherwise 0. The middle one is the polar form c0 + c1·(lo + hi)/2 + c2·lo·hi.
int sign_throughout(const Poly& q, const DyadicInterval& i) {
  const int first = q.sign_at(i.lo, i.bits);
  if (first == 0 || q.sign_at(i.hi, i.bits) != first) return 0;
  if (q.degree() < 2) return first;
  const std::vector<Integer>& c = q.coefficients();
  const Integer middle =
      c[0].shifted(2 * i.bits + 1) + (c[1] * (i.lo + i.hi)).shifted(i.bits) + (c[2] * i.lo * i.hi).shifted(1);
  return middle.sign() == first ? first : 0;
}

}  // namespace

IntegerPolynomial::IntegerPolynomial(std::vector<Integer> coefficients) : c_(std::move(coefficients)) {
  while (!c_.empty() && c_.back().sign() == 0) c_.pop_back();
}

Poly Poly::operator+(const Poly& o) const {
  std::vector<Integer> r(std::max(c_.size(), o.c_.size()));
  for (std::size_t i = 0; i < r.size(); ++i) {
    if (i < c_.size()) r[i] = c_[i];
    if (i < o.c_.size()) r[i] = r[i] + o.c_[i];
  }
  return Poly(std::move(r));
}

Poly Poly::operator-(const Poly& o) const {
  std::vector<Integer> negated = o.c_;
  for (Integer& x : negated) x = -x;
  return *this + Poly(std::move(negated));
}

Poly Poly::operator*(const Poly& o) const {
  if (is_zero() || o.is_zero()) return Poly();
  std::vector<Integer> r(c_.size() + o.c_.size() - 1);
  for (std::size_t i = 0; i < c_.size(); ++i)
    for (std::size_t j = 0; j < o.c_.size(); ++j) r[i + j] = r[i + j] + c_[i] * o.c_[j];
  return Poly(std::move(r));
}

Poly Poly::derivative() const {
  std::vector<Integer> r;
  for (std::size_t i = 1; i < c_.size(); ++i) r.push_back(c_[i] * Integer(static_cast<std::int64_t>(i)));
  return Poly(std::move(r));
}

int Poly::sign_at(const Integer& numerator, unsigned bits) const {
  Integer value;
  unsigned scale = 0;
  for (std::size_t i = c_.size(); i-- > 0; scale += bits) value = value * numerator + c_[i].shifted(scale);
  return value.sign();
}

SignSequence sign_sequence(const Poly& p, const Poly& q) {
  SignSequence s{p};
  for (Poly next = p.derivative() * q; !next.is_zero();) {
    s.push_back(std::move(next));
    next = negated_remainder(s[s.size() - 2], s.back());
  }
  return s;
}

int tarski_sum(const SignSequence& s, const DyadicInterval& i) {
  return changes_at(s, i.lo, i.bits) - changes_at(s, i.hi, i.bits);
}

std::vector<DyadicInterval> isolated_roots(const Poly& p, DyadicInterval i) {
  std::vector<DyadicInterval> found;
  if (p.degree() == 0) return found;
  while (p.sign_at(i.lo, i.bits) == 0) i.lo = i.lo - Integer(1);
  while (p.sign_at(i.hi, i.bits) == 0) i.hi = i.hi + Integer(1);
  const SignSequence sturm = sign_sequence(p, one());
  isolate(p, sturm, i, tarski_sum(sturm, i), found);
  return found;
}

int sign_at_root(const Poly& p, const DyadicInterval& root, const Poly& q) {
  if (q.is_zero()) return 0;
  const int sign = sign_throughout(q, root);
  return sign != 0 ? sign : tarski_sum(sign_sequence(p, q), root);
}

DyadicInterval narrowed(const Poly& p, DyadicInterval root) {
  // A root at which p changes sign is located by the signs of p alone; a root of even multiplicity is located
  // by counting.
  const int at_lo = p.sign_at(root.lo, root.bits);
  const bool changes = at_lo != p.sign_at(root.hi, root.bits);
  const SignSequence sturm = changes ? SignSequence{} : sign_sequence(p, one());
  while (!narrow_enough(root)) {
    const Cut halves = split(p, root);
    const bool is_left =
        changes ? p.sign_at(halves.left.hi, halves.left.bits) != at_lo : tarski_sum(sturm, halves.left) == 1;
    root = is_left ? halves.left : halves.right;
  }
  return root;
}

double below(const DyadicInterval& i) {
  if (i.lo.sign() <= 0) return 0;
  // Bit by bit: the largest m / 2^53 that is not above.
  constexpr int bits = std::numeric_limits<double>::digits;
  double t = 0;
  for (int k = 1; k <= bits; ++k) {
    const double next = t + std::ldexp(1.0, -k);
    const Integer m(static_cast<std::int64_t>(std::ldexp(next, bits)));
    if ((m.shifted(i.bits) - i.lo.shifted(bits)).sign() <= 0) t = next;
  }
  return t;
}

}  // namespace touchstone::impact
