#include "fuzz/causes/classes.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "fuzz/causes/parting.h"
#include "oracles/routes/routes.h"

namespace touchstone::fuzz {
namespace {

std::optional<ShapeKind> kind_named(std::string_view name) {
  for (int k = 0; k < shape_kind_count; ++k)
    if (type_name(static_cast<ShapeKind>(k)) == name) return static_cast<ShapeKind>(k);
  return std::nullopt;
}

constexpr std::string_view scene_route = "scene";

using Place = std::tuple<std::string, std::string, Symptom, bool>;  // path, route, symptom, parting

std::map<Place, FindingClass> fold(const CampaignResult& result, const EngineKnowledge& knowledge) {
  std::map<Place, FindingClass> classes;
  for (const auto& [key, f] : result.findings) {
    Symptom s = symptom_of(f);
    std::string path = knowledge.path_of(f.engine),
                route = route_of(f.engine, f.shapes, s.question, knowledge);
    const bool parting = is_of_parting_bodies(f);
    FindingClass& c = classes[{path, route, s, parting}];
    c.parting = parting;
    c.path = std::move(path);
    c.route = std::move(route);
    c.symptom = std::move(s);
    c.findings.push_back(&f);
    c.count += f.count;
  }
  return classes;
}

// Of the classes of the same path and question: one of the same route before a failure of any route, a wrong
// answer before a failure, the more frequent before the rarer.
FindingClass* plain_class(std::map<Place, FindingClass>& classes, const FindingClass& of) {
  const auto rank = [&](const FindingClass& c) {
    return std::tuple(c.route == of.route, c.symptom.stage != FaultStage::failure, c.count);
  };
  FindingClass* best = nullptr;
  for (auto& [place, c] : classes) {
    if (c.path != of.path || c.symptom.question != of.symptom.question) continue;
    if (c.symptom.stage == FaultStage::contradiction) continue;
    if (c.route != of.route && c.route != any_shapes) continue;
    if (!best || rank(c) > rank(*best)) best = &c;
  }
  return best;
}

}  // namespace

EngineKnowledge no_knowledge() {
  EngineKnowledge k;
  k.path_of = [](const std::string& engine) { return engine; };
  k.route_of = [](const std::string&, Question question, ShapeKind a, ShapeKind b) {
    return std::string(routes::common_route({question, a, b}));
  };
  k.knows_routes = [](const std::string&) { return false; };
  k.documented = [](const std::string&, const Symptom&, const std::string&, Fault, bool) {
    return std::string();
  };
  k.others = [](const std::string&) { return std::vector<OtherEngine>(); };
  return k;
}

std::optional<std::pair<ShapeKind, ShapeKind>> kinds_of_pair(std::string_view shapes) {
  const auto dash = shapes.find('-');
  if (dash == std::string_view::npos) return std::nullopt;
  const auto a = kind_named(shapes.substr(0, dash)), b = kind_named(shapes.substr(dash + 1));
  return a && b ? std::optional(std::pair(*a, *b)) : std::nullopt;
}

std::string route_of(const std::string& engine, const std::string& shapes, Question question,
                     const EngineKnowledge& knowledge) {
  if (shapes == any_shapes) return shapes;
  if (shapes.find('-') == std::string::npos) return std::string(scene_route);
  const auto kinds = kinds_of_pair(shapes);
  return kinds ? knowledge.route_of(engine, question, kinds->first, kinds->second) : shapes;
}

std::vector<FindingClass> classes_of(const CampaignResult& result, const EngineKnowledge& knowledge,
                                     Contradictions contradictions) {
  std::map<Place, FindingClass> classes = fold(result, knowledge);
  for (auto at = classes.begin(); at != classes.end();) {
    if (contradictions == Contradictions::apart) break;
    FindingClass* explains =
        at->second.symptom.stage == FaultStage::contradiction ? plain_class(classes, at->second) : nullptr;
    if (!explains) {
      ++at;
      continue;
    }
    for (const Finding* f : at->second.findings) explains->explained.push_back(f);
    at = classes.erase(at);
  }
  std::vector<FindingClass> sorted;
  for (auto& [place, c] : classes) {
    std::stable_sort(c.findings.begin(), c.findings.end(),
                     [](const Finding* x, const Finding* y) { return x->count > y->count; });
    sorted.push_back(std::move(c));
  }
  return sorted;
}

}  // namespace touchstone::fuzz
