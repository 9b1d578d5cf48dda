// Polynomials with integer coefficients, their real roots, and exact signs of other polynomials at a root.
//
// Sturm and Tarski: let V(t) be the number of sign changes at t of the signed remainder sequence of P and
// P'·Q. Then V(a) − V(b) is the sum of sign Q(α) over the roots α of P in (a, b), with multiple roots counted
// once, provided that P(a) and P(b) are not zero (Basu, Pollack, Roy 2006, "Algorithms in Real Algebraic
// Geometry", theorem 2.73). Q = 1 counts roots; with exactly one root in (a, b) the sum is the sign of Q
// there, including zero.
#pragma once

#include <vector>

#include "core/impact/exact_integer.h"

namespace touchstone::impact {

/// Coefficients from t⁰ on; the last one is not zero. Empty: the zero polynomial.
class IntegerPolynomial {
 public:
  IntegerPolynomial() = default;
  explicit IntegerPolynomial(std::vector<Integer> coefficients);
  bool is_zero() const { return c_.empty(); }
  std::size_t degree() const { return c_.size() - 1; }  // undefined for zero
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

/// p, p'·q, and their remainders up to positive factors. p is not zero.
SignSequence sign_sequence(const IntegerPolynomial& p, const IntegerPolynomial& q);

/// Σ sign q(α) over the roots α of p inside `i`, where `s` is sign_sequence(p, q).
int tarski_sum(const SignSequence& s, const DyadicInterval& i);

/// The real roots of p inside `i`, in ascending order, each isolated in an interval whose ends are not roots.
/// Ends of `i` that are roots are first moved outward by units of 2^-bits. p is not zero.
std::vector<DyadicInterval> isolated_roots(const IntegerPolynomial& p, DyadicInterval i);

/// Sign of q at the only root of p inside `root`. q has degree at most 2.
int sign_at_root(const IntegerPolynomial& p, const DyadicInterval& root, const IntegerPolynomial& q);

/// The same root in an interval of width at most 2^-50.
DyadicInterval narrowed(const IntegerPolynomial& p, DyadicInterval root);

/// The largest multiple of 2^-53 that is at most the lower end, or 0 if that end is negative.
double below(const DyadicInterval& i);

}  // namespace touchstone::impact
