#include "fuzz/judge/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/math/roundoff.h"
#include "fuzz/judge/check.h"
#include "fuzz/judge/truth.h"
#include "scenarios/value/invalid_numbers.h"

namespace touchstone::fuzz {
namespace {

// A tolerance that is not a length is a fault.
void check_claim(const CheckInput& in, CheckOutput& out) {
  const double c = in.answer.claimed_tolerance;
  if (!std::isfinite(c) || c < 0)
    out.fault_always(Fault::no_number, 0, in.query, fmt::format("claims a tolerance of {}", c));
  if (is_pair_question(in.query.question)) out.note_claim(in, in.truth.scale(in.query.a, in.query.b));
}

CheckOutput run_checks(const CheckInput& in) {
  CheckOutput out;
  check_claim(in, out);
  for (const CheckRow& row : checks)
    if (row.question == in.query.question) row.check(in, out);
  std::stable_sort(out.faults.begin(), out.faults.end(),
                   [](const FaultReport& x, const FaultReport& y) { return x.error_in_l > y.error_in_l; });
  return out;
}

// A missed candidate is judged without tolerance, and the received poses of a script are unknown; an overlap
// thinner than the engine's own rounding of the scene is then blamed on that rounding.
Blame blame_of(const Judgement& j, const CheckInput& in) {
  if (j.faults.empty()) return Blame::none;
  if (is_broad_question(in.query.question)) {
    const FaultReport& worst = j.faults.front();
    if (worst.fault != Fault::missed) return Blame::algorithm;
    return worst.error > in.tau(worst.a, worst.b, in.truth.scale(worst.a, worst.b)) ||
                   pair_roundoff(in.card, in.truth.scene(), worst.a, worst.b) <= double_roundoff
               ? Blame::algorithm
               : Blame::representation;
  }
  return j.received_faults.empty() ? Blame::representation : Blame::algorithm;
}

// The second judgement, against the scene received. Bodies that are D apart change every error by at most 2D,
// so only an answer within that distance of the limit is judged again.
std::vector<FaultReport> faults_received(const CheckInput& asked, int frame, double excess,
                                         const std::vector<FaultReport>& faults) {
  const double change = 2 * asked.truth.displacement(frame);
  if (frame == 0 || (excess > 0 && excess > change)) return faults;
  if (excess + change <= 0) return {};
  return run_checks({asked.truth, frame, asked.query, asked.answer, asked.card}).faults;
}

// Throwing on invalid bodies is a legitimate refusal.
bool is_refusal(const CheckInput& asked) {
  return (asked.answer.outcome == Outcome::threw || asked.answer.outcome == Outcome::invalid_input) &&
         asked.query.question == Question::candidates && !invalid_numbers(asked.truth.scene()).empty();
}

// A form of a case, a shrunk one for instance, may have lost what makes two bodies a ray and its target.
bool asks_something(const CheckInput& asked) {
  return asked.query.question != Question::ray || is_ray(asked.truth.scene(), asked.query);
}

// received_frame: empty when the engine did not hold the bodies in question. No answer can then be right for
// what it received, and any fault is due to the representation.
Judgement judge_one(const CheckInput& asked, std::optional<int> received_frame) {
  Judgement j;
  j.outcome = asked.answer.outcome;
  if (!asks_something(asked)) j.outcome = Outcome::unsupported;
  if (was_not_attempted(j.outcome) || is_refusal(asked)) return j;
  if (j.outcome != Outcome::answered) {
    FaultReport f;
    f.a = asked.query.a;
    f.b = asked.query.b;
    f.words =
        std::string(to_string(j.outcome)) + (asked.answer.detail.empty() ? "" : ": " + asked.answer.detail);
    j.faults.push_back(f);
    if (received_frame) j.received_faults.push_back(std::move(f));
    j.blame = received_frame ? Blame::algorithm : Blame::representation;
    return j;
  }
  CheckOutput out = run_checks(asked);
  j.undecided = out.undecided;
  j.unjudged = std::move(out.unjudged);
  j.wide_claim = out.wide_claim;
  j.wide_claim_in_l = out.wide_claim_in_l;
  j.faults = std::move(out.faults);
  j.worst_in_l = out.worst_in_l;
  j.pairs_true = out.pairs_true;
  j.pairs_reported = out.pairs_reported;
  j.pairs_duplicate = out.pairs_duplicate;
  j.manifold_coverage = out.manifold_coverage;
  j.manifold_centred = out.manifold_centred;
  j.bound_slack_in_l = out.bound_slack_in_l;
  if (!received_frame) {
    j.blame = j.faults.empty() ? Blame::none : Blame::representation;
    return j;
  }
  j.received_faults = faults_received(asked, *received_frame, out.excess, j.faults);
  j.blame = blame_of(j, asked);
  return j;
}

}  // namespace

void CheckOutput::not_judged(std::string claim, bool by_definition) {
  const auto same = [&](const Unjudged& u) { return u.claim == claim; };
  if (std::none_of(unjudged.begin(), unjudged.end(), same))
    unjudged.push_back({std::move(claim), by_definition});
}

void CheckOutput::note_claim(const CheckInput& in, double l) {
  const Question q = in.query.question;
  const bool has_offset = q == Question::overlap || q == Question::contact;
  const double of_settings = q == Question::time_of_impact || q == Question::ray ? sweep_skin(in.card)
                             : has_offset                                        ? contact_offset(in.card)
                                                                                 : 0;
  const double claim =
      in.card.source == claimed_by_user ? 0 : std::max(of_settings, believed_claim(in.card, in.answer));
  if (!(claim > fuzz::wide_claim * l) || claim / l <= wide_claim_in_l) return;
  wide_claim = claim;
  wide_claim_in_l = claim / l;
  if (claim >= l) not_judged("anything: the engine claims a tolerance as large as the bodies", false);
}

std::vector<Judgement> judge(const Case& c, const EngineCard& card, const CaseObservations& observations,
                             Truth& truth) {
  std::vector<Judgement> result;
  const int received = truth.frame_of(observations.received);
  const bool all_held = is_held(c.scene, observations.received, {Question::scene_contacts});
  for (std::size_t i = 0; i < c.queries.size(); ++i) {
    static const Observation missing = no_answer(Outcome::crashed, "the engine gave no answer");
    const Observation& answer = i < observations.answers.size() ? observations.answers[i] : missing;
    const bool held = all_held || is_held(c.scene, observations.received, c.queries[i]);
    result.push_back(
        judge_one({truth, 0, c.queries[i], answer, card}, held ? std::optional(received) : std::nullopt));
    result.back().holds_other_shape = held && result.back().blame == Blame::representation &&
                                      holds_other_shape(c.scene, observations.received);
  }
  return result;
}

}  // namespace touchstone::fuzz
