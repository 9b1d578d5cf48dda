#include "fuzz/judge/truth.h"

#include "fuzz/judge/tau.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "scenarios/value/candidate_pairs.h"
#include "scenarios/value/invalid_numbers.h"

namespace touchstone::fuzz {
namespace {

Motion motion_of(const Scene& s, int body) {
  return s.bodies[static_cast<std::size_t>(body)].motion.value_or(Motion{});
}

// True when every number that the engine reports equals the given one, so that frame 0 serves. A Placement
// never equals a Pose exactly unless the matrix of the rotation is exact in doubles.
bool same_as_asked(const Scene& s, const ReceivedScene& r) {
  for (std::size_t i = 0; i < r.shapes.size() && i < s.shapes.size(); ++i)
    if (r.shapes[i] && *r.shapes[i] != s.shapes[i]) return false;
  for (std::size_t i = 0; i < r.bodies.size() && i < s.bodies.size(); ++i) {
    if (!r.bodies[i]) continue;
    const Pose& p = s.bodies[i].pose;
    if (r.bodies[i]->translation != p.translation || p.rotation != Quat{} ||
        r.bodies[i]->matrix != Mat3::Identity())
      return false;
  }
  return true;
}

constexpr double unbounded = std::numeric_limits<double>::infinity();

// Each point of one set is within this distance of the other set, and so is each point of their hulls: a
// convex combination of points is as near to the same combination of their neighbours. Unbounded when there
// are too many points to compare.
double hausdorff_distance(const std::vector<Vec3>& v, const std::vector<Vec3>& w) {
  constexpr std::size_t most_pairs = 1 << 20;
  if (v.empty() || w.empty() || v.size() > most_pairs / w.size()) return unbounded;
  const auto one_way = [](const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
    double worst = 0;
    for (const Vec3& p : from) {
      double least = unbounded;
      for (const Vec3& q : to) least = std::min(least, (p - q).norm());
      worst = std::max(worst, least);
    }
    return worst;
  };
  return std::max(one_way(v, w), one_way(w, v));
}

// How far apart the numbers of two shapes are: every point of one is within this of the other. Infinity for
// shapes of different kinds: the engine's answers are then always judged for the shape it holds.
double shape_difference(const Shape& x, const Shape& y) {
  if (x.index() != y.index()) return unbounded;
  if (const TriangleMesh* m = triangles_if(x))
    if (m->triangles != triangles_if(y)->triangles) return unbounded;
  if (const auto* h = hull_if(x))
    if (const auto& held = hull_if(y)->vertices; held.size() != h->vertices.size()) {
      const auto* outer = std::get_if<Padded<Hull>>(&x);
      const double between = outer ? std::abs(outer->padding - std::get<Padded<Hull>>(y).padding) : 0;
      return hausdorff_distance(h->vertices, held) + between;
    }
  double sum = 0;
  std::visit(
      [&](const auto& sx) {
        using S = std::decay_t<decltype(sx)>;
        const S& sy = std::get<S>(y);
        if constexpr (std::is_same_v<S, HalfSpace>) {
          // A half-space is unbounded: a different normal displaces its points without limit.
          sum = sx == sy ? 0 : unbounded;
        } else {
          for_each_field(sx, [&](auto name, const auto& v, Domain) {
            for_each_field(sy, [&](auto other, const auto& w, Domain) {
              if (name != other) return;
              using V = std::decay_t<decltype(v)>;
              if constexpr (std::is_same_v<V, std::decay_t<decltype(w)>>) {
                if constexpr (std::is_same_v<V, double>) sum += std::abs(v - w);
                if constexpr (std::is_same_v<V, Vec3>) sum += (v - w).template lpNorm<1>();
                if constexpr (std::is_same_v<V, std::vector<Vec3>>) {
                  double worst = v.size() == w.size() ? 0 : unbounded;
                  for (std::size_t i = 0; i < std::min(v.size(), w.size()); ++i)
                    worst = std::max(worst, (v[i] - w[i]).norm());
                  sum += worst;
                }
              }
            });
          });
        }
      },
      x);
  return sum;
}

// A half-space turns about its body's origin and has no bounded reach, so its frame must be judged for itself
// unless the pose is the same.
double displacement_of(const Scene& s, const ReceivedScene& r) {
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();  // of the differences below
  double worst = 0;
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    const Body& b = s.bodies[i];
    const Shape& shape = s.shapes[static_cast<std::size_t>(b.shape)];
    double moved = 0;
    const auto k = static_cast<std::size_t>(b.shape);
    if (k < r.shapes.size() && r.shapes[k]) moved += shape_difference(shape, *r.shapes[k]);
    if (i < r.bodies.size() && r.bodies[i]) {
      const double turned = (r.bodies[i]->matrix - rotation_matrix(b.pose.rotation)).norm() + rounding;
      const double reach = bounding_radius(shape);
      moved += (r.bodies[i]->translation - b.pose.translation).stableNorm();
      if (!(std::isinf(reach) && r.bodies[i]->matrix == Mat3::Identity() && b.pose.rotation == Quat{}))
        moved += turned * reach;
    }
    if (!(moved < unbounded)) return unbounded;  // NaN too: inf - inf
    worst = std::max(worst, moved * (1 + rounding));
  }
  return worst;
}

}  // namespace

bool is_other_shape(const Shape& asked, const Shape& held) {
  if (asked.index() != held.index()) return true;
  if (const auto* h = hull_if(asked)) {
    const bool has_other_size = h->vertices.size() != hull_if(held)->vertices.size();
    if (has_other_size || std::holds_alternative<Hull>(asked)) return has_other_size;
  }
  if (const TriangleMesh* m = triangles_if(asked)) return m->triangles != triangles_if(held)->triangles;
  if (std::holds_alternative<HalfSpace>(asked)) return false;
  constexpr double most_of_rounding = 1e-3;  // rounding to float and welding in a cooker are far less
  return !(shape_difference(asked, held) <= most_of_rounding * bounding_radius(asked));
}

bool holds_other_shape(const Scene& asked, const ReceivedScene& received) {
  for (std::size_t i = 0; i < asked.shapes.size() && i < received.shapes.size(); ++i)
    if (received.shapes[i] && is_other_shape(asked.shapes[i], *received.shapes[i])) return true;
  return false;
}

Truth::Truth(const Scene& asked) : asked_(asked), frames_(1) {}

int Truth::frame_of(const ReceivedScene& whole) {
  const ReceivedScene received = held_part(asked_, whole);
  if (same_as_asked(asked_, received)) return 0;
  for (std::size_t i = 1; i < frames_.size(); ++i)
    if (frames_[i].received == received) return static_cast<int>(i);
  frames_.push_back({});
  frames_.back().received = received;
  frames_.back().displacement = displacement_of(asked_, received);
  return static_cast<int>(frames_.size()) - 1;
}

Placed Truth::placed(int frame, int body) const {
  const auto b = static_cast<std::size_t>(body);
  const Body& asked = asked_.bodies[b];
  Placed p{&asked_.shape_of(body), asked.pose};
  if (frame == 0) return p;
  const ReceivedScene& r = frames_[static_cast<std::size_t>(frame)].received;
  const auto s = static_cast<std::size_t>(asked.shape);
  if (s < r.shapes.size() && r.shapes[s]) p.shape = &*r.shapes[s];
  if (b < r.bodies.size() && r.bodies[b]) p.pose = *r.bodies[b];
  return p;
}

const referee::PairTruth& Truth::pair(int frame, int a, int b) {
  auto& cache = frames_[static_cast<std::size_t>(frame)].pairs;
  auto it = cache.find({a, b});
  if (it == cache.end()) {
    const auto hints = hints_.find({a, b});
    const std::span<const Vec3> directions =
        hints == hints_.end() ? std::span<const Vec3>{} : std::span<const Vec3>(hints->second);
    it = cache.emplace(BodyPair{a, b}, referee::judge_pair(placed(frame, a), placed(frame, b), directions))
             .first;
  }
  return it->second;
}

referee::Verdict Truth::within(int frame, int a, int b) {
  return referee::judge_within(placed(frame, a), placed(frame, b), asked_.margin, pair(frame, a, b));
}

const referee::TimeTruth& Truth::motion(int frame, int a, int b) {
  auto& cache = frames_[static_cast<std::size_t>(frame)].motions;
  auto it = cache.find({a, b});
  if (it == cache.end())
    it = cache
             .emplace(BodyPair{a, b}, referee::judge_motion(placed(frame, a), motion_of(asked_, a),
                                                            placed(frame, b), motion_of(asked_, b)))
             .first;
  return it->second;
}

const referee::ContactRegion& Truth::contact_region(int frame, int a, int b) {
  auto& cache = frames_[static_cast<std::size_t>(frame)].regions;
  auto it = cache.find({a, b});
  if (it == cache.end())
    it = cache
             .emplace(BodyPair{a, b},
                      referee::contact_region(placed(frame, a), placed(frame, b), pair(frame, a, b).normal,
                                              referee::contact_slack_factor * scale(a, b)))
             .first;
  return it->second;
}

referee::Bracket Truth::width(int frame, int a, int b, const Vec3& n) const {
  return referee::width(placed(frame, a), placed(frame, b), n);
}

Placed Truth::placed_after(int frame, int body, const Vec3& way) const {
  Placed moved = placed(frame, body);
  std::visit([&](auto& pose) { pose.translation += way; }, moved.pose);
  return moved;
}

referee::PairTruth Truth::pair_after(int frame, int a, int b, const Vec3& way) const {
  return referee::judge_pair(placed(frame, a), placed_after(frame, b, way));
}

referee::Bracket Truth::width_at(int frame, int a, int b, double t, const Vec3& n) const {
  return referee::width(placed(frame, a), placed_after(frame, b, t * motion_of(asked_, b).linear), n);
}

referee::Bracket Truth::distance_to(int frame, int body, const Vec3& p, double enough) const {
  return referee::distance_to(placed(frame, body), p, enough);
}

referee::Bracket Truth::gap_at(int frame, int a, int b, double t) const {
  return referee::gap_at(placed(frame, a), motion_of(asked_, a), placed(frame, b), motion_of(asked_, b), t);
}

double Truth::depth_in_mesh(int frame, int a, int b) const {
  Placed mesh = placed(frame, a), body = placed(frame, b);
  if (is_mesh(*mesh.shape) && std::holds_alternative<SolidMesh>(*body.shape)) std::swap(mesh, body);
  if (std::holds_alternative<SolidMesh>(*mesh.shape) && is_bounded(kind_of(*body.shape)))
    return referee::certain_depth_of_solids(mesh, body);
  if (!std::holds_alternative<TriangleMesh>(*mesh.shape)) std::swap(mesh, body);
  const auto* m = std::get_if<TriangleMesh>(mesh.shape);
  if (!m) return 0;
  if (std::holds_alternative<TriangleMesh>(*body.shape))
    return std::max(0.0, -referee::gap_at(mesh, {}, body, {}, 0).hi);
  double depth = 0;
  for (const auto& [i, j, k] : m->triangles) {
    const auto vertex = [&](int v) { return m->vertices[static_cast<std::size_t>(v)]; };
    const Shape triangle = make_hull({vertex(i), vertex(j), vertex(k)});
    depth = std::max(depth, -referee::judge_pair({&triangle, mesh.pose}, body).gap.hi);
  }
  return depth;
}

double Truth::depth_before(int frame, int a, int b, double t) {
  const referee::TimeTruth& truth = motion(frame, a, b);
  const double contact = truth.verdict == referee::TimeTruth::Verdict::hit ? truth.t_hi : 0;
  return referee::certified_depth_before(placed(frame, a), motion_of(asked_, a), placed(frame, b),
                                         motion_of(asked_, b), t, contact);
}

double Truth::depth_in_step(int frame, int a, int b) {
  auto& cache = frames_[static_cast<std::size_t>(frame)].depths;
  const auto it = cache.find({a, b});
  if (it != cache.end()) return it->second;
  const double depth = depth_before(frame, a, b, 1.0);
  frames_[static_cast<std::size_t>(frame)].depths[{a, b}] = depth;
  return depth;
}

double Truth::displacement(int frame) const { return frames_[static_cast<std::size_t>(frame)].displacement; }

double Truth::speed(int a, int b) const {
  const Motion ma = motion_of(asked_, a), mb = motion_of(asked_, b);
  const auto turning = [&](int body, const Motion& m) {
    return m.angular.isZero(0) ? 0.0 : m.angular.stableNorm() * bounding_radius(asked_.shape_of(body));
  };
  return ((ma.linear - mb.linear).stableNorm() + turning(a, ma) + turning(b, mb)) * (1 + speed_rounding);
}

const std::vector<Truth::StepState>& Truth::steps() {
  if (steps_) return *steps_;
  steps_.emplace();
  StepState now{std::vector<std::optional<Pose>>(asked_.bodies.size())};
  for (const Step& s : effective_script(asked_)) {
    const auto b = static_cast<std::size_t>(s.body);
    switch (s.op) {
      case Step::Op::insert:
        now.pose[b] = s.pose.value_or(asked_.bodies[b].pose);
        break;
      case Step::Op::move:
        now.pose[b] = s.pose;
        break;
      case Step::Op::remove:
        now.pose[b].reset();
        break;
      case Step::Op::query:
        steps_->push_back(now);
        break;
    }
  }
  return *steps_;
}

// The pairs whose outer boxes overlap, then the exact verdict on each remaining pair.
std::vector<Truth::TruePair> Truth::overlapping(const std::vector<std::optional<Placed>>& bodies) {
  std::vector<BoxedBody> entries;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i]) entries.push_back({referee::outer_box(*bodies[i]), static_cast<int>(i)});
  std::vector<TruePair> result;
  for (const auto& [a, b] : overlapping_boxes(std::move(entries))) {
    if (!is_reportable(asked_, a, b)) continue;
    TruePair p{
        {a, b},
        referee::judge_pair(*bodies[static_cast<std::size_t>(a)], *bodies[static_cast<std::size_t>(b)])};
    if (p.truth.verdict == referee::Verdict::undecided) ++undecided_pairs_;
    if (p.truth.verdict == referee::Verdict::overlap) result.push_back(std::move(p));
  }
  return result;
}

namespace {

// Contains every point within half the margin of the box.
Aabb grown(Aabb box, double margin) {
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = std::nextafter(box.lo[k] - margin / 2, -unbounded);
    box.hi[k] = std::nextafter(box.hi[k] + margin / 2, unbounded);
  }
  return box;
}

}  // namespace

std::vector<Truth::TruePair> Truth::near(const std::vector<std::optional<Placed>>& bodies) {
  std::vector<BoxedBody> entries;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i])
      entries.push_back({grown(referee::outer_box(*bodies[i]), asked_.margin), static_cast<int>(i)});
  std::vector<TruePair> result;
  for (const auto& [a, b] : overlapping_boxes(std::move(entries))) {
    if (!is_reportable(asked_, a, b)) continue;
    const Placed &x = *bodies[static_cast<std::size_t>(a)], &y = *bodies[static_cast<std::size_t>(b)];
    TruePair p{{a, b}, referee::judge_pair(x, y)};
    const referee::Verdict within = referee::judge_within(x, y, asked_.margin, p.truth);
    if (within == referee::Verdict::undecided) ++undecided_pairs_within_;
    if (within == referee::Verdict::overlap) result.push_back(std::move(p));
  }
  return result;
}

const std::vector<BodyPair>& Truth::meeting_pairs() {
  if (meeting_pairs_) return *meeting_pairs_;
  meeting_pairs_.emplace();
  std::vector<BoxedBody> entries;
  for (int i = 0; i < static_cast<int>(asked_.bodies.size()); ++i)
    entries.push_back({referee::outer_box(placed(0, i), motion_of(asked_, i)), i});
  for (const auto& [a, b] : overlapping_boxes(std::move(entries))) {
    if (!is_reportable(asked_, a, b)) continue;
    const auto verdict = motion(0, a, b).verdict;
    if (verdict == referee::TimeTruth::Verdict::undecided) ++undecided_meetings_;
    if (verdict == referee::TimeTruth::Verdict::hit) meeting_pairs_->push_back({a, b});
  }
  return *meeting_pairs_;
}

// A body that is no set, which only candidate queries may contain, is in no true pair.
std::vector<std::optional<Placed>> Truth::present(const StepState& state) const {
  std::vector<std::optional<Placed>> bodies(asked_.bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (const Shape& shape = asked_.shape_of(static_cast<int>(i));
        state.pose[i] && is_closed_set(shape, *state.pose[i]))
      bodies[i] = Placed{&shape, *state.pose[i]};
  return bodies;
}

const std::vector<std::vector<Truth::TruePair>>& Truth::true_pairs() {
  if (true_pairs_) return *true_pairs_;
  true_pairs_.emplace();
  for (const StepState& state : steps()) true_pairs_->push_back(overlapping(present(state)));
  return *true_pairs_;
}

const std::vector<std::vector<Truth::TruePair>>& Truth::pairs_within() {
  if (pairs_within_) return *pairs_within_;
  pairs_within_.emplace();
  for (const StepState& state : steps()) pairs_within_->push_back(near(present(state)));
  return *pairs_within_;
}

const std::vector<Truth::TruePair>& Truth::scene_pairs(int frame) {
  auto& cached = frames_[static_cast<std::size_t>(frame)].scene_pairs;
  if (!cached) {
    std::vector<std::optional<Placed>> bodies(asked_.bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) bodies[i] = placed(frame, static_cast<int>(i));
    auto pairs = overlapping(bodies);
    frames_[static_cast<std::size_t>(frame)].scene_pairs = std::move(pairs);
  }
  return *frames_[static_cast<std::size_t>(frame)].scene_pairs;
}

void Truth::hint(int a, int b, const Vec3& direction) {
  if (direction.allFinite() && !direction.isZero(0)) hints_[{a, b}].push_back(direction);
}

}  // namespace touchstone::fuzz
