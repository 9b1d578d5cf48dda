#include "cli/replay_capture.h"

#include <fmt/format.h>

#include <map>

#include "cli/answer_text.h"
#include "cli/chosen_engines.h"
#include "cli/command.h"
#include "cli/query_file.h"
#include "core/base/input_error.h"
#include "fuzz/judge/judge.h"
#include "reports/text/text.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/codec/scene_codec.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {
namespace {

using Json = nlohmann::ordered_json;

struct RulingCount {
  std::uint64_t answers = 0, right = 0, wrong = 0, failed = 0, open = 0;
  void add(const Judgement& j) {
    const Ruling r = j.ruling();
    ++answers;
    right += r == Ruling::right;
    wrong += r == Ruling::wrong;
    failed += r == Ruling::failed;
    open += r == Ruling::undecided || r == Ruling::not_judged;
  }
};

Json to_json(const RulingCount& c) {
  return {
      {"answers", c.answers}, {"right", c.right}, {"wrong", c.wrong}, {"failed", c.failed}, {"open", c.open}};
}

class CaptureReplay {
 public:
  CaptureReplay(const std::vector<EnginePtr>& beside, const CaptureOptions& o) : beside_(beside), o_(o) {}

  void add(const fuzz::QueryLine& q, const std::string& place) {
    if (!q.answer) throw InputError(place, "has no \"answer\": nothing to judge");
    const std::string engine = q.engine.empty() ? "recorded" : cut_utf8(printable(q.engine), longest_name);
    const Judgement j = fuzz::judge_stated(q.scene, *q.answer, o_.precision);
    all_.add(j);
    recorded_[engine].add(j);
    if (j.ruling() == Ruling::wrong) show(j, place, engine, q.scene);
    ask_beside(q.scene);
  }

  int finish(const std::string& what) const {
    const int code = all_.wrong > 0 ? exit_wrong : all_.right > 0 ? exit_clean : exit_failed;
    if (o_.json)
      fmt::print("{}\n", document().dump(1, ' ', false, Json::error_handler_t::replace));
    else
      print_counts();
    const std::string words = fmt::format("{} of {} recorded answers wrong", reports::grouped(all_.wrong),
                                          reports::grouped(all_.answers));
    return print_verdict(code, what, code == exit_failed ? words + "; none could be judged" : words, o_.json);
  }

 private:
  // Names longer than this are cut, so that a row keeps to 80 columns.
  static constexpr std::size_t longest_name = 30;

  void show(const Judgement& j, const std::string& place, const std::string& engine, const Scene& scene) {
    if (!o_.json) {
      fmt::print("{}\n{}",
                 reports::wrapped(fmt::format("{}: {}: {} and {}", printable(place), engine,
                                              type_name(scene.shape_of(0)), type_name(scene.shape_of(1))),
                                  79, 2),
                 ruling_text(j));
      return;
    }
    Json row{{"place", place}, {"engine", engine}, {"scene", to_json(scene)}};
    row.update(fuzz::judgement_to_json(j));
    wrong_.push_back(std::move(row));
  }

  void ask_beside(const Scene& scene) {
    if (beside_.empty()) return;
    const Case c{"capture", "capture", scene, default_queries(scene)};
    fuzz::Truth truth(c.scene);
    for (const EnginePtr& e : beside_)
      for (const Judgement& j : fuzz::judge(c, e->card(), e->run({&c, 1})[0], truth))
        if (j.ruling() != Ruling::unsupported) asked_[e->card().name].add(j);
  }

  static void print_rows(const std::map<std::string, RulingCount>& rows) {
    for (const auto& [name, c] : rows)
      fmt::print("{:<30} {:>9} {:>9} {:>8} {:>8} {:>8}\n", name, c.answers, c.right, c.wrong, c.failed,
                 c.open);
  }
  void print_counts() const {
    fmt::print("\n{:<30} {:>9} {:>9} {:>8} {:>8} {:>8}\n", "recorded", "answers", "right", "wrong", "failed",
               "open");
    print_rows(recorded_);
    if (asked_.empty()) return;
    fmt::print("asked beside\n");
    print_rows(asked_);
  }

  Json document() const {
    Json j{{"wrong", wrong_}, {"recorded", Json::object()}, {"beside", Json::object()}};
    for (const auto& [name, c] : recorded_) j["recorded"][name] = to_json(c);
    for (const auto& [name, c] : asked_) j["beside"][name] = to_json(c);
    return j;
  }

  const std::vector<EnginePtr>& beside_;
  const CaptureOptions& o_;
  RulingCount all_;
  std::map<std::string, RulingCount> recorded_, asked_;
  Json wrong_ = Json::array();
};

}  // namespace

int replay_captures(std::span<const std::string> files, const std::vector<EnginePtr>& beside,
                    const CaptureOptions& o) {
  CaptureReplay replay(beside, o);
  for (const std::string& file : files)
    for_each_query(file, [&](const fuzz::QueryLine& q, const std::string& place) { replay.add(q, place); });
  return replay.finish(files.size() == 1 ? printable(files[0]) : fmt::format("{} captures", files.size()));
}

}  // namespace touchstone::cli
