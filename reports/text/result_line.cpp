#include "reports/text/result_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

#include "core/base/exact_text.h"
#include "core/base/hash.h"
#include "reports/record/causes.h"
#include "reports/record/chart.h"
#include "reports/record/stored.h"
#include "reports/text/record_text.h"
#include "reports/text/text.h"

namespace touchstone::reports {
namespace {

using fuzz::Json;

constexpr std::size_t most_names = 4;

std::string list_of(const std::vector<std::string>& names) {
  const std::size_t shown = std::min(names.size(), most_names);
  std::string text =
      fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<long>(shown), ", "));
  if (names.size() > shown) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

std::string hash_of(const std::string& text) { return hex64(Hasher().add(std::string_view(text)).value()); }

// Wrong and failed answers of one engine, over all questions.
struct Score {
  std::string engine;
  std::uint64_t answered = 0, wrong = 0, failed = 0;
};

Score score_of(const std::string& engine, const JsonReader& questions) {
  static const std::set<std::string_view> no_failure{"answered", "unsupported", "not_asked"};
  Score s{engine};
  for (const auto& [question, tally] : members_of(questions)) {
    s.wrong += count_of(tally["wrong"]);
    for (const auto& [outcome, count] : members_of(tally["outcomes"])) {
      if (outcome == "answered") s.answered += count_of(count);
      if (!no_failure.contains(outcome)) s.failed += count_of(count);
    }
  }
  return s;
}

// "wrong: ode 83, bullet-f64-query 19; failed: fcl-libccd 2"
std::string faults_of(std::vector<Score> scores, const char* word, std::uint64_t Score::*count) {
  std::erase_if(scores, [&](const Score& s) { return s.*count == 0; });
  std::stable_sort(scores.begin(), scores.end(),
                   [&](const Score& x, const Score& y) { return x.*count > y.*count; });
  std::vector<std::string> parts;
  for (const Score& s : scores) parts.push_back(fmt::format("{} {}", s.engine, grouped(s.*count)));
  return parts.empty() ? "" : fmt::format("{}: {}", word, list_of(parts));
}

std::string joined(const std::string& a, const std::string& b) {
  return a + (a.empty() || b.empty() ? "" : "; ") + b;
}

ResultLine campaign(const JsonReader& summary, std::uint64_t findings) {
  ResultLine line{.kind = "campaign"};
  std::vector<Score> scores;
  std::vector<std::string> names;
  std::uint64_t answered = 0;
  std::string identity;
  for (const auto& [engine, questions] : members_of(summary["engines"])) {
    const Score s = score_of(engine, questions);
    scores.push_back(s);
    names.push_back(engine);
    answered += s.answered;
    identity += fmt::format("{} {} {} {};", engine, s.answered, s.wrong, s.failed);
  }
  const std::uint64_t cases = count_of(summary["cases"]);
  line.subject = list_of(names);
  line.content = fmt::format("{}, {}, {} of findings", counted(cases, "case", "cases"),
                             counted(answered, "answer", "answers"), counted(findings, "kind", "kinds"));
  line.verdict =
      joined(faults_of(scores, "wrong", &Score::wrong), faults_of(scores, "failed", &Score::failed));
  line.mood = line.verdict.empty() ? Mood::good : Mood::bad;
  if (line.verdict.empty()) line.verdict = "no wrong answer";
  if (answered == 0) {
    line.verdict = "no answers: proves nothing";
    line.mood = Mood::open;
  }
  line.identity = hash_of(fmt::format("{} {} {}", cases, findings, identity));
  return line;
}

ResultLine causes(const JsonReader& j) {
  ResultLine line{.kind = "causes"};
  std::set<std::string> paths;
  std::map<std::string, std::uint64_t> by_severity;
  std::uint64_t count = 0;
  for (const JsonReader& c : j["causes"].items()) {
    paths.insert(c["path"].string());
    ++by_severity[c["severity"].string()];
    ++count;
  }
  line.subject = list_of({paths.begin(), paths.end()});
  line.content = fmt::format("{} behind {} of {}", counted(count, "cause", "causes"),
                             counted(count_of(j["answers"]), "wrong answer", "wrong answers"),
                             counted(count_of(j["cases"]), "case", "cases"));
  std::vector<std::string> parts;
  for (const std::string_view severity : fuzz::severity_names)
    if (const auto at = by_severity.find(std::string(severity)); at != by_severity.end())
      parts.push_back(fmt::format("{} {}", at->second, at->first));
  line.verdict = parts.empty() ? "no cause" : list_of(parts);
  line.mood = parts.empty() ? Mood::good : Mood::bad;
  line.identity = j["digest"].string();
  return line;
}

ResultLine certificate(const JsonReader& j) {
  ResultLine line{.kind = "certificate", .subject = j["subject"].string(), .mood = Mood::good};
  std::uint64_t cases = 0, pairs = 0;
  for (const JsonReader& e : j["evidence"].items()) {
    cases += count_of(e["cases"]);
    pairs += count_of(e["pairs_true"]);
  }
  line.content = fmt::format("{} scope, {}, {}", j["scope"].string(), counted(cases, "case", "cases"),
                             counted(pairs, "overlapping pair", "overlapping pairs"));
  for (const auto& [level, verdict] : members_of(j["verdict"])) {
    const std::string word = verdict.string();
    line.verdict += fmt::format("{}{} {}", line.verdict.empty() ? "" : ", ", level, word);
    if (word == "refuted") line.mood = Mood::bad;
    if (word != "certified" && line.mood == Mood::good) line.mood = Mood::open;
  }
  line.identity = j["digest"].string();
  return line;
}

ResultLine chart(const Json& document, const std::string& place) {
  const fuzz::Chart c = fuzz::chart_from_json(document, place);
  std::map<std::string, bool> is_sound;
  for (const fuzz::ChartRow& r : c.rows) {
    const bool sound = r.failed + r.missed + r.ghost + r.no_number + r.wrong == 0;
    const auto at = is_sound.emplace(r.engine, true).first;
    at->second = at->second && sound;
  }
  std::vector<std::string> sound;
  for (const auto& [engine, is] : is_sound)
    if (is) sound.push_back(engine);
  return {.kind = "chart",
          .subject = counted(is_sound.size(), "engine", "engines"),
          .content = fmt::format("speed and accuracy, {} chart; {} on {}", c.scope, c.machine.date,
                                 c.machine.processor),
          .verdict = sound.empty() ? "every engine is wrong or fails somewhere"
                                   : fmt::format("never wrong: {}", list_of(sound)),
          .identity = hash_of(document.dump())};
}

ResultLine stability(const JsonReader& j) {
  std::map<std::string, std::pair<std::uint64_t, std::uint64_t>> fails;  // results, and how many fail
  for (const JsonReader& r : j["results"].items()) {
    auto& [all, failing] = fails[r["engine"].string()];
    ++all;
    failing += r["fails_at"].json().is_null() ? 0 : 1;
  }
  std::vector<std::string> sound;
  for (const auto& [engine, count] : fails)
    if (count.second == 0) sound.push_back(engine);
  return {.kind = "stability",
          .subject = counted(fails.size(), "engine", "engines"),
          .content = fmt::format("{}, {} scope", counted(j["ladders"].items().size(), "ladder", "ladders"),
                                 j["scope"].string()),
          .verdict =
              sound.empty() ? "every engine fails somewhere" : fmt::format("never fails: {}", list_of(sound)),
          .identity = hash_of(j.json().dump())};
}

ResultLine assessment(const JsonReader& j) {
  ResultLine line{.kind = "robot"};
  const std::string robot = j["robot"].string(), world = j["world"].string();
  line.subject = (robot.empty() ? "a robot" : robot) + (world.empty() ? "" : " in " + world);
  std::vector<std::string> miss;
  for (const JsonReader& e : j["engines"].items())
    if (count_of(e["missed"]) > 0) miss.push_back(e["engine"].string());
  line.content = fmt::format("{}, {} asked of {}",
                             counted(count_of(j["configurations"]), "configuration", "configurations"),
                             counted(count_of(j["asked"]), "pair", "pairs"),
                             counted(j["engines"].items().size(), "engine", "engines"));
  line.verdict = miss.empty() ? "no collision missed" : "collisions missed by " + list_of(miss);
  line.mood = miss.empty() ? Mood::good : Mood::bad;
  if (count_of(j["asked"]) == 0) {
    line.verdict = "no pair was asked";
    line.mood = Mood::open;
  }
  line.identity = hash_of(j.json().dump());
  return line;
}

// Lengths have the scene's unit.
ResultLine plan(const JsonReader& j) {
  ResultLine line{.kind = "plan", .subject = j["scene"].string()};
  line.content = fmt::format("{}, {}", counted(count_of(j["bodies"]), "body", "bodies"),
                             counted(count_of(j["steps"]), "step", "steps"));
  for (const JsonReader& row : j["rows"].items()) {
    if (!row["plan"].boolean()) continue;
    const bool sound = count_of(row["outside"]) + count_of(row["unanswered"]) + count_of(row["unswept"]) == 0;
    line.verdict = fmt::format("{} a step, {}", duration(fuzz::number_from(row["ns_median"])),
                               sound ? "within the error asked for" : "not within the error asked for");
    line.mood = sound ? Mood::good : Mood::bad;
  }
  line.identity = hash_of(j.json().dump());
  return line;
}

ResultLine versions(const JsonReader& j) {
  const std::size_t causes = j["causes"].items().size();
  return {.kind = "releases",
          .subject = j["engine"].string(),
          .content = counted(j["releases"].items().size(), "release", "releases"),
          .verdict = counted(causes, "cause", "causes"),
          .mood = causes > 0 ? Mood::bad : Mood::good,
          .identity = hash_of(j.json().dump())};
}

ResultLine fingerprint(const JsonReader& j) {
  return {.kind = "fingerprint",
          .subject = j["engine"].string(),
          .content = fmt::format("{} {}, answers to {}", j["library"].string(), j["version"].string(),
                                 counted(count_of(j["cases"]), "case", "cases")),
          .verdict = "hash " + j["hash"].string(),
          .identity = j["hash"].string()};
}

ResultLine cover(const JsonReader& j) {
  const bool covers = j["covers"].boolean();
  return {.kind = "cover",
          .subject = counted(count_of(j["pieces"]), "convex piece", "convex pieces"),
          .content = fmt::format("a mesh of {}", counted(count_of(j["triangles"]), "triangle", "triangles")),
          .verdict = covers ? "contain the mesh" : "do not contain the mesh",
          .mood = covers ? Mood::good : Mood::bad,
          .identity = hash_of(j.json().dump())};
}

std::string questions_in(const JsonReader& list) {
  std::set<std::string> names;
  for (const JsonReader& q : list.items()) names.insert(q["question"].string());
  std::vector<std::string> words;
  for (std::string name : names) {
    std::replace(name.begin(), name.end(), '_', ' ');
    words.push_back(name);
  }
  return list_of(words);
}

ResultLine stored_case(const JsonReader& j, const std::string& place) {
  ResultLine line{.kind = "case", .verdict = "not asked here"};
  line.subject = j.has("id") ? j["id"].string() : place;
  line.content = counted(j["scene"]["bodies"].items().size(), "body", "bodies");
  if (j.has("queries") && !j["queries"].items().empty()) line.content += "; " + questions_in(j["queries"]);
  line.identity = hash_of(j.json().dump());
  return line;
}

// A page has the answers that the case does not have, so the two are different results.
ResultLine case_page(const JsonReader& j) {
  ResultLine line{.kind = "case", .subject = j["title"].string()};
  std::set<std::string> engines, wrong, failed;
  for (const JsonReader& q : j["queries"].items()) {
    if (!q.has("engines")) continue;
    for (const auto& [engine, e] : members_of(q["engines"])) {
      const std::string outcome = e["answer"]["outcome"].string();
      if (outcome == "unsupported") continue;
      engines.insert(engine);
      if (!e["faults"].items().empty()) (outcome == "answered" ? wrong : failed).insert(engine);
    }
  }
  line.content =
      fmt::format("{}; {}; {}", counted(j["case"]["scene"]["bodies"].items().size(), "body", "bodies"),
                  questions_in(j["queries"]), counted(engines.size(), "engine", "engines"));
  if (!wrong.empty()) line.verdict = "wrong: " + list_of({wrong.begin(), wrong.end()});
  if (!failed.empty())
    line.verdict = joined(line.verdict, "failed: " + list_of({failed.begin(), failed.end()}));
  line.mood = line.verdict.empty() ? Mood::good : Mood::bad;
  if (line.verdict.empty()) line.verdict = "no wrong answer";
  line.identity = hash_of(j["case"].json().dump()) + "/page";
  return line;
}

ResultLine broad_page(const JsonReader& j) {
  return {.kind = "case",
          .subject = j["name"].string(),
          .content =
              fmt::format("{} in {} of broad phases", counted(j["bodies"].items().size(), "body", "bodies"),
                          counted(j["frames"].items().size(), "query", "queries")),
          .verdict = "not judged",
          .identity = hash_of(j.json().dump())};
}

std::optional<ResultLine> line_of_page(const Json& document, const JsonReader& j) {
  const std::string page = j["page"].string();
  if (page == "report") return campaign(j["summary"], count_of(j["findings"]["count"]));
  if (page == "causes") return causes(j["record"]);
  if (page == "certificate") return certificate(j["certificate"]);
  if (page == "chart") return chart(document, j.file());
  if (page == "stability") return stability(j);
  if (page == "assess") return assessment(j["assessment"]);
  if (page == "plan") return plan(j["plan"]);
  if (page == "case") return case_page(j);
  return std::nullopt;
}

bool is_broad_page(const JsonReader& j) { return j.has("methods") && j.has("fixed") && j.has("frames"); }

bool is_summary(const JsonReader& j) {
  return j.has("cases") && j.has("pair_cases") && j.has("engines") && j.has("findings");
}

}  // namespace

std::string_view to_string(Mood m) {
  constexpr auto names = std::to_array<std::string_view>({"none", "good", "bad", "open"});
  return names[static_cast<std::size_t>(m)];
}

std::optional<ResultLine> result_line(const Json& document, const std::string& place) {
  if (!document.is_object()) return std::nullopt;
  const JsonReader j(document, place);
  if (j.has("page") && j["page"].json().is_string()) return line_of_page(document, j);
  if (j.has("touchstone_causes")) return causes(j);
  if (j.has("touchstone_broad_certificate")) return certificate(j);
  if (j.has("touchstone_assessment")) return assessment(j);
  if (j.has("touchstone_plan")) return plan(j);
  if (j.has("touchstone_versions")) return versions(j);
  if (j.has("touchstone_fingerprint")) return fingerprint(j);
  if (j.has("touchstone_cover")) return cover(j);
  if (j.has("touchstone_case")) return stored_case(j, place);
  if (is_broad_page(j)) return broad_page(j);
  if (is_summary(j)) return campaign(j, members_of(j["findings"]).size());
  return std::nullopt;
}

}  // namespace touchstone::reports
