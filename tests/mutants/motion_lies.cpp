#include "tests/mutants/motion_lies.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <utility>

#include "oracles/core/core_engine.h"
#include "tests/mutants/pair.h"

namespace touchstone::mutants {
namespace {

class MotionLiar final : public Engine {
 public:
  explicit MotionLiar(const MotionLie& m) : told_(m), lie_(m.lie), card_(core_.card()) {
    card_.name = m.name;
    card_.complete_manifolds = false;
    if (m.claim > 0) card_.source = "a page";
  }
  const EngineCard& card() const override { return card_; }
  std::vector<CaseObservations> run(std::span<const Case> cases) override {
    auto result = core_.run(cases);
    for (std::size_t i = 0; i < cases.size(); ++i)
      for (std::size_t k = 0; k < cases[i].queries.size(); ++k) {
        Observation& o = result[i].answers[k];
        o.claimed_tolerance = told_.claim;
        lie_(cases[i], cases[i].queries[k], o);
      }
    return result;
  }
  void forget() { lie_ = told_.lie; }

 private:
  const MotionLie& told_;
  Lie lie_;
  CoreEngine core_;
  EngineCard card_;
};

// The id of a frame ends in @ and its number.
int frame_of(const Case& c) {
  const auto place = c.id.rfind('@');
  int frame = 0;
  if (place != std::string::npos) std::from_chars(c.id.data() + place + 1, c.id.data() + c.id.size(), frame);
  return frame;
}

Lie in_frames(bool (*which)(int frame), ContactLie lie) {
  return [=](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::contact) && o.normal && which(frame_of(c))) lie(c, q, o);
  };
}
bool every_third(int frame) { return frame % 3 == 2; }
bool odd(int frame) { return frame % 2 == 1; }
bool all(int) { return true; }

void opposite(const Case&, const Query&, Observation& o) { o.normal = -*o.normal; }
void dropped(const Case&, const Query&, Observation& o) {
  o.overlap = false;
  o.normal.reset();
  o.depth.reset();
  o.manifold.clear();
}
void without_last_point(const Case&, const Query&, Observation& o) {
  if (o.manifold.size() > 1) o.manifold.pop_back();
}
void one_end_or_the_other(const Case& c, const Query&, Observation& o) {
  if (o.manifold.size() < 2) return;
  o.manifold = {odd(frame_of(c)) ? o.manifold.back() : o.manifold.front()};
}
void next_point_first(const Case& c, const Query&, Observation& o) {
  if (o.manifold.empty()) return;
  std::rotate(o.manifold.begin(), o.manifold.begin() + frame_of(c) % static_cast<int>(o.manifold.size()),
              o.manifold.end());
}
void other_ids(const Case& c, const Query&, Observation& o) {
  for (ManifoldPoint& p : o.manifold)
    if (p.id) p.id = *p.id << 32 | static_cast<std::uint64_t>(frame_of(c));
}
// Of a box: the axis after that of the normal, with its depth and no points.
void another_axis(const Case& c, const Query& q, Observation& o) {
  const Vec3 n(o.normal->z(), o.normal->x(), o.normal->y());
  const bool of_shaft = std::abs(n.z()) > 0.5;
  o.normal = of_shaft ? Vec3(n.y(), n.z(), n.x()) : n;
  o.depth = width(c, q, *o.normal);
  o.manifold.clear();
}

// f(answer to this question in the last frame, this answer).
Lie after_last_frame(Question question, void (*f)(const Observation& before, Observation& now)) {
  return [=, last = std::vector<std::pair<Query, Observation>>{}](const Case&, const Query& q,
                                                                  Observation& o) mutable {
    if (!asks(q, question)) return;
    const Observation right = o;
    const auto found = std::find_if(last.begin(), last.end(), [&](const auto& x) { return x.first == q; });
    if (found == last.end()) {
      last.emplace_back(q, right);
      return;
    }
    f(found->second, o);
    found->second = right;
  };
}
void the_same(const Observation& before, Observation& now) { now = before; }
void same_depth(const Observation& before, Observation& now) {
  if (before.depth && now.depth) now.depth = before.depth;
}
void same_normal(const Observation& before, Observation& now) {
  if (before.normal && now.normal) now.normal = before.normal;
}

// Whatever was asked before: the first question is answered as the core does.
Lie unless_first(Question question, void (*f)(const Case&, const Query&, Observation&)) {
  return [=, asked = false](const Case& c, const Query& q, Observation& o) mutable {
    if (std::exchange(asked, true) && asks(q, question) && o.outcome == Outcome::answered) f(c, q, o);
  };
}
void farther(const Case&, const Query&, Observation& o) {
  if (o.distance) *o.distance += 1e-6;
}

Lie distance_off_on_odd_frames() {
  return [](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::distance) && o.distance && odd(frame_of(c))) *o.distance += 0x1p-4;
  };
}

}  // namespace

const std::vector<MotionLie>& motion_lies() {
  constexpr auto cont = Question::contact, dist = Question::distance;
  static const std::vector<MotionLie> lies = {
      {"motion_flips", "needless", "settle", "the opposite normal in every third frame",
       in_frames(every_third, opposite), 0, true},
      {"motion_other_best", "tied", "cube_in_a_shaft", "another of the best normals in odd frames",
       in_frames(odd, another_axis)},
      {"motion_second_best", "needless", "cube_in_a_shaft_off_centre",
       "the second-best normal in odd frames, right within its claim", in_frames(odd, another_axis), 0x1p-2},
      {"motion_drops", "verdict", "slide", "no contact in odd frames", in_frames(odd, dropped), 0, true},
      {"motion_lags", "wrong", "roll", "the contact of the frame before", after_last_frame(cont, the_same), 0,
       true},
      {"motion_depth_lags", "wrong", "settle", "the depth of the frame before",
       after_last_frame(cont, same_depth), 0, true},
      {"motion_shakes", "depth", "settle", "a sixteenth farther in odd frames, right within its claim",
       distance_off_on_odd_frames(), 0x1p-3},
      {"motion_loses_points", "count", "slide", "a point less in odd frames",
       in_frames(odd, without_last_point)},
      {"motion_wanders", "points", "slide", "one point of the face, from either end in turn",
       in_frames(all, one_end_or_the_other)},
      {"motion_new_ids", "ids", "slide", "the points get new ids in each frame", in_frames(all, other_ids)},
      {"motion_renames", "order", "slide", "the points begin with another one in each frame",
       in_frames(all, next_point_first)},
      {"motion_keeps_normal", "state", "pass", "the normal of the frame before",
       after_last_frame(cont, same_normal), 0, true},
      {"motion_leaks", "state", "settle", "1e-6 farther once another question was asked",
       unless_first(dist, farther), 0, true},
      {"motion_first_complete", "state", "slide", "all points to the first question, later one less",
       unless_first(cont, without_last_point)},
  };
  return lies;
}

EnginePtr make_motion_liar(const MotionLie& m) { return std::make_unique<MotionLiar>(m); }

bool forget_motion(Engine& e) {
  auto* const liar = dynamic_cast<MotionLiar*>(&e);
  if (liar) liar->forget();
  return liar != nullptr;
}

}  // namespace touchstone::mutants
