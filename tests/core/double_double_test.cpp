// DoubleDouble against 400-bit arithmetic: each operation within its stated bound, on random operands and on
// those that are hard for it.
#include "core/math/double_double.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>

#include "core/math/rng.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

using Reference = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<400, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;

constexpr double u2 = 0x1p-106;  // u², u = 2⁻⁵³
constexpr double inf = std::numeric_limits<double>::infinity();

Reference exact(const DoubleDouble& x) { return Reference(x.high()) + Reference(x.low()); }

bool is_normalized(const DoubleDouble& x) { return x.high() + x.low() == x.high(); }

/// In units of u², relative; infinite if only the computed value is zero or only the true one is.
double relative_error(const DoubleDouble& computed, const Reference& truth) {
  if (truth == 0) return computed == 0 ? 0 : inf;
  return (abs((exact(computed) - truth) / truth) / u2).convert_to<double>();
}

/// Of magnitude 2^-range to 2^range. The low part is zero, of full length, or short and far below.
DoubleDouble random_number(Rng& r, int range) {
  const double high = (r.chance(0.5) ? 1 : -1) * r.binary_scale(-range, range);
  const double ulp = std::ldexp(1.0, std::ilogb(high) - 52);
  const double u = r.uniform();
  double low = ulp * r.uniform(-0.5, 0.5);
  if (u < 0.1) low = 0;
  if (u > 0.8) low = std::ldexp(low, -static_cast<int>(r.below(50)));
  const Rounded s = fast_two_sum(high, low);
  return {s.value, s.error};
}

/// Shares the leading bits of −x.
DoubleDouble almost_opposite(Rng& r, const DoubleDouble& x) {
  const DoubleDouble d = random_number(r, 0) * std::ldexp(x.high(), -static_cast<int>(r.below(110)));
  return -x + d;
}

struct Worst {
  double sum = 0, sum_double = 0, product = 0, product_double = 0, quotient = 0, quotient_double = 0,
         root = 0;
  bool normalized = true;
};

void take(double& most, DoubleDouble computed, const Reference& truth, Worst& w) {
  most = std::max(most, relative_error(computed, truth));
  w.normalized = w.normalized && is_normalized(computed);
}

void measure(const DoubleDouble& x, const DoubleDouble& y, Worst& w) {
  const Reference a = exact(x), b = exact(y), d = y.high();
  take(w.sum, x + y, a + b, w);
  take(w.sum, x - y, a - b, w);
  take(w.sum_double, x + y.high(), a + d, w);
  take(w.sum_double, y.high() - x, d - a, w);
  take(w.product, x * y, a * b, w);
  take(w.product_double, x * y.high(), a * d, w);
  take(w.quotient, x / y, a / b, w);
  take(w.quotient, y.high() / x, d / a, w);
  take(w.quotient_double, x / y.high(), a / d, w);
  take(w.root, sqrt(abs(x)), sqrt(abs(a)), w);
}

void check_bounds(const Worst& w) {
  CHECK(w.normalized);
  CHECK(w.sum <= 3 + 1e-15);
  CHECK(w.sum_double <= 2);
  CHECK(w.product <= 5);
  CHECK(w.product_double <= 3);
  CHECK(w.quotient <= 15 + 1e-14);
  CHECK(w.quotient_double <= 3);
  CHECK(w.root <= 3.125);
}

}  // namespace

TEST_CASE("transforms are exact, also near the largest double and where terms cancel", "[double-double]") {
  Rng r(1);
  bool sums = true, products = true;
  for (int i = 0; i < 20000; ++i) {
    const int range = i % 2 ? 30 : 480;
    const double a = random_number(r, range).high(), b = random_number(r, range).high();
    const Rounded s = two_sum(a, b), p = two_product(a, b);
    sums = sums && Reference(s.value) + s.error == Reference(a) + b;
    products = products && Reference(p.value) + p.error == Reference(a) * b;
  }
  CHECK(sums);
  CHECK(products);
  const double large = 0x1.fffffffffffffp+1023, odd = 0x1.0000000000001p-30;
  for (const auto& [a, b] : {std::pair{large, odd}, std::pair{odd, -large}, std::pair{-large, 0x1.8p-1074}}) {
    const Rounded p = two_product(a, b);
    CHECK(Reference(p.value) + p.error == Reference(a) * b);
  }
}

TEST_CASE("operations keep their relative bounds", "[double-double]") {
  Rng r(2);
  Worst w;
  for (int i = 0; i < 20000; ++i) measure(random_number(r, 3), random_number(r, 3), w);
  check_bounds(w);
}

TEST_CASE("operations keep their relative bounds where operands cancel", "[double-double]") {
  Rng r(3);
  Worst w;
  for (int i = 0; i < 20000; ++i) {
    const DoubleDouble x = random_number(r, 3);
    measure(x, almost_opposite(r, x), w);
  }
  check_bounds(w);
}

TEST_CASE("operations keep their relative bounds from the least to the largest scale", "[double-double]") {
  Rng r(4);
  Worst w;
  for (int i = 0; i < 20000; ++i) {
    const DoubleDouble x = random_number(r, 400), y = random_number(r, 400);
    measure(x, y, w);
  }
  check_bounds(w);
  const DoubleDouble least = std::numeric_limits<DoubleDouble>::min();
  const DoubleDouble largest = {0x1p1023, 0x1p940};
  CHECK(relative_error(least * DoubleDouble(1.5, 0x1p-60), exact(least) * exact({1.5, 0x1p-60})) <= 5);
  CHECK(relative_error(largest / 3, exact(largest) / 3) <= 3);
  CHECK(relative_error(sqrt(largest), sqrt(exact(largest))) <= 3.125);
  const DoubleDouble most = std::numeric_limits<DoubleDouble>::max();
  CHECK(relative_error(sqrt(most), sqrt(exact(most))) <= 0x1p53);  // that of double
}

TEST_CASE("sine and cosine keep their absolute bound", "[double-double]") {
  using boost::multiprecision::cos;
  using boost::multiprecision::sin;
  Rng r(5);
  double worst = 0, circle = 0;
  const auto try_angle = [&](const DoubleDouble& x) {
    const Reference a = exact(x);
    const double bound = 0x1p-101 + 0x1p-154 * std::abs(x.high());
    const SineCosine s = sine_and_cosine(x);
    CHECK(sin(x) == s.sine);
    CHECK(cos(x) == s.cosine);
    const double off = std::max(abs(exact(s.sine) - sin(a)).convert_to<double>(),
                                abs(exact(s.cosine) - cos(a)).convert_to<double>());
    worst = std::max(worst, off / bound);
    circle = std::max(circle, std::abs((s.sine * s.sine + s.cosine * s.cosine - 1).high()));
  };
  for (int i = 0; i < 600; ++i) try_angle(random_number(r, i % 3 == 0 ? 95 : i % 3 == 1 ? 40 : 4));
  // Next to the multiples of π/32, at which table and quadrant change.
  const DoubleDouble step = std::numbers::pi_v<DoubleDouble> / 32;
  for (int k = -140; k <= 140; ++k)
    for (const double off : {-0x1p-60, 0.0, 0x1p-40}) try_angle(step * k + off);
  CHECK(worst <= 1);
  CHECK(circle <= 0x1p-100);
  CHECK(sin(DoubleDouble(0)) == 0);
  CHECK(cos(DoubleDouble(0)) == 1);
  for (const double x : {0x1p100, -0x1p1000}) {
    CHECK(sin(DoubleDouble(x)) == 0);
    CHECK(cos(DoubleDouble(x)) == 1);
  }
  CHECK(std::isnan(sin(DoubleDouble(inf)).high()));
  CHECK(std::isnan(cos(DoubleDouble(std::nan(""))).high()));
}

TEST_CASE("constants of DoubleDouble are those that they are called", "[double-double]") {
  const Reference pi = boost::math::constants::pi<Reference>();
  CHECK(relative_error(std::numbers::pi_v<DoubleDouble>, pi) <= 1);
  for (std::size_t k = 0; k < detail::sines.size(); ++k)
    CHECK(relative_error(detail::sines[k], k == 0 ? Reference(0) : sin(pi * k / 16)) <= 1);
}

TEST_CASE("infinities, zeros and NaN behave as those of double", "[double-double]") {
  const auto is = [](const DoubleDouble& x, double value) { return x.high() == value && x.low() == 0; };
  const auto is_nan = [](const DoubleDouble& x) { return std::isnan(x.high()); };
  const DoubleDouble zero = 0, one = 1, infinite = inf, tiny = {1, 0x1p-80};
  CHECK(is(infinite + one, inf));
  CHECK(is(infinite + infinite, inf));
  CHECK(is(one - infinite, -inf));
  CHECK(is(infinite * tiny, inf));
  CHECK(is(infinite * -2.0, -inf));
  CHECK(is(one / zero, inf));
  CHECK(is(one / 0.0, inf));
  CHECK(is(tiny / infinite, 0));
  CHECK(is(infinite / 3, inf));
  CHECK(is(zero * tiny, 0));
  CHECK(is(zero / tiny, 0));
  CHECK(is(tiny - tiny, 0));
  CHECK(is(sqrt(zero), 0));
  CHECK(is(sqrt(infinite), inf));
  CHECK(is_nan(sqrt(-one)));
  CHECK(is_nan(infinite - infinite));
  CHECK(is_nan(infinite * zero));
  CHECK(is_nan(zero / zero));
  CHECK(is(DoubleDouble(1e308) * 10, inf));
  CHECK(is(DoubleDouble(1e308) * DoubleDouble(1e10), inf));
  CHECK(is(DoubleDouble(1.7e308) + DoubleDouble(1.7e308), inf));
  CHECK(isfinite(one));
  CHECK_FALSE(isfinite(infinite));
  const DoubleDouble nan = std::nan("");
  CHECK_FALSE(nan < one);
  CHECK_FALSE(nan >= one);
  CHECK_FALSE(nan == nan);
}

TEST_CASE("comparisons and the conversion to double see the low part", "[double-double]") {
  const DoubleDouble x = {1, 0x1p-90}, y = {1, -0x1p-90};
  CHECK(x > 1);
  CHECK(y < 1);
  CHECK(y <= x);
  CHECK(x >= x);
  CHECK(x != y);
  CHECK(abs(-x) == x);
  CHECK(abs(DoubleDouble(0) - DoubleDouble(0, 0)) == 0);
  CHECK(static_cast<double>(x) == 1);
  // Halfway between two doubles and a little more: rounds up, although the sum of the parts was a tie.
  const DoubleDouble half = DoubleDouble(1) + 0x1p-53 + 0x1p-100;
  CHECK(static_cast<double>(half) == 1 + 0x1p-52);
  CHECK(ldexp(x, -3) == x / 8);
  constexpr DoubleDouble folded = 1 + 8 * std::numeric_limits<DoubleDouble>::epsilon();
  static_assert(folded > 1 && folded - 1 == 0x1p-98);
  CHECK(folded - 1 == 8 * std::numeric_limits<DoubleDouble>::epsilon());
}

TEST_CASE("Eigen computes with DoubleDouble", "[double-double]") {
  using Vector = Eigen::Matrix<DoubleDouble, 3, 1>;
  using Matrix = Eigen::Matrix<DoubleDouble, 3, 3>;
  const Vector v = Eigen::Vector3d(1, -2, 2).cast<DoubleDouble>() / 3;
  CHECK(abs(v.norm() - 1) <= 0x1p-101);
  CHECK(abs(v.squaredNorm() - 1) <= 0x1p-101);
  const Vector u = v.unitOrthogonal(), w = v.cross(u);
  CHECK(abs(u.dot(v)) <= 0x1p-100);
  CHECK(abs(w.norm() - 1) <= 0x1p-100);
  int at = -1;
  CHECK(v.cwiseAbs().minCoeff(&at) == v[0]);
  CHECK(at == 0);
  CHECK(v.maxCoeff() == v[2]);
  CHECK((2 * v - v * 0.5).isApprox(v + v / 2));
  CHECK((v.cwiseMax(-v) - v.cwiseAbs()).isZero(0));
  CHECK(v.cast<double>() == Eigen::Vector3d(1.0 / 3, -2.0 / 3, 2.0 / 3));
  Matrix m;
  m << v, u, w;
  const Matrix i = m.transpose() * m;
  CHECK((i - Matrix::Identity()).cwiseAbs().maxCoeff() <= 0x1p-100);
}
