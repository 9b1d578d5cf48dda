#include "tests/mutants/equal_lies.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

#include "fuzz/causes/representative.h"
#include "fuzz/causes/respond.h"

namespace touchstone::mutants {
namespace {

class Comparison {
 public:
  Comparison(const fuzz::CampaignResult& result, const fuzz::MakeEngine& make)
      : result_(result), make_(make) {}

  // On the case of a finding and its changed forms.
  bool answer_alike(const std::string& x, const std::string& y, const std::string& key) {
    const fuzz::Responses &p = responses(x, key), &q = responses(y, key);
    return p.shown == q.shown && p.faults == q.faults && p.responses == q.responses && p.also == q.also &&
           p.error_in_l == q.error_in_l;
  }

 private:
  const fuzz::Responses& responses(const std::string& engine, const std::string& key) {
    const auto [at, is_new] = known_.try_emplace({engine, key});
    if (is_new) {
      const fuzz::Finding& f = result_.findings.at(key);
      fuzz::EnginePool pool(make_);
      at->second = fuzz::respond(fuzz::case_of(f), fuzz::symptom_of(f), engine, {}, pool);
    }
    return at->second;
  }

  const fuzz::CampaignResult& result_;
  const fuzz::MakeEngine& make_;
  std::map<std::pair<std::string, std::string>, fuzz::Responses> known_;
};

}  // namespace

std::map<std::string, std::string> equal_lies(const fuzz::Causes& causes, const fuzz::CampaignResult& result,
                                              const fuzz::MakeEngine& make) {
  std::map<std::string, std::string> first;
  for (const auto& [key, f] : result.findings) first[f.engine] = f.engine;
  Comparison compared(result, make);
  for (const fuzz::Cause& cause : causes.causes) {
    std::map<std::string, std::vector<std::string>> keys;
    for (const std::string& key : cause.keys) keys[result.findings.at(key).engine].push_back(key);
    for (auto x = keys.begin(); x != keys.end(); ++x)
      for (auto y = std::next(x); y != keys.end(); ++y) {
        const auto alike = [&](const std::string& key) {
          return compared.answer_alike(x->first, y->first, key);
        };
        if (!std::ranges::all_of(x->second, alike) || !std::ranges::all_of(y->second, alike)) continue;
        const std::string from = first.at(y->first), to = first.at(x->first);
        for (auto& [engine, name] : first)
          if (name == from) name = to;
      }
  }
  return first;
}

}  // namespace touchstone::mutants
