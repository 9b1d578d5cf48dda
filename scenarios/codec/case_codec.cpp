#include "scenarios/codec/case_codec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/input_error.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/codec/json_reader.h"
#include "scenarios/codec/scene_codec.h"
#include "scenarios/codec/scene_fields.h"
#include "scenarios/codec/value_codec.h"
#include "scenarios/value/invalid_numbers.h"
#include "scenarios/value/moving_pairs.h"

namespace touchstone {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view version_field = "touchstone_case";
constexpr int version = 1;
constexpr auto former_invalid_numbers = "odd_numbers";  // the field's name in files of earlier releases
constexpr auto case_fields =
    std::to_array<std::string_view>({version_field, "id", "description", "source", "family", "scene",
                                     "queries", "expect", "invalid_numbers", former_invalid_numbers});
constexpr auto pair_query_fields = std::to_array<std::string_view>({"question", "a", "b"});
constexpr auto scene_query_fields = std::to_array<std::string_view>({"question"});

Json to_json(const Query& q) {
  Json j{{"question", to_string(q.question)}};
  if (is_pair_question(q.question)) {
    j["a"] = q.a;
    j["b"] = q.b;
  }
  return j;
}

int read_body(const JsonReader& r, const Scene& scene) {
  const int i = r.integer();
  if (i < 0 || i >= static_cast<int>(scene.bodies.size()))
    r.fail("index " + std::to_string(i) + " is not a body");
  return i;
}

Query read_query(const JsonReader& r, const Scene& scene) {
  r.require_object();
  const std::string name = r["question"].string();
  const auto question = question_from_string(name);
  if (!question) {
    std::string list;
    for (std::string_view n : question_names) list += (list.empty() ? "" : ", ") + std::string(n);
    r["question"].fail("unknown question; known are " + list);
  }
  Query q;
  q.question = *question;
  if (!is_pair_question(q.question)) {
    r.require_object(scene_query_fields);
    if (q.question == Question::candidates_within && scene.margin < 0)
      r["question"].fail("needs a scene whose margin is not negative");
    return q;
  }
  r.require_object(pair_query_fields);
  q.a = read_body(r["a"], scene);
  q.b = read_body(r["b"], scene);
  if (q.a == q.b) r.fail("asks about one body; a and b must differ");
  if (q.question == Question::ray && !is_ray(scene, q))
    r.fail(
        "a ray is a body b that is a sphere of radius 0 and moves without turning, against a body a at rest");
  return q;
}

void read_version(const JsonReader& r) {
  const JsonReader v = r[version_field];
  if (v.integer() != version)
    v.fail("version " + std::to_string(v.integer()) + " is not known; this build reads version " +
           std::to_string(version));
}

Scene read_scene(const JsonReader& r, const std::string& place) {
  try {
    return scene_from_json(r.json());
  } catch (const InputError& e) {
    throw InputError(json_place(place, e.place().empty() ? "scene" : "scene." + e.place()), e.reason());
  }
}

// JSON has no NaN and no infinity.
Json invalid_to_json(double x) {
  if (std::isnan(x)) return "NaN";
  if (std::isinf(x)) return x > 0 ? "Infinity" : "-Infinity";
  return x;
}
double read_invalid(const JsonReader& r) {
  if (r.json().is_number()) return r.number();
  const std::string text = r.string();
  if (text == "NaN") return std::numeric_limits<double>::quiet_NaN();
  if (text != "Infinity" && text != "-Infinity")
    r.fail("must be a number, \"NaN\", \"Infinity\" or \"-Infinity\"");
  return text[0] == '-' ? -HUGE_VAL : HUGE_VAL;
}

// Such bodies are not exact sets: only their effect on other bodies' pairs can be judged.
void read_invalid_numbers(const JsonReader& r, Case& c) {
  for (const Query& q : c.queries)
    if (q.question != Question::candidates) r.fail("such a scene allows only candidates queries");
  std::vector<InvalidNumber> all;
  for (const auto& [place, value] : members_of(r)) all.push_back({place, read_invalid(value)});
  try {
    insert_invalid_numbers(c.scene, all);
  } catch (const InputError& e) {
    r.fail(e.place() + " " + e.reason());
  }
}

StoredCase from_scene(Scene scene) {
  StoredCase s;
  s.c.id = scene.name;
  s.c.queries = default_queries(scene);
  s.c.scene = std::move(scene);
  return s;
}

void write_list(std::string& out, const std::string& name, const Json& items) {
  out += ",\n \"" + name + "\": [";
  for (std::size_t i = 0; i < items.size(); ++i) out += (i ? ",\n  " : "\n  ") + to_line(items[i]);
  out += items.empty() ? "]" : "\n ]";
}

}  // namespace

std::vector<Query> default_queries(const Scene& scene) {
  const bool has_motion = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                      [](const Body& b) { return b.motion.has_value(); });
  std::vector<Query> q;
  if (scene.bodies.size() == 2) {
    for (Question question : {Question::overlap, Question::distance, Question::contact})
      q.push_back({question, 0, 1});
    if (has_motion) q.push_back({Question::time_of_impact, 0, 1});
    if (!scene.script.empty()) q.push_back({Question::candidates, 0, 1});
    return q;
  }
  q = {{Question::candidates, 0, 1}, {Question::scene_contacts, 0, 1}};
  if (!moves(scene)) return q;
  q.push_back({Question::swept_candidates, 0, 1});
  const auto pairs = moving_pairs(scene);
  for (std::size_t i = 0; i < std::min(pairs.size(), most_impacts_asked); ++i)
    q.push_back({Question::time_of_impact, pairs[i].first, pairs[i].second});
  return q;
}

nlohmann::ordered_json case_to_json(const Case& c) { return stored_case_to_json({c, "", "", {}}); }

nlohmann::ordered_json stored_case_to_json(const StoredCase& s) {
  Json j{{version_field, version}};
  if (!s.c.id.empty()) j["id"] = s.c.id;
  if (!s.description.empty()) j["description"] = s.description;
  if (!s.source.empty()) j["source"] = s.source;
  if (!s.c.family.empty()) j["family"] = s.c.family;
  const auto invalid = invalid_numbers(s.c.scene);
  j["scene"] = touchstone::to_json(invalid.empty() ? s.c.scene : without_invalid_numbers(s.c.scene));
  for (const InvalidNumber& n : invalid) j["invalid_numbers"][n.place] = invalid_to_json(n.value);
  j["queries"] = Json::array();
  for (const Query& q : s.c.queries) j["queries"].push_back(to_json(q));
  if (Json e = scenarios::to_json(s.expect); !e.empty()) j["expect"] = std::move(e);
  return j;
}

StoredCase stored_case_from_json(const nlohmann::ordered_json& j, const std::string& place) {
  const JsonReader r(j, place);
  r.require_object(case_fields);
  read_version(r);
  StoredCase s;
  if (r.has("id")) s.c.id = r["id"].string();
  if (r.has("description")) s.description = r["description"].string();
  if (r.has("source")) s.source = r["source"].string();
  if (r.has("family")) s.c.family = r["family"].string();
  s.c.scene = read_scene(r["scene"], place);
  if (r.has("queries"))
    for (const JsonReader& q : r["queries"].items()) s.c.queries.push_back(read_query(q, s.c.scene));
  else
    s.c.queries = default_queries(s.c.scene);
  for (const char* const name : {"invalid_numbers", former_invalid_numbers})
    if (r.has(name)) read_invalid_numbers(r[name], s.c);
  if (r.has("expect")) s.expect = scenarios::read_expectation(r["expect"]);
  return s;
}

Case case_from_json(const nlohmann::ordered_json& j, const std::string& place) {
  return stored_case_from_json(j, place).c;
}

StoredCase load_stored_case(const std::filesystem::path& file) {
  const std::string place = file.string();
  const Json j = parse_json(read_file(file), place);
  const bool bare_scene = j.is_object() && j.contains(scene_fields::version_field);
  StoredCase s = bare_scene ? from_scene(scene_from_json(j, place)) : stored_case_from_json(j, place);
  if (s.c.id.empty()) s.c.id = file.stem().string();
  return s;
}

Case load_case(const std::filesystem::path& file) { return load_stored_case(file).c; }

std::string to_text(const StoredCase& s) {
  const Json j = stored_case_to_json(s);
  std::string out = "{\"touchstone_case\": " + std::to_string(version);
  for (const char* field : {"id", "description", "source", "family"})
    if (j.contains(field)) out += ",\n \"" + std::string(field) + "\": " + to_line(j[field]);
  std::string scene = touchstone::to_text(without_invalid_numbers(s.c.scene));
  scene.pop_back();  // the newline
  out += ",\n\"scene\": " + scene;
  if (j.contains("invalid_numbers")) out += ",\n \"invalid_numbers\": " + to_line(j["invalid_numbers"]);
  write_list(out, "queries", j["queries"]);
  if (j.contains("expect")) out += ",\n \"expect\": " + to_line(j["expect"]);
  return out + "\n}\n";
}

void save_case(const StoredCase& s, const std::filesystem::path& file) { write_file(file, to_text(s)); }

namespace scenarios {

std::vector<StoredCase> load_corpus(const std::filesystem::path& directory) {
  std::error_code ec;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(directory, ec))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  if (ec) throw InputError(directory.string(), "cannot be listed: " + ec.message());
  std::sort(files.begin(), files.end());
  std::vector<StoredCase> all;
  for (const auto& file : files) all.push_back(load_stored_case(file));
  return all;
}

}  // namespace scenarios
}  // namespace touchstone
