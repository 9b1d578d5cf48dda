// How engines behave as one degeneracy is turned up, rung by rung: what `touchstone stability` found.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reports/record/observation_json.h"

namespace touchstone::fuzz {

/// B moved by one unit in the last place of each coordinate, A and B exchanged, the scene in another rigid
/// frame, the scene in another unit of length (a power of two).
inline constexpr std::size_t form_count = 4;
inline constexpr std::array<const char*, form_count> form_columns{"jitter", "order", "frame", "unit"};

struct Rung {
  double value = 0;
  std::uint64_t asked = 0, answers = 0, failed = 0, missed = 0, ghost = 0, wrong = 0;
  std::uint64_t open = 0;  // undecided or not judged
  /// Largest errors in L of wrong answers: of depths and distances (off, infeasible, excess), of normals (not
  /// minimal, not unit), of times of impact (late, early).
  double depth_error = 0, normal_error = 0, impact_error = 0;
  /// By other forms of the same pairs, as `form_columns`: the largest change of distance or depth in L
  /// (impact: of the time), and in how many cases the two answers contradict each other. (No answers
  /// contradict each other for an ulp.)
  std::array<double, form_count> spread{};
  std::array<std::uint64_t, form_count> broken{};
};

struct LadderResult {
  std::string ladder, engine, question;
  std::vector<Rung> rungs;
  /// Value of the first rung with a wrong answer or none at all.
  std::optional<double> fails_at() const;
  /// Value of the first rung with an answer that another form of its pair contradicts.
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
