// A case: a scene and its queries, as plain values.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.h"

namespace touchstone {

/// The numbers are those of ts_question.
enum class Question : std::uint8_t {
  overlap,
  distance,
  contact,
  time_of_impact,
  candidates,       // at the bodies' poses: motions are ignored
  scene_contacts,   // likewise
  swept_candidates  // pairs that overlap at some time of the step, from the bodies' own poses; no script
};
inline constexpr auto question_names = std::to_array<std::string_view>(
    {"overlap", "distance", "contact", "time_of_impact", "candidates", "scene_contacts", "swept_candidates"});
static_assert(question_names.size() == static_cast<std::size_t>(Question::swept_candidates) + 1);
constexpr std::string_view to_string(Question q) { return question_names[static_cast<std::size_t>(q)]; }
constexpr std::optional<Question> question_from_string(std::string_view s) {
  for (std::size_t i = 0; i < question_names.size(); ++i)
    if (question_names[i] == s) return static_cast<Question>(i);
  return std::nullopt;
}
constexpr bool is_pair_question(Question q) { return q <= Question::time_of_impact; }
constexpr bool is_broad_question(Question q) {
  return q == Question::candidates || q == Question::swept_candidates;
}

struct Query {
  Question question = Question::overlap;
  int a = 0, b = 1;  // bodies; not used by candidates, scene_contacts and swept_candidates
  bool operator==(const Query&) const = default;
};

/// A scene and its queries.
struct Case {
  std::string id;      // "family/index" or a file's name; for display
  std::string family;  // generator or scenario it came from
  Scene scene;
  std::vector<Query> queries;
  bool operator==(const Case&) const = default;
};

/// Cases that ask for swept candidates have no other queries.
inline bool has_swept_candidates_query(const Case& c) {
  return !c.queries.empty() && c.queries[0].question == Question::swept_candidates;
}

// The size of a case.

/// Compared in this order.
struct CaseSize {
  std::size_t bodies = 0;
  std::size_t steps = 0;   // of the script; 0 for the default (insert all, query)
  std::uint64_t bits = 0;  // bits to write down the rest: significant bits and exponents of all numbers, one
                           // for each vertex, triangle, shape, query, motion, flag and name
  auto operator<=>(const CaseSize&) const = default;
};

}  // namespace touchstone
