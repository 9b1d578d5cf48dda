// One case in full: what the referee knows about each query, and every engine's answers and judgements.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "reports/record/observation_json.h"
#include "scenarios/value/certificate.h"
#include "scenarios/value/judgement.h"

namespace touchstone::fuzz {

/// The referee's answer to one query. Which fields are set depends on the question.
struct RefereeAnswer {
  /// Pairs at rest: "disjoint", "overlap" or "undecided"; time of impact: "impact", "no impact" or
  /// "undecided".
  std::string verdict;
  std::string note;  // for people: why it is undecided, or what the time is known from

  // Pairs at rest (overlap, distance, contact, within, bounded_distance).
  std::array<double, 2> gap{};  // the signed gap is within [gap[0], gap[1]], which may be infinite
  Vec3 normal = Vec3::Zero();   // world, unit within rounding, from A to B
  std::array<Vec3, 2> witness{Vec3::Zero(), Vec3::Zero()};  // world; points of A and B that realise the gap
  Certificate verdict_certificate, depth_certificate;
  std::string within;  // of the question `within`: "within", "beyond" or "undecided"
  int level = 0;       // 0 doubles with error bounds, 1 extended precision, 2 exact

  // Time of impact and ray: the first contact is at a t within [time[0], time[1]], a part of the step.
  std::array<double, 2> time{};

  /// Pairs that truly overlap or, for candidates_within, are within the margin: for candidates, at each query
  /// of the script; for scene contacts and swept candidates, one list.
  std::vector<std::vector<BodyPair>> pairs;
  std::uint64_t undecided_pairs = 0;  // swept candidates, candidates_within

  Json certificate;  // of the verdict, in the exact form that `touchstone check` accepts; null: there is none
};

struct JudgedCase {
  struct OfEngine {
    std::string engine;
    std::vector<Observation> answers;   // one a query
    std::vector<Judgement> judgements;  // likewise
  };
  Case c;
  std::vector<RefereeAnswer> referee;  // one a query
  bool exact = false;                  // RefereeAnswer::certificate was asked for
  std::vector<OfEngine> engines;
};
Json to_json(const JudgedCase& j);

}  // namespace touchstone::fuzz
