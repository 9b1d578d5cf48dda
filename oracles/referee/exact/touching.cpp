#include "oracles/referee/exact/exact_point.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <vector>

#include "oracles/checker/checker.h"
#include "oracles/referee/exact/rational.h"
#include "oracles/referee/filter/real3.h"
#include "oracles/referee/limits.h"

namespace touchstone::referee {
namespace {

// Whether the exact point is the one in doubles.
bool is_representable(const Certificate& c) {
  for (int k = 0; k < 3; ++k)
    if (exact(c.point[k]) != rational_from_text(c.rationals[static_cast<std::size_t>(k)])) return false;
  return true;
}

// Whether the exact point, of which `rounded` is the rounding, is certainly not in the body: cheaper to show
// than in exact arithmetic, and true of most guesses.
bool is_outside(const Placed& body, const Vec3& rounded) {
  constexpr double any_bracket = std::numeric_limits<double>::infinity();
  return distance_to(body, rounded, any_bracket).lo > value_rounding_of<double> * rounded.stableNorm();
}

}  // namespace

Certificate guess_common_point(const std::array<Vec3, 2>& witness, const Placed& a, const Placed& b,
                               int& level) {
  const Vec3 middle = witness[0] + 0.5 * (witness[1] - witness[0]);
  double size = 0;
  for (const Vec3& w : witness) size = std::max(size, w.cwiseAbs().maxCoeff());
  if (!std::isfinite(size)) return {};
  for (const Placed& p : {a, b})
    if (const double r = bounding_radius(*p.shape); std::isfinite(r)) size = std::max(size, r);
  Certificate c;
  c.kind = Certificate::Kind::common_point;
  std::vector<double> steps{0};  // the unchanged witness comes first
  steps.insert(steps.end(), std::begin(limits::guess_factors), std::end(limits::guess_factors));
  for (const double step : steps)
    for (const Vec3& w : {middle, witness[0], witness[1]}) {
      const Rational e = exact(step * size);
      c.rationals.clear();
      for (int k = 0; k < 3; ++k) {
        const Rational x = exact(w[k]), guess = e > 0 ? simplest_between(x - e, x + e) : x;
        c.rationals.push_back(text_of(guess));
        c.point[k] = guess.convert_to<double>();
      }
      // Most guesses are doubles of a few bits, and most are wrong: short integers tell at once.
      if (is_representable(c)) {
        const auto in_a = contains_short(a, c.point);
        const auto in_b = in_a && !*in_a ? in_a : contains_short(b, c.point);
        if (in_a && in_b) {
          if (!*in_a || !*in_b) continue;
          level = 1;
          return c;
        }
      }
      if (!is_outside(a, c.point) && !is_outside(b, c.point) && checker::check(c, a, b)) {
        level = 2;
        return c;
      }
    }
  return {};
}

}  // namespace touchstone::referee
