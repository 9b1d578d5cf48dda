#include "fuzz/causes/examinations.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "core/base/input_error.h"
#include "fuzz/shrink/canonical.h"
#include "reports/record/stored.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/codec/scene_codec.h"
#include "scenarios/text/printable.h"

namespace touchstone::fuzz {
namespace {

constexpr const char* key_field = "key";

template <class Enum>
Enum one_of(const JsonReader& j, std::size_t count) {
  const std::uint64_t n = count_of(j);
  if (n >= count) j.fail(fmt::format("is not below {}", count));
  return static_cast<Enum>(n);
}

template <class Enum>
Json number_of(Enum e) {
  return static_cast<std::uint64_t>(e);
}

// What is printed later has no control characters.
std::string text_of(const JsonReader& j) { return printable(j.string(), "\n"); }

Json json_of(const Symptom& s) {
  return Json::array({std::string(to_string(s.question)), number_of(s.stage), s.detail});
}

Symptom symptom_from(const JsonReader& j) {
  const auto parts = j.items(3);
  const auto question = question_from_string(parts[0].string());
  if (!question) parts[0].fail("is no question");
  return {*question, one_of<FaultStage>(parts[1], fault_stage_names.size()), text_of(parts[2])};
}

Json json_of(const Deviation& d) {
  Json of = Json::array();
  for (const double x : d.of) of.push_back(number(x));
  return Json::array({d.manner, number(d.error), std::move(of)});
}

Deviation deviation_from(const JsonReader& j) {
  const auto parts = j.items(3);
  Deviation d;
  d.manner = text_of(parts[0]);
  d.error = number_from(parts[1]);
  const auto of = parts[2].items(d.of.size());
  for (std::size_t i = 0; i < d.of.size(); ++i) d.of[i] = number_from(of[i]);
  return d;
}

Json json_of(const Responses& r) {
  Json responses = Json::array(), deviations = Json::array(), laws = Json::array(), also = Json::array();
  for (const Responded& x : r.responses)
    responses.push_back(Json::array({x.intervention, x.change, number_of(x.response)}));
  for (const Deviation& d : r.deviations) deviations.push_back(json_of(d));
  for (const ErrorLaw& law : r.laws)
    laws.push_back(Json::array({number_of(law.reference), number(law.factor)}));
  for (const Symptom& s : r.also) also.push_back(json_of(s));
  return {{"shown", r.shown},
          {"error_in_l", number(r.error_in_l)},
          {"faults", r.faults},
          {"responses", std::move(responses)},
          {"deviation", json_of(r.deviation)},
          {"deviations", std::move(deviations)},
          {"laws", std::move(laws)},
          {"also", std::move(also)}};
}

Responses responses_from(const JsonReader& j) {
  Responses r;
  r.shown = j["shown"].boolean();
  r.error_in_l = number_from(j["error_in_l"]);
  for (const JsonReader& fault : j["faults"].items()) r.faults.insert(text_of(fault));
  for (const JsonReader& item : j["responses"].items()) {
    const auto parts = item.items(3);
    r.responses.push_back(
        {text_of(parts[0]), text_of(parts[1]), one_of<Response>(parts[2], response_names.size())});
  }
  r.deviation = deviation_from(j["deviation"]);
  for (const JsonReader& d : j["deviations"].items(r.responses.size()))
    r.deviations.push_back(deviation_from(d));
  for (const JsonReader& law : j["laws"].items()) {
    const auto parts = law.items(2);
    r.laws.push_back({one_of<Reference>(parts[0], references.size()), number_from(parts[1])});
  }
  for (const JsonReader& s : j["also"].items()) r.also.insert(symptom_from(s));
  return r;
}

Json json_of(const Examined& e) {
  return {{"smallest", case_to_json(e.smallest)},
          {"defensible", e.defensible ? case_to_json(*e.defensible) : Json()},
          {"responses", json_of(e.responses)}};
}

Examined examined_from(const JsonReader& j) {
  Examined e;
  e.smallest = campaign_case(j["smallest"].json(), j["smallest"].place());
  if (const JsonReader d = j["defensible"]; !d.json().is_null())
    e.defensible = campaign_case(d.json(), d.place());
  e.responses = responses_from(j["responses"]);
  e.canonical = canonical(e.shown());
  return e;
}

}  // namespace

Json examination_json(const Representative& r) {
  return {{key_field, r.finding->key()},
          {"failing", r.failing ? to_json(*r.failing) : Json()},
          {"first", json_of(r.first)},
          {"second", r.second ? json_of(*r.second) : Json()}};
}

void restore_examination(Representative& r, const JsonReader& j) {
  if (const JsonReader f = j["failing"]; !f.json().is_null()) {
    r.failing = finding_from_json(f);
    r.symptom = symptom_of(*r.failing);
  }
  r.first = examined_from(j["first"]);
  if (const JsonReader s = j["second"]; !s.json().is_null()) r.second = examined_from(s);
  r.asked = true;
}

Examinations::Examinations(std::filesystem::path file, Json about)
    : file_(std::move(file)), about_(std::move(about)) {
  if (!std::filesystem::exists(file_)) return;
  const std::string text = read_file(file_, campaign_limits.bytes);
  std::size_t at = 0;
  for (std::size_t line = 1, end = text.find('\n'); end != std::string::npos;
       ++line, at = end + 1, end = text.find('\n', at)) {
    const std::string place = fmt::format("{}: line {}", file_.string(), line);
    Json j = parse_json(std::string_view(text).substr(at, end - at), place, campaign_limits);
    if (line == 1) {
      is_begun_ = j == about_;
      if (!is_begun_) return;
      continue;
    }
    std::string key = JsonReader(j, place)[key_field].string();
    known_.insert_or_assign(std::move(key), std::move(j));
  }
  if (is_begun_) std::filesystem::resize_file(file_, at);
}

bool Examinations::restore(Representative& r) const {
  const auto known = known_.find(r.finding->key());
  if (known == known_.end()) return false;
  restore_examination(r, JsonReader(known->second, file_.string(), known->first));
  return true;
}

void Examinations::add(const Representative& r) {
  if (!not_kept_.empty()) return;
  if (!is_begun_) {
    std::error_code error;
    std::filesystem::remove(file_, error);
    if (error) not_kept_ = fmt::format("{}: {}", file_.string(), error.message());
    append(about_);
    is_begun_ = true;
  }
  append(examination_json(r));
  ++added_;
}

void Examinations::append(const Json& line) {
  if (!not_kept_.empty()) return;
  std::ofstream out(file_, std::ios::binary | std::ios::app);
  out << json_text(line) << '\n';
  out.flush();
  if (!out) not_kept_ = fmt::format("{}: {}", file_.string(), std::strerror(errno));
}

void Examinations::remove() {
  std::error_code error;
  std::filesystem::remove(file_, error);
  if (error) not_kept_ = fmt::format("{}: {}", file_.string(), error.message());
}

}  // namespace touchstone::fuzz
