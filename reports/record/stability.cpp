#include "reports/record/stability.h"

#include "core/base/exact_text.h"

namespace touchstone::fuzz {
namespace {

constexpr const char* columns[] = {
    "value", "asked",       "answers",      "failed",       "missed",      "ghost",
    "wrong", "depth_error", "normal_error", "impact_error", "jitter",      "order",
    "frame", "unit",        "order_broken", "frame_broken", "unit_broken", "open"};

Json cells(const Rung& r) {
  Json all{r.value,
           r.asked,
           r.answers,
           r.failed,
           r.missed,
           r.ghost,
           r.wrong,
           number(r.depth_error),
           number(r.normal_error),
           number(r.impact_error)};
  for (const double x : r.spread) all.push_back(number(x));
  for (std::size_t k = 1; k < form_count; ++k) all.push_back(r.broken[k]);
  all.push_back(r.open);
  return all;
}

}  // namespace

std::optional<double> LadderResult::fails_at() const {
  for (const Rung& r : rungs)
    if (r.wrong + r.failed > 0) return r.value;
  return std::nullopt;
}

std::optional<double> LadderResult::breaks_at(std::size_t form) const {
  for (const Rung& r : rungs)
    if (r.broken[form] > 0) return r.value;
  return std::nullopt;
}

Json to_json(const Stability& s) {
  Json ladders = Json::array(), results = Json::array();
  for (const auto& l : s.ladders) ladders.push_back({{"name", l.name}, {"line", l.line}, {"unit", l.unit}});
  for (const LadderResult& r : s.results) {
    Json rungs = Json::array();
    for (const Rung& rung : r.rungs) rungs.push_back(cells(rung));
    const auto rung = [](const std::optional<double>& at) { return at ? Json(*at) : Json(); };
    Json result{{"ladder", r.ladder}, {"engine", r.engine}, {"question", r.question}};
    result["fails_at"] = rung(r.fails_at());
    for (std::size_t k = 1; k < form_count; ++k)
      result[std::string(form_columns[k]) + "_fails_at"] = rung(r.breaks_at(k));
    result["rungs"] = std::move(rungs);
    results.push_back(std::move(result));
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
