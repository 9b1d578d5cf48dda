#include "fuzz/causes/name.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fuzz/causes/group.h"
#include "fuzz/causes/intervention.h"

namespace touchstone::fuzz {
namespace {

constexpr std::string_view fragile_reason = "fragile", steady_reason = "steady";

std::size_t count(const Responses& r, Response what) {
  return static_cast<std::size_t>(
      std::ranges::count_if(r.responses, [&](const Responded& x) { return x.response == what; }));
}

std::string verdict_words(const NamedFault& s, bool missed) {
  if (s.symptom.question == Question::ray)
    return missed ? "Rays miss what they hit" : "Rays hit what they miss";
  if (s.symptom.question == Question::contact_within)
    return missed ? "Contacts within a margin are missing" : "Contacts beyond a margin are reported";
  if (s.symptom.question == Question::within)
    return missed ? "Bodies within a margin are denied" : "Bodies beyond a margin are said to be within it";
  if (s.symptom.question == Question::time_of_impact)
    return missed ? "Impacts are missed" : "Impacts that never happen are reported";
  if (is_broad_question(s.symptom.question))
    return missed ? "Pairs are missing" : "Pairs name bodies that are not there";
  if (s.is_of_one_question && s.symptom.question == Question::distance)
    return missed ? "Distances deny overlaps" : "Distances claim overlaps that do not exist";
  if (s.is_of_one_question && s.symptom.question == Question::contact)
    return missed ? "Contacts are missing" : "Contacts are reported where there are none";
  return missed ? "Overlaps are denied" : "Bodies that are apart are said to overlap";
}

// "Crashed at distance-inl.h:177", from the words of a finding.
std::string failure_words(const NamedFault& s) {
  std::string words = s.failure.empty() ? s.symptom.detail : s.failure;
  // Names of outcomes have words joined by _; names of places may contain it too.
  for (const std::string_view outcome : outcome_names)
    if (words.starts_with(outcome))
      std::replace(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(outcome.size()), '_', ' ');
  if (!words.empty() && words.front() >= 'a' && words.front() <= 'z')
    words.front() = static_cast<char>(words.front() - 'a' + 'A');
  return words;
}

// "time of impact"
std::string question_words(Question q) {
  std::string words(to_string(q));
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

// "relation scale"
std::string relation_words(std::string fault) {
  std::replace(fault.begin(), fault.end(), '_', ' ');
  return fault;
}

std::string words_of(const NamedFault& s) {
  switch (s.severity) {
    case Severity::crash:
    case Severity::declined:
      return failure_words(s);
    case Severity::hang:
      return fmt::format("Questions about {} are not answered in time", question_words(s.symptom.question));
    case Severity::missed:
      return verdict_words(s, true);
    case Severity::ghost:
      return verdict_words(s, false);
    case Severity::infeasible:
      if (s.fault == "no_number") return "The number asked for is missing";
      if (s.fault == "normal_not_unit") return "Normals are zero or not of unit length";
      return "Depth and normal do not separate";
    case Severity::time:
      return s.fault == "early" ? "Times of impact are early" : "Times of impact are late";
    case Severity::not_minimal:
      if (s.fault == "inner_edge") return "Normals on flat parts of meshes are those of inner edges";
      return s.fault == "not_minimal" ? "Normals are not those of the least depth" : "Depths are too large";
    case Severity::distance:
      return s.fault == "bound_off" ? "Bounds of distances are none" : "Distances are wrong";
    case Severity::witness:
      if (s.fault == "gradient_off") return "Gradients of distances are wrong";
      if (s.symptom.question == Question::distance) return "Closest points are wrong";
      return s.fault == "incomplete" ? "Manifolds leave out a part of the contact"
                                     : "Points of manifolds are wrong";
    case Severity::unstable:
      return fmt::format("The same question about {} is answered differently",
                         question_words(s.symptom.question));
    case Severity::relation:
      return fmt::format("Answers contradict each other ({})", relation_words(s.fault));
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
std::string place_words(const NamedFault& s) {
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

std::string main_reason(const Responses& r, FaultStage stage, const std::vector<OtherEngine>& others) {
  if (r.responses.empty()) return "";
  if (is_fragile(r)) return std::string(fragile_reason);
  const Responded* best = nullptr;
  int most = 0;
  for (const Responded& x : r.responses) {
    if (x.response != Response::gone) continue;
    // Whether the bodies overlap matters for distances alone: other faults need it.
    const bool is_about_side = x.intervention == "pull_apart" || x.intervention == "push_together";
    const int telling =
        is_about_side && stage == FaultStage::distance ? 1 : meaning_of(x.intervention, others).telling;
    if (telling <= most) continue;
    most = telling;
    best = &x;
  }
  return best ? best->intervention : std::string(steady_reason);
}

std::string describe_reason(const std::string& reason, const Responses& r,
                            const std::vector<OtherEngine>& others) {
  const std::size_t gone = count(r, Response::gone), stays = count(r, Response::stays);
  if (reason == fragile_reason)
    return fmt::format("a borderline case: vanishes under {} of {} changes", gone, gone + stays);
  if (reason == steady_reason)
    return gone == 0 ? fmt::format("stays under all {} changes", stays)
                     : fmt::format("stays under {} of {} changes", stays, gone + stays);
  return meaning_of(reason, others).if_gone;
}

std::string describe_law(std::span<const ErrorLaw> laws) {
  constexpr double visible_share = 1.0 / 128;  // in three digits of a factor
  if (laws.size() != 1) return "";
  const double factor = laws[0].factor;
  switch (laws[0].reference) {
    case Reference::truth:
      if (std::abs(factor) < visible_share)
        return fmt::format("off by {:.2g} of the true value", std::abs(factor));
      if (std::abs(1 + factor) < visible_share) return "about 0 instead of the true value";
      return fmt::format("{:.3g} times the true value", 1 + factor);
    case Reference::one:
      return fmt::format("off by {:.2g} at any scale", std::abs(factor));
    case Reference::scale:
      return fmt::format("off by {:.2g} of the scale of the scene", std::abs(factor));
    case Reference::smaller:
      return fmt::format("off by {:.2g} of the smaller body", std::abs(factor));
    case Reference::larger:
      return fmt::format("off by {:.2g} of the larger body", std::abs(factor));
  }
  return "";
}

std::string describe_fault(const NamedFault& s) { return words_of(s) + place_words(s); }

}  // namespace touchstone::fuzz
