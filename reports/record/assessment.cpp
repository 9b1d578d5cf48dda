#include "reports/record/assessment.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <tuple>

namespace touchstone::fuzz {
namespace {

const Tally& tally_of(const AssessedEngine& e, Question q) {
  static const Tally none;
  const auto it = e.tallies.find(q);
  return it == e.tallies.end() ? none : it->second;
}

Json tally_json(const Tally& t, bool with_times) {
  Json j = {{"answered", t.answered()},
            {"right", t.right},
            {"wrong", t.wrong},
            {"missed", t.missed},
            {"ghosts", t.ghost},
            {"undecided", t.undecided},
            {"not_judged", t.not_judged},
            {"failed", t.failed()},
            {"unsupported", t.unsupported()},
            {"worst_error_in_l", t.worst_in_l}};
  if (with_times) j["median_ns"] = t.time.quantile(0.5);
  return j;
}

Json engine_json(const AssessedEngine& e, bool with_times) {
  Json j = {{"engine", e.name}, {"library", e.library}, {"version", e.version}, {"settings", e.settings}};
  for (const auto& [question, tally] : e.tallies)
    j["questions"][std::string(to_string(question))] = tally_json(tally, with_times);
  j["worst_distance_error"] = e.worst_distance_error;
  if (!e.worst_pair.empty()) j["worst_pair"] = e.worst_pair;
  j["silent_about_collisions"] = e.silent;
  j["padding"] = e.silent == 0 ? Json(e.padding) : Json();
  return j;
}

}  // namespace

std::vector<Advice> advice_on(const Assessment& a) {
  std::vector<Advice> list;
  for (const AssessedEngine& e : a.engines) {
    const Tally& t = tally_of(e, Question::overlap);
    if (a.asked > 0 && t.answered() == a.asked && e.silent == 0)
      list.push_back({e.name, e.padding, t.missed > 0, t.ghost, t.time.quantile(0.5)});
  }
  std::sort(list.begin(), list.end(), [](const Advice& x, const Advice& y) {
    return std::tie(x.padding, x.by_distance, x.ghosts, x.median_ns, x.engine) <
           std::tie(y.padding, y.by_distance, y.ghosts, y.median_ns, y.engine);
  });
  return list;
}

Json to_json(const Assessment& a, bool with_times) {
  Json j = {{"touchstone_assessment", 1},
            {"robot", a.robot},
            {"world", a.world},
            {"seed", a.seed},
            {"configurations", a.configurations},
            {"of_trajectory", a.of_trajectory},
            {"near", a.near},
            {"pairs_of_a_configuration", a.possible},
            {"near_pairs", a.near_pairs},
            {"asked", a.asked},
            {"overlapping", a.overlapping},
            {"apart", a.apart},
            {"undecided", a.undecided},
            {"interrupted", a.interrupted},
            {"engines", Json::array()}};
  for (const AssessedEngine& e : a.engines) j["engines"].push_back(engine_json(e, with_times));
  if (!with_times) return j;
  j["advice"] = Json::array();
  for (const Advice& x : advice_on(a))
    j["advice"].push_back({{"engine", x.engine},
                           {"padding", x.padding},
                           {"by_distance", x.by_distance},
                           {"ghosts", x.ghosts},
                           {"median_ns", x.median_ns}});
  return j;
}

}  // namespace touchstone::fuzz
