#include "fuzz/record/chart.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace touchstone::fuzz {
namespace {

constexpr const char* columns[] = {
    "engine",    "question",   "regime",         "pair",   "scale",     "bodies",    "asked",
    "answers",   "failed",     "missed",         "ghost",  "no_number", "wrong",     "rounding",
    "undecided", "ns_min",     "ns_median",      "ns_p99", "ns_spread", "error_p50", "error_p99",
    "error_max", "pairs_true", "pairs_reported", "front",  "tie",       "unsound"};

// Four digits are more than a time repeats and an error is worth; the page of a full chart has 4e4 rows.
Json rounded(double x) { return std::isfinite(x) ? number(std::stod(fmt::format("{:.4g}", x))) : number(x); }

// The strings of a chart, each once: rows name them by their place.
class Strings {
 public:
  Json place(const std::string& text) {
    const auto [at, is_new] = places_.try_emplace(text, all_.size());
    if (is_new) all_.push_back(text);
    return at->second;
  }
  Json take() { return std::move(all_); }

 private:
  std::map<std::string, std::size_t> places_;
  Json all_ = Json::array();
};

template <class Text>
Json cells(const ChartRow& r, Text&& text) {
  return {text(r.engine),
          text(r.question),
          text(r.regime),
          text(r.pair),
          text(r.scale),
          r.bodies,
          r.asked,
          r.answers,
          r.failed,
          r.missed,
          r.ghost,
          r.no_number,
          r.wrong,
          r.rounding,
          r.undecided,
          rounded(r.ns_min),
          rounded(r.ns_median),
          rounded(r.ns_p99),
          rounded(r.ns_spread),
          rounded(r.error_p50),
          rounded(r.error_p99),
          rounded(r.error_max),
          r.pairs_true,
          r.pairs_reported,
          r.front,
          r.tie,
          text(r.unsound)};
}

}  // namespace

Json to_json(const Machine& m) {
  return {{"processor", m.processor}, {"cores", m.cores},       {"load", m.load},
          {"system", m.system},       {"compiler", m.compiler}, {"date", m.date}};
}

Json to_json(const Chart& c) {
  Json engines = Json::array(), rows = Json::array();
  Strings strings;
  for (const ChartEngine& e : c.engines)
    engines.push_back(
        {{"name", e.name}, {"library", e.library}, {"version", e.version}, {"settings", e.settings}});
  for (const ChartRow& r : c.rows) rows.push_back(cells(r, [&](const auto& t) { return strings.place(t); }));
  return {{"page", "chart"},
          {"version", 2},
          {"scope", c.scope},
          {"seed", c.seed},
          {"rounds", c.rounds},
          {"measure_ns", c.measure_ns},
          {"machine", to_json(c.machine)},
          {"engines", std::move(engines)},
          {"columns", columns},
          {"text_columns", {"engine", "question", "regime", "pair", "scale", "unsound"}},
          {"strings", strings.take()},
          {"rows", std::move(rows)}};
}

std::string to_csv(const Chart& c) {
  std::string text;
  for (const char* name : columns) {
    if (!text.empty()) text += ',';
    text += name;
  }
  text += '\n';
  for (const ChartRow& r : c.rows)
    text.append(csv_cells(cells(r, [](const std::string& t) { return t; }))).append(1, '\n');
  return text;
}

}  // namespace touchstone::fuzz
