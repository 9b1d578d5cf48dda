#include "oracles/referee/touching.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "core/tolerance.h"
#include "oracles/referee/checker.h"
#include "oracles/referee/rational.h"

namespace touchstone::referee {
namespace {

Integer floor_of(const Rational& x) {
  const Integer n = numerator(x), d = denominator(x);
  const Integer q = n / d;  // towards zero
  return q * d > n ? Integer(q - 1) : q;
}

/// The fraction of least denominator in [lo, hi], by the continued fractions of both ends.
Rational simplest_between(const Rational& lo, const Rational& hi) {
  const Integer whole = floor_of(lo);
  if (Rational(whole) == lo) return lo;
  if (Rational(whole + 1) <= hi) return Rational(whole + 1);
  const Rational w(whole);
  return w + Rational(1) / simplest_between(Rational(1) / (hi - w), Rational(1) / (lo - w));
}

}  // namespace

Certificate guess_common_point(const std::array<Vec3, 2>& witness, const Placed& a, const Placed& b) {
  const Vec3 middle = witness[0] + 0.5 * (witness[1] - witness[0]);
  double size = 0;
  for (const Vec3& w : witness) size = std::max(size, w.cwiseAbs().maxCoeff());
  if (!std::isfinite(size)) return {};
  for (const Placed& p : {a, b})
    if (const double r = bounding_radius(*p.shape); std::isfinite(r)) size = std::max(size, r);
  Certificate c;
  c.kind = Certificate::Kind::common_point;
  std::vector<double> steps{0};  // the witness as it stands comes first
  steps.insert(steps.end(), std::begin(tolerance::referee_guess_factors),
               std::end(tolerance::referee_guess_factors));
  for (const double step : steps)
    for (const Vec3& w : {middle, witness[0], witness[1]}) {
      const Rational e = exact(step * size);
      c.rationals.clear();
      for (int k = 0; k < 3; ++k) {
        const Rational x = exact(w[k]), guess = e > 0 ? simplest_between(x - e, x + e) : x;
        c.rationals.push_back(text_of(guess));
        c.point[k] = guess.convert_to<double>();
      }
      if (check(c, a, b)) return c;
    }
  return {};
}

}  // namespace touchstone::referee
