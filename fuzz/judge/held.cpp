#include "fuzz/judge/truth.h"

#include <algorithm>
#include <cmath>

#include "fuzz/judge/largest_number.h"

namespace touchstone::fuzz {
namespace {

bool is_fit(double v, Domain d) { return std::isfinite(v) && (d == Domain::any || v >= 0); }
bool is_fit(const Vec3& v, Domain d) {
  if (!v.allFinite()) return false;
  if (d == Domain::nonzero_vector) return !v.isZero(0);
  return d == Domain::any || (v.array() >= 0).all();
}
bool is_fit(const std::vector<Vec3>& v, Domain) {
  return std::all_of(v.begin(), v.end(), [](const Vec3& p) { return p.allFinite(); });
}
bool is_fit(const std::vector<std::array<int, 3>>&, Domain) { return true; }

// An engine may scale the numbers of a plane at will.
double largest_size(const Shape& shape) {
  return std::holds_alternative<HalfSpace>(shape) ? 0 : largest_number(shape);
}

// Rounding moves a number by a fraction of the largest one. A number a million times as large has nothing to
// do with the given scene, and numbers of 1e300 beside those of 1 cost the referee minutes.
class Plausible {
 public:
  explicit Plausible(const Scene& asked) {
    constexpr double times = 1e6;  // as above
    double m = 1;                  // at least one unit of length
    for (const Shape& s : asked.shapes) m = std::max(m, largest_size(s));
    for (const Body& b : asked.bodies) m = std::max(m, largest_number(b.pose.translation));
    limit_ = times * m;
  }
  bool operator()(const Shape& s) const { return is_a_set(s) && largest_size(s) <= limit_; }
  bool operator()(const Placement& p) const {
    constexpr double largest_turn = 1e6;  // for a matrix that should only rotate
    return p.matrix.allFinite() && p.matrix.lpNorm<Eigen::Infinity>() <= largest_turn &&
           p.translation.allFinite() && largest_number(p.translation) <= limit_;
  }

 private:
  double limit_;
};

// Candidate queries may contain invalid bodies (scenarios/value/invalid_numbers.h): holding those is not a
// fault.
bool is_body_held(const Plausible& plausible, const Scene& asked, const ReceivedScene& r, std::size_t body) {
  if (!asked.bodies[body].pose.translation.allFinite() || !is_a_set(asked.shape_of(static_cast<int>(body))))
    return true;
  if (body < r.bodies.size() && r.bodies[body] && !plausible(*r.bodies[body])) return false;
  const auto shape = static_cast<std::size_t>(asked.bodies[body].shape);
  return shape >= r.shapes.size() || !r.shapes[shape] || plausible(*r.shapes[shape]);
}

}  // namespace

bool is_a_set(const Shape& shape) {
  bool good = true;
  std::visit(
      [&](const auto& s) {
        for_each_field(s, [&](auto, const auto& v, Domain d) { good = good && is_fit(v, d); });
      },
      shape);
  return good;
}

ReceivedScene held_part(const Scene& asked, const ReceivedScene& received) {
  const Plausible plausible(asked);
  ReceivedScene r = received;
  for (auto& s : r.shapes)
    if (s && !plausible(*s)) s.reset();
  for (auto& b : r.bodies)
    if (b && !plausible(*b)) b.reset();
  return r;
}

bool is_held(const Scene& asked, const ReceivedScene& received, const Query& query) {
  const Plausible plausible(asked);
  if (is_pair_question(query.question))
    return is_body_held(plausible, asked, received, static_cast<std::size_t>(query.a)) &&
           is_body_held(plausible, asked, received, static_cast<std::size_t>(query.b));
  for (std::size_t i = 0; i < asked.bodies.size(); ++i)
    if (!is_body_held(plausible, asked, received, i)) return false;
  return true;
}

}  // namespace touchstone::fuzz
