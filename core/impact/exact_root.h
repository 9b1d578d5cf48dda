// Polynomials with integer coefficients, their real roots, and exact signs of other polynomials at a root.
//
// Sturm and Tarski: let V(t) be the number of sign changes at t of the signed remainder sequence of P and
// P'·Q. Then V(a) − V(b) is the sum of sign Q(α) over the roots α of P in (a, b), multiple roots counted
// once, provided that P(a) and P(b) are not zero (Basu, Pollack, Roy 2006, "Algorithms in Real Algebraic
// Geometry", theorem 2.73). Q = 1 counts roots; with one root in (a, b) it is the sign of Q there, zero
// included.
#pragma once

#include <vector>

#include "core/impact/exact_integer.h"

namespace touchstone::ccd {

/// Coefficients from t⁰ on; the last one is not zero; none: the zero polynomial.
class IntegerPolynomial {
 public:
  IntegerPolynomial() = default;
  explicit IntegerPolynomial(std::vector<Integer> coefficients);
  bool is_zero() const { return c_.empty(); }
  std::size_t degree() const { return c_.size() - 1; }  // not of zero
  const Integer& lead() const { return c_.back(); }
  const std::vector<Integer>& coefficients() const { return c_; }
  IntegerPolynomial operator+(const IntegerPolynomial& o) const;
  IntegerPolynomial operator-(const IntegerPolynomial& o) const;
  IntegerPolynomial operator*(const IntegerPolynomial& o) const;
  IntegerPolynomial derivative() const;
  /// Sign at numerator / 2^bits.
  int sign_at(const Integer& numerator, unsigned bits) const;

 private:
  std::vector<Integer> c_;
};

/// The open interval (lo, hi) / 2^bits.
struct DyadicInterval {
  Integer lo, hi;
  unsigned bits = 0;
};

using SignSequence = std::vector<IntegerPolynomial>;

/// p, p'·q, and remainders up to positive factors. p is not zero.
SignSequence sign_sequence(const IntegerPolynomial& p, const IntegerPolynomial& q);

/// Σ sign q(α) over the roots of p inside, where `s` is sign_sequence(p, q).
int tarski_sum(const SignSequence& s, const DyadicInterval& i);

/// The real roots of p inside, in ascending order, each alone in an interval whose ends are no roots. The
/// ends of `i` that are roots are first moved outward by units of 2^-bits. p not zero.
std::vector<DyadicInterval> isolated_roots(const IntegerPolynomial& p, DyadicInterval i);

/// Sign of q at the one root of p inside. q of degree at most 2.
int sign_at_root(const IntegerPolynomial& p, const DyadicInterval& root, const IntegerPolynomial& q);

/// The same root in an interval of width at most 2^-50.
DyadicInterval narrowed(const IntegerPolynomial& p, DyadicInterval root);

/// The largest multiple of 2^-53 that is not above the lower end, or 0 when that is negative.
double below(const DyadicInterval& i);

}  // namespace touchstone::ccd
