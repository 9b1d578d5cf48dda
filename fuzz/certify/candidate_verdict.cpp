#include "fuzz/certify/candidate_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/hash.h"
#include "core/base/input_error.h"
#include "fuzz/judge/candidate_comparison.h"
#include "fuzz/judge/truth.h"

namespace touchstone::fuzz {
namespace {

// A pair that must be reported, and the kind of fault if it is lost.
struct RequiredPair {
  BodyPair pair;
  FaultKind kind = FaultKind::touching;
  double share = 0;
};
using RequiredPairs = std::vector<RequiredPair>;

constexpr double least_solid_share = 0.01;  // smaller overlaps count as touching

RequiredPair required_with_share(BodyPair pair, double share) {
  return {pair, share > least_solid_share ? FaultKind::solid : FaultKind::touching, share > 0 ? share : 0};
}

// The share of two boxes: the minimum over the axes of the overlap divided by the smaller side.
RequiredPair required_by_boxes(BodyPair pair, const Aabb& a, const Aabb& b) {
  if (!(a.lo.allFinite() && a.hi.allFinite() && b.lo.allFinite() && b.hi.allFinite()))
    return {pair, FaultKind::unbounded, 0};
  double share = 1;
  for (int k = 0; k < 3; ++k) {
    // Halved before subtracting, so that boxes near the largest double do not overflow.
    const double side = std::min(a.hi[k] / 2 - a.lo[k] / 2, b.hi[k] / 2 - b.lo[k] / 2);
    const double shared = std::min(a.hi[k], b.hi[k]) / 2 - std::max(a.lo[k], b.lo[k]) / 2;
    share = side > 0 ? std::min(share, shared / side) : 0;
  }
  return required_with_share(pair, share);
}

// The share of two bodies: the certain depth divided by the diameter of the smaller.
RequiredPair required_by_bodies(const Scene& s, const Truth::TruePair& p) {
  const auto [a, b] = p.bodies;
  const double ra = bounding_radius(s.shape_of(a)), rb = bounding_radius(s.shape_of(b));
  if (!(std::isfinite(ra) && std::isfinite(rb))) return {p.bodies, FaultKind::unbounded, 0};
  const double size = 2 * std::min(ra, rb);
  return required_with_share(p.bodies, size > 0 ? std::clamp(-p.truth.gap.hi / size, 0.0, 1.0) : 0);
}

// The bodies present and their poses; at the level of boxes also their boxes.
struct State {
  std::vector<char> present;
  std::vector<Pose> pose;
  std::vector<Aabb> box;
  std::vector<char> has_box;  // the box is closed, so its pairs must be reported
};

class Replay {
 public:
  Replay(const Scene& s, BroadLevel level, bool invalid) : s_(s), level_(level), invalid_(invalid) {
    const std::size_t n = s.bodies.size();
    now_.present.resize(n);
    now_.pose.resize(n);
    now_.box.resize(n);
    now_.has_box.resize(n);
  }
  void apply(const Step& step) {
    const auto b = static_cast<std::size_t>(step.body);
    now_.present[b] = step.op != Step::Op::remove;
    if (step.op == Step::Op::remove) return;
    now_.pose[b] = step.pose.value_or(s_.bodies[b].pose);
    if (level_ == BroadLevel::boxes) place(step.body);
  }
  const State& now() const { return now_; }

  RequiredPairs required_pairs() const {
    std::vector<BoxedBody> boxed;
    for (std::size_t i = 0; i < now_.present.size(); ++i)
      if (now_.present[i] && now_.has_box[i]) boxed.push_back({now_.box[i], static_cast<int>(i)});
    const auto box = [&](int i) -> const Aabb& { return now_.box[static_cast<std::size_t>(i)]; };
    RequiredPairs out;
    for (const BodyPair& p : overlapping_boxes(std::move(boxed)))
      if (is_reportable(s_, p.first, p.second))
        out.push_back(required_by_boxes(p, box(p.first), box(p.second)));
    return out;
  }

 private:
  void place(int body) {
    const auto b = static_cast<std::size_t>(body);
    const auto box = exact_box(s_.shape_of(body), now_.pose[b]);
    if (!box && !invalid_) throw InputError("body " + std::to_string(body), "has no exact box");
    const bool closed = box && (box->lo.array() <= box->hi.array()).all() &&
                        (!invalid_ || (box->lo.allFinite() && box->hi.allFinite()));
    now_.has_box[b] = closed;
    if (closed) now_.box[b] = *box;
  }
  const Scene& s_;
  BroadLevel level_;
  bool invalid_;
  State now_;
};

// If `swept`, the pairs that meet at some time in the step, starting from the bodies' own poses.
std::vector<RequiredPairs> true_pairs_of_bodies(const Scene& s, bool swept, std::uint64_t& undecided) {
  Truth truth(s);
  if (swept) {
    RequiredPairs meeting;
    for (const BodyPair& p : truth.meeting_pairs()) meeting.push_back({p, FaultKind::moving, 0});
    undecided += truth.undecided_meetings();
    return {meeting};
  }
  std::vector<RequiredPairs> out;
  for (const auto& step : truth.true_pairs()) {
    RequiredPairs& pairs = out.emplace_back();
    for (const auto& p : step) pairs.push_back(required_by_bodies(s, p));
  }
  undecided += truth.undecided_pairs();
  return out;
}

class Judge {
 public:
  Judge(const Case& c, const Observation& answer, BroadLevel level, bool invalid)
      : s_(c.scene),
        swept_(has_swept_candidates_query(c)),
        answer_(answer),
        level_(level),
        invalid_(invalid),
        replay_(c.scene, level, invalid) {}

  CandidateVerdict run() {
    hash_.add(hash(s_));
    hash_.add(static_cast<int>(answer_.outcome));
    v_.steps = s_.script.size();
    if (answer_.outcome == Outcome::answered)
      judge();
    else
      failed();
    std::stable_sort(
        v_.faults.begin(), v_.faults.end(),
        [](const CandidateFault& x, const CandidateFault& y) { return is_graver(x.what, y.what); });
    v_.digest = hash_.value();
    return std::move(v_);
  }

 private:
  // Throwing on an invalid box counts as refusing it.
  void failed() {
    const Outcome o = answer_.outcome;
    v_.refused =
        o == Outcome::unsupported || o == Outcome::invalid_input || (invalid_ && o == Outcome::threw);
    v_.timed_out = depends_on_time(o);
    v_.words = answer_.detail.empty() ? std::string(to_string(o)) : answer_.detail;
    if (!v_.refused && !v_.timed_out) wrong(to_string(o), FaultKind::numbers, v_.words, Place{});
  }
  void judge() {
    std::vector<RequiredPairs> truth;
    if (level_ == BroadLevel::bodies) truth = true_pairs_of_bodies(s_, swept_, v_.undecided);
    if (swept_) return judge_query(0, truth.at(0));
    std::size_t k = 0;
    for (const Step& step : s_.script) {
      if (step.op != Step::Op::query) {
        replay_.apply(step);
        continue;
      }
      judge_query(static_cast<int>(k), level_ == BroadLevel::bodies ? truth[k] : replay_.required_pairs());
      ++k;
    }
    if (answer_.candidate_pairs.size() > k)
      wrong("no_number", FaultKind::numbers, "answers more queries than the script has",
            {static_cast<int>(k)});
  }
  void judge_query(int k, const RequiredPairs& truth) {
    const auto found = compare_candidates(
        answer_, static_cast<std::size_t>(k), static_cast<int>(s_.bodies.size()), truth, &RequiredPair::pair,
        [&](int i) { return swept_ || replay_.now().present[static_cast<std::size_t>(i)]; });
    ++v_.queries;
    v_.pairs_true += truth.size();
    v_.pairs_reported += found.reported.size();
    hash_.add(found.reported.size());
    for (const auto& [a, b] : found.reported) hash_.add(a).add(b);
    for (const std::size_t i : found.missed) missed(k, truth[i]);
    for (const BodyPair& p : found.stale) stale(k, p);
  }
  void missed(int k, const RequiredPair& d) {
    const auto [a, b] = d.pair;
    const std::string how =
        d.kind == FaultKind::solid    ? fmt::format("overlap by {:.2g} of the smaller body's size", d.share)
        : d.kind == FaultKind::moving ? std::string("meet within the step")
        : d.kind == FaultKind::unbounded ? std::string("overlap, one of them unbounded,")
                                         : std::string("touch, overlap by at most 1 %, or have no volume,");
    wrong("missed", d.kind,
          fmt::format("query {}: bodies {} and {} {} but are not reported as candidates", k, a, b, how),
          {k, a, b, d.share});
  }
  void stale(int k, const BodyPair& p) {
    wrong("stale", FaultKind::numbers,
          fmt::format("query {}: the pair ({}, {}) names a body that is not present", k, p.first, p.second),
          {k, p.first, p.second});
  }
  struct Place {
    int query = -1, a = -1, b = -1;
    double share = 0;
  };
  // Filled member by member: g++ 12 warns of uninitialised strings with braced initialisation.
  void wrong(std::string_view fault, FaultKind kind, std::string words, const Place& at) {
    CandidateFault f;
    f.what.fault = fault;
    f.what.kind = kind;
    f.words = std::move(words);
    f.query = at.query;
    f.a = at.a;
    f.b = at.b;
    f.share = at.share;
    const auto same = std::find_if(v_.faults.begin(), v_.faults.end(),
                                   [&](const CandidateFault& x) { return x.what == f.what; });
    if (same == v_.faults.end())
      v_.faults.push_back(std::move(f));
    else if (f.share > same->share)
      *same = std::move(f);
  }

  const Scene& s_;
  bool swept_;  // one question about all bodies, without a script
  const Observation& answer_;
  BroadLevel level_;
  bool invalid_;
  Replay replay_;
  Hasher hash_;
  CandidateVerdict v_;
};

}  // namespace

bool CandidateVerdict::shows(const FaultClass& c) const {
  return std::any_of(faults.begin(), faults.end(), [&](const CandidateFault& f) { return f.what == c; });
}

CandidateVerdict judge_candidates(const Case& c, const Observation& answer, BroadLevel level, bool invalid) {
  return Judge(c, answer, level, invalid).run();
}

}  // namespace touchstone::fuzz
