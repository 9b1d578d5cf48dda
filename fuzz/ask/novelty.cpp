#include "fuzz/ask/novelty.h"

#include <algorithm>
#include <cmath>

#include "core/base/hash.h"
#include "fuzz/ask/degeneracy.h"
#include "fuzz/ask/magnitude.h"
#include "reports/record/result.h"
#include "scenarios/random/mutate.h"

namespace touchstone::fuzz {
namespace {

// Powers of 64: a few classes between a rounding error and the size of the scene.
int order(double x) {
  return x > 0 && std::isfinite(x) ? static_cast<int>(std::floor(std::log2(x) / 6)) : 99;
}

// How many of the three components along the body's axes are zero within 1e-6.
int axis_class(const Body& b, const Vec3& n) {
  const Vec3 local = rotation_matrix(b.pose.rotation).transpose() * n;
  constexpr double zero = 1e-6;  // looser than the rounding of a float
  int zeros = 0;
  for (const double e : local) zeros += std::abs(e) < zero;
  return zeros;
}

std::string place(const Case& c, const Query& q) {
  return shapes_of(c, q.a, q.b) + std::string(degeneracy_of(c, q.a, q.b));
}

std::string touching_features(const Case& c, const Query& q, const Observation& o) {
  std::string s = std::to_string(std::min<std::size_t>(o.manifold.size(), 9));
  if (!o.normal || !is_pair_question(q.question)) return s;
  for (const int i : {q.a, q.b})
    s += '/' + std::to_string(axis_class(c.scene.bodies[static_cast<std::size_t>(i)], *o.normal));
  return s;
}

}  // namespace

void add_features(const Case& c, const Query& q, const EngineCard& card, const Observation& o,
                  const Judgement& j, std::vector<std::uint64_t>& out) {
  const std::string who = card.name + ' ' + std::string(to_string(q.question)) + ' ' + place(c, q) + ' ';
  std::string what = std::string(to_string(j.outcome)) + std::string(to_string(j.blame));
  for (const FaultReport& f : j.faults)
    what += std::string(to_string(f.fault)) + std::string(to_string(magnitude_of(f.error_in_l)));
  out.push_back(Hasher().add("fault " + who + what).value());
  out.push_back(Hasher().add("touch " + who + touching_features(c, q, o)).value());
  out.push_back(Hasher().add("error " + who + std::to_string(order(j.worst_in_l))).value());
  if (const auto gap = o.distance ? o.distance : o.depth)
    out.push_back(
        Hasher().add("gap " + who + (*gap < 0 ? "-" : "+") + std::to_string(order(std::abs(*gap)))).value());
}

void add_pattern(const Case& c, std::size_t query, std::span<const CaseObservations> observations,
                 std::vector<std::uint64_t>& out) {
  const Query& q = c.queries[query];
  std::string s = "pattern " + std::string(to_string(q.question)) + ' ' + place(c, q) + ' ';
  for (const CaseObservations& of_engine : observations) {
    const Observation& o = of_engine.answers[query];
    if (o.outcome != Outcome::answered)
      s += static_cast<char>('a' + static_cast<int>(o.outcome));
    else if (o.overlap)
      s += *o.overlap ? '1' : '0';
    else if (o.distance)
      s += *o.distance <= 0 ? '1' : '0';
    else
      s += o.toi ? '1' : '0';
  }
  out.push_back(Hasher().add(s).value());
}

void Pool::note(const Case& c, std::span<const std::uint64_t> shown) {
  bool is_new = false;
  for (const std::uint64_t f : shown) is_new |= features.insert(f).second;
  if (is_new && cases.size() < max_cases) cases.push_back(c);
}

Case Pool::draw(Rng& rng) const {
  for (int tries = 0; tries < 4; ++tries) {
    // The later of two draws: older cases have been tried more often.
    const auto one = rng.below(published), other = rng.below(published);
    Case c = cases[std::max(one, other)];
    bool valid = true;
    for (std::uint64_t n = 1 + rng.below(4); n > 0 && valid; --n) valid = apply(random_change(rng), c);
    if (valid) return c;
  }
  return {};
}

}  // namespace touchstone::fuzz
