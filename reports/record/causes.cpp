#include "reports/record/causes.h"

#include <algorithm>

#include "reports/record/stored.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/printable.h"

namespace touchstone::fuzz {
namespace {

template <class Enum, std::size_t n>
Enum from_name(const JsonReader& j, const std::array<std::string_view, n>& names) {
  const std::string text = j.string();
  const auto at = std::find(names.begin(), names.end(), text);
  if (at == names.end()) j.fail("is none of the known words: " + printable(text));
  return static_cast<Enum>(at - names.begin());
}

std::string text_of(const JsonReader& j) { return printable(j.string(), "\n"); }

std::vector<std::string> texts_of(const JsonReader& j) {
  std::vector<std::string> all;
  for (const JsonReader& item : j.items()) all.push_back(text_of(item));
  return all;
}

Json to_json(const CauseCase& c) {
  return {{"engine", c.engine},      {"key", c.key},
          {"words", c.words},        {"error_in_l", number(c.error_in_l)},
          {"bodies", c.size.bodies}, {"steps", c.size.steps},
          {"bits", c.size.bits},     {"case", c.c}};
}

CauseCase case_from(const JsonReader& j) {
  CauseCase c;
  c.engine = text_of(j["engine"]);
  c.key = text_of(j["key"]);
  c.words = text_of(j["words"]);
  c.error_in_l = number_from(j["error_in_l"]);
  c.size.bodies = count_of(j["bodies"]);
  c.size.steps = count_of(j["steps"]);
  c.size.bits = count_of(j["bits"]);
  c.c = j["case"].json();
  return c;
}

std::string id_from(const JsonReader& j) {
  const std::string id = j.string();
  if (!is_cause_id(id)) j.fail("is not the id of a cause: " + printable(id));
  return id;
}

Cause cause_from(const JsonReader& j) {
  Cause c;
  c.id = id_from(j["id"]);
  c.path = text_of(j["path"]);
  c.library = text_of(j["library"]);
  c.route = text_of(j["route"]);
  c.title = text_of(j["title"]);
  c.severity = from_name<Severity>(j["severity"], severity_names);
  c.documented = text_of(j["documented"]);
  c.wrong = count_of(j["wrong"]);
  c.asked = count_of(j["asked"]);
  c.worst_in_l = number_from(j["worst_in_l"]);
  c.first_index = count_of(j["first_index"]);
  c.engines = texts_of(j["engines"]);
  c.questions = texts_of(j["questions"]);
  c.faults = texts_of(j["faults"]);
  c.shapes = texts_of(j["shapes"]);
  c.families = texts_of(j["families"]);
  for (const JsonReader& r : j["response"].items())
    c.response.push_back({text_of(r["intervention"]), text_of(r["change"]),
                          from_name<Response>(r["response"], response_names)});
  c.keys = texts_of(j["keys"]);
  c.consequences = texts_of(j["consequences"]);
  c.smallest = case_from(j["smallest"]);
  c.defensible = case_from(j["defensible"]);
  c.worst = case_from(j["worst"]);
  c.certificate = j["certificate"].json();
  c.program = text_of(j["program"]);
  c.no_program = text_of(j["no_program"]);
  return c;
}

}  // namespace

Json to_json(const Cause& c) {
  Json response = Json::array();
  for (const Responded& r : c.response)
    response.push_back(
        {{"intervention", r.intervention}, {"change", r.change}, {"response", to_string(r.response)}});
  return {{"id", c.id},
          {"path", c.path},
          {"library", c.library},
          {"route", c.route},
          {"title", c.title},
          {"severity", to_string(c.severity)},
          {"documented", c.documented},
          {"wrong", c.wrong},
          {"asked", c.asked},
          {"worst_in_l", number(c.worst_in_l)},
          {"first_index", c.first_index},
          {"engines", c.engines},
          {"questions", c.questions},
          {"faults", c.faults},
          {"shapes", c.shapes},
          {"families", c.families},
          {"response", std::move(response)},
          {"keys", c.keys},
          {"consequences", c.consequences},
          {"smallest", to_json(c.smallest)},
          {"defensible", to_json(c.defensible)},
          {"worst", to_json(c.worst)},
          {"certificate", c.certificate},
          {"program", c.program},
          {"no_program", c.no_program}};
}

bool is_cause_id(std::string_view id) {
  constexpr std::size_t longest = 120;
  return !id.empty() && id.size() <= longest && id.front() != '-' &&
         std::all_of(id.begin(), id.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
         });
}

Json to_json(const Causes& c) {
  Json causes = Json::array();
  for (const Cause& cause : c.causes) causes.push_back(to_json(cause));
  return {{"touchstone_causes", 1}, {"campaign", c.campaign},
          {"digest", c.digest},     {"seed", c.seed},
          {"cases", c.cases},       {"answers", c.answers},
          {"keys", c.keys},         {"unseen", number(c.unseen)},
          {"notes", c.notes},       {"causes", std::move(causes)}};
}

Causes causes_from_json(const JsonReader& j) {
  if (count_of(j["touchstone_causes"]) != 1) j["touchstone_causes"].fail("is a version that is not known");
  Causes c;
  c.campaign = text_of(j["campaign"]);
  c.digest = text_of(j["digest"]);
  c.seed = count_of(j["seed"]);
  c.cases = count_of(j["cases"]);
  c.answers = count_of(j["answers"]);
  c.keys = count_of(j["keys"]);
  c.unseen = number_from(j["unseen"]);
  c.notes = texts_of(j["notes"]);
  for (const JsonReader& cause : j["causes"].items()) c.causes.push_back(cause_from(cause));
  return c;
}

}  // namespace touchstone::fuzz
