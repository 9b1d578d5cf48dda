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
  Json j = {{"engine", e.name},
            {"library", e.library},
            {"version", e.version},
            {"settings", e.settings},
            {"is_own", e.is_own}};
  for (const auto& [question, tally] : e.tallies)
    j["questions"][std::string(to_string(question))] = tally_json(tally, with_times);
  j["distances_apart"] = e.distances_apart;
  j["worst_distance_error"] = e.worst_distance_error;
  if (!e.worst_pair.empty()) j["worst_pair"] = e.worst_pair;
  j["missed"] = e.missed;
  j["false_alarms"] = e.false_alarms;
  j["largest_gap_reported"] = e.largest_gap;
  j["denied_collisions"] = e.denied;
  j["deepest_denied"] = e.deepest_denied;
  j["unanswered"] = e.unanswered;
  j["samples"] = Json::array();
  for (const AssessedSample& s : e.samples)
    j["samples"].push_back({{"kind", to_string(s.kind)},
                            {"configuration", s.configuration},
                            {"bodies", {s.a, s.b}},
                            {"size", s.size}});
  j["silent_about_collisions"] = e.silent;
  j["padding"] = e.silent == 0 ? Json(e.padding) : Json();
  return j;
}

Json test_json(const std::vector<TestAdvice>& list) {
  Json all = Json::array();
  for (const TestAdvice& x : list)
    all.push_back({{"engine", x.engine},
                   {"padding", x.padding},
                   {"by_distance", x.by_distance},
                   {"false_alarms", x.false_alarms},
                   {"median_ns", x.median_ns}});
  return all;
}

Json distance_json(const std::vector<DistanceAdvice>& list) {
  Json all = Json::array();
  for (const DistanceAdvice& x : list)
    all.push_back({{"engine", x.engine}, {"worst_error", x.worst_error}, {"median_ns", x.median_ns}});
  return all;
}

}  // namespace

std::string_view to_string(AssessedSample::Kind kind) {
  constexpr std::string_view names[] = {"missed", "false", "distance"};
  return names[static_cast<std::size_t>(kind)];
}

void keep_largest(std::vector<AssessedSample>& samples) {
  std::sort(samples.begin(), samples.end(), [](const AssessedSample& x, const AssessedSample& y) {
    return std::tuple(x.kind, -x.size, x.index) < std::tuple(y.kind, -y.size, y.index);
  });
  std::size_t of_kind = 0;
  std::optional<AssessedSample::Kind> last;
  std::erase_if(samples, [&](const AssessedSample& s) {
    of_kind = s.kind == last ? of_kind + 1 : 0;
    last = s.kind;
    return of_kind >= most_samples_of_kind;
  });
}

std::vector<TestAdvice> test_advice(const Assessment& a) {
  std::vector<TestAdvice> list;
  for (const AssessedEngine& e : a.engines) {
    const Tally& t = tally_of(e, Question::overlap);
    if (a.asked == 0 || t.answered() != a.asked || e.silent > 0) continue;
    const bool by_distance = e.denied > 0;
    const Tally& needed = by_distance ? tally_of(e, Question::distance) : t;
    list.push_back({e.name, e.is_own, e.padding, by_distance, e.false_alarms, needed.time.quantile(0.5)});
  }
  std::sort(list.begin(), list.end(), [](const TestAdvice& x, const TestAdvice& y) {
    return std::tie(x.padding, x.by_distance, x.false_alarms, x.median_ns, x.engine) <
           std::tie(y.padding, y.by_distance, y.false_alarms, y.median_ns, y.engine);
  });
  return list;
}

std::vector<DistanceAdvice> distance_advice(const Assessment& a) {
  std::vector<DistanceAdvice> list;
  for (const AssessedEngine& e : a.engines)
    if (a.apart > 0 && e.distances_apart == a.apart)
      list.push_back(
          {e.name, e.is_own, e.worst_distance_error, tally_of(e, Question::distance).time.quantile(0.5)});
  const auto rank = [&](const DistanceAdvice& x) {
    const bool accepted = x.worst_error <= a.error;
    return std::tuple(!accepted, accepted ? 0 : x.worst_error, x.median_ns, x.engine);
  };
  std::sort(list.begin(), list.end(),
            [&](const DistanceAdvice& x, const DistanceAdvice& y) { return rank(x) < rank(y); });
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
            {"accepted_error", a.error},
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
  j["advice"] = {{"collision_test", test_json(test_advice(a))},
                 {"distance", distance_json(distance_advice(a))}};
  return j;
}

}  // namespace touchstone::fuzz
