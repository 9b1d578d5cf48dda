#include "fuzz/causes/name.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "fuzz/causes/group.h"
#include "fuzz/causes/intervention.h"

namespace touchstone::fuzz {
namespace {

// The more an intervention says about the cause, the earlier it stands here. What is left out says nothing by
// itself: a contact vanishes when the bodies are moved apart.
constexpr auto telling = std::to_array<std::string_view>({fresh_process,
                                                          other_memory,
                                                          "other_settings",
                                                          "tighter",
                                                          "looser",
                                                          "more_iterations",
                                                          "other_precision",
                                                          "normalize_rotations",
                                                          "box_as_hull",
                                                          "sphere_as_ellipsoid",
                                                          "sphere_as_capsule",
                                                          "cylinder_as_hull",
                                                          "reorder_hull",
                                                          "scale_up",
                                                          "scale_down",
                                                          "turn_by_1e_9",
                                                          "turn_by_1e_6",
                                                          "turn_by_1e_3",
                                                          "exchange",
                                                          "insert_in_reverse",
                                                          "insert_final_poses",
                                                          "release_static",
                                                          "leave_groups",
                                                          "move_to_origin",
                                                          "move_away",
                                                          "turn_world",
                                                          "round_to_float",
                                                          "stop_turning",
                                                          "move_b_only",
                                                          "set_upright",
                                                          "halve_depth",
                                                          "other_solver",
                                                          "other_path",
                                                          "grow_a",
                                                          "grow_b",
                                                          "nudge"});

constexpr std::string_view fragile_reason = "fragile", steady_reason = "steady";

std::size_t count(const Responses& r, Response what) {
  return static_cast<std::size_t>(
      std::ranges::count_if(r.responses, [&](const Responded& x) { return x.response == what; }));
}

std::string verdict_words(const Subject& s, bool missed) {
  if (s.symptom.question == Question::time_of_impact)
    return missed ? "Impacts are missed" : "Impacts that never happen are reported";
  if (is_broad_question(s.symptom.question))
    return missed ? "Pairs are missing" : "Pairs name bodies that are not there";
  return missed ? "Overlaps are denied" : "Bodies that are apart are said to overlap";
}

// "Crashed at distance-inl.h:177", from the words of a finding.
std::string failure_words(const Subject& s) {
  std::string words = s.failure.empty() ? s.symptom.detail : s.failure;
  // Names of outcomes have words joined by _; names of places may contain it too.
  for (const std::string_view outcome : outcome_names)
    if (words.starts_with(outcome))
      std::replace(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(outcome.size()), '_', ' ');
  if (!words.empty() && words.front() >= 'a' && words.front() <= 'z')
    words.front() = static_cast<char>(words.front() - 'a' + 'A');
  return words;
}

std::string words_of(const Subject& s) {
  switch (s.severity) {
    case Severity::crash:
      return failure_words(s);
    case Severity::hang:
      return fmt::format("Does not answer in time ({})", to_string(s.symptom.question));
    case Severity::missed:
      return verdict_words(s, true);
    case Severity::ghost:
      return verdict_words(s, false);
    case Severity::infeasible:
      if (s.fault == "no_number") return "The number asked for is missing";
      if (s.fault == "normal_not_unit") return "Normals are zero or not of unit length";
      return "Moving by the depth along the normal does not separate";
    case Severity::time:
      return s.fault == "early" ? "Times of impact are early" : "Times of impact are late";
    case Severity::not_minimal:
      return s.fault == "not_minimal" ? "Normals are not those of the least depth" : "Depths are too large";
    case Severity::distance:
      return "Distances are wrong";
    case Severity::witness:
      if (s.symptom.question == Question::distance) return "Closest points are wrong";
      return s.fault == "incomplete" ? "Manifolds leave out a part of the contact"
                                     : "Points of manifolds are wrong";
    case Severity::unstable:
      return fmt::format("The same question is answered differently ({})", to_string(s.symptom.question));
    case Severity::relation:
      return fmt::format("Answers contradict each other ({})", s.symptom.detail);
  }
  return "";
}

std::string_view route_words(std::string_view route) {
  if (route == "convex") return "convex shapes";
  if (route == "mesh") return "meshes";
  if (route == "half-space") return "half-spaces";
  if (route == "sphere") return "spheres";
  if (route == "any" || route == "scene" || route == "pairs") return "";
  return route;
}

// The kinds of shapes if they are few, else the routes.
std::string place_words(const Subject& s) {
  constexpr std::size_t few = 2;
  const bool are_kinds = s.shapes.size() <= few;
  std::string words;
  for (const std::string& name : are_kinds ? s.shapes : s.routes) {
    const std::string_view word = route_words(name);
    if (word.empty()) continue;
    words += words.empty() ? " (" : ", ";
    words += word;
  }
  if (!words.empty()) words += ")";
  return words;
}

}  // namespace

std::string main_reason(const Responses& r, FaultStage stage) {
  if (r.responses.empty()) return "";
  if (is_fragile(r)) return std::string(fragile_reason);
  const auto gone = [&](std::string_view name) {
    return std::ranges::any_of(r.responses, [&](const Responded& x) {
      return x.intervention == name && x.response == Response::gone;
    });
  };
  for (const std::string_view name : telling)
    if (gone(name)) return std::string(name);
  // Whether the bodies overlap matters for distances alone: other faults need it.
  for (const std::string_view name : {"pull_apart", "push_together"})
    if (stage == FaultStage::distance && gone(name)) return std::string(name);
  return std::string(steady_reason);
}

std::string describe_reason(const std::string& reason, const Responses& r,
                            const std::vector<OtherEngine>& others) {
  const std::size_t gone = count(r, Response::gone), stays = count(r, Response::stays);
  if (reason == fragile_reason)
    return fmt::format("a borderline case: vanishes under {} of {} changes", gone, gone + stays);
  if (reason == steady_reason) return fmt::format("whatever is changed: stays under all {} changes", stays);
  return meaning_of(reason, others);
}

std::string describe_fault(const Subject& s) { return words_of(s) + place_words(s); }

}  // namespace touchstone::fuzz
