#include <algorithm>
#include <cmath>
#include <map>

#include "cli/page_contents.h"
#include "fuzz/judge/judge.h"
#include "reports/text/record_text.h"
#include "scenarios/codec/scene_codec.h"

namespace touchstone::cli {
namespace {

using fuzz::AssessedSample;
using fuzz::Assessment;
using fuzz::Json;

// A pair and whose example it is.
struct Example {
  AssessedSample sample;
  std::vector<std::pair<std::string, AssessedSample>> of;
};

// In the order of pairs, each once; those that more engines get wrong first.
std::vector<Example> examples_of(const Assessment& a) {
  std::map<std::uint64_t, Example> by_index;
  for (const fuzz::AssessedEngine& e : a.engines)
    for (const AssessedSample& s : e.samples) {
      Example& x = by_index[s.index];
      x.sample = s;
      x.of.emplace_back(e.name, s);
    }
  std::vector<Example> list;
  for (auto& [index, x] : by_index) list.push_back(std::move(x));
  const auto kind = [](const Example& x) {
    return std::min_element(x.of.begin(), x.of.end(),
                            [](const auto& p, const auto& q) { return p.second.kind < q.second.kind; })
        ->second.kind;
  };
  std::stable_sort(list.begin(), list.end(), [&](const Example& x, const Example& y) {
    return std::pair(kind(x), y.of.size()) < std::pair(kind(y), x.of.size());
  });
  return list;
}

Json statement(const referee::PairTruth& truth, const CaseObservations& o,
               const std::vector<Judgement>& judgements) {
  const Observation &verdict = o.answers[0], &distance = o.answers[1];
  Json j = {{"outcome", to_string(verdict.outcome)}};
  if (verdict.overlap) j["overlap"] = *verdict.overlap;
  if (distance.distance) {
    const double d = *distance.distance;
    j["distance"] = fuzz::number(d);
    if (truth.verdict == referee::Verdict::disjoint && std::isfinite(d))
      j["error"] = std::max({truth.gap.lo - d, d - truth.gap.hi, 0.0});
  }
  j["faults"] = Json::array();
  for (const Judgement& x : judgements)
    for (const FaultReport& f : x.faults) j["faults"].push_back(to_string(f.fault));
  return j;
}

Json pair_json(const Example& x, const Scene& scene, std::size_t frame,
               const std::vector<EnginePtr>& engines) {
  const AssessedSample& s = x.sample;
  const Case c = fuzz::case_of_pair(scene, {s.configuration, s.a, s.b});
  fuzz::Truth truth(c.scene);
  const referee::PairTruth& pair = truth.pair(0, 0, 1);
  Json j = {{"frame", frame},
            {"configuration", s.configuration},
            {"a", s.a},
            {"b", s.b},
            {"verdict", referee::to_string(pair.verdict)},
            {"gap", Json::array({fuzz::number(pair.gap.lo), fuzz::number(pair.gap.hi)})}};
  if (pair.verdict == referee::Verdict::disjoint)
    j["witness"] = Json::array({fuzz::vector(pair.witness[0]), fuzz::vector(pair.witness[1])});
  j["of"] = Json::array();
  for (const auto& [engine, sample] : x.of)
    j["of"].push_back({{"engine", engine}, {"kind", to_string(sample.kind)}, {"size", sample.size}});
  j["engines"] = Json::object();
  for (const EnginePtr& e : engines) {
    const CaseObservations o = e->run({&c, 1})[0];
    j["engines"][e->card().name] = statement(pair, o, fuzz::judge(c, e->card(), o, truth));
  }
  return j;
}

}  // namespace

Json assess_page(const Model& model, const std::vector<Configuration>& all, const Assessment& a,
                 const std::vector<EnginePtr>& engines, const std::string& command) {
  const std::vector<Example> examples = examples_of(a);
  std::map<std::uint64_t, std::size_t> frame_of;
  for (const Example& x : examples) frame_of.emplace(x.sample.configuration, 0);
  if (frame_of.empty()) frame_of.emplace(0, 0);
  std::vector<Configuration> shown;
  Json numbers = Json::array();
  for (auto& [number, frame] : frame_of) {
    frame = shown.size();
    shown.push_back(all[number]);
    numbers.push_back(number);
  }
  Scene scene = scene_of(model, std::span(shown).first(1));
  Json pairs = Json::array();
  for (const Example& x : examples) {
    place_bodies(model, all[x.sample.configuration], scene);
    pairs.push_back(pair_json(x, scene, frame_of[x.sample.configuration], engines));
  }
  const Scene frames = scene_of(model, shown);
  const reports::AssessmentWords words = reports::assessment_words(a);
  return {{"page", "assess"},
          {"version", 1},
          {"title", "Which engine can be trusted on " + (a.robot.empty() ? "this robot" : a.robot) + "?"},
          {"command", command},
          {"heading", words.heading},
          {"legend", words.legend},
          {"notes", words.notes},
          {"advice", words.advice},
          {"assessment", to_json(a, true)},
          {"scene", to_json(frames)},
          {"configurations", std::move(numbers)},
          {"hull_faces", hull_faces(frames)},
          {"pairs", std::move(pairs)}};
}

}  // namespace touchstone::cli
