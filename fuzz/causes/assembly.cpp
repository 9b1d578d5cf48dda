#include "fuzz/causes/assembly.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "core/base/exact_text.h"
#include "core/base/hash.h"
#include "fuzz/causes/classes.h"
#include "fuzz/causes/intervention.h"
#include "fuzz/causes/name.h"
#include "reports/record/result.h"
#include "scenarios/codec/case_codec.h"

namespace touchstone::fuzz {
namespace {

using Texts = std::set<std::string>;

// A reduced case may have kinds of shapes that no pair of the cause has: no title speaks of these.
Responses without_absent_kinds(Responses r, const std::vector<std::string>& pairs) {
  for (const Intervention& i : interventions) {
    const auto may_have_it = [&](const std::string& pair) {
      const auto kinds = kinds_of_pair(pair);
      return !kinds || kinds->first == *i.replaces || kinds->second == *i.replaces;
    };
    if (!i.replaces || std::ranges::any_of(pairs, may_have_it)) continue;
    for (Responded& x : r.responses)
      if (x.intervention == i.name && x.response == Response::gone) x.response = Response::differs;
  }
  return r;
}

std::vector<std::string> listed(const Texts& texts) { return {texts.begin(), texts.end()}; }

std::string joined(const Texts& texts) {
  std::string all;
  for (const std::string& text : texts) {
    if (!all.empty()) all += ", ";
    all += text;
  }
  return all;
}

// A word that may name a directory.
std::string id_word(const std::string& text) {
  std::string word;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    const bool upper = c >= 'A' && c <= 'Z';
    word += plain ? c : upper ? static_cast<char>(c - 'A' + 'a') : '-';
  }
  return word;
}

constexpr std::string_view not_shown = "not shown";

CauseCase of_example(const Finding& f, const Example& e) {
  return {f.engine, f.key(), case_to_json(*e.c), f.words, e.error_in_l, e.size};
}

// The example that is best by `is_better`, the first of equals; an empty case if there is none.
template <class IsBetter>
CauseCase best_example(const std::vector<const Finding*>& findings, IsBetter&& is_better) {
  const Finding* of = nullptr;
  const Example* best = nullptr;
  for (const Finding* f : findings)
    for (const Example& e : f->examples)
      if (e.c && (!best || is_better(e, *best))) {
        of = f;
        best = &e;
      }
  return best ? of_example(*of, *best) : CauseCase{};
}

// An answer may have several faults, each in a finding of its own: of all findings of one engine about one
// question and the same shapes, the most frequent fault counts. At most the true number.
std::uint64_t wrong_answers(const std::vector<const Finding*>& findings) {
  std::map<std::tuple<std::string, std::string, std::string>, std::map<std::string, std::uint64_t>> counts;
  for (const Finding* f : findings) counts[{f->engine, f->question, f->shapes}][f->fault] += f->count;
  std::uint64_t n = 0;
  for (const auto& [place, by_fault] : counts)
    n += std::ranges::max_element(by_fault, {}, [](const auto& x) { return x.second; })->second;
  return n;
}

// Of a failure at a known place in the code, whose key names no shapes: those of its cases.
void add_shapes(const Finding& f, Texts& shapes) {
  Texts of_cases;
  if (f.shapes == any_shapes)
    for (const Example& e : f.examples)
      if (e.c)
        for (const Query& q : e.c->queries)
          if (to_string(q.question) == f.question) of_cases.insert(shapes_of(*e.c, q.a, q.b));
  if (of_cases.empty()) of_cases.insert(f.shapes);
  shapes.merge(of_cases);
}

std::string most_frequent_fault(const std::vector<const Finding*>& findings, Severity severity) {
  std::map<std::string, std::uint64_t> counts;
  for (const Finding* f : findings)
    if (severity_of(*f) == severity) counts[f->fault] += f->count;
  return std::ranges::max_element(counts, {}, [](const auto& x) { return x.second; })->first;
}

}  // namespace

Assembly::Findings Assembly::findings_of(const Group& g) const {
  Findings findings;
  for (const std::size_t m : g.members)
    findings.insert(findings.end(), all_[m].stands_for.begin(), all_[m].stands_for.end());
  return findings;
}

Cause Assembly::cause_of(const Group& g) const {
  const Findings findings = findings_of(g);
  Cause c;
  Texts paths, routes;
  for (const std::size_t m : g.members) {
    paths.insert(classes_[all_[m].of_class].path);
    routes.insert(classes_[all_[m].of_class].route);
  }
  c.path = joined(paths);
  c.route = joined(routes);
  c.documented = g.documented;
  add_lists(c, findings);
  c.wrong = wrong_answers(findings);
  c.asked = std::max(c.wrong, asked_about(result_, findings));
  add_consequences(c, g);
  add_name(c, g, findings, listed(routes));
  c.worst =
      best_example(findings, [](const Example& x, const Example& y) { return x.error_in_l > y.error_in_l; });
  c.smallest = best_example(findings, [](const Example& x, const Example& y) { return x.size < y.size; });
  return c;
}

void Assembly::add_lists(Cause& c, const Findings& findings) const {
  Texts engines, questions, faults, shapes, families, keys;
  c.first_index = ~std::uint64_t{0};
  for (const Finding* f : findings) {
    engines.insert(f->engine);
    questions.insert(f->question);
    faults.insert(f->fault);
    add_shapes(*f, shapes);
    keys.insert(f->key());
    for (const Example& e : f->examples)
      if (e.c) families.insert(e.c->family);
    c.severity = std::min(c.severity, severity_of(*f));
    c.first_index = std::min(c.first_index, f->first_index);
    c.worst_in_l = std::max(c.worst_in_l, f->worst_in_l);
  }
  c.engines = listed(engines);
  c.questions = listed(questions);
  c.faults = listed(faults);
  c.shapes = listed(shapes);
  c.families = listed(families);
  c.keys = listed(keys);
}

void Assembly::add_consequences(Cause& c, const Group& g) const {
  std::map<std::string, std::uint64_t> counts;
  Texts keys(c.keys.begin(), c.keys.end());
  const auto add = [&](const Finding& f) {
    counts[fmt::format("{} {}", f.question, f.fault)] += f.count;
    keys.insert(f.key());
  };
  for (const std::size_t m : g.consequences)
    for (const Finding* f : all_[m].stands_for) add(*f);
  for (const Finding* f : g.explained) add(*f);
  for (const auto& [what, n] : counts) c.consequences.push_back(fmt::format("{} ({})", what, n));
  c.keys = listed(keys);
}

std::uint64_t Assembly::wrong(const Group& g) const { return wrong_answers(findings_of(g)); }

// The first key, in their order, that has at least an eighth as many wrong answers as the most frequent one:
// what is rare in one campaign may be absent from the next, and must not change a cause's id.
template <class KeyOf>
auto Assembly::first_frequent(const Group& g, KeyOf&& key_of) const {
  constexpr std::uint64_t rare = 8;
  std::map<std::decay_t<decltype(key_of(g.members.front()))>, std::uint64_t> counts;
  std::uint64_t most = 0;
  for (const std::size_t m : g.members)
    for (const Finding* f : all_[m].stands_for) most = std::max(most, counts[key_of(m)] += f->count);
  return std::ranges::find_if(counts, [&](const auto& x) { return rare * x.second >= most; })->first;
}

std::string Assembly::path_word(const Group& g) const {
  return id_word(first_frequent(g, [&](std::size_t m) { return classes_[all_[m].of_class].path; }));
}

std::uint64_t Assembly::place_hash(const Group& g) const {
  Hasher hash;
  hash.add(path_word(g)).add(symptom(g).detail).add(g.documented);
  if (!g.documented.empty()) return hash.value();
  hash.add(first_frequent(g, [&](std::size_t m) { return classes_[all_[m].of_class].route; }));
  hash.add(to_string(first_frequent(g, [&](std::size_t m) { return all_[m].symptom.question; })));
  return hash.value();
}

std::uint64_t Assembly::response_hash(const Group& g, std::uint64_t place) const {
  const Responses of_all = common_response(g);
  Hasher hash;
  hash.add(place).add(reason_of(g, of_all));
  if (!g.shown_only_by.empty()) hash.add(g.shown_only_by);
  if (!is_exact(g)) return hash.value();
  for (const Responded& r : of_all.responses) hash.add(to_string(r.response));
  for (const std::string& fault : of_all.faults) hash.add(fault);
  hash.add(of_all.deviation.manner);
  for (const ErrorLaw& law : of_all.laws) hash.add(static_cast<int>(law.reference));
  const Case& shown = leader(g).first.shown();
  hash.add(shown.scene.bodies.size()).add(shown.scene.script.size());
  for (const Shape& shape : shown.scene.shapes) hash.add(type_name(shape));
  if (std::isfinite(of_all.error_in_l) && of_all.error_in_l > 0) hash.add(std::ilogb(of_all.error_in_l));
  return hash.value();
}

std::vector<Group> Assembly::identified(std::vector<Group> groups) const {
  std::stable_sort(groups.begin(), groups.end(),
                   [&](const Group& x, const Group& y) { return wrong(x) > wrong(y); });
  std::set<std::pair<FaultStage, std::uint64_t>> taken;  // places, each by the most frequent group there
  std::map<std::string, std::size_t> known;
  std::vector<Group> distinct;
  for (Group& g : groups) {
    const std::uint64_t place = place_hash(g);
    const bool is_first = taken.insert({symptom(g).stage, place}).second && !is_exact(g);
    constexpr std::size_t digits = 6;
    g.id = fmt::format("{}-{}-{}", path_word(g), to_string(symptom(g).stage),
                       hex64(is_first ? place : response_hash(g, place)).substr(0, digits));
    const auto [at, is_new] = known.try_emplace(g.id, distinct.size());
    if (is_new) {
      distinct.push_back(std::move(g));
      continue;
    }
    Group& to = distinct[at->second];
    to.members.insert(to.members.end(), g.members.begin(), g.members.end());
    to.consequences.insert(to.consequences.end(), g.consequences.begin(), g.consequences.end());
    to.explained.insert(to.explained.end(), g.explained.begin(), g.explained.end());
  }
  share_explained(distinct);
  for (Group& g : distinct) show_gravest(g);
  return distinct;
}

// The first member with the gravest fault that its case shows leads: its case is the one that people see.
void Assembly::show_gravest(Group& g) const {
  const auto severity = [&](std::size_t m) {
    const Representative& r = all_[m];
    return r.asked && r.first.responses.shown ? severity_of(r.shown()) : Severity::relation;
  };
  const auto gravest = std::ranges::min_element(g.members, {}, severity);
  std::rotate(g.members.begin(), gravest, gravest + 1);
}

// A contradiction belongs to the group that has a finding of the class that explains it: of the same engine
// about the same shapes, if there is one, else of the same engine, else the first.
void Assembly::share_explained(std::vector<Group>& groups) const {
  for (std::size_t k = 0; k < classes_.size(); ++k)
    for (const Finding* f : classes_[k].explained) {
      Group* owner = nullptr;
      int best = -1;
      for (Group& g : groups)
        for (const std::vector<std::size_t>* part : {&g.members, &g.consequences})
          for (const std::size_t m : *part) {
            if (all_[m].of_class != k) continue;
            for (const Finding* plain : all_[m].stands_for) {
              const int likeness = 2 * (plain->engine == f->engine) + (plain->shapes == f->shapes);
              if (likeness <= best) continue;
              best = likeness;
              owner = &g;
            }
          }
      owner->explained.push_back(f);  // every class has a representative
    }
}

void Assembly::add_name(Cause& c, const Group& g, const Findings& findings,
                        const std::vector<std::string>& routes) const {
  const Representative& led = leader(g);
  const Symptom& s = symptom(g);
  std::set<Question> questions;
  for (const std::size_t m : g.members) questions.insert(all_[m].symptom.question);
  // What the case that is shown shows, if it was asked.
  const bool is_shown = led.asked && led.first.responses.shown;
  const Severity severity = is_shown ? severity_of(led.shown()) : c.severity;
  c.severity = std::min(c.severity, severity);
  c.title = describe_fault(
      {severity, s, is_shown ? led.shown().fault : most_frequent_fault(findings, severity),
       s.stage == FaultStage::failure ? led.finding->words : "", routes, c.shapes, questions.size() == 1});
  const Responses of_all = common_response(g);
  c.response = of_all.responses;
  const std::string reason = reason_of(g, without_absent_kinds(seen_in_leader(g, of_all), c.shapes));
  if (reason == not_shown)
    c.title += ": not shown when its case is asked alone";
  else if (!reason.empty())
    c.title += fmt::format(": {}", describe_reason(reason, of_all, knowledge_.others(led.finding->engine)));
  if (const std::string law = describe_law(of_all.laws); !law.empty()) c.title += fmt::format("; {}", law);
  c.id = g.id;
}

// For each intervention, the response of most members; of as many, the leader's.
Responses Assembly::common_response(const Group& g) const {
  Responses common = leader(g).first.responses;
  for (std::size_t i = 0; i < common.responses.size(); ++i) {
    Response& r = common.responses[i].response;
    std::map<Response, std::size_t> votes;
    for (const std::size_t m : g.members) {
      const Responses& of = all_[m].first.responses;
      if (of.shown && i < of.responses.size() &&
          of.responses[i].intervention == common.responses[i].intervention)
        ++votes[of.responses[i].response];
    }
    votes.erase(Response::not_applicable);
    votes.erase(Response::open);
    for (const auto& [response, n] : votes)
      if (n > votes[r]) r = response;
  }
  return common;
}

// Without what makes the faults of most members vanish but not the leader's: the title is read beside its
// case.
Responses Assembly::seen_in_leader(const Group& g, Responses of_all) const {
  const std::vector<Responded>& own = leader(g).first.responses.responses;
  for (std::size_t i = 0; i < of_all.responses.size(); ++i)
    if (own[i].response != Response::gone && of_all.responses[i].response == Response::gone)
      of_all.responses[i].response = Response::differs;
  return of_all;
}

std::string Assembly::reason_of(const Group& g, const Responses& of_all) const {
  if (leader(g).asked && !leader(g).first.responses.shown) return std::string(not_shown);
  return main_reason(of_all, symptom(g).stage, knowledge_.others(leader(g).finding->engine));
}

bool Assembly::is_exact(const Group& g) const {
  const auto noise = noise_.find(classes_[leader(g).of_class].path);
  return noise == noise_.end() || fuzz::is_exact(noise->second);
}

}  // namespace touchstone::fuzz
