#include "reports/record/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/exact_text.h"
#include "core/base/input_error.h"
#include "reports/record/stored.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::fuzz {
namespace {

constexpr const char* columns[] = {"engine",    "question",  "regime",     "pair",           "scale",
                                   "bodies",    "asked",     "answers",    "failed",         "missed",
                                   "ghost",     "no_number", "wrong",      "rounding",       "undecided",
                                   "ns_min",    "ns_median", "ns_p99",     "ns_spread",      "error_p50",
                                   "error_p99", "error_max", "pairs_true", "pairs_reported", "front",
                                   "tie",       "unsound",   "not_judged", "wide_claim"};

// Four digits exceed the repeatability of times and the precision needed of errors; a full chart has 4e4
// rows.
Json rounded(double x) {
  return std::isfinite(x) ? number(double_from_text(fmt::format("{:.4g}", x)).value_or(x)) : number(x);
}

// The distinct strings of a chart; rows refer to them by index.
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
          r.front ? 1 : 0,  // not true/false: keeps the page of a full chart below 5 MB
          r.tie ? 1 : 0,
          text(r.unsound),
          r.not_judged,
          r.wide_claim};
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

namespace {

using Places = std::map<std::string, std::size_t>;

// Reads the cells of one row by column name.
class RowReader {
 public:
  RowReader(const std::vector<std::string>& strings, const Places& places, const JsonReader& row)
      : strings_(strings), places_(places), row_(row), cells_(row.items(places.size())) {}
  void operator()(const char* name, std::string& v) const {
    const JsonReader& at = cell(name);
    const std::uint64_t i = count_of(at);
    if (i >= strings_.size()) at.fail("is not an index into the strings");
    v = strings_[i];
  }
  void operator()(const char* name, double& v) const { v = number_from(cell(name)); }
  void operator()(const char* name, std::uint64_t& v) const { v = count_of(cell(name)); }
  void operator()(const char* name, bool& v) const { v = count_of(cell(name)) != 0; }
  bool has(const char* name) const { return places_.contains(name); }

 private:
  const JsonReader& cell(const char* name) const {
    const auto place = places_.find(name);
    if (place == places_.end()) row_.fail("lacks the column " + std::string(name));
    return cells_[place->second];
  }
  const std::vector<std::string>& strings_;
  const Places& places_;
  const JsonReader& row_;
  std::vector<JsonReader> cells_;
};

ChartRow row_from_json(const RowReader& read) {
  ChartRow r;
  read("engine", r.engine);
  read("question", r.question);
  read("regime", r.regime);
  read("pair", r.pair);
  read("scale", r.scale);
  read("unsound", r.unsound);
  read("bodies", r.bodies);
  read("asked", r.asked);
  read("answers", r.answers);
  read("failed", r.failed);
  read("missed", r.missed);
  read("ghost", r.ghost);
  read("no_number", r.no_number);
  read("wrong", r.wrong);
  read("rounding", r.rounding);
  read("undecided", r.undecided);
  read("ns_min", r.ns_min);
  read("ns_median", r.ns_median);
  read("ns_p99", r.ns_p99);
  read("ns_spread", r.ns_spread);
  read("error_p50", r.error_p50);
  read("error_p99", r.error_p99);
  read("error_max", r.error_max);
  read("pairs_true", r.pairs_true);
  if (read.has("not_judged")) {  // absent from charts of earlier versions
    read("not_judged", r.not_judged);
    read("wide_claim", r.wide_claim);
  }
  read("pairs_reported", r.pairs_reported);
  read("front", r.front);
  read("tie", r.tie);
  return r;
}

}  // namespace

namespace {

Machine machine_from_json(const JsonReader& j) {
  Machine m;
  m.processor = j["processor"].string();
  m.cores = static_cast<unsigned>(std::max(0, j["cores"].integer()));
  m.load = number_from(j["load"]);
  m.system = j["system"].string();
  m.compiler = j["compiler"].string();
  m.date = j["date"].string();
  return m;
}

Places places_of(const JsonReader& names) {
  Places places;
  const auto all = names.items();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!places.emplace(all[i].string(), i).second) all[i].fail("repeats the name of a column");
  return places;
}

}  // namespace

Chart chart_from_json(const Json& json, const std::string& file) {
  const JsonReader j(json, file);
  if (!j.has("page") || j["page"].json() != "chart" || j["version"].json() != 2)
    throw InputError(file, "is not a chart of this version");
  Chart c;
  c.machine = machine_from_json(j["machine"]);
  c.scope = j["scope"].string();
  c.seed = count_of(j["seed"]);
  c.rounds = j["rounds"].integer();
  const std::uint64_t max_ns = std::uint64_t{1} << 62, ns = count_of(j["measure_ns"]);
  if (ns > max_ns) j["measure_ns"].fail("is too long for a measurement");
  c.measure_ns = static_cast<std::int64_t>(ns);
  for (const JsonReader& e : j["engines"].items())
    c.engines.push_back(
        {e["name"].string(), e["library"].string(), e["version"].string(), e["settings"].string()});
  std::vector<std::string> strings;
  for (const JsonReader& text : j["strings"].items()) strings.push_back(text.string());
  const Places places = places_of(j["columns"]);
  for (const JsonReader& row : j["rows"].items()) c.rows.push_back(row_from_json({strings, places, row}));
  return c;
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
