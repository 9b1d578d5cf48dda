// Exact roots of polynomials: which are found, their signs in other polynomials, their order, and the doubles
// around them.
#include <cmath>

#include "oracles/referee/exact/polynomial.h"
#include "tests/support/catch.h"

namespace touchstone::referee_test {
namespace {

using namespace touchstone::referee;

Polynomial poly(const std::vector<Rational>& c) { return Polynomial(c); }
/// t − x.
Polynomial root_at(const Rational& x) { return poly({-x, 1}); }
/// t^n − c.
Polynomial power(std::size_t n, const Rational& c) {
  std::vector<Rational> r(n + 1, Rational(0));
  r[0] = -c;
  r[n] = 1;
  return Polynomial(r);
}
Rational half() { return Rational(1, 2); }

/// The only root of p in [0, 1].
Root only_root(const Polynomial& p) {
  const std::vector<Root> r = roots_in_unit_interval(p);
  REQUIRE(r.size() == 1);
  return r[0];
}

std::pair<double, double> enclosed(const Root& r) {
  double lo = -1, hi = -1;
  enclose(r, lo, hi);
  return {lo, hi};
}

}  // namespace

TEST_CASE("polynomials: arithmetic, and division with and without a remainder", "[referee][polynomial]") {
  const Polynomial a = poly({6, -5, 1}), zero;  // (t − 2)(t − 3)
  CHECK(zero.is_zero());
  CHECK(zero.degree() == 0);
  CHECK(poly({0, 0}).is_zero());
  CHECK((a - a).is_zero());
  CHECK((a * zero).is_zero());
  CHECK(zero.derivative().is_zero());
  CHECK(poly({7}).derivative().is_zero());
  CHECK(a(Rational(2)) == 0);
  CHECK(a(half()) == Rational(15, 4));
  CHECK((a.derivative() - poly({-5, 2})).is_zero());
  CHECK((root_at(2) * root_at(3) - a).is_zero());
  // The leading terms of a sum may cancel.
  CHECK((poly({1, 1}) - poly({0, 1})).degree() == 0);
  Polynomial q, r;
  Polynomial::divide(a, root_at(2), q, r);
  CHECK((q - root_at(3)).is_zero());
  CHECK(r.is_zero());
  Polynomial::divide(power(20, 1), poly({-1, 0, 3}), q, r);
  CHECK(q.degree() == 18);
  CHECK((q * poly({-1, 0, 3}) + r - power(20, 1)).is_zero());
  CHECK(r.degree() == 0);
  CHECK(r(Rational(0)) == Rational(1, 59049) - 1);
  Polynomial::divide(poly({1, 1}), a, q, r);
  CHECK(q.is_zero());
  CHECK((r - poly({1, 1})).is_zero());
}

TEST_CASE("roots in [0, 1]: none, at the ends, inside, outside, multiple", "[referee][polynomial]") {
  const auto count = [](const Polynomial& p) { return roots_in_unit_interval(p).size(); };
  CHECK(count(poly({5})) == 0);
  CHECK(count(poly({1, 0, 1})) == 0);
  CHECK(count(root_at(-1)) == 0);
  CHECK(count(root_at(Rational(5, 4))) == 0);
  CHECK(count(power(2, half())) == 1);  // and −1/√2
  // At the ends, exactly.
  for (const Rational& end : {Rational(0), Rational(1)}) {
    const Root r = only_root(root_at(end) * poly({1, 0, 1}));
    CHECK(r.is_exact);
    CHECK(r.hi == end);
  }
  CHECK(count(root_at(0) * root_at(1) * root_at(half())) == 3);
  // Multiple roots count once, whatever their multiplicity; neighbours are told apart.
  const Polynomial third = root_at(Rational(1, 3));
  CHECK(count(third * third) == 1);
  CHECK(count(third * third * third * third) == 1);
  CHECK(count(root_at(0) * root_at(0)) == 1);
  CHECK(count(third * third * root_at(1) * root_at(1) * root_at(1)) == 2);
  const Rational close = Rational(1, 3) + Rational(1, Integer(1) << 200);
  const std::vector<Root> two = roots_in_unit_interval(third * third * root_at(close));
  REQUIRE(two.size() == 2);
  CHECK(compare(two[0], two[1]) < 0);
  CHECK(sign_at(third, two[0]) == 0);
  CHECK(sign_at(third, two[1]) > 0);
  // Ascending, each alone in its interval.
  Polynomial many = poly({1});
  for (int k = 1; k <= 8; ++k) many = many * root_at(Rational(k, 9));
  const std::vector<Root> roots = roots_in_unit_interval(many);
  REQUIRE(roots.size() == 8);
  for (std::size_t k = 0; k < 8; ++k) {
    CHECK(sign_at(root_at(Rational(static_cast<int>(k) + 1, 9)), roots[k]) == 0);
    if (k > 0) CHECK(roots[k - 1].hi <= roots[k].lo);
  }
}

TEST_CASE("roots in [0, 1]: polynomials of two terms with a huge gap between their degrees",
          "[referee][polynomial]") {
  for (const std::size_t n : {3u, 40u, 101u}) {
    const Root r = only_root(power(n, half()));
    const auto [lo, hi] = enclosed(r);
    CHECK(lo <= std::pow(0.5, 1.0 / static_cast<double>(n)) * (1 + 1e-15));
    CHECK(hi == std::nextafter(lo, 2));
    CHECK(power(n, half())(exact(lo)) < 0);
    CHECK(power(n, half())(exact(hi)) > 0);
  }
  // t^40 (t − 1): a root of multiplicity 40 at one end.
  CHECK(roots_in_unit_interval(power(40, 0) * root_at(1)).size() == 2);
}

TEST_CASE("refine: halves the interval, or finds the root itself", "[referee][polynomial]") {
  Root r = only_root(power(2, half()));
  for (int i = 0; i < 60; ++i) {
    const Rational width = r.hi - r.lo;
    refine(r);
    CHECK(r.hi - r.lo == width / 2);
    CHECK(r.lo * r.lo < half());
    CHECK(r.hi * r.hi > half());
    CHECK_FALSE(r.is_exact);
  }
  Root q = only_root(root_at(Rational(5, 8)));
  for (int i = 0; i < 3; ++i) refine(q);
  CHECK(q.is_exact);
  CHECK(q.hi == Rational(5, 8));
  const Rational lo = q.lo;
  refine(q);  // no effect on an exact root
  CHECK(q.lo == lo);
  CHECK(q.hi == Rational(5, 8));
}

TEST_CASE("sign_at: zero, constant, common root, near and far", "[referee][polynomial]") {
  const Root r = only_root(power(2, half()));  // 1/√2
  CHECK(sign_at(Polynomial(), r) == 0);
  CHECK(sign_at(poly({-3}), r) == -1);
  CHECK(sign_at(power(2, half()), r) == 0);
  CHECK(sign_at(power(2, half()) * root_at(7), r) == 0);
  CHECK(sign_at(poly({0, 1}), r) == 1);
  CHECK(sign_at(root_at(1), r) == -1);
  // Convergents of 1/√2 from both sides, 1e-12 away.
  CHECK(sign_at(root_at(Rational(470832, 665857)), r) == 1);
  CHECK(sign_at(root_at(Rational(1136689, 1607521)), r) == -1);
  // A common factor that does not vanish there: (t² − 1/2)(t + 2) at the root of (t − 1/4)(t + 2).
  const Root quarter = only_root(root_at(Rational(1, 4)) * root_at(-2));
  CHECK(sign_at(power(2, half()) * root_at(-2), quarter) == -1);
  const Root at_one = only_root(root_at(1));
  CHECK(sign_at(root_at(half()), at_one) == 1);
}

TEST_CASE("compare: exact or not, equal as roots of different polynomials, close", "[referee][polynomial]") {
  const Root root_half = only_root(power(2, half())), same = only_root(power(4, Rational(1, 4))),
             one = only_root(root_at(1)), zero = only_root(root_at(0)),
             cubic = only_root(power(3, Rational(1, 3)));
  CHECK(compare(zero, one) < 0);
  CHECK(compare(one, zero) > 0);
  CHECK(compare(one, one) == 0);
  CHECK(compare(root_half, one) < 0);
  CHECK(compare(one, root_half) > 0);
  CHECK(compare(root_half, same) == 0);
  CHECK(compare(same, root_half) == 0);
  CHECK(compare(root_half, cubic) > 0);  // 0.7071, 0.6934
  CHECK(compare(cubic, root_half) < 0);
  // 2^-100 apart, both irrational.
  const Root near = only_root(power(2, half() + Rational(1, Integer(1) << 100)));
  CHECK(compare(root_half, near) < 0);
  CHECK(compare(near, root_half) > 0);
  // One is a root of the other's polynomial, but another one: √(1/2) and √(1/3) of the same product.
  const Polynomial both = power(2, half()) * power(2, Rational(1, 3));
  const std::vector<Root> r = roots_in_unit_interval(both);
  REQUIRE(r.size() == 2);
  CHECK(compare(r[0], root_half) < 0);
  CHECK(compare(root_half, r[0]) > 0);
  CHECK(compare(r[1], root_half) == 0);
  // A root that bisection meets while it separates them.
  CHECK(compare(only_root(root_at(Rational(3, 4))), root_half) > 0);
  CHECK(compare(root_half, only_root(root_at(Rational(11, 16)))) > 0);
}

TEST_CASE("enclose: a double itself, or the doubles on both sides", "[referee][polynomial]") {
  CHECK(enclosed(only_root(root_at(0))) == std::pair{0.0, 0.0});
  CHECK(enclosed(only_root(root_at(1))) == std::pair{1.0, 1.0});
  CHECK(enclosed(only_root(root_at(half()))) == std::pair{0.5, 0.5});
  // Doubles of 53 bits, which bisection by itself would take 53 steps to meet, and one that it never meets.
  for (const double x : {0.1, 0.7071067811865476, 0x1p-60, 0x1.8p-1000}) {
    const auto [lo, hi] = enclosed(only_root(root_at(exact(x)) * poly({2, 1})));
    CHECK(lo <= x);
    CHECK(hi >= x);
    CHECK(std::nextafter(lo, 1) >= hi);
  }
  for (const int n : {3, 7, 1000003}) {
    const auto [lo, hi] = enclosed(only_root(root_at(Rational(1, n))));
    CHECK(exact(lo) < Rational(1, n));
    CHECK(exact(hi) > Rational(1, n));
    CHECK(std::nextafter(lo, 1) == hi);
  }
  const auto [lo, hi] = enclosed(only_root(power(2, half())));
  CHECK(exact(lo) * exact(lo) < half());
  CHECK(exact(hi) * exact(hi) > half());
  CHECK(std::nextafter(lo, 1) == hi);
}

}  // namespace touchstone::referee_test
