// How engines behave as one degeneracy increases, rung by rung: the results of `touchstone stability`.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reports/record/observation_json.h"

namespace touchstone::fuzz {

/// Forms of a pair: B moved by one ulp in each coordinate, A and B exchanged, the scene in another rigid
/// frame, the scene in another unit of length (a power of two).
inline constexpr std::size_t form_count = 4;
inline constexpr std::array<const char*, form_count> form_columns{"jitter", "order", "frame", "unit"};

struct Rung {
  double value = 0;
  std::uint64_t asked = 0, answers = 0, failed = 0, missed = 0, ghost = 0, wrong = 0;
  std::uint64_t open = 0;  // undecided or not judged
  /// Largest errors of wrong answers, in L: depths and distances (off, infeasible, excess), normals (not
  /// minimal, not unit), times of impact (late, early).
  double depth_error = 0, normal_error = 0, impact_error = 0;
  /// For the other forms of the same pairs, in the order of `form_columns`: the largest change of distance or
  /// depth in L (for impacts, of the time), and the number of cases in which the two answers contradict each
  /// other. (For jitter, differing answers are never a contradiction.)
  std::array<double, form_count> spread{};
  std::array<std::uint64_t, form_count> broken{};
};

struct LadderResult {
  std::string ladder, engine, question;
  std::vector<Rung> rungs;
  /// Value of the first rung with a wrong or failed answer.
  std::optional<double> fails_at() const;
  /// Value of the first rung with an answer that this form of its pair contradicts.
  std::optional<double> breaks_at(std::size_t form) const;
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
