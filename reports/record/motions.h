// What engines' answers do from frame to frame of smooth motions: the result of `touchstone stability
// --motions`.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "reports/record/observation_json.h"
#include "scenarios/value/flicker.h"

namespace touchstone::fuzz {

/// What is listed, with its evidence, besides the kinds of flicker.
inline constexpr std::string_view wrong_evidence = "wrong", state_evidence = "state",
                                  switch_evidence = "switch";

struct MotionEvidence {
  std::string kind;    // a kind of flicker, or one of the above
  std::string motion;  // id of the motion: name/seed/number
  int frame = 0, frames = 0;
  std::string question;
  int a = 0, b = 1;
  Vec3 before = Vec3::Zero(), after = Vec3::Zero();  // the normals stated, if any
  double amount = 0;
  std::string words;
};

struct MotionResult {
  std::string motion, engine;
  std::uint64_t motions = 0, frames = 0;
  std::uint64_t answers = 0, wrong = 0, failed = 0, open = 0;  // open: undecided or not judged
  std::uint64_t changes = 0;   // answers to one question in two frames in a row
  std::uint64_t switches = 0;  // jumps of the normal that the truth requires
  std::array<std::uint64_t, flicker_count> flickers{};
  std::array<double, flicker_count> worst{};  // largest amount of each kind
  double restless = 0;  // rad: by how much more than the truth the normal turns within one feature, at most
  std::uint64_t state_asked = 0, state_differs = 0;  // answers repeated without the earlier frames
  std::vector<MotionEvidence> evidence;              // the first of each kind
  /// Without `order`, which concerns only those who know a point by its place in the list.
  std::uint64_t flicker_sum() const;
  /// Flickers per thousand changes.
  double score() const;
  void merge(const MotionResult& later);
};

struct Motions {
  struct Row {
    std::string name, line;
  };
  std::uint64_t seed = 0;
  int count = 0, frames = 0;  // motions a row, frames a motion
  std::vector<Row> rows;
  std::vector<MotionResult> results;
};

/// Evidence is kept up to this many of a kind.
inline constexpr std::size_t most_evidence_of_a_kind = 3;
/// Adds it if there is room.
void keep(std::vector<MotionEvidence>& list, MotionEvidence e);

Json to_json(const Motions& m);
std::string to_csv(const Motions& m);

}  // namespace touchstone::fuzz
