#include <CGAL/Gmpzf.h>
#include <CGAL/Polytope_distance_d.h>
#include <CGAL/Polytope_distance_d_traits_3.h>
#include <CGAL/Simple_cartesian.h>

#include "tests/second_referee/second_referee.h"

namespace touchstone::second_referee {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Traits = CGAL::Polytope_distance_d_traits_3<Kernel, CGAL::Gmpzf, double>;
using Distance = CGAL::Polytope_distance_d<Traits>;

std::vector<Kernel::Point_3> points(const Polytope& p) {
  std::vector<Kernel::Point_3> all;
  for (const Vec3& v : p.vertices) all.emplace_back(v.x(), v.y(), v.z());
  return all;
}

// Quotients of Gmpzf compare exactly by multiplying out.
bool at_least(const CGAL::Gmpzf& numerator, const CGAL::Gmpzf& denominator, const CGAL::Gmpzf& x) {
  return numerator >= x * x * denominator;
}
bool at_most(const CGAL::Gmpzf& numerator, const CGAL::Gmpzf& denominator, const CGAL::Gmpzf& x) {
  return numerator <= x * x * denominator;
}

}  // namespace

Gap gap_of(const Polytope& a, const Polytope& b, double scale, double lo, double hi) {
  const auto p = points(a), q = points(b);
  const Distance d(p.begin(), p.end(), q.begin(), q.end());
  const CGAL::Gmpzf numerator = d.squared_distance_numerator(),
                    denominator = d.squared_distance_denominator();
  Gap gap;
  gap.overlap = CGAL::is_zero(numerator);
  if (gap.overlap) return gap;
  const CGAL::Gmpzf factor(scale), least = CGAL::Gmpzf(lo) * factor, most = CGAL::Gmpzf(hi) * factor;
  gap.is_within = (lo <= 0 || at_least(numerator, denominator, least)) && hi >= 0 &&
                  at_most(numerator, denominator, most);
  return gap;
}

}  // namespace touchstone::second_referee
