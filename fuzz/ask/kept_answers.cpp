#include "fuzz/ask/kept_answers.h"

#include <map>
#include <utility>

#include "core/base/hash.h"

namespace touchstone::fuzz {
namespace {

std::uint64_t hash_of(const Case& c) {
  Hasher h;
  h.add(hash(c.scene));
  for (const Query& q : c.queries) h.add(static_cast<int>(q.question)).add(q.a).add(q.b);
  return h.value();
}

CaseObservations without_details(CaseObservations all) {
  for (Observation& o : all.answers) {
    o.detail.clear();
    o.elapsed_ns = 0;
    o.slow = false;
  }
  return all;
}

CaseObservations not_asked(const Case& c) {
  CaseObservations all;
  all.answers.assign(c.queries.size(), no_answer(Outcome::not_asked, "not kept"));
  return all;
}

}  // namespace

bool fits(const CaseObservations& all, const Case& c) {
  const auto is_none_or = [](std::size_t n, std::size_t of) { return n == 0 || n == of; };
  return all.answers.size() == c.queries.size() &&
         is_none_or(all.received.shapes.size(), c.scene.shapes.size()) &&
         is_none_or(all.received.bodies.size(), c.scene.bodies.size());
}

void KeepingEngine::start() {
  kept_ = {};
  is_first_ = true;
}

std::vector<CaseObservations> KeepingEngine::run(std::span<const Case> cases) {
  auto all = engine_->run(cases);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (is_first_)
      kept_.cases.push_back(without_details(all[i]));
    else
      kept_.later.push_back({false, true, hash_of(cases[i]), without_details(all[i])});
  is_first_ = false;
  return all;
}

std::vector<CaseObservations> KeepingEngine::run_again(std::span<const Case> cases) {
  auto all = engine_->run_again(cases);
  for (std::size_t i = 0; i < cases.size(); ++i)
    kept_.later.push_back({true, i < all.size(), hash_of(cases[i]),
                           i < all.size() ? without_details(all[i]) : CaseObservations{}});
  return all;
}

// A case may have been put several times: its answers are given in the same order.
class KeptEngine::Lookup {
 public:
  explicit Lookup(const std::vector<LaterAnswer>& later) {
    for (const LaterAnswer& a : later) answers_.emplace(std::pair(a.again, a.case_hash), &a);
  }
  const LaterAnswer* next(bool again, const Case& c) {
    const std::pair key(again, hash_of(c));
    const auto it = answers_.lower_bound(key);
    if (it == answers_.end() || it->first != key) return nullptr;
    const LaterAnswer* found = it->second;
    answers_.erase(it);
    return !found->supported || fits(found->observations, c) ? found : nullptr;
  }

 private:
  std::multimap<std::pair<bool, std::uint64_t>, const LaterAnswer*> answers_;
};

KeptEngine::KeptEngine(const EngineCard& card, const KeptAnswers& answers)
    : card_(card), answers_(answers), lookup_(std::make_unique<Lookup>(answers.later)) {}
KeptEngine::~KeptEngine() = default;

std::vector<CaseObservations> KeptEngine::run(std::span<const Case> cases) {
  if (std::exchange(is_first_, false)) return answers_.cases;
  std::vector<CaseObservations> all;
  for (const Case& c : cases) {
    const LaterAnswer* a = lookup_->next(false, c);
    missing_derived_ += a == nullptr;
    all.push_back(a ? a->observations : not_asked(c));
  }
  return all;
}

std::vector<CaseObservations> KeptEngine::run_again(std::span<const Case> cases) {
  std::vector<CaseObservations> all;
  for (const Case& c : cases) {
    const LaterAnswer* a = lookup_->next(true, c);
    missing_again_ += a == nullptr;
    if (!a || !a->supported) return {};
    all.push_back(a->observations);
  }
  return all;
}

}  // namespace touchstone::fuzz
