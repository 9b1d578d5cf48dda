#include "cli/page_contents.h"

#include <filesystem>
#include <set>

#include "cli/chosen_engines.h"
#include "cli/command.h"
#include "cli/program_for.h"
#include "core/base/input_error.h"
#include "fuzz/ask/judged_case.h"
#include "fuzz/bisect/bisect.h"
#include "fuzz/shrink/keeps_finding.h"

namespace touchstone::cli {
namespace {

using fuzz::Json;

// Beyond these limits the page shows the command instead: computing the rest would take too long.
constexpr std::size_t most_bodies = 64, most_pairs = 6;
constexpr std::size_t max_program_size = 40'000;

// The pairs that some question names, each once, in order.
std::vector<std::pair<int, int>> pairs_of(const Case& c) {
  std::vector<std::pair<int, int>> pairs;
  for (const Query& q : c.queries)
    if (is_pair_question(q.question) &&
        std::find(pairs.begin(), pairs.end(), std::pair(q.a, q.b)) == pairs.end())
      pairs.emplace_back(q.a, q.b);
  return pairs;
}

Json stages_of(const Case& c, const EnginePtr& engine) {
  Json list = Json::array();
  for (const auto& [a, b] : pairs_of(c)) {
    if (list.size() == most_pairs) break;
    Json stages = Json::array();
    for (const fuzz::Stage& s : fuzz::which_stage(c, a, b, -1, engine))
      stages.push_back({{"name", s.name}, {"faults", s.faults}});
    list.push_back({{"a", a}, {"b", b}, {"stages", std::move(stages)}});
  }
  return list;
}

// One program per question: for the first finding, by key, that the engine's API can show.
Json programs_of(const Case& c, const EnginePtr& engine) {
  Json list = Json::array();
  std::set<std::string> questions;
  const auto found = fuzz::findings_of({&c, 1}, engine);
  for (const auto& [key, finding] : found[0]) {
    if (questions.contains(finding.question)) continue;
    try {
      const std::string text = program_for(finding, engine->card(), engine->card().name);
      if (text.size() > max_program_size) continue;
      list.push_back({{"key", key}, {"question", finding.question}, {"program", text}});
      questions.insert(finding.question);
    } catch (const InputError&) {
      // The engine's API lacks this shape or question, so no program can be written.
    }
  }
  return list;
}

Json engine_json(const Case& c, const EnginePtr& engine, bool wrong) {
  const EngineCard& card = engine->card();
  Json j = {{"library", card.library}, {"version", card.version}, {"settings", card.settings}};
  j["has_reproducer"] = has_program(card.name);
  if (!wrong || c.scene.bodies.size() > most_bodies) return j;
  j["stages"] = stages_of(c, engine);
  if (has_program(card.name)) j["programs"] = programs_of(c, engine);
  return j;
}

// For a large mesh, an exact certificate of a motion takes minutes.
bool has_large_mesh(const Scene& scene) {
  constexpr std::size_t large = 200;
  return std::any_of(scene.shapes.begin(), scene.shapes.end(), [](const Shape& s) {
    const TriangleMesh* mesh = triangles_if(s);
    return mesh && mesh->triangles.size() > large;
  });
}

}  // namespace

Json hull_faces(const Scene& scene) {
  Json faces = Json::object();
  for (std::size_t i = 0; i < scene.shapes.size(); ++i)
    if (const auto* h = hull_if(scene.shapes[i])) faces[std::to_string(i)] = h->faces;
  return faces;
}

Json case_page(const std::string& named, const StoredCase& stored, const std::string& engines,
               const WorkerLimits& limits) {
  const Case& c = stored.c;
  fuzz::CaseJudge judge(c);
  Json cards = Json::object();
  for (const EnginePtr& engine : make_engines(engine_names(engines), limits)) {
    const EngineCard& card = engine->card();
    const auto answers = engine->run({&c, 1})[0];
    const auto& judgements = judge.add(card, answers);
    const bool wrong =
        std::any_of(judgements.begin(), judgements.end(), [](const auto& j) { return !j.faults.empty(); });
    cards[card.name] = engine_json(c, engine, wrong);
  }
  const auto certificates = has_large_mesh(c.scene) ? fuzz::Certificates::depths : fuzz::Certificates::exact;
  Json queries = std::move(to_json(std::move(judge).result(certificates))["queries"]);
  return {{"page", "case"},
          {"version", 2},
          {"title", c.id.empty() ? std::filesystem::path(named).stem().string() : c.id},
          {"command", program_name() + " replay " + shell_word(named)},
          {"case", stored_case_to_json(stored)},
          {"hull_faces", hull_faces(c.scene)},
          {"engines", std::move(cards)},
          {"queries", std::move(queries)}};
}

}  // namespace touchstone::cli
