#include "fuzz/bisect/releases.h"

#include <algorithm>
#include <set>

#include "core/base/input_error.h"
#include "fuzz/ask/ask.h"

namespace touchstone::fuzz {
namespace {

constexpr std::string_view crashed = "crashed";

CampaignResult judged(const Case& c, const FaultSought& sought, const EnginePtr& engine,
                      const CaseObservations& observed) {
  CampaignResult r;
  if (sought.by != FoundBy::referee) relate_into(r, c, 0, engine, observed);
  judge_into(r, c, 0, {&engine, 1}, {&observed, 1});
  return r;
}

bool is_sought(const Finding& f, const FaultSought& sought) {
  if (f.question != sought.question) return false;
  return sought.fault == crashed ? f.fault.starts_with(crashed) : f.fault == sought.fault;
}

// Why a question was not answered, in the engine's own words.
std::string why_not(const Case& c, const CaseObservations& observed, const std::string& question) {
  for (std::size_t i = 0; i < observed.answers.size(); ++i)
    if (to_string(c.queries[i].question) == question && !observed.answers[i].detail.empty())
      return observed.answers[i].detail;
  return "";
}

ReleaseSays without_fault(const Case& c, const FaultSought& sought, const CampaignResult& r,
                          const std::string& engine, const CaseObservations& observed) {
  const auto question = question_from_string(sought.question);
  const auto of_engine = r.tallies.find(engine);
  if (!question || of_engine == r.tallies.end() || !of_engine->second.contains(*question))
    return {Showing::open, "the case does not ask this question"};
  const Tally& t = of_engine->second.at(*question);
  if (t.unsupported() + t.not_asked() > 0 && t.answered() == 0)
    return {Showing::lacks, why_not(c, observed, sought.question)};
  if (t.undecided + t.not_judged > 0) return {Showing::open, "the referee could not decide"};
  return {Showing::right, ""};
}

// The releases between lo and hi (exclusive), the nearest to their middle first.
std::vector<std::size_t> from_the_middle(std::size_t lo, std::size_t hi) {
  std::vector<std::size_t> all;
  for (std::size_t i = lo; i < hi; ++i) all.push_back(i);
  const std::size_t middle = lo + (hi - lo) / 2;
  std::stable_sort(all.begin(), all.end(), [&](std::size_t a, std::size_t b) {
    const auto apart = [&](std::size_t x) { return x > middle ? x - middle : middle - x; };
    return apart(a) < apart(b);
  });
  return all;
}

}  // namespace

FaultSought fault_in(const std::string& key, const std::string& engine) {
  const auto refuse = [&] { throw InputError("key " + key, "is not of a finding of " + engine); };
  if (!key.starts_with(engine + ".")) refuse();
  const std::string rest = key.substr(engine.size() + 1);
  const auto first = rest.find('.'), second = rest.find('.', first + 1);
  if (first == std::string::npos || second == std::string::npos) refuse();
  FaultSought sought{rest.substr(0, first), rest.substr(first + 1, second - first - 1), found_by(key)};
  if (sought.fault.starts_with(crashed)) sought.fault = crashed;
  return sought;
}

ReleaseSays ask_release(const Case& c, const FaultSought& sought, const EnginePtr& engine) {
  const CaseObservations observed = engine->run({&c, 1}).front();
  const CampaignResult r = judged(c, sought, engine, observed);
  const Finding* other = nullptr;
  for (const auto& [key, f] : r.findings) {
    if (is_sought(f, sought)) return {Showing::shows, f.words};
    if (f.question == sought.question && !other) other = &f;
  }
  if (other) return {Showing::differs, other->fault + ": " + other->words};
  return without_fault(c, sought, r, engine->card().name, observed);
}

Verdict verdict_of(const ReleaseSays& says) {
  switch (says.showing) {
    case Showing::shows:
      return Verdict::bad;
    case Showing::right:
    case Showing::differs:
      return Verdict::good;
    default:
      return Verdict::skip;
  }
}

FirstBad first_bad(std::size_t count, const std::function<Verdict(std::size_t)>& ask) {
  FirstBad r{count - 1, std::nullopt, {}};
  std::set<std::size_t> skipped;
  const auto lo = [&] { return r.good ? *r.good + 1 : 0; };
  for (bool narrowed = true; narrowed;) {
    narrowed = false;
    for (const std::size_t i : from_the_middle(lo(), r.bad)) {
      if (skipped.contains(i)) continue;
      const Verdict v = ask(i);
      if (v == Verdict::skip) {
        skipped.insert(i);
        continue;
      }
      if (v == Verdict::bad)
        r.bad = i;
      else
        r.good = i;
      narrowed = true;
      break;
    }
  }
  r.skipped.assign(skipped.lower_bound(lo()), skipped.lower_bound(r.bad));
  return r;
}

}  // namespace touchstone::fuzz
