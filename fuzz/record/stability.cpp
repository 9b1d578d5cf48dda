#include "fuzz/record/stability.h"

#include "core/base/exact_text.h"

namespace touchstone::fuzz {
namespace {

constexpr const char* columns[] = {"value", "asked",       "answers",      "failed",       "missed", "ghost",
                                   "wrong", "depth_error", "normal_error", "impact_error", "jitter", "order"};

Json cells(const Rung& r) {
  return {r.value,
          r.asked,
          r.answers,
          r.failed,
          r.missed,
          r.ghost,
          r.wrong,
          number(r.depth_error),
          number(r.normal_error),
          number(r.impact_error),
          number(r.jitter),
          number(r.order)};
}

}  // namespace

std::optional<double> LadderResult::fails_at() const {
  for (const Rung& r : rungs)
    if (r.wrong + r.failed > 0) return r.value;
  return std::nullopt;
}

Json to_json(const Stability& s) {
  Json ladders = Json::array(), results = Json::array();
  for (const auto& l : s.ladders) ladders.push_back({{"name", l.name}, {"line", l.line}, {"unit", l.unit}});
  for (const LadderResult& r : s.results) {
    Json rungs = Json::array();
    for (const Rung& rung : r.rungs) rungs.push_back(cells(rung));
    const auto at = r.fails_at();
    results.push_back({{"ladder", r.ladder},
                       {"engine", r.engine},
                       {"question", r.question},
                       {"fails_at", at ? Json(*at) : Json()},
                       {"rungs", std::move(rungs)}});
  }
  return {{"page", "stability"},    {"version", 1},
          {"scope", s.scope},       {"seed", s.seed},
          {"per_rung", s.per_rung}, {"ladders", std::move(ladders)},
          {"columns", columns},     {"results", std::move(results)}};
}

std::string to_csv(const Stability& s) {
  std::string text = "ladder,engine,question";
  for (const char* name : columns) text.append(1, ',').append(name);
  text += '\n';
  for (const LadderResult& r : s.results)
    for (const Rung& rung : r.rungs) {
      text.append(r.ladder).append(1, ',').append(r.engine).append(1, ',').append(r.question);
      text.append(1, ',').append(csv_cells(cells(rung))).append(1, '\n');
    }
  return text;
}

}  // namespace touchstone::fuzz
