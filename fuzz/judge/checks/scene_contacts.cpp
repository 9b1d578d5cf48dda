// Whole-scene contacts: broad and narrow phase together. Each reported contact is judged as a contact, and
// each pair that overlaps by more than τ must be reported.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "fuzz/judge/check.h"

namespace touchstone::fuzz {
namespace {

void check_stated(const CheckInput& in, CheckOutput& out, const SceneContact& c, std::set<BodyPair>& stated) {
  const int n = static_cast<int>(in.truth.scene().bodies.size());
  if (c.a < 0 || c.b < 0 || c.a >= n || c.b >= n || c.a == c.b) {
    out.fault_always(Fault::stale, 0, {in.query.question, c.a, c.b},
                     fmt::format("contact names bodies {} and {}", c.a, c.b));
    return;
  }
  const auto [a, b] = std::minmax(c.a, c.b);
  stated.insert({a, b});
  const StatedContact contact{a, b, c.a > c.b ? Vec3(-c.normal) : c.normal, c.depth};
  if (!judge_validity(in, out, contact)) return;
  const referee::PairTruth& truth = in.truth.pair(in.frame, a, b);
  const double l = in.truth.scale(a, b);
  out.note_claim(in, l);
  const double most_gap = in.tau(a, b, l) + in.offset();
  if (truth.verdict == referee::Verdict::undecided) {
    out.undecided = true;
    out.frame_matters();
    return;
  }
  if (truth.verdict == referee::Verdict::disjoint) {
    const double gap = std::max(0.0, truth.gap.lo);
    out.error(gap, l, most_gap);
    out.frame_matters();
    if (gap > most_gap)
      out.fault(Fault::ghost, gap, l, {in.query.question, a, b},
                fmt::format("contact between {} and {}, which are {:.6g} apart", a, b, gap),
                truth.verdict_certificate);
    if (gap > most_gap) return;
  }
  judge_normal_and_depth(in, out, contact, truth);
}

}  // namespace

void check_scene_contacts(const CheckInput& in, CheckOutput& out) {
  // An engine may report several points of one pair; the deepest is judged as the contact.
  std::map<BodyPair, SceneContact> deepest;
  for (const SceneContact& c : in.answer.contacts) {
    const BodyPair key = std::minmax(c.a, c.b);
    const auto [it, first] = deepest.try_emplace(key, c);
    if (first) continue;
    judge_validity(in, out, {key.first, key.second, c.normal, c.depth});
    if (!(c.depth <= it->second.depth)) it->second = c;
  }
  std::set<BodyPair> stated;
  for (const auto& [pair, c] : deepest) check_stated(in, out, c, stated);
  const auto& due = in.truth.scene_pairs(in.frame);
  out.undecided |= in.truth.undecided_pairs() > 0;
  for (const Truth::TruePair& p : due) {
    if (stated.count(p.bodies)) continue;
    const auto [a, b] = p.bodies;
    const double l = in.truth.scale(a, b), depth = certain_depth(in, a, b, p.truth);
    const double tau = in.tau(a, b, l);
    out.error(depth, l, tau);
    if (depth > tau)
      out.fault(Fault::missed, depth, l, {in.query.question, a, b},
                fmt::format("no contact between {} and {}, which overlap by {:.6g}", a, b, depth),
                p.truth.verdict_certificate);
  }
}

}  // namespace touchstone::fuzz
