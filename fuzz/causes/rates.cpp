#include "fuzz/causes/classes.h"

#include <set>
#include <string>
#include <tuple>

namespace touchstone::fuzz {
namespace {

// Answers and failures of the engine to a question about such shapes.
std::uint64_t answers_about(const CampaignResult& r, const std::string& engine, Question q,
                            const std::string& shapes) {
  if (const auto of_engine = r.open.find(engine); of_engine != r.open.end())
    if (const auto pairs = of_engine->second.find(q); pairs != of_engine->second.end())
      if (const auto n = pairs->second.find(shapes); n != pairs->second.end()) return n->second.answers;
  const auto of_engine = r.tallies.find(engine);
  if (of_engine == r.tallies.end()) return 0;
  const auto tally = of_engine->second.find(q);
  return tally == of_engine->second.end() ? 0 : tally->second.answered() + tally->second.failed();
}

}  // namespace

std::uint64_t asked_about(const CampaignResult& result, std::span<const Finding* const> findings) {
  std::set<std::tuple<std::string, std::string, std::string>> counted;
  std::uint64_t asked = 0;
  for (const Finding* f : findings) {
    const auto question = question_from_string(f->question);
    const bool whole = !question || !is_pair_question(*question) || f->shapes == any_shapes;
    const std::string shapes = whole ? "all" : f->shapes;
    if (question && counted.emplace(f->engine, f->question, shapes).second)
      asked += answers_about(result, f->engine, *question, shapes);
  }
  return asked;
}

std::vector<double> rates_of(const std::vector<FindingClass>& classes, const CampaignResult& result) {
  std::vector<double> rates;
  for (const FindingClass& c : classes) {
    const std::uint64_t asked = asked_about(result, c.findings);
    rates.push_back(asked > 0 ? static_cast<double>(c.count) / static_cast<double>(asked) : 0);
  }
  return rates;
}

}  // namespace touchstone::fuzz
