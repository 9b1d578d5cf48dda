#include "oracles/referee/exact/polynomial.h"

#include <algorithm>

#include "core/math/roundoff.h"

namespace touchstone::referee {
namespace {

using Chain = std::vector<Polynomial>;

// Sturm chain of a polynomial without multiple roots.
Chain sturm_chain(const Polynomial& p) {
  Chain chain{p, p.derivative()};
  while (!chain.back().is_zero()) {
    Polynomial q, r;
    Polynomial::divide(chain[chain.size() - 2], chain.back(), q, r);
    chain.push_back(Polynomial() - r);
  }
  chain.pop_back();
  return chain;
}

int changes(const Chain& chain, const Rational& t) {
  int n = 0, last = 0;
  for (const Polynomial& p : chain) {
    const int s = p(t).sign();
    if (s == 0) continue;
    n += last != 0 && s != last;
    last = s;
  }
  return n;
}

// Distinct roots in (lo, hi].
int count(const Chain& chain, const Rational& lo, const Rational& hi) {
  return changes(chain, lo) - changes(chain, hi);
}

Polynomial gcd(Polynomial a, Polynomial b) {
  while (!b.is_zero()) {
    Polynomial q, r;
    Polynomial::divide(a, b, q, r);
    a = std::move(b);
    b = std::move(r);
  }
  return a;
}

Polynomial without_multiple_roots(const Polynomial& p) {
  if (p.degree() < 2) return p;
  Polynomial q, r;
  Polynomial::divide(p, gcd(p, p.derivative()), q, r);
  return q;
}

int count_roots(const Polynomial& p, const Rational& lo, const Rational& hi) {
  if (p.degree() == 0) return 0;
  return count(sturm_chain(without_multiple_roots(p)), lo, hi);
}

void isolate(const Chain& chain, const Rational& lo, const Rational& hi, std::vector<Root>& roots) {
  const int n = count(chain, lo, hi);
  if (n == 0) return;
  if (n == 1) {
    const bool exact = chain.front()(hi) == 0;
    roots.push_back({chain.front(), lo, hi, exact});
    return;
  }
  const Rational middle = (lo + hi) / 2;
  isolate(chain, lo, middle, roots);
  isolate(chain, middle, hi, roots);
}

}  // namespace

Rational Polynomial::operator()(const Rational& t) const {
  Rational v = 0;
  for (auto i = c_.rbegin(); i != c_.rend(); ++i) v = v * t + *i;
  return v;
}

Polynomial Polynomial::derivative() const {
  std::vector<Rational> d;
  for (std::size_t i = 1; i < c_.size(); ++i) d.push_back(static_cast<long>(i) * c_[i]);
  return Polynomial(std::move(d));
}

Polynomial operator+(const Polynomial& a, const Polynomial& b) {
  std::vector<Rational> c(std::max(a.c_.size(), b.c_.size()), Rational(0));
  for (std::size_t i = 0; i < a.c_.size(); ++i) c[i] = a.c_[i];
  for (std::size_t i = 0; i < b.c_.size(); ++i) c[i] = c[i] + b.c_[i];
  return Polynomial(std::move(c));
}

Polynomial operator-(const Polynomial& a, const Polynomial& b) { return a + Polynomial({Rational(-1)}) * b; }

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  if (a.is_zero() || b.is_zero()) return {};
  std::vector<Rational> c(a.c_.size() + b.c_.size() - 1, Rational(0));
  for (std::size_t i = 0; i < a.c_.size(); ++i)
    for (std::size_t j = 0; j < b.c_.size(); ++j) c[i + j] = c[i + j] + a.c_[i] * b.c_[j];
  return Polynomial(std::move(c));
}

void Polynomial::divide(const Polynomial& a, const Polynomial& b, Polynomial& quotient,
                        Polynomial& remainder) {
  std::vector<Rational> q(a.c_.size() >= b.c_.size() ? a.c_.size() - b.c_.size() + 1 : 0, Rational(0));
  std::vector<Rational> r = a.c_;
  for (std::size_t k = q.size(); k-- > 0;) {
    q[k] = r[k + b.degree()] / b.lead();
    for (std::size_t i = 0; i < b.c_.size(); ++i) r[k + i] = r[k + i] - q[k] * b.c_[i];
  }
  quotient = Polynomial(std::move(q));
  remainder = Polynomial(std::move(r));
}

std::vector<Root> roots_in_unit_interval(const Polynomial& given) {
  const Polynomial p = without_multiple_roots(given);
  std::vector<Root> roots;
  if (p.degree() == 0) return roots;
  if (p(Rational(0)) == 0) roots.push_back({p, Rational(-1), Rational(0), true});
  isolate(sturm_chain(p), Rational(0), Rational(1), roots);
  return roots;
}

void refine(Root& r) {
  if (r.is_exact) return;
  const Rational middle = (r.lo + r.hi) / 2;
  if (count(sturm_chain(r.p), r.lo, middle) == 0) {
    r.lo = middle;
    return;
  }
  r.hi = middle;
  r.is_exact = r.p(middle) == 0;
}

int sign_at(const Polynomial& q, Root r) {
  if (q.is_zero()) return 0;
  if (r.is_exact || q.degree() == 0) return q(r.hi).sign();
  if (count_roots(gcd(r.p, q), r.lo, r.hi) > 0) return 0;
  while (!r.is_exact && count_roots(q, r.lo, r.hi) > 0) refine(r);
  return q(r.hi).sign();
}

int compare(Root a, Root b) {
  // With b exact, the sign of t - b at a is the answer. Otherwise separate the intervals, unless the roots
  // are the same.
  if (b.is_exact) return sign_at(Polynomial({-b.hi, Rational(1)}), std::move(a));
  if (a.is_exact) return -compare(std::move(b), std::move(a));
  if (sign_at(b.p, a) == 0) {
    // a is a root of b.p; it is the same root as b exactly when it lies in b's interval.
    const bool above = sign_at(Polynomial({-b.lo, Rational(1)}), a) > 0;
    const bool below = sign_at(Polynomial({-b.hi, Rational(1)}), a) <= 0;
    return above && below ? 0 : above ? 1 : -1;
  }
  while (a.lo < b.hi && b.lo < a.hi) {
    refine(a);
    refine(b);
    if (a.is_exact || b.is_exact) return compare(std::move(a), std::move(b));
  }
  return a.hi <= b.lo ? -1 : 1;
}

void enclose(Root r, double& lo, double& hi) {
  // mpq_get_d rounds towards zero, and every root is >= 0.
  for (;;) {
    hi = r.hi.convert_to<double>();
    if (exact(hi) < r.hi) hi = std::nextafter(hi, infinity);
    lo = r.is_exact ? r.hi.convert_to<double>() : std::max(0.0, r.lo.convert_to<double>());
    if (exact(lo) > (r.is_exact ? r.hi : r.lo)) lo = std::nextafter(lo, -infinity);
    if (r.is_exact || std::nextafter(lo, infinity) >= hi) return;
    // Bisection never isolates a root that is itself a double: try it.
    const double inner = std::nextafter(lo, infinity);
    if (std::nextafter(inner, infinity) >= hi && r.p(exact(inner)) == 0) {
      r.hi = exact(inner);
      r.is_exact = true;
    }
    refine(r);
  }
}

}  // namespace touchstone::referee
