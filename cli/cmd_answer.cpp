// touchstone answer: what is true of two bodies, or of the pairs of a scene, with certificates; and whether
// somebody's own numbers about them are right.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>
#include <vector>

#include "cli/answer_text.h"
#include "cli/case_argument.h"
#include "cli/command.h"
#include "cli/judged_by.h"
#include "cli/query_file.h"
#include "core/base/input_error.h"
#include "fuzz/answer/body_text.h"
#include "fuzz/answer/pair_answer.h"
#include "fuzz/answer/query_line.h"
#include "reports/text/text.h"
#include "scenarios/codec/scene_codec.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {
namespace {

using Json = nlohmann::ordered_json;

struct AnswerOptionsText {
  std::vector<std::string> subjects;
  std::vector<int> pair;
  std::string answers, error;
  std::optional<double> within;
  bool json = false, no_certificates = false, single = false;
};

// What the exit code is made from.
struct Tally {
  std::uint64_t pairs = 0, decided = 0;
  std::uint64_t stated = 0, right = 0, wrong = 0;
};

class Answering {
 public:
  Answering(const AnswerOptionsText& o, std::vector<fuzz::StatedAnswer> stated)
      : o_(o), stated_(std::move(stated)) {
    precision_.single = o.single;
    if (!o.error.empty()) precision_.tolerance = length_from_text(o.error);
    options_.certificates = !o.no_certificates;
  }

  /// `scene` has two bodies. `own`: the answer that came with it.
  void add(const Scene& scene, const std::string& title, const std::optional<fuzz::StatedAnswer>& own) {
    const fuzz::StatedAnswer* stated = own ? &*own : nullptr;
    if (!stated_.empty()) {
      if (own) throw InputError(o_.answers, "the questions bring answers of their own");
      if (tally_.pairs >= stated_.size())
        throw InputError(o_.answers,
                         fmt::format("has {} answers, fewer than there are pairs", stated_.size()));
      stated = &stated_[tally_.pairs];
    }
    ++tally_.pairs;
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const Placed a{&scene.shape_of(0), scene.bodies[0].pose}, b{&scene.shape_of(1), scene.bodies[1].pose};
    fuzz::AnswerOptions options = options_;
    options.margin = o_.within;
    if (!options.margin && scene.margin != 0) options.margin = scene.margin;
    const fuzz::PairAnswer answer = fuzz::answer_pair(a, b, options);
    std::optional<fuzz::ImpactAnswer> impact;
    const bool moves = scene.bodies[0].motion || scene.bodies[1].motion;
    if (moves)
      impact = fuzz::answer_motion(a, scene.bodies[0].motion.value_or(Motion{}), b,
                                   scene.bodies[1].motion.value_or(Motion{}), options_);
    const auto ns = std::chrono::nanoseconds(Clock::now() - start).count();
    using Undecided = referee::TimeTruth::Verdict;
    tally_.decided += answer.truth.verdict != referee::Verdict::undecided &&
                      (!impact || impact->truth.verdict != Undecided::undecided) &&
                      (!answer.within || answer.within->verdict != referee::Verdict::undecided);
    std::optional<Judgement> ruling;
    if (stated) ruling = fuzz::judge_stated(scene, *stated, precision_);
    if (ruling) {
      ++tally_.stated;
      tally_.right += ruling->right();
      tally_.wrong += ruling->ruling() == Ruling::wrong;
    }
    if (o_.json)
      print_json(scene, answer, impact, ruling, ns);
    else
      print_text(title, answer, impact, ruling, ns);
  }

  int finish() const {
    if (tally_.pairs < stated_.size())
      throw InputError(o_.answers, fmt::format("has {} answers for {} pairs", stated_.size(), tally_.pairs));
    if (tally_.stated > 0 && !o_.json && tally_.pairs > 1)
      fmt::print("{} stated: {} right, {} wrong\n", reports::counted(tally_.stated, "answer", "answers"),
                 reports::grouped(tally_.right), reports::grouped(tally_.wrong));
    if (tally_.wrong > 0) return exit_wrong;
    const bool proved = tally_.stated > 0 ? tally_.right > 0 : tally_.decided > 0;
    return proved ? exit_clean : exit_failed;
  }

 private:
  void print_json(const Scene& scene, const fuzz::PairAnswer& answer,
                  const std::optional<fuzz::ImpactAnswer>& impact, const std::optional<Judgement>& ruling,
                  std::int64_t ns) const {
    Json j{{"touchstone_answer", 1}, {"scene", to_json(scene)}};
    j.update(fuzz::to_json(answer));
    if (impact) j["time_of_impact"] = fuzz::to_json(*impact);
    if (ruling) j["stated"] = fuzz::judgement_to_json(*ruling);
    j["nanoseconds"] = ns;
    fmt::print("{}\n", j.dump(-1, ' ', false, Json::error_handler_t::replace));
    std::fflush(stdout);  // a program that asks line by line waits for it
  }

  void print_text(const std::string& title, const fuzz::PairAnswer& answer,
                  const std::optional<fuzz::ImpactAnswer>& impact, const std::optional<Judgement>& ruling,
                  std::int64_t ns) const {
    fmt::print("{}\n{}", reports::wrapped(printable(title, "\n"), 79, 2), answer_text(answer));
    if (impact) fmt::print("{}", answer_text(*impact));
    fmt::print("  {:<12}{}\n", "time", reports::duration(static_cast<double>(ns)));
    if (ruling) fmt::print("{}", ruling_text(*ruling));
    std::fflush(stdout);
  }

  const AnswerOptionsText& o_;
  std::vector<fuzz::StatedAnswer> stated_;
  fuzz::StatedPrecision precision_;
  fuzz::AnswerOptions options_;
  Tally tally_;
};

std::string name_of(const Scene& s, int body) {
  const std::string& name = s.bodies[static_cast<std::size_t>(body)].name;
  return fmt::format("{} {}{}", body, type_name(s.shape_of(body)),
                     name.empty() ? "" : " " + cut_utf8(name, 40));
}

std::vector<BodyPair> pairs_of(const AnswerOptionsText& o, const Scene& scene) {
  const int n = static_cast<int>(scene.bodies.size());
  if (!o.pair.empty()) {
    for (int i : o.pair)
      if (i < 0 || i >= n)
        throw InputError("--pair", fmt::format("body {} does not exist; the scene has {}", i, n));
    if (o.pair[0] == o.pair[1]) throw InputError("--pair", "names the same body twice");
    return {{o.pair[0], o.pair[1]}};
  }
  constexpr int most_bodies = 64;  // about two thousand pairs
  if (n > most_bodies)
    throw InputError(o.subjects[0], fmt::format("has {} bodies; choose two with --pair A B", n));
  std::vector<BodyPair> all;
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b)
      if (!is_filtered(scene, a, b)) all.emplace_back(a, b);
  if (all.empty()) throw InputError(o.subjects[0], "has no pair of bodies to ask about");
  return all;
}

void answer_scene(const AnswerOptionsText& o, Answering& answering) {
  const Scene scene = case_argument(o.subjects[0]).c.scene;
  for (const auto& [a, b] : pairs_of(o, scene))
    answering.add(extract_pair(scene, a, b), fmt::format("{}, {}", name_of(scene, a), name_of(scene, b)), {});
}

void answer_two_shapes(const AnswerOptionsText& o, Answering& answering) {
  const Json a = fuzz::body_from_text(o.subjects[0], "first body"),
             b = fuzz::body_from_text(o.subjects[1], "second body");
  answering.add(fuzz::scene_of_bodies(a, b, "bodies"),
                fmt::format("A: {}\nB: {}", o.subjects[0], o.subjects[1]), {});
}

void answer_queries(const AnswerOptionsText& o, Answering& answering) {
  for_each_query(o.subjects[0], [&](const fuzz::QueryLine& q, const std::string& place) {
    answering.add(q.scene, q.engine.empty() ? place : fmt::format("{} ({})", place, cut_utf8(q.engine, 60)),
                  q.answer);
  });
}

int run(const AnswerOptionsText& o) {
  if (o.within && !std::isfinite(*o.within)) throw InputError("--within", "must be a finite number");
  Answering answering(o,
                      o.answers.empty() ? std::vector<fuzz::StatedAnswer>{} : load_stated_answers(o.answers));
  const bool two = o.subjects.size() == 2;
  if (!o.pair.empty() && (two || is_query_file(o.subjects[0])))
    throw InputError("--pair", "chooses two bodies of a scene");
  if (two)
    answer_two_shapes(o, answering);
  else if (is_query_file(o.subjects[0]))
    answer_queries(o, answering);
  else
    answer_scene(o, answering);
  return answering.finish();
}

}  // namespace

Run declare_answer(CLI::App& app) {
  auto o = std::make_shared<AnswerOptionsText>();
  app.add_option("subject", o->subjects,
                 "two bodies as text (see below), a scene or case file, a scenario, a file of JSON lines "
                 "(.jsonl), or - for JSON lines on standard input")
      ->required()
      ->expected(1, 2);
  app.add_option("--pair", o->pair, "bodies A and B of a scene (default: every pair)")->expected(2);
  app.add_option("--answers", o->answers,
                 "judge these stated answers, one for each pair: a JSON object or array, or JSON lines");
  app.add_option(
      "--within", o->within,
      "also answer whether the signed gap is at most this (default: the scene's margin, if it has one)");
  app.add_option("--error", o->error, "error allowed to stated answers besides rounding: 0.1mm, 1e-4");
  app.add_flag("--single", o->single, "stated answers were computed in single precision");
  app.add_flag("--no-certificates", o->no_certificates, "leave out certificates, which take the most time");
  app.add_flag("--json", o->json, "one line of JSON for each pair");
  app.footer(
      "A body: SHAPE NUMBERS [at X Y Z] [rot X Y Z 30deg] [quat X Y Z W]\n"
      "[move X Y Z] [spin X Y Z] [pad P]. Extents and heights are halves:\n" +
      fuzz::describe_shape_texts() +
      "rot turns about an axis (deg or rad). move and spin are velocities over one\n"
      "step; with them the time of impact is answered too. pad adds all points\n"
      "within P of the shape.\n"
      "A JSON line: {\"a\": BODY, \"b\": BODY, \"answer\": STATED}; BODY is such a text, or\n"
      "{\"shape\", \"pose\", \"motion\"} of the scene format. STATED has any of overlap,\n"
      "distance (signed), lower_bound, upper_bound, normal (A to B), moment,\n"
      "unique_gradient, depth, witness, points, time_of_impact.\n"
      "Exit codes: 0 answered, and what is stated is right; 1 something stated is\n"
      "wrong; 2 bad input; 3 nothing could be decided.");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
