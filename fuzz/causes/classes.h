// Findings folded into classes: engines that share code, shapes that take the same route through it, faults
// that show the same symptom. Nothing is asked.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fuzz/causes/symptom.h"
#include "reports/record/result.h"

namespace touchstone::fuzz {

/// Another engine to put the same case to, which differs in one respect.
struct OtherEngine {
  std::string name;     // of the intervention: "other_precision", "tighter", "other_path"
  std::string change;   // for people: "asked in double precision"
  std::string if_gone;  // what it means when the fault vanishes
  std::string engine;
  int telling = 0;  // as in Intervention
  /// Questions that it answers by another call of its library: that such a fault vanishes says nothing about
  /// the change.
  std::vector<Question> other_calls = {};
};

/// What is known about engines beyond their cards; all functions accept any engine's name.
struct EngineKnowledge {
  /// Settings and precisions of one code: "bullet-query" for bullet-f32-query-tuned.
  std::function<std::string(const std::string& engine)> path_of;
  /// The routine that the library chooses for the pair: "sphere", "convex", "mesh".
  std::function<std::string(const std::string& engine, Question question, ShapeKind a, ShapeKind b)> route_of;
  /// False where route_of is a guess: then a case may be reduced to one on another route.
  std::function<bool(const std::string& engine)> knows_routes;
  /// Where the engine's documentation states that it has this fault; empty: nowhere. `parting`: of bodies
  /// that are in contact at the start and move apart (parting.h).
  std::function<std::string(const std::string& engine, const Symptom& symptom, const std::string& route,
                            Fault fault, bool parting)>
      documented;
  std::function<std::vector<OtherEngine>(const std::string& engine)> others;
};

/// For engines of which nothing is known.
EngineKnowledge no_knowledge();

/// The kinds of a pair's shapes as a finding's key names them, "box-sphere". None if it names no pair:
/// "scene".
std::optional<std::pair<ShapeKind, ShapeKind>> kinds_of_pair(std::string_view shapes);

/// The route of a finding about these shapes, as in its key; `question` is folded (symptom.h).
std::string route_of(const std::string& engine, const std::string& shapes, Question question,
                     const EngineKnowledge& knowledge);

struct FindingClass {
  std::string path, route;
  Symptom symptom;
  bool parting = false;                   // is_of_parting_bodies(), of all findings or of none
  std::vector<const Finding*> findings;   // by descending count, then by key
  std::vector<const Finding*> explained;  // contradictions that this class explains; by key
  std::uint64_t count = 0;                // of `findings`
};

enum class Contradictions { explained, apart };

/// Sorted by path, route, symptom and whether bodies part. With `explained`, a contradiction joins the most
/// frequent class of the same path, question and route, if there is one; that is what can be said without
/// asking. The result must outlive the classes.
std::vector<FindingClass> classes_of(const CampaignResult& result, const EngineKnowledge& knowledge,
                                     Contradictions contradictions = Contradictions::explained);

/// How many answers the findings' engines gave to such questions about such shapes.
std::uint64_t asked_about(const CampaignResult& result, std::span<const Finding* const> findings);

/// Wrong answers of each class, divided by the answers to such questions.
std::vector<double> rates_of(const std::vector<FindingClass>& classes, const CampaignResult& result);

}  // namespace touchstone::fuzz
