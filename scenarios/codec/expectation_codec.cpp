#include "scenarios/codec/value_codec.h"

#include <array>
#include <nlohmann/json.hpp>

namespace touchstone::scenarios {
namespace {

using Json = nlohmann::ordered_json;

constexpr auto known =
    std::to_array<std::string_view>({"overlap", "gap", "normal", "impact", "all_pairs", "box_pairs",
                                     "overlapping_pairs", "pairs_at_query", "reason"});
constexpr auto value_fields = std::to_array<std::string_view>({"value", "tolerance"});
constexpr auto impact_fields = std::to_array<std::string_view>({"hit", "time", "tolerance"});

std::optional<int> read_count(const JsonReader& r, std::string_view field) {
  if (!r.has(field)) return std::nullopt;
  const int n = r[field].integer();
  if (n < 0) r[field].fail("a count cannot be negative");
  return n;
}

double read_tolerance(const JsonReader& r) {
  const double t = r.has("tolerance") ? r["tolerance"].number() : 0;
  if (t < 0) r["tolerance"].fail("is negative");
  return t;
}

Expectation::Impact read_impact(const JsonReader& r) {
  r.require_object(impact_fields);
  Expectation::Impact i;
  i.hit = r["hit"].boolean();
  if (!i.hit) {
    if (r.has("time")) r["time"].fail("has no meaning without a hit");
    return i;
  }
  i.time = r["time"].number();
  i.tolerance = read_tolerance(r);
  return i;
}

std::vector<std::vector<BodyPair>> read_pairs(const JsonReader& r) {
  std::vector<std::vector<BodyPair>> lists;
  for (const JsonReader& list : r.items()) {
    auto& pairs = lists.emplace_back();
    for (const JsonReader& p : list.items()) {
      const auto v = p.items(2);
      pairs.emplace_back(v[0].integer(), v[1].integer());
    }
  }
  return lists;
}

}  // namespace

nlohmann::ordered_json to_json(const Expectation& e) {
  Json j = Json::object();
  if (e.overlap) j["overlap"] = *e.overlap;
  if (e.gap) j["gap"] = {{"value", e.gap->value}, {"tolerance", e.gap->tolerance}};
  if (e.normal) j["normal"] = Json::array({e.normal->x(), e.normal->y(), e.normal->z()});
  if (e.impact) {
    j["impact"] = {{"hit", e.impact->hit}};
    if (e.impact->hit) {
      j["impact"]["time"] = e.impact->time;
      j["impact"]["tolerance"] = e.impact->tolerance;
    }
  }
  if (e.all_pairs) j["all_pairs"] = *e.all_pairs;
  if (e.box_pairs) j["box_pairs"] = *e.box_pairs;
  if (e.overlapping_pairs) j["overlapping_pairs"] = *e.overlapping_pairs;
  for (const auto& list : e.pairs_at_query) {
    Json pairs = Json::array();
    for (const auto& [a, b] : list) pairs.push_back(Json::array({a, b}));
    j["pairs_at_query"].push_back(pairs);
  }
  if (!e.reason.empty()) j["reason"] = e.reason;
  return j;
}

Expectation read_expectation(const JsonReader& r) {
  r.require_object(known);
  Expectation e;
  if (r.has("overlap")) e.overlap = r["overlap"].boolean();
  if (r.has("gap")) {
    const JsonReader gap = r["gap"];
    gap.require_object(value_fields);
    e.gap = {gap["value"].number(), read_tolerance(gap)};
  }
  if (r.has("normal")) e.normal = r["normal"].vec3();
  if (r.has("impact")) e.impact = read_impact(r["impact"]);
  e.all_pairs = read_count(r, "all_pairs");
  e.box_pairs = read_count(r, "box_pairs");
  e.overlapping_pairs = read_count(r, "overlapping_pairs");
  if (r.has("pairs_at_query")) e.pairs_at_query = read_pairs(r["pairs_at_query"]);
  if (r.has("reason")) e.reason = r["reason"].string();
  return e;
}

}  // namespace touchstone::scenarios
