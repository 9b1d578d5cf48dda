#include "reports/record/expected.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "scenarios/codec/json_file.h"
#include "scenarios/text/iso_date.h"
#include "scenarios/text/printable.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {
namespace {

std::string name_from(const JsonReader& j) {
  const std::string text = j.string();
  if (text.empty() || printable(text) != text) j.fail("is not a name: " + printable(text));
  return text;
}

std::string question_from(const JsonReader& j) {
  const std::string text = j.string();
  if (!question_from_string(text)) j.fail("is not a question: " + printable(text));
  return text;
}

ExpectedFailure entry_from(const JsonReader& j) {
  constexpr auto fields =
      std::to_array<std::string_view>({"case", "engine", "question", "fault", "reason", "until"});
  j.require_object(fields);
  ExpectedFailure e;
  e.asked = {name_from(j["case"]), name_from(j["engine"]), question_from(j["question"])};
  e.fault = name_from(j["fault"]);
  e.reason = printable(j["reason"].string(), "\n");
  if (e.reason.find_first_not_of(" \n") == std::string::npos) j["reason"].fail("is empty");
  if (!j.has("until")) return e;
  e.until = j["until"].string();
  if (!is_iso_date(e.until)) j["until"].fail("is not a date such as 2026-11-23: " + printable(e.until));
  return e;
}

auto identity(const ExpectedFailure& e) { return std::tie(e.asked, e.fault); }

// Of entries that cover one of several failures.
using Identities = std::set<std::tuple<AskedQuestion, std::string>>;
void add(Identities& of, const Failure& f) {
  of.insert({f.asked, f.fault});
  of.insert({f.asked, any_fault});
}

bool has_ended(const ExpectedFailure& e, const std::string& today) {
  return !e.until.empty() && today.substr(0, iso_date_length) > e.until;
}

bool covers(const ExpectedFailure& e, const Failure& f) {
  return e.asked == f.asked && (e.fault == any_fault || e.fault == f.fault);
}

// By question and fault; of several, the first.
std::vector<Failure> sorted(std::vector<Failure> all) {
  const auto identity_of = [](const Failure& f) { return std::tie(f.asked, f.fault); };
  std::stable_sort(all.begin(), all.end(),
                   [&](const Failure& x, const Failure& y) { return identity_of(x) < identity_of(y); });
  const auto same = [&](const Failure& x, const Failure& y) { return identity_of(x) == identity_of(y); };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  return all;
}

// The entries about each question.
using ByQuestion = std::map<AskedQuestion, std::vector<const ExpectedFailure*>>;

void file_under(ExpectedComparison& r, const Failure& f, const ByQuestion& entries,
                const std::string& today) {
  std::string ended;
  if (const auto of_question = entries.find(f.asked); of_question != entries.end())
    for (const ExpectedFailure* e : of_question->second) {
      if (!covers(*e, f)) continue;
      if (!has_ended(*e, today)) {
        r.as_expected.push_back({f, e->reason});
        return;
      }
      ended = fmt::format("expected until {}: {}", e->until, e->reason);
    }
  r.newly_wrong.push_back({f, ended});
}

Json entry_json(const AskedQuestion& a, const std::string& fault) {
  return {{"case", a.case_id}, {"engine", a.engine}, {"question", a.question}, {"fault", fault}};
}

Json entry_json(const ExpectedFailure& e) {
  Json j = entry_json(e.asked, e.fault);
  j["reason"] = e.reason;
  if (!e.until.empty()) j["until"] = e.until;
  return j;
}

Json entry_json(const ExpectedComparison::Filed& filed) {
  Json j = entry_json(filed.failure.asked, filed.failure.fault);
  j["words"] = filed.failure.words;
  j["why"] = filed.why;
  return j;
}

template <class T>
Json list(const std::vector<T>& all) {
  Json j = Json::array();
  for (const T& one : all) j.push_back(entry_json(one));
  return j;
}

}  // namespace

std::vector<ExpectedFailure> expected_from_json(const JsonReader& j) {
  constexpr auto fields = std::to_array<std::string_view>({"touchstone_expected", "failures"});
  j.require_object(fields);
  if (count_of(j["touchstone_expected"]) != 1)
    j["touchstone_expected"].fail("is a version that is not known");
  std::vector<ExpectedFailure> all;
  Identities seen;
  for (const JsonReader& item : j["failures"].items()) {
    all.push_back(entry_from(item));
    if (!seen.insert(identity(all.back())).second) item.fail("is there twice");
  }
  return all;
}

Json to_json(std::vector<ExpectedFailure> expected) {
  std::sort(expected.begin(), expected.end());
  return {{"touchstone_expected", 1}, {"failures", list(expected)}};
}

ExpectedComparison compare(const std::vector<ExpectedFailure>& expected, const ShownFailures& shown,
                           const std::string& today) {
  ByQuestion entries;
  for (const ExpectedFailure& e : expected) entries[e.asked].push_back(&e);
  ExpectedComparison r;
  Identities wrong;
  for (const Failure& f : sorted(shown.failures)) {
    file_under(r, f, entries, today);
    add(wrong, f);
  }
  for (const ExpectedFailure& e : expected) {
    if (wrong.contains(identity(e))) continue;
    (shown.answered.contains(e.asked) ? r.fixed : r.not_asked).push_back(e);
  }
  std::sort(r.fixed.begin(), r.fixed.end());
  std::sort(r.not_asked.begin(), r.not_asked.end());
  return r;
}

std::vector<ExpectedFailure> as_shown(const std::vector<ExpectedFailure>& expected,
                                      const ExpectedComparison& compared, const std::string& reason) {
  Identities ended, fixed;
  for (const auto& newly : compared.newly_wrong) add(ended, newly.failure);
  for (const ExpectedFailure& e : compared.fixed) fixed.insert(identity(e));
  std::vector<ExpectedFailure> r;
  for (const ExpectedFailure& e : expected)
    if (!fixed.contains(identity(e)) && !ended.contains(identity(e))) r.push_back(e);
  for (const auto& newly : compared.newly_wrong)
    r.push_back({newly.failure.asked, newly.failure.fault, reason, ""});
  std::sort(r.begin(), r.end());
  return r;
}

std::string summary_of(const ExpectedComparison& c) {
  return fmt::format("{} wrong as expected, {} fixed, {} newly wrong, {} not asked", c.as_expected.size(),
                     c.fixed.size(), c.newly_wrong.size(), c.not_asked.size());
}

Json to_json(const ExpectedComparison& c) {
  return {{"as_expected", list(c.as_expected)},
          {"fixed", list(c.fixed)},
          {"newly_wrong", list(c.newly_wrong)},
          {"not_asked", list(c.not_asked)}};
}

}  // namespace touchstone::fuzz
