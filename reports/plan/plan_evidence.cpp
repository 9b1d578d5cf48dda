#include "reports/plan/plan_evidence.h"

#include <algorithm>

#include "core/math/rng.h"

namespace touchstone::fuzz {
namespace {

using Kinds = std::pair<ShapeKind, ShapeKind>;

constexpr int candidates_per_pair = 8;  // candidates examined per sampled pair

// Orders candidates so that kinds of shapes take turns, at random within each kind. Stops once there are
// `most`.
std::vector<Occurrence> in_turns(const Course& c, const std::vector<std::vector<BodyPair>>& candidates,
                                 Rng& rng, std::size_t most) {
  std::map<Kinds, std::vector<Occurrence>> by_kind;
  for (std::size_t s = 0; s < candidates.size(); ++s)
    for (const auto& [a, b] : candidates[s])
      by_kind[std::minmax(kind_of(c.scene.shape_of(a)), kind_of(c.scene.shape_of(b)))].push_back(
          {static_cast<int>(s), a, b});
  std::vector<Occurrence> order;
  for (bool any = true; any && order.size() < most;) {
    any = false;
    for (auto& [kinds, left] : by_kind) {
      if (left.empty()) continue;
      any = true;
      std::swap(left[rng.below(left.size())], left.back());
      order.push_back(left.back());
      left.pop_back();
    }
  }
  return order;
}

}  // namespace

Placed PlanSample::placed(int step, int body) const {
  return {&course_.scene.shape_of(body), poses_[at(step)][at(body)]};
}

PlanSample::PlanSample(const Course& course, const EndPoses& poses,
                       const std::vector<std::vector<BodyPair>>& candidates, std::uint64_t seed, int pairs,
                       double margin)
    : course_(course), poses_(poses), margin_(margin) {
  Rng rng(seed);
  const auto order = in_turns(course, candidates, rng, at(candidates_per_pair * pairs));
  // The core's answer only selects the pairs: half are in contact or within the margin if there are enough.
  Fidelity plain;
  plain.margin = margin;
  const auto shapes = planned_shapes(course.scene, plain);
  std::vector<Occurrence> picked, apart;
  for (const Occurrence& o : order) {
    const PlannedShape &a = shapes[at(course.scene.bodies[at(o.a)].shape)],
                       &b = shapes[at(course.scene.bodies[at(o.b)].shape)];
    const PlannedNear c = planned_near(plain, a, planned_body(a, poses[at(o.step)][at(o.a)]), b,
                                       planned_body(b, poses[at(o.step)][at(o.b)]));
    if (c.outcome == Outcome::unsupported) continue;
    (c.within && picked.size() < at(pairs) / 2 ? picked : apart).push_back(o);
  }
  for (std::size_t i = 0; i < apart.size() && picked.size() < at(pairs); ++i) picked.push_back(apart[i]);
  for (const Occurrence& o : picked) {
    Judged j{{o.a, o.b}, referee::judge_pair(placed(o.step, o.a), placed(o.step, o.b)), true};
    ++judged_;
    if (j.truth.verdict == referee::Verdict::undecided) ++undecided_;
    const auto is_mesh = [&](int i) { return touchstone::is_mesh(course.scene.shape_of(i)); };
    j.has_depth = !is_mesh(o.a) && !is_mesh(o.b);
    of_step_[o.step].push_back(std::move(j));
  }
}

// Only certain errors count: measured from the side of each bracket that favours the answer.
double PlanSample::error_of(int step, const Judged& j, const StepReport& report) const {
  const auto is_this = [&](const auto& x) { return BodyPair(x.a, x.b) == j.pair; };
  const referee::Bracket& gap = j.truth.gap;
  const auto near = std::find_if(report.near.begin(), report.near.end(), is_this);
  if (near != report.near.end()) {
    const double beyond = std::max(0.0, gap.lo - margin_);
    return near->gap ? std::max({beyond, gap.lo - *near->gap, *near->gap - gap.hi}) : beyond;
  }
  const auto contact = std::find_if(report.contacts.begin(), report.contacts.end(), is_this);
  if (contact == report.contacts.end()) {
    // A mesh has no depth, so an overlap that is left out is only as wrong as the margin says.
    return std::max(0.0, margin_ - (j.has_depth ? gap.hi : std::max(gap.hi, 0.0)));
  }
  if (gap.lo > 0) return gap.lo;
  if (!j.has_depth) return 0;
  const auto w =
      referee::width(placed(step, j.pair.first), placed(step, j.pair.second), contact->contact.normal);
  const double depth = contact->contact.depth;
  return std::max({0.0, w.lo - depth, depth - w.hi, depth + gap.lo});
}

void PlanSample::judge(int step, const StepReport& report, double error, PlanRow& row) const {
  const auto of_this = of_step_.find(step);
  if (of_this == of_step_.end()) return;
  for (const Judged& j : of_this->second) {
    const double off = error_of(step, j, report);
    row.error = std::max(row.error, off);
    row.outside += !(off <= error);
  }
}

}  // namespace touchstone::fuzz
