// Swept pairs. A body that is not swept is represented by the box of its end pose, widened by the distance
// that its points move in the step, |v| + R·|ω|; this contains its swept box and is cheaper. Few swept bodies
// are tested against all boxes one by one; more go through a broad phase in which all other bodies are fixed.
#include "core/world/step_world.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/broad/body_box.h"
#include "core/broad/catalog.h"

namespace touchstone {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Up to this many, comparing every box is cheaper than setting up a broad phase (a count; same pairs).
constexpr std::size_t few_swept = 24;

// Covers about ten roundings of 2^-53 of a pose, its box and the sizes.
constexpr double pose_slack = 0x1p-40;

bool moves(const Motion& m) { return !m.linear.isZero(0) || !m.angular.isZero(0); }

// Counts what was not answered. Returns whether it was supported.
bool is_supported(Outcome outcome, StepReport& r) {
  if (outcome == Outcome::unsupported) {
    ++r.unsupported;
    return false;
  }
  if (outcome != Outcome::answered) r.outcome = outcome;
  return true;
}

void note(int a, int b, ContactAnswer c, StepReport& r) {
  if (is_supported(c.outcome, r) && c.overlap) r.contacts.push_back({a, b, std::move(c)});
}

void note(int a, int b, PlannedNear n, StepReport& r) {
  if (!is_supported(n.outcome, r) || !n.within) return;
  if (n.contact)
    r.contacts.push_back({a, b, std::move(*n.contact)});
  else
    r.near.push_back({a, b, n.gap});
}

// The exact body at any t in [0,1] lies within the widened box. The end pose is rounded by at most about ten
// units of 2^-53 of its coordinates and of the body; pose_slack covers that.
Aabb widened_by_motion(const Aabb& end, const InnerExtent& e, const Motion& m) {
  const double size = std::isinf(e.reach) ? 0 : e.reach;
  const double turn = m.angular.isZero(0) ? 0 : size * m.angular.norm();
  const Vec3 travel = m.linear.cwiseAbs() + Vec3::Constant(turn);
  Aabb box = end;
  for (int k = 0; k < 3; ++k) {
    const double slack = pose_slack * (travel[k] + size + std::max(std::abs(end.lo[k]), std::abs(end.hi[k])));
    // The body comes from where its velocity points away from; turning may extend it on any side.
    box.lo[k] -= std::max(m.linear[k], 0.0) + turn + (std::isfinite(slack) ? slack : 0);
    box.hi[k] += std::max(-m.linear[k], 0.0) + turn + (std::isfinite(slack) ? slack : 0);
  }
  return box;
}

}  // namespace

namespace {

Fidelity with_phase(std::string_view broad_phase) {
  Fidelity f;
  f.broad_phase = broad_phase;
  return f;
}

}  // namespace

StepWorld::StepWorld(Scene scene, std::string_view broad_phase)
    : StepWorld(std::move(scene), with_phase(broad_phase)) {}

StepWorld::StepWorld(Scene scene, Fidelity fidelity)
    : scene_(std::move(scene)),
      fidelity_(std::move(fidelity)),
      phase_(broad::make_broad_phase(fidelity_.broad_phase)) {
  if (!phase_) throw std::invalid_argument("unknown broad phase: " + fidelity_.broad_phase);
  shapes_ = planned_shapes(scene_, fidelity_);
  const std::size_t n = scene_.bodies.size();
  by_hand_.assign(n, 0);
  moved_.assign(n, 1);
  std::vector<InnerExtent> of_shape;
  for (const Shape& s : scene_.shapes) of_shape.push_back(inner_extent(s));
  for (std::size_t i = 0; i < n; ++i) {
    const Body& b = scene_.bodies[i];
    extent_.push_back(of_shape[at(b.shape)]);
    box_size_.push_back(broad::box_size(scene_.shape_of(static_cast<int>(i))));
    end_.push_back(b.pose);
    bodies_.push_back(planned_body(planned_shape(static_cast<int>(i)), b.pose));
    end_box_.push_back(planned_box(fidelity_, planned_shape(static_cast<int>(i)), bodies_[i]));
    phase_->insert(static_cast<int>(i), end_box_[i],
                   b.is_static ? broad::Mobility::fixed : broad::Mobility::moving);
  }
}

const PlannedShape& StepWorld::planned_shape(int body) const {
  return shapes_[at(scene_.bodies[at(body)].shape)];
}

void StepWorld::set(int body, const Pose& start, const Motion& motion) {
  scene_.bodies.at(at(body)).pose = start;
  scene_.bodies[at(body)].motion = motion;
  moved_[at(body)] = 1;
}

void StepWorld::flag(int body, bool flagged) { by_hand_.at(at(body)) = flagged; }

void StepWorld::accept() {
  for (std::size_t i = 0; i < end_.size(); ++i) scene_.bodies[i].pose = end_[i];
}

Motion StepWorld::motion_of(int body) const { return scene_.bodies[at(body)].motion.value_or(Motion{}); }

void StepWorld::place_at_end() {
  updates_.clear();
  for (std::size_t i = 0; i < end_.size(); ++i) {
    const Body& b = scene_.bodies[i];
    const bool going = b.motion && moves(*b.motion);
    if (!going && !moved_[i]) continue;
    moved_[i] = 0;
    end_[i] = going ? pose_at(b.pose, *b.motion, 1) : b.pose;
    const PlannedShape& shape = planned_shape(static_cast<int>(i));
    bodies_[i] = planned_body(shape, end_[i]);
    end_box_[i] = planned_box(fidelity_, shape, bodies_[i]);
    updates_.push_back({static_cast<int>(i), end_box_[i]});
  }
  phase_->update(updates_);
}

ContactAnswer StepWorld::contact_of(int a, int b, PairMemory* memory) const {
  return planned_contact(fidelity_, planned_shape(a), bodies_[at(a)], planned_shape(b), bodies_[at(b)],
                         memory);
}

PlannedNear StepWorld::near_of(int a, int b, PairMemory* memory) const {
  return planned_near(fidelity_, planned_shape(a), bodies_[at(a)], planned_shape(b), bodies_[at(b)], memory);
}

void StepWorld::find_contacts(StepReport& r) {
  phase_->pairs(pairs_);
  std::vector<std::pair<broad::IdPair, PairMemory>> memory;
  auto last = memory_.begin();
  for (const broad::IdPair& pair : pairs_) {
    const auto [a, b] = pair;
    if (!is_reported(scene_, a, b)) continue;
    ++r.candidates;
    PairMemory* remembered = nullptr;
    if (fidelity_.remember) {
      while (last != memory_.end() && last->first < pair) ++last;
      memory.emplace_back(pair, last != memory_.end() && last->first == pair ? last->second : PairMemory{});
      remembered = &memory.back().second;
    }
    if (fidelity_.margin > 0 || fidelity_.verdict_only)
      note(a, b, near_of(a, b, remembered), r);
    else
      note(a, b, contact_of(a, b, remembered), r);
  }
  memory_.swap(memory);
}

void StepWorld::choose(const SweepOptions& o, StepReport& r) const {
  for (int i = 0; i < static_cast<int>(end_.size()); ++i) {
    const Body& b = scene_.bodies[at(i)];
    const Motion m = b.motion.value_or(Motion{});
    const InnerExtent& e = extent_[at(i)];
    if (by_hand_[at(i)]) {
      r.swept.push_back({i, SweepReason::by_hand, pass_bound(e, m), e.inner});
    } else if (b.motion && o.which == SweepOptions::Which::all && moves(m)) {
      r.swept.push_back({i, SweepReason::all, pass_bound(e, m), e.inner});
    } else if (b.motion && o.which == SweepOptions::Which::by_criterion && is_flagged(e, m, o.share)) {
      const bool turning = turn_bound(e, m) > m.linear.norm() / 2;
      r.swept.push_back({i, turning ? SweepReason::turning : SweepReason::travel, pass_bound(e, m), e.inner});
    }
  }
}

std::vector<BodyPair> StepWorld::swept_pairs(const StepReport& r) {
  std::vector<char> is_swept(end_.size(), 0);
  for (const SweptBody& s : r.swept) is_swept[at(s.body)] = 1;
  const auto box_of_swept = [&](int i) {
    const Pose& start = scene_.bodies[at(i)].pose;
    if (fidelity_.loose_boxes && is_bounded(kind_of(scene_.shape_of(i))))
      return broad::loose_swept_box(broad::loose_box(scene_.shape_of(i), start, box_size_[at(i)]), start,
                                    motion_of(i), extent_[at(i)].reach);
    return broad::swept_box(scene_.shape_of(i), scene_.bodies[at(i)].pose, motion_of(i));
  };
  const auto box_of_other = [&](int i) {
    // Impacts use the original shape, which may extend slightly beyond the simpler one.
    Aabb end = end_box_[at(i)];
    if (planned_shape(i).simpler) {
      const double out = planned_shape(i).error() +
                         pose_slack * (planned_shape(i).reach() + end_[at(i)].translation.lpNorm<1>());
      end.lo.array() -= out;
      end.hi.array() += out;
    }
    return scene_.bodies[at(i)].motion ? widened_by_motion(end, extent_[at(i)], motion_of(i)) : end;
  };
  std::vector<BodyPair> found;
  if (r.swept.size() <= few_swept) {
    std::vector<Aabb> boxes;
    for (const SweptBody& s : r.swept) boxes.push_back(box_of_swept(s.body));
    for (std::size_t k = 0; k < boxes.size(); ++k)
      for (std::size_t l = k + 1; l < boxes.size(); ++l)
        if (overlaps(boxes[k], boxes[l])) found.emplace_back(r.swept[k].body, r.swept[l].body);
    for (int i = 0; i < static_cast<int>(end_.size()); ++i) {
      if (is_swept[at(i)]) continue;
      const Aabb other = box_of_other(i);
      for (std::size_t k = 0; k < boxes.size(); ++k)
        if (overlaps(boxes[k], other)) found.push_back(std::minmax(r.swept[k].body, i));
    }
  } else {
    const auto phase = broad::make_broad_phase("automatic");
    for (int i = 0; i < static_cast<int>(end_.size()); ++i)
      phase->insert(i, is_swept[at(i)] ? box_of_swept(i) : box_of_other(i),
                    is_swept[at(i)] ? broad::Mobility::moving : broad::Mobility::fixed);
    phase->pairs(pairs_);
    for (const auto& [a, b] : pairs_) found.emplace_back(a, b);
  }
  std::sort(found.begin(), found.end());
  return found;
}

void StepWorld::find_impact(const BodyPair& pair, const SweepOptions& o, StepReport& r) const {
  const auto [a, b] = pair;
  const bool unconditional = by_hand_[at(a)] || by_hand_[at(b)] || o.which == SweepOptions::Which::all;
  if (!unconditional && !needs_sweep(extent_[at(a)], motion_of(a), extent_[at(b)], motion_of(b), o.share)) {
    ++r.spared;
    return;
  }
  ++r.asked;
  // Impacts are those of the original shapes.
  const auto moving = [&](int i) {
    const PlannedShape& s = planned_shape(i);
    const Pose& pose = scene_.bodies[at(i)].pose;
    return s.simpler ? MovingShape(&scene_.shape_of(i), pose, motion_of(i))
                     : s.collider.at(pose, motion_of(i));
  };
  const ImpactAnswer x = time_of_impact(moving(a), moving(b));
  if (x.outcome == Outcome::unsupported) {
    ++r.unsupported;
    return;
  }
  if (x.outcome != Outcome::answered) r.outcome = x.outcome;
  if (x.toi || x.outcome != Outcome::answered) r.impacts.push_back({a, b, x});
}

void StepWorld::find_impacts(const SweepOptions& o, StepReport& r) {
  choose(o, r);
  if (r.swept.empty()) return;
  for (const BodyPair& p : swept_pairs(r)) {
    if (!is_reported(scene_, p.first, p.second)) continue;
    ++r.swept_candidates;
    find_impact(p, o, r);
  }
  const auto time = [](const PairImpact& x) { return x.impact.toi.value_or(x.impact.clear_until); };
  std::stable_sort(r.impacts.begin(), r.impacts.end(),
                   [&](const PairImpact& x, const PairImpact& y) { return time(x) < time(y); });
}

StepReport StepWorld::step(const SweepOptions& options) {
  StepReport r;
  place_at_end();
  find_contacts(r);
  find_impacts(options, r);
  return r;
}

}  // namespace touchstone
