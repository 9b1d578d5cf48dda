#include "fuzz/causes/representative.h"

#include <algorithm>
#include <set>
#include <utility>

#include "fuzz/causes/kept.h"
#include "fuzz/causes/plain_cases.h"
#include "fuzz/judge/relation.h"
#include "fuzz/shrink/canonical.h"
#include "fuzz/shrink/defensible.h"
#include "fuzz/shrink/shrink_both.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/random/numbers.h"

namespace touchstone::fuzz {
namespace {

// How alike two findings of one class are.
int likeness(const Finding& x, const Finding& y) {
  return 4 * (x.shapes == y.shapes) + 2 * (x.fault == y.fault) + (x.engine == y.engine) +
         (x.degeneracy == y.degeneracy);
}

// A question that exceeds its time costs a thousand others. A contradiction is to be compared with faults
// that are known; its case is seldom shown.
bool is_slow(const Symptom& s) { return s.detail.starts_with(to_string(Outcome::timed_out)); }
std::size_t tries_for(const Representative& r, std::size_t tries) {
  constexpr std::size_t most_if_slow = 12;
  if (is_slow(r.symptom)) return std::min(tries, most_if_slow);
  return is_relation(r.finding->fault) ? tries / 4 : tries;
}

// The examples whose cases are stored, the simplest first.
std::vector<const Case*> starting_cases(const Finding& f) {
  std::vector<const Example*> all;
  for (const Example& e : f.examples)
    if (e.c) all.push_back(&e);
  std::stable_sort(all.begin(), all.end(),
                   [](const Example* x, const Example* y) { return x->size < y->size; });
  std::vector<const Case*> cases;
  for (const Example* e : all) cases.push_back(e->c.get());
  return cases;
}

StillShows and_is_defensible(const StillShows& still) {
  return [&still](std::span<const Case> cases) {
    std::vector<bool> shows = still(cases);
    for (std::size_t i = 0; i < cases.size(); ++i) shows[i] = shows[i] && is_defensible(cases[i]);
    return shows;
  };
}

// What is defensible stays so, and the smallest case gets no larger.
void normalize(Examined& e, const StillShows& still, PlainForms forms) {
  // Of all plain cases, the first one may not be defensible where a later one is.
  const bool pass_over = e.defensible && forms == PlainForms::all;
  Case plain = normal_form(e.shown(), pass_over ? and_is_defensible(still) : still, forms);
  if (e.defensible) {
    if (is_defensible(plain)) e.defensible = std::move(plain);
  } else if (measure(plain) < measure(e.smallest) && (is_solid(plain) || !is_solid(e.smallest))) {
    e.smallest = std::move(plain);
  }
}

}  // namespace

std::vector<Representative> representatives_of(const FindingClass& c, std::size_t of_class,
                                               std::size_t most) {
  std::vector<const Finding*> unlike, alike;
  std::set<std::pair<std::string, std::string>> taken;
  for (const Finding* f : c.findings)
    (taken.emplace(f->shapes, f->fault).second ? unlike : alike).push_back(f);
  unlike.insert(unlike.end(), alike.begin(), alike.end());
  std::vector<Representative> chosen;
  for (const Finding* f : unlike) {
    if (chosen.size() >= most) break;
    Representative r;
    r.of_class = of_class;
    r.symptom = c.symptom;
    r.finding = f;
    r.stands_for.push_back(f);
    chosen.push_back(std::move(r));
  }
  for (std::size_t i = chosen.size(); i < unlike.size(); ++i) {
    const auto nearest =
        std::max_element(chosen.begin(), chosen.end(), [&](const Representative& x, const Representative& y) {
          return likeness(*x.finding, *unlike[i]) < likeness(*y.finding, *unlike[i]);
        });
    nearest->stands_for.push_back(unlike[i]);
  }
  return chosen;
}

Case case_of(const Finding& f) { return case_from_json(f.evidence_json.at("case"), f.key()); }

void examine(Representative& r, const EngineKnowledge& knowledge, std::size_t tries, bool twice,
             EnginePool& pool) {
  const std::vector<const Case*> cases = starting_cases(*r.finding);
  r.first.smallest = cases.empty() ? case_of(*r.finding) : *cases.front();
  const EnginePtr& engine = pool.named(r.finding->engine);
  if (!engine) return;
  engine->resume();
  if (r.symptom.stage == FaultStage::contradiction)
    if (auto plain = plain_form(r.first.smallest, r.symptom.question, engine)) {
      r.first.smallest = std::move(plain->c);
      r.failing = std::move(plain->finding);
      r.symptom = symptom_of(*r.failing);
    }
  const std::vector<OtherEngine> others = knowledge.others(r.finding->engine);
  const PlainForms forms = knowledge.knows_routes(r.finding->engine) ? PlainForms::nearest : PlainForms::all;
  const auto examined = [&](const Case& from) {
    const StillShows still = keeps(engine, kept_of(from, r.shown(), engine, knowledge), knowledge);
    ShrunkPair shrunk = shrink_solid(from, still, tries_for(r, tries));
    Examined e{std::move(shrunk.minimum.smallest), {}, {}, {}};
    if (shrunk.defensible) e.defensible = std::move(shrunk.defensible->smallest);
    if (!is_slow(r.symptom)) normalize(e, still, forms);
    e.responses = respond(e.shown(), r.symptom, r.finding->engine, others, pool);
    e.canonical = canonical(e.shown());
    return e;
  };
  r.first = examined(r.first.smallest);
  r.asked = true;
  if (twice && cases.size() > 1 && !is_slow(r.symptom) && !is_relation(r.finding->fault))
    r.second = examined(*cases.back());
}

}  // namespace touchstone::fuzz
