// A case of the corpus (corpus/README.md): two bounded convex bodies, the questions about them, what is true,
// and how an answer is judged from the case alone.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.h"
#include "fuzz/answer/pair_answer.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz::corpus {

/// A case before its truth is known.
struct Seed {
  std::string id;         // "part/name", unique in the corpus
  std::string comment;    // one line
  std::string mechanism;  // one of scenarios::mechanisms
  std::string source;     // where it comes from
  Scene scene;            // bodies 0 (A) and 1 (B), bounded and convex
};

/// The signed gap as a closed form: sign * sqrt(square) - less, all rational ("n/d" or "n").
struct ExactGap {
  int sign = 1;
  std::string square, less;
  std::string value;  // the gap itself where it is rational, else empty
};

/// Tolerances for which right times of impact are listed where they are known, as exponents k: 2^-k * L.
inline constexpr std::array listed_exponents{47, 46, 45, 40, 34, 28, 22, 18, 17, 16, 13, 10, 7};
/// τ of an engine that computes in doubles or floats and claims nothing: 64 unit roundoffs times L.
inline constexpr int exponent_of_double = 47, exponent_of_single = 18;

/// The times at which an impact may be reported with tolerance 2^-exponent * L; without a window, none may.
struct RightTimes {
  int exponent = 0;
  std::optional<std::array<double, 2>> window;
};

struct MotionFacts {
  ImpactAnswer answer;
  double deepest = 0;  // a depth that is certain at some time of the step; 0: none
  std::vector<RightTimes> right_times;
};

/// Bodies at rest have `pair`, moving ones `motion`.
struct CorpusCase {
  Seed seed;
  double scale = 0;  // L of docs/truth.md §2
  std::vector<std::string> degeneracy;
  std::string size;
  std::optional<PairAnswer> pair;
  std::optional<ExactGap> exact;
  std::optional<MotionFacts> motion;
};

/// overlap, distance and contact of bodies at rest; time of impact of moving ones.
std::vector<Question> questions_about(const Scene& s);
/// With these questions.
Case as_case(const std::string& id, Scene scene);

/// One file of the corpus.
struct Part {
  std::string name;  // of its file, without .json; ids begin with it
  std::vector<Seed> seeds;
};

/// Reported failures and causes, from `directory`/*.json; ladders, handmade scenarios and the lattice, from
/// this program. Sorted by name. Throws InputError.
std::vector<Part> all_parts(const std::filesystem::path& directory);

}  // namespace touchstone::fuzz::corpus
