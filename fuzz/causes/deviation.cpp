#include "fuzz/causes/deviation.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace touchstone::fuzz {
namespace {

double middle(const referee::Bracket& b) { return b.lo + (b.hi - b.lo) / 2; }

// The pair of the fault, and the engine's numbers about it.
struct Reported {
  int a = 0, b = 1;
  std::optional<Vec3> normal;
  std::optional<double> depth;
};

Reported reported(const Query& q, const Observation& o, const FaultReport& f) {
  if (is_pair_question(q.question)) return {q.a, q.b, o.normal, o.depth};
  Reported r{f.a, f.b, {}, {}};
  for (const SceneContact& c : o.contacts)
    if (c.a == f.a && c.b == f.b) {
      r.normal = c.normal;
      r.depth = c.depth;
    }
  return r;
}

constexpr double unit_within = 1e-12;      // the length of a normal that counts as 1
constexpr double same_width = 1e-9;        // of L: widths that count as equal
constexpr double nearly_opposite = -0.99;  // the cosine between two normals

// A contact is a normal and the depth that it requires; which of the two is wrong?
void add_contact(Deviation& d, const Reported& r, Truth& truth) {
  if (!r.normal || !r.depth) return;
  const Vec3& n = *r.normal;
  const double length = n.norm();
  if (!std::isfinite(length)) {
    d.manner = "normal not a number";
    return;
  }
  if (length == 0) {
    d.manner = "normal zero";
    return;
  }
  if (std::abs(length - 1) > unit_within) {
    d.manner = "normal not unit";
    d.error = length - 1;
    return;
  }
  const referee::PairTruth& pair = truth.pair(0, r.a, r.b);
  if (!std::isfinite(pair.gap.lo) || !std::isfinite(pair.gap.hi)) return;
  const double needed = middle(truth.width(0, r.a, r.b, n)), least = -middle(pair.gap);
  const bool is_best = needed - least <= same_width * d.of[static_cast<std::size_t>(Reference::scale)];
  d.of[static_cast<std::size_t>(Reference::truth)] = least;
  if (is_best) {
    d.manner = "depth";
    d.error = *r.depth - needed;
  } else if (n.dot(pair.normal) < nearly_opposite * pair.normal.norm()) {
    d.manner = "normal opposite";
  } else {
    d.manner = "normal";
    d.error = needed - least;
  }
}

void add_distance(Deviation& d, int a, int b, const Observation& o, Truth& truth) {
  const referee::PairTruth& pair = truth.pair(0, a, b);
  if (!o.distance || !std::isfinite(pair.gap.lo) || !std::isfinite(pair.gap.hi)) return;
  d.manner = "distance";
  d.of[static_cast<std::size_t>(Reference::truth)] = middle(pair.gap);
  d.error = *o.distance - middle(pair.gap);
}

void add_time(Deviation& d, int a, int b, const Observation& o, Truth& truth) {
  const referee::TimeTruth& time = truth.motion(0, a, b);
  if (!o.toi || time.verdict != referee::TimeTruth::Verdict::hit) return;
  d.manner = "time";
  const double t = (time.t_lo + time.t_hi) / 2;
  d.of[static_cast<std::size_t>(Reference::truth)] = t;
  d.error = *o.toi - t;
}

// Which number is missing or cannot be used.
std::string missing_number(const Query& q, const Observation& o) {
  if (!std::isfinite(o.claimed_tolerance)) return "claim not a number";
  if (o.claimed_tolerance < 0) return "claim negative";
  if (q.question == Question::distance || q.question == Question::bounded_distance) {
    if (o.moment && !o.moment->allFinite()) return "gradient not a number";
    if (!o.distance) return "no distance";
    return std::isinf(*o.distance) ? "distance infinite" : "distance not a number";
  }
  if (is_motion_question(q.question)) return "time not a number";
  if (!o.overlap) return "no verdict";
  if (!is_contact_question(q.question) || !*o.overlap) return "no_number";
  if (!o.normal) return "no normal";
  if (!o.depth) return "no depth";
  return std::isfinite(*o.depth) ? "no_number" : "depth not a number";
}

// Which of the two bounds is on the wrong side of the gap.
void add_bound(Deviation& d, int a, int b, const Observation& o, Truth& truth) {
  const referee::PairTruth& pair = truth.pair(0, a, b);
  if (!std::isfinite(pair.gap.lo) || !std::isfinite(pair.gap.hi)) return;
  const double gap = middle(pair.gap);
  const bool is_lower = o.lower_bound && *o.lower_bound > gap;
  if (!is_lower && !o.upper_bound) return;
  d.manner = is_lower ? "lower bound" : "upper bound";
  d.of[static_cast<std::size_t>(Reference::truth)] = gap;
  d.error = (is_lower ? *o.lower_bound : *o.upper_bound) - gap;
}

void add_gradient(Deviation& d, int a, int b, const Observation& o, Truth& truth) {
  if (!o.normal || !o.moment) return;
  const Vec3& n = truth.pair(0, a, b).normal;
  if (o.normal->dot(n) < nearly_opposite * n.norm())
    d.manner = "gradient opposite";
  else if (o.moment->isZero(0))
    d.manner = "moment zero";
}

// Points that are off, or no points at all.
void add_points(Deviation& d, const Observation& o, const FaultReport& f) {
  bool are_finite = true;
  if (o.witness)
    for (const Vec3& p : *o.witness) are_finite &= p.allFinite();
  for (const ManifoldPoint& p : o.manifold) are_finite &= p.position.allFinite() && std::isfinite(p.depth);
  if (!are_finite) d.manner = "points not a number";
  d.error = are_finite ? f.error : 0;
}

double finite_or_0(double x) { return std::isfinite(x) ? x : 0; }

}  // namespace

Deviation deviation_of(const Case& c, const Query& q, const Observation& o, const FaultReport& f,
                       Truth& truth) {
  Deviation d;
  d.manner = to_string(f.fault);
  const Reported r = reported(q, o, f);
  const int bodies = static_cast<int>(c.scene.bodies.size());
  if (r.a < 0 || r.b < 0 || r.a >= bodies || r.b >= bodies) return d;
  const double x = finite_or_0(extent(c.scene.shape_of(r.a))), y = finite_or_0(extent(c.scene.shape_of(r.b)));
  d.of = {0, truth.scale(r.a, r.b), x > 0 && y > 0 ? std::min(x, y) : std::max(x, y), std::max(x, y), 1};
  switch (f.fault) {
    case Fault::distance_off:
      add_distance(d, r.a, r.b, o, truth);
      break;
    case Fault::normal_not_unit:
    case Fault::infeasible:
    case Fault::not_minimal:
    case Fault::depth_excess:
      add_contact(d, r, truth);
      break;
    case Fault::late:
    case Fault::early:
      add_time(d, r.a, r.b, o, truth);
      break;
    case Fault::missed:
    case Fault::ghost:
    case Fault::stale:
    case Fault::unstable:
    case Fault::inner_edge:
    case Fault::failed:
      break;
    case Fault::bound_off:
      add_bound(d, r.a, r.b, o, truth);
      break;
    case Fault::gradient_off:
      add_gradient(d, r.a, r.b, o, truth);
      break;
    case Fault::no_number:
      d.manner = missing_number(q, o);
      break;
    case Fault::witness_off:
    case Fault::point_off:
    case Fault::point_depth:
    case Fault::incomplete:
      add_points(d, o, f);
      break;
  }
  return d;
}

std::vector<ErrorLaw> laws_of(std::span<const Deviation> of_one_fault) {
  constexpr double spread = 1.0 / 16;  // of the factors of one law, relative
  constexpr std::size_t fewest = 3;
  std::vector<ErrorLaw> laws;
  if (of_one_fault.size() < fewest) return laws;
  for (std::size_t k = 0; k < references.size(); ++k) {
    double lo = HUGE_VAL, hi = -HUGE_VAL;
    bool all_finite = true;
    for (const Deviation& d : of_one_fault) {
      const double factor = d.error / d.of[k];
      all_finite &= std::isfinite(factor) && factor != 0;
      lo = std::min(lo, factor);
      hi = std::max(hi, factor);
    }
    if (all_finite && hi - lo <= spread * std::max(std::abs(lo), std::abs(hi)))
      laws.push_back({static_cast<Reference>(k), lo + (hi - lo) / 2});
  }
  return laws;
}

bool obey_one_law(std::span<const ErrorLaw> x, std::span<const ErrorLaw> y) {
  constexpr double same_factor = 0.1;  // of two cases with different roundings, relative
  if (x.empty() || y.empty()) return x.empty() && y.empty();
  return std::ranges::any_of(x, [&](const ErrorLaw& p) {
    return std::ranges::any_of(y, [&](const ErrorLaw& q) {
      return p.reference == q.reference &&
             std::abs(p.factor - q.factor) <= same_factor * std::max(std::abs(p.factor), std::abs(q.factor));
    });
  });
}

}  // namespace touchstone::fuzz
