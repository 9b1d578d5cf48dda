#include "fuzz/corpus/corpus_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/base/input_error.h"
#include "fuzz/answer/query_line.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/codec/scene_codec.h"
#include "scenarios/codec/value_codec.h"

namespace touchstone::fuzz::corpus {
namespace {

using Json = nlohmann::ordered_json;

Json bracket(const referee::Bracket& b) {
  const auto number = [](double x) { return std::isfinite(x) ? Json(x + 0.0) : Json(); };
  return {number(b.lo), number(b.hi)};
}

Json body_json(const Json& scene, std::size_t i) {
  const Json& body = scene["bodies"][i];
  Json j{{"shape", scene["shapes"][body["shape"].get<std::size_t>()]}};
  for (const char* field : {"pose", "motion"})
    if (body.contains(field)) j[field] = body[field];
  return j;
}

Json exact_json(const ExactGap& g) {
  if (!g.value.empty()) return {{"value", g.value}};
  return {{"sign", g.sign}, {"square", g.square}, {"less", g.less}};
}

Json truth_json(const PairAnswer& p, const std::optional<ExactGap>& exact) {
  Json j{{"verdict", p.truth.verdict == referee::Verdict::overlap ? "overlap" : "apart"},
         {"gap", bracket(p.truth.gap)}};
  if (exact) j["exact"] = exact_json(*exact);
  Json certificates = Json::object();
  const auto put = [&](const char* name, const Certificate& c) {
    if (c.kind != Certificate::Kind::none) certificates[name] = touchstone::to_json(c);
  };
  put("verdict", p.proof->verdict);
  put("at_least", p.proof->at_least);
  put("at_most", p.proof->at_most);
  j["certificates"] = std::move(certificates);
  return j;
}

Json truth_json(const MotionFacts& m) {
  const referee::TimeTruth& t = m.answer.truth;
  const bool hit = t.verdict == referee::TimeTruth::Verdict::hit;
  Json j{{"verdict", hit ? "hit" : "no hit"}};
  if (hit) j["time"] = bracket({t.t_lo, t.t_hi});
  j["least_gap"] = bracket(t.least_gap);
  j["deepest"] = m.deepest;
  j["right_times"] = Json::array();
  for (const RightTimes& r : m.right_times) {
    Json row{r.exponent};
    if (r.window)
      for (const double x : *r.window) row.push_back(x);
    j["right_times"].push_back(std::move(row));
  }
  Json certificates = Json::object();
  if (m.answer.certificate && !m.answer.certificate->claims_nothing())
    certificates["impact"] = touchstone::to_json(*m.answer.certificate);
  j["certificates"] = std::move(certificates);
  return j;
}

constexpr const char *must = "must", *may = "may", *must_not = "must not";

// Of an answer without claimed tolerance in arithmetic whose τ is 2^-exponent * L.
Json classes(const CorpusCase& c, int exponent) {
  const double tau = std::ldexp(c.scale, -exponent);
  const auto both = [](const char* yes, const char* no, bool yes_is_wrong, bool no_is_wrong) {
    const auto word = [](bool wrong, bool other_wrong) {
      return wrong ? must_not : other_wrong ? must : may;
    };
    return Json{{yes, word(yes_is_wrong, no_is_wrong)}, {no, word(no_is_wrong, yes_is_wrong)}};
  };
  if (c.pair) {
    const bool overlap = c.pair->truth.verdict == referee::Verdict::overlap;
    const referee::Bracket& gap = c.pair->truth.gap;
    return both("overlap", "apart", !overlap && gap.lo > tau, overlap && -gap.hi > tau);
  }
  const auto row = std::find_if(c.motion->right_times.begin(), c.motion->right_times.end(),
                                [&](const RightTimes& r) { return r.exponent <= exponent; });
  if (row == c.motion->right_times.end()) return both("hit", "no hit", false, false);
  return both("hit", "no hit", !row->window, c.motion->deepest > std::ldexp(c.scale, -row->exponent));
}

constexpr auto case_fields = std::to_array<std::string_view>(
    {"id", "comment", "flags", "a", "b", "questions", "scale", "truth", "expect"});
constexpr auto flag_fields = std::to_array<std::string_view>({"mechanism", "degeneracy", "size", "source"});

StoredCorpusCase case_from_json(const JsonReader& r) {
  r.require_object(case_fields);
  StoredCorpusCase c;
  c.place = r.place();
  c.id = r["id"].string();
  const JsonReader flags = r["flags"];
  flags.require_object(flag_fields);
  c.mechanism = flags["mechanism"].string();
  c.size = flags["size"].string();
  c.source = flags["source"].string();
  for (const JsonReader& d : flags["degeneracy"].items()) c.degeneracy.push_back(d.string());
  c.scene = scene_of_bodies(r["a"].json(), r["b"].json(), r.place());
  for (const int body : {0, 1})
    if (!is_convex(kind_of(c.scene.shape_of(body)))) r.fail("the corpus has bounded convex shapes only");
  std::vector<std::string> asked;
  for (const JsonReader& q : r["questions"].items()) asked.push_back(q.string());
  const auto about = questions_about(c.scene);
  if (!std::equal(asked.begin(), asked.end(), about.begin(), about.end(),
                  [](const std::string& name, Question q) { return name == to_string(q); }))
    r["questions"].fail("are not those of such bodies: overlap, distance, contact at rest; time_of_impact");
  r["truth"].require_object();
  c.truth = r["truth"].json();
  if (about[0] == Question::time_of_impact)
    for (const JsonReader& row : r["truth"]["right_times"].items()) {
      const auto numbers = row.items();
      if (numbers.empty()) row.fail("is empty");
      c.exponents.push_back(numbers[0].integer());
    }
  return c;
}

}  // namespace

nlohmann::ordered_json to_json(const CorpusCase& c) {
  const Json scene = touchstone::to_json(c.seed.scene);
  Json j{{"id", c.seed.id},
         {"comment", c.seed.comment},
         {"flags",
          {{"mechanism", c.seed.mechanism},
           {"degeneracy", c.degeneracy},
           {"size", c.size},
           {"source", c.seed.source}}},
         {"a", body_json(scene, 0)},
         {"b", body_json(scene, 1)},
         {"questions", Json::array()},
         {"scale", c.scale}};
  for (const Question q : questions_about(c.seed.scene)) j["questions"].push_back(to_string(q));
  j["truth"] = c.pair ? truth_json(*c.pair, c.exact) : truth_json(*c.motion);
  j["expect"] = {{"double", classes(c, exponent_of_double)}, {"single", classes(c, exponent_of_single)}};
  return j;
}

std::string file_text(const std::vector<CorpusCase>& cases) {
  std::string text = "{\"touchstone_corpus\":" + std::to_string(format_version) + ",\"release\":\"" +
                     std::string(release) + "\",\"cases\":[";
  for (std::size_t i = 0; i < cases.size(); ++i) text += (i ? ",\n" : "\n") + to_line(to_json(cases[i]));
  return text + "\n]}\n";
}

std::vector<StoredCorpusCase> load_corpus(const std::filesystem::path& directory) {
  const std::filesystem::path folder = directory / "cases";
  if (!std::filesystem::is_directory(folder))
    throw InputError(folder.string(), "is not a directory; DIR of a corpus holds cases/*.json");
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<StoredCorpusCase> all;
  std::set<std::string> ids;
  for (const auto& file : files) {
    const Json j = load_json(file);
    const JsonReader r(j, file.string());
    if (r["touchstone_corpus"].integer() != format_version)
      r["touchstone_corpus"].fail("is not the version that this program reads");
    for (const JsonReader& c : r["cases"].items()) {
      all.push_back(case_from_json(c));
      if (!ids.insert(all.back().id).second) c["id"].fail("is the id of two cases");
    }
  }
  if (all.empty()) throw InputError(folder.string(), "holds no cases");
  return all;
}

}  // namespace touchstone::fuzz::corpus
