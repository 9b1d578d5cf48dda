// Integers of any size, and signs at the roots of polynomials.
#include <cmath>

#include "core/impact/exact_root.h"
#include "core/math/rng.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::impact;

namespace {

__extension__ using I128 = __int128;

IntegerPolynomial poly(std::vector<std::int64_t> c) {
  std::vector<Integer> r;
  for (std::int64_t x : c) r.emplace_back(x);
  return IntegerPolynomial(std::move(r));
}
Integer big(I128 x) {
  const auto hi = static_cast<std::int64_t>(x >> 64);
  const auto lo = static_cast<std::uint64_t>(x);
  return Integer(hi).shifted(64) + Integer(static_cast<std::int64_t>(lo >> 1)).shifted(1) +
         Integer(static_cast<std::int64_t>(lo & 1));
}

}  // namespace

TEST_CASE("integers: sums and products agree with 128-bit arithmetic", "[exact]") {
  Rng r(3);
  const auto draw = [&](int bits) {
    const I128 x = static_cast<I128>(r.next()) << 20 | static_cast<I128>(r.below(1 << 20));
    return (r.chance(0.5) ? -x : x) >> (84 - bits);
  };
  for (int i = 0; i < 20000; ++i) {
    const I128 a = draw(static_cast<int>(r.below(63))), b = draw(static_cast<int>(r.below(63)));
    const I128 c = draw(static_cast<int>(r.below(84)));
    REQUIRE((big(a) * big(b) - big(a * b)).sign() == 0);
    REQUIRE((big(a) + big(c) - big(a + c)).sign() == 0);
    REQUIRE((big(a) - big(c)).sign() == (a > c) - (a < c));
    const auto shift = static_cast<unsigned>(r.below(40));
    REQUIRE((big(c).shifted(shift) - big(c * (I128{1} << shift))).sign() == 0);
    REQUIRE(((big(a) * big(c)).shifted(200) - big(c).shifted(130) * big(a).shifted(70)).sign() == 0);
  }
  CHECK(Integer(std::numeric_limits<std::int64_t>::min()).sign() == -1);
  CHECK((-Integer(0)).sign() == 0);
}

TEST_CASE("roots: each has its own interval, whatever its multiplicity", "[exact]") {
  const DyadicInterval all{Integer(-8), Integer(8), 0};
  // (t − 1)²(t + 2): two distinct roots; t³ − 2: one; t² + 1: none; (t − 3)³: one.
  CHECK(isolated_roots(poly({2, -3, 0, 1}), all).size() == 2);
  CHECK(isolated_roots(poly({-2, 0, 0, 1}), all).size() == 1);
  CHECK(isolated_roots(poly({1, 0, 1}), all).empty());
  CHECK(isolated_roots(poly({-27, 27, -9, 1}), all).size() == 1);
  CHECK(isolated_roots(poly({5}), all).empty());
  // Roots at the ends of the interval are found too.
  CHECK(isolated_roots(poly({0, 1}), {Integer(0), Integer(1), 0}).size() == 1);
  // Two roots 2^-40 apart.
  const std::int64_t two40 = std::int64_t{1} << 40;
  CHECK(isolated_roots(poly({0, -1}) * poly({1, -two40}), all).size() == 2);
}

TEST_CASE("roots: signs of other polynomials at a root are exact, zero included", "[exact]") {
  const auto p = poly({-2, 0, 1});  // ±√2
  const auto roots = isolated_roots(p, {Integer(-8), Integer(8), 0});
  REQUIRE(roots.size() == 2);
  const auto sign = [&](std::size_t k, std::vector<std::int64_t> q) {
    return sign_at_root(p, roots[k], poly(q));
  };
  CHECK(sign(0, {0, 1}) == -1);
  CHECK(sign(1, {0, 1}) == 1);
  CHECK(sign(1, {-4, 0, 2}) == 0);
  CHECK(sign(0, {}) == 0);
  // √2 against convergents of its continued fraction, within 2^-39, alternately below and above.
  CHECK(sign(1, {-941664, 665857}) == 1);
  CHECK(sign(1, {-665857, 470832}) == -1);
  CHECK(sign(1, {-1607521, 1136689}) == 1);
  const DyadicInterval near = narrowed(p, roots[1]);
  CHECK(below({near.lo - Integer(1).shifted(near.bits), Integer(0), near.bits}) ==
        Approx(0.41421356237309505));
  // The interval of a root of even multiplicity is narrowed by counting roots.
  const auto square = p * p;
  const auto twice = isolated_roots(square, {Integer(0), Integer(8), 0});
  REQUIRE(twice.size() == 1);
  const DyadicInterval narrow = narrowed(square, twice[0]);
  CHECK(p.sign_at(narrow.lo, narrow.bits) == -1);
  CHECK(p.sign_at(narrow.hi, narrow.bits) == 1);
}

TEST_CASE("roots: at the ends of an interval, and at the points where it would be split", "[exact]") {
  const auto root_at = [](std::int64_t x) { return poly({-x, 1}); };
  const auto alone = [](const IntegerPolynomial& p, const std::vector<DyadicInterval>& roots) {
    const SignSequence s = sign_sequence(p, poly({1}));
    for (const DyadicInterval& i : roots) {
      CHECK(p.sign_at(i.lo, i.bits) != 0);
      CHECK(p.sign_at(i.hi, i.bits) != 0);
      CHECK(tarski_sum(s, i) == 1);
    }
  };
  // Of (−8, 8), the first four of the points that are tried.
  const auto splits = root_at(0) * root_at(-2) * root_at(2) * root_at(-4);
  const auto found = isolated_roots(splits, {Integer(-8), Integer(8), 0});
  REQUIRE(found.size() == 4);
  alone(splits, found);
  const auto ends = root_at(0) * root_at(1) * root_at(1);
  const auto both = isolated_roots(ends, {Integer(0), Integer(1), 0});
  REQUIRE(both.size() == 2);
  alone(ends, both);
  // Moved outward by more than one unit, past a row of roots.
  const auto row = root_at(0) * root_at(-1) * root_at(-2);
  const auto past = isolated_roots(row, {Integer(0), Integer(1), 0});
  REQUIRE(past.size() == 3);
  alone(row, past);
}

TEST_CASE("roots: of any multiplicity and with a huge gap between degrees", "[exact]") {
  const DyadicInterval all{Integer(-8), Integer(8), 0};
  IntegerPolynomial power = poly({1});
  for (int n = 1; n <= 6; ++n) {
    power = power * poly({-3, 1});
    const auto roots = isolated_roots(power, all);
    REQUIRE(roots.size() == 1);
    const DyadicInterval i = narrowed(power, roots[0]);
    CHECK(poly({-3, 1}).sign_at(i.lo, i.bits) == -1);
    CHECK(poly({-3, 1}).sign_at(i.hi, i.bits) == 1);
    CHECK(sign_at_root(power, roots[0], poly({-3, 1})) == 0);
    CHECK(sign_at_root(power, roots[0], poly({-10, 0, 1})) == -1);
  }
  for (const std::size_t n : {3u, 31u, 60u}) {
    std::vector<std::int64_t> c(n + 1, 0);
    c[0] = -2;
    c[n] = 1;
    CHECK(isolated_roots(poly(c), all).size() == (n % 2 == 0 ? 2 : 1));
    const auto positive = isolated_roots(poly(c), {Integer(0), Integer(8), 0});
    REQUIRE(positive.size() == 1);
    const DyadicInterval i = narrowed(poly(c), positive[0]);
    CHECK(1 + below({i.lo - Integer(1).shifted(i.bits), i.hi, i.bits}) ==
          Approx(std::pow(2, 1 / static_cast<double>(n))).epsilon(1e-14));
  }
}

TEST_CASE("roots: a sign from the interval's Bernstein coefficients, or by counting", "[exact]") {
  const auto p = poly({-2, 0, 1});
  const DyadicInterval wide{Integer(0), Integer(8), 0}, tight = narrowed(p, wide);
  for (const DyadicInterval& i : {wide, tight}) {
    CHECK(sign_at_root(p, i, poly({-7})) == -1);
    CHECK(sign_at_root(p, i, poly({9, 1})) == 1);
    CHECK(sign_at_root(p, i, poly({-1, 1})) == 1);
    CHECK(sign_at_root(p, i, poly({-3, 2})) == -1);
    CHECK(sign_at_root(p, i, poly({3, -5, 2})) == -1);  // (t − 1)(2t − 3)
    CHECK(sign_at_root(p, i, poly({-4, 0, 2})) == 0);
    // Positive at both ends of the wide interval, with a double root at 3.
    CHECK(sign_at_root(p, i, poly({9, -6, 1})) == 1);
  }
}

TEST_CASE("roots: the double below an interval", "[exact]") {
  const auto of = [](std::int64_t lo, unsigned bits) { return below({Integer(lo), Integer(lo + 1), bits}); };
  CHECK(of(-3, 2) == 0);
  CHECK(of(0, 2) == 0);
  CHECK(of(1, 1) == 0.5);
  CHECK(of(5, 3) == 0.625);
  CHECK(of(1, 53) == 0x1p-53);
  CHECK(of(1, 60) == 0);  // below the grid of 2^-53
  CHECK(of((std::int64_t{1} << 60) / 3, 60) <= 1 / 3.0);
  CHECK(of((std::int64_t{1} << 60) / 3, 60) > 1 / 3.0 - 0x1p-53);
  CHECK(of(1, 0) == 1 - 0x1p-53);
  CHECK(of(9, 0) == 1 - 0x1p-53);
}
