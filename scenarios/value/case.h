// A case: a scene and its queries, as plain values.
#pragma once

#include <algorithm>
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
  candidates,         // at the bodies' poses: motions are ignored
  scene_contacts,     // likewise
  swept_candidates,   // pairs that overlap at some time of the step, from the bodies' own poses; no script
  within,             // is the signed distance at most the scene's margin?
  bounded_distance,   // the signed distance, or a lower bound of it that is at least the scene's margin
  candidates_within,  // as candidates: pairs whose signed distance is at most the scene's margin, >= 0
  ray,                // b, a sphere of radius 0, moves in a straight line: where it meets a at rest
  contact_within      // as contact, of bodies whose signed distance is at most the scene's margin
};
inline constexpr auto question_names = std::to_array<std::string_view>(
    {"overlap", "distance", "contact", "time_of_impact", "candidates", "scene_contacts", "swept_candidates",
     "within", "bounded_distance", "candidates_within", "ray", "contact_within"});
static_assert(question_names.size() == static_cast<std::size_t>(Question::contact_within) + 1);
constexpr std::string_view to_string(Question q) { return question_names[static_cast<std::size_t>(q)]; }
constexpr std::optional<Question> question_from_string(std::string_view s) {
  for (std::size_t i = 0; i < question_names.size(); ++i)
    if (question_names[i] == s) return static_cast<Question>(i);
  return std::nullopt;
}
constexpr bool is_pair_question(Question q) {
  return q <= Question::time_of_impact || q == Question::within || q == Question::bounded_distance ||
         q == Question::ray || q == Question::contact_within;
}
/// Questions about the normal, the depth and the points of a pair.
constexpr bool is_contact_question(Question q) {
  return q == Question::contact || q == Question::contact_within;
}
constexpr bool is_broad_question(Question q) {
  return q == Question::candidates || q == Question::swept_candidates || q == Question::candidates_within;
}
/// Questions about the bodies' motions over the step; all others are about bodies at rest.
constexpr bool is_motion_question(Question q) {
  return q == Question::time_of_impact || q == Question::swept_candidates || q == Question::ray;
}
/// Questions that run the scene's script.
constexpr bool is_script_question(Question q) {
  return q == Question::candidates || q == Question::candidates_within;
}
/// Questions that refer to the scene's margin.
constexpr bool is_margin_question(Question q) {
  return q == Question::within || q == Question::bounded_distance || q == Question::candidates_within ||
         q == Question::contact_within;
}

struct Query {
  Question question = Question::overlap;
  int a = 0, b = 1;  // bodies; used by pair questions only
  bool operator==(const Query&) const = default;
};

/// Whether the bodies of a `ray` query are a target at rest and a point on a straight way.
inline bool is_ray(const Scene& s, const Query& q) {
  const auto body = [&](int i) -> const Body& { return s.bodies[static_cast<std::size_t>(i)]; };
  const auto* point = std::get_if<Sphere>(&s.shape_of(q.b));
  const auto& target = body(q.a).motion;
  const auto& way = body(q.b).motion;
  return point && point->radius == 0 && way && way->angular.isZero(0) && (!target || *target == Motion{});
}

/// A scene and its queries.
struct Case {
  std::string id;      // "family/index" or a file's name; for display
  std::string family;  // generator or scenario it came from
  Scene scene;
  std::vector<Query> queries;
  bool operator==(const Case&) const = default;
};

/// Whether the scene has what each query asks about: a ray for a `ray`, a margin that is not negative for
/// `candidates_within`. Indices of bodies are not looked at.
inline bool has_what_is_asked(const Case& c) {
  return std::all_of(c.queries.begin(), c.queries.end(), [&](const Query& q) {
    if (q.question == Question::ray) return is_ray(c.scene, q);
    return q.question != Question::candidates_within || c.scene.margin >= 0;
  });
}

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
