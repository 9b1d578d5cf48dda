// What is true of one pair of bodies, with certificates that the checker has accepted.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "oracles/referee/referee.h"
#include "oracles/referee/region/gradient_set.h"
#include "scenarios/value/certificate.h"

namespace touchstone::fuzz {

/// A certificate with what it proves. The kind is `none` when the referee has none that the checker accepts.
struct GapProof {
  Certificate verdict;
  Certificate at_least;  // depth_direction: gap >= -offset
  Certificate at_most;   // inner_polytope: gap <= -offset
  /// What the two prove, in the scene's unit; infinite without a certificate. Contains the truth like
  /// PairTruth::gap, and is wider by the rounding of the points to doubles.
  referee::Bracket gap;
  /// The points of at_most lie inside the bodies by the radii of the balls that round them.
  bool rounded = false;
};

/// Is the gap at most the margin? overlap: yes; disjoint: no (referee::judge_within).
struct WithinAnswer {
  double margin = 0;
  referee::Verdict verdict = referee::Verdict::undecided;
  /// The bounds of the gap that are certified show it. Otherwise it rests on the referee alone: the gap is
  /// the margin, or differs from it by no more than the rounding of the certificates.
  bool certified = false;
};

struct PairAnswer {
  referee::PairTruth truth;
  std::optional<WithinAnswer> within;  // if asked for
  /// Present if asked for and known: every normal when several are about equally good.
  std::optional<referee::NearMinimalNormals> normals;
  /// The gradients of the signed distance by the pose of B, if asked for and a normal is known; not
  /// certified.
  std::optional<referee::GradientSet> gradients;
  /// Present if asked for.
  std::optional<GapProof> proof;
  /// The checker accepted a certificate of the verdict and of both ends of the gap. For an overlapping mesh,
  /// whose depth is not defined, that of the verdict is all there is to prove.
  bool certified = false;
  std::string not_certified;  // why not; empty when certified or not asked
};

struct ImpactAnswer {
  referee::TimeTruth truth;
  std::optional<ImpactCertificate> certificate;  // if asked for
  /// The checker accepted that there is no contact before t_lo (less a few ulps) and, for a hit, that there
  /// is one at t_hi (plus as little).
  bool certified = false;
  std::string not_certified;
};

struct AnswerOptions {
  std::optional<double> margin = std::nullopt;  // whether the gap is at most this
  bool certificates = true;  // exact arithmetic: about a hundred times slower than the answer
  /// The set of normals of least depth. Only for spheres, boxes, capsules, hulls and rounded boxes, whose set
  /// is known to be complete; that of others is an estimate that takes seconds.
  bool normals = true;
  bool gradients =
      true;  // the set of gradients; for bodies that overlap, complete only where the normals are
};

/// Never throws for valid shapes; what cannot be decided is undecided.
PairAnswer answer_pair(const Placed& a, const Placed& b, const AnswerOptions& options = {});
ImpactAnswer answer_motion(const Placed& a, const Motion& motion_a, const Placed& b, const Motion& motion_b,
                           const AnswerOptions& options = {});

/// Infinite ends of brackets are null. Certificates are as `touchstone check` reads them.
nlohmann::ordered_json to_json(const PairAnswer& answer);
nlohmann::ordered_json to_json(const ImpactAnswer& answer);

}  // namespace touchstone::fuzz
