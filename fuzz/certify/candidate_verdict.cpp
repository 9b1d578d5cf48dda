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

// The share of two bodies that must be reported because they are within a margin: by how much they are nearer
// than that, divided by the diameter of the smaller. They need not overlap.
RequiredPair required_within(const Scene& s, const Truth::TruePair& p) {
  const auto [a, b] = p.bodies;
  const double ra = bounding_radius(s.shape_of(a)), rb = bounding_radius(s.shape_of(b));
  if (!(std::isfinite(ra) && std::isfinite(rb))) return {p.bodies, FaultKind::unbounded, 0};
  const double size = 2 * std::min(ra, rb), by = s.margin - p.truth.gap.hi;
  return required_with_share(p.bodies, size > 0 ? std::clamp(by / size, 0.0, 1.0) : 0);
}

// The share of two bodies: the certain depth divided by the diameter of the smaller.
RequiredPair required_by_bodies(const Scene& s, const Truth::TruePair& p) {
  const auto [a, b] = p.bodies;
  const double ra = bounding_radius(s.shape_of(a)), rb = bounding_radius(s.shape_of(b));
  if (!(std::isfinite(ra) && std::isfinite(rb))) return {p.bodies, FaultKind::unbounded, 0};
  const double size = 2 * std::min(ra, rb);
  return required_with_share(p.bodies, size > 0 ? std::clamp(-p.truth.gap.hi / size, 0.0, 1.0) : 0);
}

// The distance of two closed boxes along an axis; 0 where they overlap. Rounded, but exact zeros are exact.
double apart_along(const Aabb& a, const Aabb& b, int axis) {
  return std::max({0.0, a.lo[axis] - b.hi[axis], b.lo[axis] - a.hi[axis]});
}

// hi - lo <= margin, exactly: rounding is monotonic, and what it left out decides a tie.
bool is_apart_at_most(double lo, double hi, double margin) {
  const double apart = hi - lo, back = apart - hi;
  const double left_out = (hi - (apart - back)) + (-lo - back);
  return apart < margin || (apart == margin && left_out <= 0);
}

// Exact. Boxes that are apart along several axes, and so finite, are decided by the referee, as bodies, where
// rounding cannot.
bool are_boxes_within(const Aabb& a, const Aabb& b, double margin) {
  int axes = 0;
  bool each = true;
  for (int k = 0; k < 3; ++k) {
    if (a.lo[k] <= b.hi[k] && b.lo[k] <= a.hi[k]) continue;
    ++axes;
    each = each && (a.lo[k] > b.hi[k] ? is_apart_at_most(b.hi[k], a.lo[k], margin)
                                      : is_apart_at_most(a.hi[k], b.lo[k], margin));
  }
  if (axes < 2 || !each) return each;
  const double about = std::hypot(apart_along(a, b, 0), apart_along(a, b, 1), apart_along(a, b, 2));
  constexpr double rounding = 0x1p-48;  // of the differences and of the length, with room to spare
  if (about <= margin * (1 - rounding)) return true;
  if (about > margin * (1 + rounding)) return false;
  const auto corners = [](const Aabb& box) {
    std::vector<Vec3> all;
    for (int i = 0; i < 8; ++i) {
      const auto end = [&](int k) { return (i >> k & 1) != 0 ? box.hi[k] : box.lo[k]; };
      all.emplace_back(end(0), end(1), end(2));
    }
    return make_hull(std::move(all));
  };
  Scene pair;
  pair.margin = margin;
  pair.shapes.emplace_back(corners(a));
  pair.shapes.emplace_back(corners(b));
  pair.bodies.resize(2);
  pair.bodies[1].shape = 1;
  return Truth(pair).within(0, 0, 1) == referee::Verdict::overlap;
}

// As required_within, for boxes.
RequiredPair required_by_margin(BodyPair pair, const Aabb& a, const Aabb& b, double margin) {
  if (!(a.lo.allFinite() && a.hi.allFinite() && b.lo.allFinite() && b.hi.allFinite()))
    return {pair, FaultKind::unbounded, 0};
  const double by = margin - std::hypot(apart_along(a, b, 0), apart_along(a, b, 1), apart_along(a, b, 2));
  const double size = std::min((a.hi - a.lo).minCoeff(), (b.hi - b.lo).minCoeff());
  return required_with_share(pair, size > 0 ? std::clamp(by / size, 0.0, 1.0) : 0);
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
  /// `margin`: boxes no farther apart than this must be paired.
  Replay(const Scene& s, BroadLevel level, bool invalid, std::optional<double> margin)
      : s_(s), level_(level), invalid_(invalid), margin_(margin) {
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
      if (now_.present[i] && now_.has_box[i])
        boxed.push_back({margin_ ? widened(now_.box[i], *margin_ / 2) : now_.box[i], static_cast<int>(i)});
    const auto box = [&](int i) -> const Aabb& { return now_.box[static_cast<std::size_t>(i)]; };
    RequiredPairs out;
    for (const BodyPair& p : overlapping_boxes(std::move(boxed)))
      if (is_reportable(s_, p.first, p.second) &&
          (!margin_ || are_boxes_within(box(p.first), box(p.second), *margin_)))
        out.push_back(margin_ ? required_by_margin(p, box(p.first), box(p.second), *margin_)
                              : required_by_boxes(p, box(p.first), box(p.second)));
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
  std::optional<double> margin_;
  State now_;
};

std::vector<RequiredPairs> pairs_within_of_bodies(const Scene& s, std::uint64_t& undecided) {
  Truth truth(s);
  std::vector<RequiredPairs> out;
  for (const auto& step : truth.pairs_within()) {
    RequiredPairs& pairs = out.emplace_back();
    for (const auto& p : step) pairs.push_back(required_within(s, p));
  }
  undecided += truth.undecided_pairs_within();
  return out;
}

// The pairs that overlap or, asked about a motion, that meet at some time in the step, starting from the
// bodies' own poses, or, asked about a margin, that are within it.
std::vector<RequiredPairs> true_pairs_of_bodies(const Scene& s, Question asked, std::uint64_t& undecided) {
  if (asked == Question::candidates_within) return pairs_within_of_bodies(s, undecided);
  Truth truth(s);
  if (asked == Question::swept_candidates) {
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
        asked_(c.queries.empty() ? Question::candidates : c.queries[0].question),
        swept_(asked_ == Question::swept_candidates),
        answer_(answer),
        level_(level),
        invalid_(invalid),
        replay_(c.scene, level, invalid,
                asked_ == Question::candidates_within ? std::optional(c.scene.margin) : std::nullopt) {}

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
    if (level_ == BroadLevel::bodies) truth = true_pairs_of_bodies(s_, asked_, v_.undecided);
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
        asked_ == Question::candidates_within ? fmt::format("are within the margin of {:g}", s_.margin)
        : d.kind == FaultKind::solid  ? fmt::format("overlap by {:.2g} of the smaller body's size", d.share)
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
  Question asked_;
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
