// How engines behave as one degeneracy is turned up, rung by rung: what `touchstone stability` found.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/record/observation_json.h"

namespace touchstone::fuzz {

struct Rung {
  double value = 0;
  std::uint64_t asked = 0, answers = 0, failed = 0, missed = 0, ghost = 0, wrong = 0;
  /// Largest errors in L of wrong answers: of depths and distances (off, infeasible, excess), of normals (not
  /// minimal, not unit), of times of impact (late, early).
  double depth_error = 0, normal_error = 0, impact_error = 0;
  /// Largest change in L of distance or depth (impact: of the time) when B moves by one unit in the last
  /// place of each coordinate, and when A and B are exchanged.
  double jitter = 0, order = 0;
};

struct LadderResult {
  std::string ladder, engine, question;
  std::vector<Rung> rungs;
  /// Value of the first rung with a wrong answer or none at all.
  std::optional<double> fails_at() const;
};

struct Stability {
  struct Ladder {
    std::string name, line, unit;
  };
  std::string scope;
  std::uint64_t seed = 0;
  int per_rung = 0;
  std::vector<Ladder> ladders;
  std::vector<LadderResult> results;
};

Json to_json(const Stability& s);
std::string to_csv(const Stability& s);

}  // namespace touchstone::fuzz
