// One check: examines one answer in one frame and adds its faults. Pure. To add one: a file in checks/, its
// declaration and its row here.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "fuzz/judge/tau.h"
#include "fuzz/judge/truth.h"
#include "scenarios/value/engine_card.h"
#include "scenarios/value/judgement.h"
#include "scenarios/value/observation.h"

namespace touchstone::fuzz {

struct CheckInput {
  Truth& truth;
  int frame = 0;
  const Query& query;
  const Observation& answer;
  const EngineCard& card;

  /// τ for the pair of bodies a and b, of scale l.
  double tau(int a, int b, double l) const { return tau_of(card, answer, truth.scene(), a, b, l); }
  /// For the pair asked about.
  double tau(double l) const { return tau(query.a, query.b, l); }
  /// How far apart bodies beyond τ may be for an answer to report them: what the engine's settings allow
  /// (tau.h), or the margin that is asked about.
  double offset() const {
    return query.question == Question::contact_within ? std::max(0.0, truth.scene().margin)
                                                      : contact_offset(card);
  }
  double bias(int a, int b) const {
    const Scene& s = truth.scene();
    return depth_bias(card, kind_of(s.shape_of(a)), kind_of(s.shape_of(b)));
  }
  /// A body whose flat faces end in circles.
  bool has_rim(int body) const {
    switch (kind_of(truth.scene().shape_of(body))) {
      case ShapeKind::cylinder:
      case ShapeKind::cone:
      case ShapeKind::padded_cylinder:
      case ShapeKind::padded_cone:
        return true;
      default:
        return false;
    }
  }
  bool is_mesh(int body) const { return touchstone::is_mesh(truth.scene().shape_of(body)); }
  /// A mesh that is not a solid.
  bool is_surface(int body) const { return kind_of(truth.scene().shape_of(body)) == ShapeKind::mesh; }
};

struct CheckOutput {
  std::vector<FaultReport> faults;
  double worst_in_l = 0;
  bool undecided = false;
  std::vector<Unjudged> unjudged;
  double wide_claim = 0, wide_claim_in_l = 0;
  std::optional<double> bound_slack_in_l;  // as Judgement has it
  std::uint64_t pairs_true = 0, pairs_reported = 0, pairs_duplicate = 0;
  std::optional<double> manifold_coverage;
  std::optional<bool> manifold_centred;
  /// Largest error − τ over everything measured: > 0 wrong by that much, < 0 right with that much to spare.
  /// Errors change by at most 2D between frames whose bodies are D apart, so a large |excess| settles both
  /// frames at once. NaN: something was measured only in this frame, and any other frame must be judged for
  /// itself.
  double excess = -std::numeric_limits<double>::infinity();

  void error(double absolute, double l, double tau) {
    if (absolute > 0 && l > 0) worst_in_l = std::max(worst_in_l, absolute / l);
    if (!std::isnan(excess)) excess = std::max(excess, absolute - tau);
  }
  /// A fault whose error was measured with error().
  void fault(Fault f, double absolute, double l, const Query& q, std::string words, Certificate c = {}) {
    faults.push_back(
        {f, absolute, l > 0 ? absolute / l : absolute, q.a, q.b, -1, std::move(words), std::move(c)});
  }
  /// A fault in every frame: the answer itself is malformed.
  void fault_always(Fault f, double absolute, const Query& q, std::string words) {
    excess = std::numeric_limits<double>::infinity();
    fault(f, absolute, 1, q, std::move(words));
  }
  /// Lists each claim once.
  void not_judged(std::string claim, bool by_definition);
  /// Records the engine's own tolerance for a pair of scale l when it is wide; one as wide as the pair leaves
  /// nothing to judge.
  void note_claim(const CheckInput& in, double l);
  void frame_matters() { excess = std::numeric_limits<double>::quiet_NaN(); }
};

void check_overlap(const CheckInput& in, CheckOutput& out);
void check_distance(const CheckInput& in, CheckOutput& out);
void check_witness(const CheckInput& in, CheckOutput& out);
void check_contact(const CheckInput& in, CheckOutput& out);
void check_manifold(const CheckInput& in, CheckOutput& out);
void check_time_of_impact(const CheckInput& in, CheckOutput& out);
void check_candidates(const CheckInput& in, CheckOutput& out);
void check_scene_contacts(const CheckInput& in, CheckOutput& out);
void check_swept_candidates(const CheckInput& in, CheckOutput& out);
void check_within(const CheckInput& in, CheckOutput& out);
void check_bounds(const CheckInput& in, CheckOutput& out);
void check_bounded_distance(const CheckInput& in, CheckOutput& out);
void check_candidates_within(const CheckInput& in, CheckOutput& out);
void check_ray(const CheckInput& in, CheckOutput& out);
void check_contact_within(const CheckInput& in, CheckOutput& out);
void check_gradient(const CheckInput& in, CheckOutput& out);

struct CheckRow {
  Question question;
  void (*check)(const CheckInput&, CheckOutput&);
};
inline constexpr auto checks = std::to_array<CheckRow>({
    {Question::overlap, check_overlap},
    {Question::distance, check_distance},
    {Question::distance, check_witness},
    {Question::distance, check_bounds},
    {Question::distance, check_gradient},
    {Question::contact, check_contact},
    {Question::contact, check_manifold},
    {Question::time_of_impact, check_time_of_impact},
    {Question::candidates, check_candidates},
    {Question::scene_contacts, check_scene_contacts},
    {Question::swept_candidates, check_swept_candidates},
    {Question::within, check_within},
    {Question::bounded_distance, check_bounded_distance},
    {Question::bounded_distance, check_witness},
    {Question::bounded_distance, check_bounds},
    {Question::candidates_within, check_candidates_within},
    {Question::ray, check_ray},
    {Question::contact_within, check_contact_within},
    {Question::contact_within, check_manifold},
});

/// The part of `contact` that scene contacts share: one stated contact of a pair that is not certainly apart
/// by more than τ. Unstated values are empty.
struct StatedContact {
  int a = 0, b = 1;
  std::optional<Vec3> normal;
  std::optional<double> depth;
};
/// Reports an invalid normal or depth, which is wrong whatever the truth is. True when both can be measured.
bool judge_validity(const CheckInput& in, CheckOutput& out, const StatedContact& c);
/// Checks feasibility, regret and excess.
void judge_normal_and_depth(const CheckInput& in, CheckOutput& out, const StatedContact& c,
                            const referee::PairTruth& truth);
/// Checks the stated normal of a convex body and a mesh where the mesh is a plane as far as the body reaches
/// through it. False: it is not, and the normal was not judged.
bool judge_inner_edges(const CheckInput& in, CheckOutput& out, const StatedContact& c);
/// For a pair that overlaps: the depth that is certain. A surface has none as a whole; in its deepest
/// triangle the depth is how far the body must move at least to be apart.
double certain_depth(const CheckInput& in, int a, int b, const referee::PairTruth& truth);

}  // namespace touchstone::fuzz
