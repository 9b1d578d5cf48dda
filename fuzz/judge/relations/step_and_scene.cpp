// Relations about more than one pose: a time step against the poses within it, and a scene against the same
// scene built in another way.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "fuzz/judge/relation.h"
#include "fuzz/judge/truth.h"
#include "scenarios/value/candidate_pairs.h"

namespace touchstone::fuzz {
namespace {

// A body at its pose at time t, at rest.
Body at_time(const Body& b, double t) {
  Body r = b;
  if (b.motion) r.pose = pose_at(b.pose, *b.motion, t);
  r.motion.reset();
  return r;
}

Derived snapshot(const RelationInput& in, const Query& q, double t) {
  Derived d;
  d.c.family = in.c.family;
  d.c.scene = extract_pair(in.c.scene, q.a, q.b);
  for (Body& b : d.c.scene.bodies) b = at_time(b, t);
  d.c.queries = {{Question::overlap, 0, 1}, {Question::distance, 0, 1}};
  // A rotation by the angle |ω|t is off by that many roundings.
  double spin = 0;
  for (const int i : {q.a, q.b})
    if (const auto& m = in.c.scene.bodies[static_cast<std::size_t>(i)].motion)
      spin += m->angular.stableNorm();
  d.rounding = (1 + spin) * pose_rounding(d.c.scene);
  d.words = fmt::format("at t = {:.9g}", t);
  return d;
}

// What a right answer to a cast implies about the gap at time t. No impact: no depth above τ at any time. A
// hit at t0: no depth above τ before t0; at t0 neither gap nor depth beyond τ, but any depth if the overlap
// is there from the start. A sweep skin lets it stop that much earlier.
GapInterval claimed_at(const Observation& o, double t, double tau, double skin) {
  if (!o.toi || t < *o.toi) return {-tau, infinity};
  if (t > *o.toi) return {};
  return {t == 0 ? -infinity : -tau, tau + skin};
}

const std::vector<double>& probe_times() {
  static const std::vector<double> times{0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1};
  return times;
}

}  // namespace

// Two times of impact of one motion, or of its halves, cannot be compared: where the bodies graze, both are
// right. Gaps can be compared.
std::vector<Derived> derive_step(const RelationInput& in) {
  std::vector<Derived> r;
  for (std::size_t i = 0; i < in.c.queries.size(); ++i) {
    const Query& q = in.c.queries[i];
    const Observation& o = in.base.answers[i];
    if (q.question != Question::time_of_impact || o.outcome != Outcome::answered) continue;
    if (o.toi && !(*o.toi >= 0 && *o.toi <= 1)) continue;
    const double tau = tau_of(in.card, o, in.c.scene, q.a, q.b, scale_of_pair(in.c.scene, q.a, q.b));
    std::vector<double> times = probe_times();
    if (o.toi) times.push_back(*o.toi);
    for (const double t : times) {
      const GapInterval claim = claimed_at(o, t, tau, sweep_skin(in.card));
      if (claim.says_nothing()) continue;
      r.push_back(snapshot(in, q, t));
      r.back().expected = {{static_cast<int>(i), claim}};
    }
  }
  return r;
}

std::vector<Derived> derive_order(const RelationInput& in) {
  const Scene& s = in.c.scene;
  if (in.c.queries.empty() || is_pair_question(in.c.queries[0].question)) return {};
  const int n = static_cast<int>(s.bodies.size());
  Derived d;
  d.c = in.c;
  d.same_questions = true;
  d.words = "bodies in reverse order";
  Scene& t = d.c.scene;
  const auto mapped = [n](int i) { return n - 1 - i; };
  for (int i = 0; i < n; ++i) d.body_of.push_back(mapped(i));
  std::reverse(t.bodies.begin(), t.bodies.end());
  for (Query& q : d.c.queries)
    if (is_pair_question(q.question)) q = {q.question, mapped(q.a), mapped(q.b)};
  for (BodyPair& p : t.ignored) p = {mapped(p.second), mapped(p.first)};
  std::sort(t.ignored.begin(), t.ignored.end());
  for (Step& step : t.script)
    if (step.op != Step::Op::query) step.body = mapped(step.body);
  return {d};
}

std::vector<Derived> derive_reinsert(const RelationInput& in) {
  const auto asks = [&](const Query& q) { return q.question == Question::candidates; };
  if (std::none_of(in.c.queries.begin(), in.c.queries.end(), asks)) return {};
  Derived d;
  d.c = in.c;
  d.same_questions = true;
  d.words = "every third body removed and inserted again before each query";
  for (int i = 0; i < static_cast<int>(in.c.scene.bodies.size()); ++i) d.body_of.push_back(i);
  std::map<int, Pose> present;
  std::vector<Step> script;
  for (const Step& step : effective_script(in.c.scene)) {
    if (step.op == Step::Op::remove) present.erase(step.body);
    if (step.op == Step::Op::insert || step.op == Step::Op::move)
      present[step.body] = step.pose.value_or(in.c.scene.bodies[static_cast<std::size_t>(step.body)].pose);
    if (step.op == Step::Op::query)
      for (const auto& [body, pose] : present)
        if (body % 3 == 0) {
          script.push_back({Step::Op::remove, body, std::nullopt});
          script.push_back({Step::Op::insert, body, pose});
        }
    script.push_back(step);
  }
  d.c.scene.script = std::move(script);
  return {d};
}

namespace {

using Pairs = std::vector<BodyPair>;

Pairs in_base(const Pairs& pairs, const std::vector<int>& body_of) {
  Pairs r;
  const int n = static_cast<int>(body_of.size());
  for (const auto& [x, y] : pairs) {
    if (x < 0 || y < 0 || x >= n || y >= n || x == y) continue;  // stale: another fault
    r.emplace_back(body_of[static_cast<std::size_t>(x)], body_of[static_cast<std::size_t>(y)]);
  }
  return sorted_unique(std::move(r));
}

// Superfluous pairs may depend on history: a broad phase may keep boxes wider than needed. A pair whose boxes
// overlap by more than τ on every axis may not.
bool boxes_overlap(const RelationInput& in, const Observation& o, const Truth::StepState& at, BodyPair p) {
  const auto box = [&](int i) -> std::optional<Aabb> {
    const auto& pose = at.pose[static_cast<std::size_t>(i)];
    if (!pose) return std::nullopt;
    return referee::outer_box({&in.c.scene.shape_of(i), *pose});
  };
  const auto x = box(p.first), y = box(p.second);
  if (!x || !y || is_filtered(in.c.scene, p.first, p.second)) return false;
  const double l = std::max(scale_of_pair(in.c.scene, p.first, p.second),
                            std::max(at.pose[static_cast<std::size_t>(p.first)]->translation.stableNorm(),
                                     at.pose[static_cast<std::size_t>(p.second)]->translation.stableNorm()));
  const double tau = tau_of(in.card, o, in.c.scene, p.first, p.second, l);
  return ((x->hi.cwiseMin(y->hi) - x->lo.cwiseMax(y->lo)).array() > tau).all();
}

std::optional<RelationBreak> find_other_pairs(const Relation& r, const RelationInput& in, const Derived& d,
                                              std::size_t query, const Observation& after) {
  const Observation& before = in.base.answers[query];
  std::vector<int> same(d.body_of.size());
  for (std::size_t i = 0; i < same.size(); ++i) same[i] = static_cast<int>(i);
  Truth truth(in.c.scene);
  const std::size_t n =
      std::min(truth.steps().size(), std::max(before.candidate_pairs.size(), after.candidate_pairs.size()));
  for (std::size_t k = 0; k < n; ++k) {
    const Pairs none;
    const Pairs x = in_base(k < before.candidate_pairs.size() ? before.candidate_pairs[k] : none, same);
    const Pairs y = in_base(k < after.candidate_pairs.size() ? after.candidate_pairs[k] : none, d.body_of);
    Pairs only;
    std::set_symmetric_difference(x.begin(), x.end(), y.begin(), y.end(), std::back_inserter(only));
    std::erase_if(only, [&](const BodyPair& p) { return !boxes_overlap(in, before, truth.steps()[k], p); });
    if (only.empty()) continue;
    const auto [a, b] = only.front();
    return RelationBreak{
        r.name,
        static_cast<int>(query),
        a,
        b,
        0,
        Blame::algorithm,
        fmt::format("{}: at query {}, {} pairs differ; the first is ({}, {}), a candidate only {}", d.words,
                    k, only.size(), a, b,
                    std::binary_search(x.begin(), x.end(), only.front()) ? "before" : "after")};
  }
  return std::nullopt;
}

using Depths = std::map<BodyPair, double>;

Depths deepest(const Observation& o, const std::vector<int>& body_of) {
  Depths r;
  for (const SceneContact& c : o.contacts) {
    const Pairs p = in_base({{c.a, c.b}}, body_of);
    if (p.empty() || !std::isfinite(c.depth)) continue;
    const auto [it, added] = r.try_emplace(p[0], c.depth);
    if (!added) it->second = std::max(it->second, c.depth);
  }
  return r;
}

// A right contact of depth p has p <= (1 + bias) d* + 2τ; an omitted pair has d* <= τ.
std::optional<RelationBreak> find_other_contacts(const Relation& r, const RelationInput& in, const Derived& d,
                                                 std::size_t query, const Observation& after) {
  const Observation& before = in.base.answers[query];
  std::vector<int> same(d.body_of.size());
  for (std::size_t i = 0; i < same.size(); ++i) same[i] = static_cast<int>(i);
  const Depths x = deepest(before, same), y = deepest(after, d.body_of);
  const auto left_out = [&](const Depths& with, const Depths& without,
                            const char* when) -> std::optional<RelationBreak> {
    for (const auto& [pair, p] : with) {
      const auto [a, b] = pair;
      const Scene& s = in.c.scene;
      if (without.contains(pair) || is_mesh(s.shape_of(a)) || is_mesh(s.shape_of(b))) continue;
      const double l = scale_of_pair(s, a, b);
      const double tau = std::max(tau_of(in.card, before, s, a, b, l), tau_of(in.card, after, s, a, b, l));
      const double bias = depth_bias(in.card, kind_of(s.shape_of(a)), kind_of(s.shape_of(b)));
      if (p > (3 + bias) * tau)
        return RelationBreak{r.name,
                             static_cast<int>(query),
                             a,
                             b,
                             p / l,
                             Blame::algorithm,
                             fmt::format("{}: a contact of ({}, {}), {:.6g} deep, is reported only {}",
                                         d.words, a, b, p, when)};
    }
    return std::nullopt;
  };
  if (auto b = left_out(x, y, "before")) return b;
  return left_out(y, x, "after");
}

}  // namespace

std::optional<RelationBreak> find_scene_break(const Relation& r, const RelationInput& in, const Derived& d,
                                              const CaseObservations& observed) {
  for (std::size_t i = 0; i < in.c.queries.size() && i < observed.answers.size(); ++i) {
    const Observation &before = in.base.answers[i], &after = observed.answers[i];
    if (before.outcome != Outcome::answered || after.outcome != Outcome::answered) continue;
    const Question q = in.c.queries[i].question;
    if (q == Question::candidates)
      if (auto b = find_other_pairs(r, in, d, i, after)) return b;
    if (q == Question::scene_contacts)
      if (auto b = find_other_contacts(r, in, d, i, after)) return b;
  }
  return std::nullopt;
}

}  // namespace touchstone::fuzz
