#include "reports/record/motions.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace touchstone::fuzz {
namespace {

Json counts(const MotionResult& r) {
  Json j{{"motion", r.motion},   {"engine", r.engine},    {"motions", r.motions}, {"frames", r.frames},
         {"answers", r.answers}, {"wrong", r.wrong},      {"failed", r.failed},   {"open", r.open},
         {"changes", r.changes}, {"switches", r.switches}};
  for (std::size_t k = 0; k < flicker_count; ++k) j[std::string(flicker_names[k])] = r.flickers[k];
  for (std::size_t k = 0; k < flicker_count; ++k)
    j["worst_" + std::string(flicker_names[k])] = number(r.worst[k]);
  j["score"] = number(r.score());
  j["restless"] = number(r.restless);
  j["state_asked"] = r.state_asked;
  j["state_differs"] = r.state_differs;
  return j;
}

Json evidence_json(const MotionEvidence& e) {
  return {{"kind", e.kind},
          {"motion", e.motion},
          {"frame", e.frame},
          {"frames", e.frames},
          {"question", e.question},
          {"a", e.a},
          {"b", e.b},
          {"before", vector(e.before)},
          {"after", vector(e.after)},
          {"amount", number(e.amount)},
          {"words", e.words}};
}

}  // namespace

std::uint64_t MotionResult::flicker_sum() const {
  const auto order = static_cast<std::size_t>(Flicker::order);
  return std::accumulate(flickers.begin(), flickers.end(), std::uint64_t{0}) - flickers[order];
}

double MotionResult::score() const {
  return changes == 0 ? 0 : 1000 * static_cast<double>(flicker_sum()) / static_cast<double>(changes);
}

std::string frame_id(const std::string& motion, int frame) {
  return fmt::format("{}/frame/{}", motion, frame);
}

std::vector<std::string> case_ids(const MotionEvidence& e) {
  if (e.kind == switch_evidence) return {};
  if (e.kind == state_evidence) return {e.motion};
  if (e.kind == wrong_evidence) return {e.motion, frame_id(e.motion, e.frame)};
  return {e.motion, frame_id(e.motion, e.frame - 1), frame_id(e.motion, e.frame)};
}

void keep(std::vector<MotionEvidence>& list, MotionEvidence e) {
  const auto same =
      std::count_if(list.begin(), list.end(), [&](const MotionEvidence& x) { return x.kind == e.kind; });
  if (static_cast<std::size_t>(same) < most_evidence_of_a_kind) list.push_back(std::move(e));
}

void MotionResult::merge(const MotionResult& o) {
  motions += o.motions;
  frames += o.frames;
  answers += o.answers;
  wrong += o.wrong;
  failed += o.failed;
  open += o.open;
  changes += o.changes;
  switches += o.switches;
  for (std::size_t k = 0; k < flicker_count; ++k) {
    flickers[k] += o.flickers[k];
    worst[k] = std::max(worst[k], o.worst[k]);
  }
  restless = std::max(restless, o.restless);
  state_asked += o.state_asked;
  state_differs += o.state_differs;
  for (const MotionEvidence& e : o.evidence) keep(evidence, e);
}

Json to_json(const Motions& m) {
  Json rows = Json::array(), results = Json::array();
  for (const auto& r : m.rows) rows.push_back({{"name", r.name}, {"line", r.line}});
  for (const MotionResult& r : m.results) {
    Json j = counts(r);
    j["evidence"] = Json::array();
    for (const MotionEvidence& e : r.evidence) j["evidence"].push_back(evidence_json(e));
    results.push_back(std::move(j));
  }
  return {{"page", "motions"},
          {"version", 1},
          {"seed", m.seed},
          {"count", m.count},
          {"frames", m.frames},
          {"rows", std::move(rows)},
          {"results", std::move(results)}};
}

std::string to_csv(const Motions& m) {
  std::string text;
  for (const MotionResult& r : m.results) {
    const Json j = counts(r);
    Json names = Json::array(), cells = Json::array();
    for (const auto& [name, value] : j.items()) {
      names.push_back(name);
      cells.push_back(value);
    }
    if (text.empty()) {
      for (const auto& name : names) text.append(text.empty() ? "" : ",").append(name.get<std::string>());
      text += '\n';
    }
    text.append(csv_cells(cells)).append(1, '\n');
  }
  return text;
}

}  // namespace touchstone::fuzz
