// Univariate polynomials with rational coefficients, their real roots in [0,1], and signs at those roots, by
// Sturm's theorem and bisection; nothing is rounded.
#pragma once

#include <vector>

#include "oracles/referee/exact/rational.h"

namespace touchstone::referee {

/// Coefficients in order of rising power, without trailing zeros; the zero polynomial has none.
class Polynomial {
 public:
  Polynomial() = default;
  /// Implicit, as for every coordinate of a Triple.
  Polynomial(int constant) : c_(1, Rational(constant)) { trim(); }
  explicit Polynomial(std::vector<Rational> c) : c_(std::move(c)) { trim(); }
  bool is_zero() const { return c_.empty(); }
  std::size_t degree() const { return c_.empty() ? 0 : c_.size() - 1; }
  const Rational& lead() const { return c_.back(); }
  Rational operator()(const Rational& t) const;
  Polynomial derivative() const;
  friend Polynomial operator+(const Polynomial& a, const Polynomial& b);
  friend Polynomial operator-(const Polynomial& a, const Polynomial& b);
  friend Polynomial operator*(const Polynomial& a, const Polynomial& b);
  /// a = quotient·b + remainder. b not zero.
  static void divide(const Polynomial& a, const Polynomial& b, Polynomial& quotient, Polynomial& remainder);

 private:
  void trim() {
    while (!c_.empty() && c_.back() == 0) c_.pop_back();
  }
  std::vector<Rational> c_;
};
using Polynomial3 = Triple<Polynomial>;

/// The only root of `p` (which has no multiple roots) in (lo, hi]; exactly hi when is_exact.
struct Root {
  Polynomial p;
  Rational lo, hi;
  bool is_exact = false;
};
/// The distinct roots in [0,1], in rising order. p must not be zero.
std::vector<Root> roots_in_unit_interval(const Polynomial& p);
/// Halves the interval, or finds that the root is rational.
void refine(Root& r);
int sign_at(const Polynomial& q, Root r);
/// Compares two roots: < 0, 0, > 0.
int compare(Root a, Root b);
/// Neighbouring doubles (or a single one) that enclose the root.
void enclose(Root r, double& lo, double& hi);

}  // namespace touchstone::referee
