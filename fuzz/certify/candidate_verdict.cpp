#include "fuzz/certify/candidate_verdict.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/hash.h"
#include "core/base/input_error.h"
#include "fuzz/judge/truth.h"

namespace touchstone::fuzz {
namespace {

using Pairs = std::vector<BodyPair>;

Pairs sorted_unique(Pairs r) {
  for (BodyPair& p : r)
    if (p.first > p.second) std::swap(p.first, p.second);
  std::sort(r.begin(), r.end());
  r.erase(std::unique(r.begin(), r.end()), r.end());
  return r;
}

bool counts(const Scene& s, int a, int b) {
  const auto fixed = [&](int i) { return s.bodies[static_cast<std::size_t>(i)].is_static; };
  return !(fixed(a) && fixed(b)) && !is_filtered(s, a, b);
}

// Who is there, and where; at the level of boxes also in which box.
struct State {
  std::vector<char> present;
  std::vector<Pose> pose;
  std::vector<Aabb> box;
  std::vector<char> asked;  // has a box that is one
};

class Replay {
 public:
  Replay(const Scene& s, Level level, bool invalid) : s_(s), level_(level), invalid_(invalid) {
    const std::size_t n = s.bodies.size();
    now_.present.resize(n), now_.pose.resize(n), now_.box.resize(n), now_.asked.resize(n);
  }
  void apply(const Step& step) {
    const auto b = static_cast<std::size_t>(step.body);
    now_.present[b] = step.op != Step::Op::remove;
    if (step.op == Step::Op::remove) return;
    now_.pose[b] = step.pose.value_or(s_.bodies[b].pose);
    if (level_ == Level::boxes) place(step.body);
  }
  const State& now() const { return now_; }

  Pairs overlapping_boxes() {
    order_.clear();
    for (int i = 0; i < static_cast<int>(now_.present.size()); ++i)
      if (now_.present[static_cast<std::size_t>(i)] && now_.asked[static_cast<std::size_t>(i)])
        order_.push_back(i);
    const auto box = [&](int i) -> const Aabb& { return now_.box[static_cast<std::size_t>(i)]; };
    std::sort(order_.begin(), order_.end(), [&](int i, int j) {
      return box(i).lo.x() < box(j).lo.x() || (box(i).lo.x() == box(j).lo.x() && i < j);
    });
    Pairs out;
    for (std::size_t i = 0; i < order_.size(); ++i)
      for (std::size_t j = i + 1; j < order_.size() && box(order_[j]).lo.x() <= box(order_[i]).hi.x(); ++j)
        if (overlaps(box(order_[i]), box(order_[j])) && counts(s_, order_[i], order_[j]))
          out.push_back(std::minmax(order_[i], order_[j]));
    std::sort(out.begin(), out.end());
    return out;
  }

 private:
  void place(int body) {
    const auto b = static_cast<std::size_t>(body);
    const auto box = exact_box(s_.shape_of(body), now_.pose[b]);
    if (!box && !invalid_) throw InputError("body " + std::to_string(body), "has no exact box");
    const bool closed = box && (box->lo.array() <= box->hi.array()).all() &&
                        (!invalid_ || (box->lo.allFinite() && box->hi.allFinite()));
    now_.asked[b] = closed;
    if (closed) now_.box[b] = *box;
  }
  const Scene& s_;
  Level level_;
  bool invalid_;
  State now_;
  std::vector<int> order_;
};

// Pairs that meet at some time of the step, for scenes with motion; the bodies stand at their own poses.
Pairs meeting_in_step(const Scene& s, Truth& truth, std::uint64_t& undecided) {
  Pairs out;
  const int n = static_cast<int>(s.bodies.size());
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b) {
      if (!counts(s, a, b)) continue;
      const auto& t = truth.motion(0, a, b);
      if (t.verdict == referee::TimeTruth::Verdict::hit) out.emplace_back(a, b);
      if (t.verdict == referee::TimeTruth::Verdict::undecided) ++undecided;
    }
  return out;
}

std::vector<Pairs> true_pairs_of_bodies(const Scene& s, std::uint64_t& undecided) {
  Truth truth(s);
  std::vector<Pairs> out;
  const bool moves =
      std::any_of(s.bodies.begin(), s.bodies.end(), [](const Body& b) { return b.motion.has_value(); });
  for (const auto& step : truth.true_pairs()) {
    Pairs& pairs = out.emplace_back();
    for (const auto& p : step) pairs.push_back(p.bodies);
  }
  undecided += truth.undecided_pairs();
  if (!moves) return out;
  const Pairs swept = meeting_in_step(s, truth, undecided);
  for (std::size_t k = 0; k < out.size(); ++k) {
    const auto& pose = truth.steps()[k].pose;
    const auto is_there = [&](int body) { return pose[static_cast<std::size_t>(body)].has_value(); };
    for (const BodyPair& p : swept)
      if (is_there(p.first) && is_there(p.second)) out[k].push_back(p);
    out[k] = sorted_unique(std::move(out[k]));
  }
  return out;
}

class Judge {
 public:
  Judge(const Case& c, const Observation& answer, Level level, bool invalid)
      : s_(c.scene), answer_(answer), level_(level), invalid_(invalid), replay_(c.scene, level, invalid) {}

  CandidateVerdict run() {
    hash_.add(hash(s_));
    hash_.add(static_cast<int>(answer_.outcome));
    v_.steps = s_.script.size();
    if (answer_.outcome == Outcome::answered)
      judge();
    else
      failed();
    v_.digest = hash_.value();
    return std::move(v_);
  }

 private:
  // To throw at what is no box is to refuse it.
  void failed() {
    v_.refused = answer_.outcome == Outcome::unsupported || answer_.outcome == Outcome::invalid_input ||
                 (invalid_ && answer_.outcome == Outcome::threw);
    v_.words = answer_.detail.empty() ? std::string(to_string(answer_.outcome)) : answer_.detail;
    if (!v_.refused) v_.fault = to_string(answer_.outcome);
  }
  void judge() {
    std::vector<Pairs> truth;
    if (level_ == Level::bodies) truth = true_pairs_of_bodies(s_, v_.undecided);
    std::size_t k = 0;
    for (const Step& step : s_.script) {
      if (step.op != Step::Op::query)
        replay_.apply(step);
      else
        judge_query(static_cast<int>(k), level_ == Level::bodies ? truth[k] : replay_.overlapping_boxes()),
            ++k;
    }
    if (answer_.candidate_pairs.size() > k)
      wrong("no_number", static_cast<int>(k), {-1, -1}, "more queries are answered than the script asks");
  }
  void judge_query(int k, const Pairs& truth) {
    static const Pairs none;
    const auto at = static_cast<std::size_t>(k);
    const Pairs reported =
        sorted_unique(at < answer_.candidate_pairs.size() ? answer_.candidate_pairs[at] : none);
    ++v_.queries, v_.pairs_true += truth.size(), v_.pairs_reported += reported.size();
    hash_.add(reported.size());
    for (const auto& [a, b] : reported) hash_.add(a).add(b);
    for (const BodyPair& p : truth)
      if (!std::binary_search(reported.begin(), reported.end(), p))
        return wrong(
            "missed", k, p,
            fmt::format("query {}: bodies {} and {} overlap and are no candidates", k, p.first, p.second));
    for (const BodyPair& p : reported)
      if (p.first == p.second || absent(p.first) || absent(p.second))
        return wrong(
            "stale", k, p,
            fmt::format("query {}: the pair ({}, {}) names a body that is not there", k, p.first, p.second));
  }
  bool absent(int i) const {
    return i < 0 || i >= static_cast<int>(s_.bodies.size()) ||
           !replay_.now().present[static_cast<std::size_t>(i)];
  }
  void wrong(const char* fault, int k, BodyPair p, std::string words) {
    if (!v_.fault.empty()) return;
    v_.fault = fault, v_.query = k, v_.a = p.first, v_.b = p.second, v_.words = std::move(words);
  }

  const Scene& s_;
  const Observation& answer_;
  Level level_;
  bool invalid_;
  Replay replay_;
  Hasher hash_;
  CandidateVerdict v_;
};

}  // namespace

CandidateVerdict judge_candidates(const Case& c, const Observation& answer, Level level, bool invalid) {
  return Judge(c, answer, level, invalid).run();
}

}  // namespace touchstone::fuzz
