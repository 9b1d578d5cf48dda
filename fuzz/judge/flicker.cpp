#include "fuzz/judge/flicker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <tuple>

#include "core/shape/convex_body.h"
#include "fuzz/judge/frames.h"
#include "fuzz/judge/tau.h"
#include "oracles/referee/region/contact_region.h"

namespace touchstone::fuzz {
namespace {

constexpr int arc_steps = 16;  // at which a ridge between two normals is looked for

double angle_between(const Vec3& x, const Vec3& y) { return std::atan2(x.cross(y).norm(), x.dot(y)); }

struct Pair {
  const AnsweredFrame& before;
  const AnsweredFrame& after;
  const Query& q;
  const EngineCard& card;
  std::array<Carried, 3> ways;

  double scale() const { return std::max(before.truth.scale(q.a, q.b), after.truth.scale(q.a, q.b)); }
  /// Of arithmetic alone, without what the engine claims.
  double rounding() const {
    return card.tau_factor * pair_roundoff(card, after.truth.scene(), q.a, q.b) * scale();
  }
  /// The larger depth, at most: how far below a plane of contact corners may lie.
  double deepest() const {
    return -std::min(before.truth.pair(0, q.a, q.b).gap.lo, after.truth.pair(0, q.a, q.b).gap.lo);
  }
  double least_change() const { return std::min({ways[0].change, ways[1].change, ways[2].change}); }
  referee::Bracket width(const Vec3& n) const { return after.truth.width(0, q.a, q.b, n); }
  bool overlap(const AnsweredFrame& f) const {
    const referee::PairTruth& t = f.truth.pair(0, q.a, q.b);
    return t.verdict == referee::Verdict::overlap && std::isfinite(t.gap.lo);
  }
};

bool has_surface(const Scene& s, const Query& q) {
  return kind_of(s.shape_of(q.a)) == ShapeKind::mesh || kind_of(s.shape_of(q.b)) == ShapeKind::mesh;
}

bool states_contact(const Observation& o) {
  return o.overlap && *o.overlap && o.normal && o.normal->allFinite() && o.normal->norm() > 0;
}

// Whether some direction on the shorter arc from n to m needs more than both, by more than the motion can
// have levelled out: then the two lie on different features in both frames.
bool has_ridge_between(const Pair& p, const Vec3& n, const Vec3& m, double change) {
  const double ends = std::max(p.width(n).hi, p.width(m).hi);
  if (!std::isfinite(ends)) return true;  // one of them leads into a half-space, or along it
  const double level = std::max(0.0, ends) + 2 * (change + p.rounding());
  const double angle = angle_between(n, m);
  // On the arc w(x) <= ends / cos(angle/2), since w is convex along the chord.
  if (ends <= level * std::cos(angle / 2)) return false;
  Vec3 aside = m - n.dot(m) * n;
  if (!(aside.norm() > 0)) aside = n.unitOrthogonal();
  aside.normalize();
  for (int i = 1; i < arc_steps; ++i) {
    const double t = angle * i / arc_steps;
    if (p.width(std::cos(t) * n + std::sin(t) * aside).lo > level) return true;
  }
  return false;
}

std::string vector_text(const Vec3& v) { return fmt::format("({:.6g} {:.6g} {:.6g})", v.x(), v.y(), v.z()); }

// "face", "edge" or "point" of the body that is ahead along n.
std::string_view feature(const Placed& body, const Vec3& n, double slack) {
  const Shape plane = HalfSpace{-n, 0};
  const Placed ahead{&plane, Pose{}};
  if (kind_of(*body.shape) == ShapeKind::half_space) return "plane";
  using enum referee::ContactRegion::Kind;
  switch (referee::contact_region(body, ahead, n, slack).kind) {
    case polygon:
      return "face";
    case segment:
      return "edge";
    case point:
      return "point";
    case none:
      break;
  }
  return "nothing";
}

std::string features(const Pair& p, const Vec3& n) {
  const double slack = referee::contact_slack_factor * p.scale();
  return fmt::format("{} of {} on {} of {}", feature(p.after.truth.placed(0, p.q.a), n, slack), p.q.a,
                     feature(p.after.truth.placed(0, p.q.b), -n, slack), p.q.b);
}

FlickerReport report(const Pair& p, Flicker f, int frame, double amount, std::string words) {
  FlickerReport r{f, frame, p.q.question, p.q.a, p.q.b, Vec3::Zero(), Vec3::Zero(), amount, std::move(words)};
  if (p.before.answer.normal) r.before = *p.before.answer.normal;
  if (p.after.answer.normal) r.after = *p.after.answer.normal;
  return r;
}

// The normal left its feature. Was there a reason to?
void judge_jump(const Pair& p, int frame, const std::array<Vec3, 3>& kept, const Vec3& now, double angle,
                FrameChange& out) {
  const referee::Bracket new_width = p.width(now);
  bool better_than_all = true;
  const Vec3* better = nullptr;
  for (const Vec3& n : kept) {
    const referee::Bracket w = p.width(n);
    better_than_all &= new_width.hi < w.lo;
    if (w.hi < new_width.lo && (!better || w.hi < p.width(*better).hi)) better = &n;
  }
  const Vec3& shown = better ? *better : kept[0];
  const std::string numbers =
      fmt::format("from {} to {}, {:.4g} rad: the old one needs {:.12g}, the new one {:.12g}",
                  vector_text(shown), vector_text(now), angle, p.width(shown).lo, new_width.hi);
  if (better_than_all) {
    out.true_switch = true;
    out.switch_words = fmt::format("{}; {} before, {} now", numbers, features(p, shown), features(p, now));
  } else if (better) {
    out.flickers.push_back(report(p, Flicker::needless, frame, angle, "the normal jumps " + numbers));
  } else {
    out.flickers.push_back(report(p, Flicker::tied, frame, angle,
                                  "the normal jumps " + numbers + ", which proves neither to need more"));
  }
}

// By how much the stated normal turns more than the referee's; 0 where one of the two is on another feature.
double restlessness(const Pair& p, double stated_turn) {
  constexpr double same_feature = 0.1;  // rad
  const Vec3 &was = p.before.truth.pair(0, p.q.a, p.q.b).normal,
             &is = p.after.truth.pair(0, p.q.a, p.q.b).normal;
  if (angle_between(was, *p.before.answer.normal) > same_feature ||
      angle_between(is, *p.after.answer.normal) > same_feature)
    return 0;
  double least = std::numbers::pi;
  for (const Carried& w : p.ways) least = std::min(least, angle_between(w.turn * was, is));
  return std::max(0.0, stated_turn - least);
}

/// True if the normal did not leave its feature.
bool judge_normals(const Pair& p, int frame, FrameChange& out) {
  const Vec3 now = p.after.answer.normal->normalized();
  std::array<Vec3, 3> kept;
  double angle = std::numbers::pi;
  bool steady = false;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    kept[k] = p.ways[k].turn * p.before.answer.normal->normalized();
    angle = std::min(angle, angle_between(kept[k], now));
    steady = steady || !has_ridge_between(p, kept[k], now, p.ways[k].change);
  }
  if (steady)
    out.restless = restlessness(p, angle);
  else
    judge_jump(p, frame, kept, now, angle, out);
  return steady;
}

// The depth and the distance change at most as much as the motion's widths do.
void judge_number(const Pair& p, int frame, std::optional<double> was, std::optional<double> is,
                  FrameChange& out) {
  if (!was || !is || !std::isfinite(*was) || !std::isfinite(*is)) return;
  const double change = std::abs(*is - *was), most = p.least_change() + 2 * p.rounding();
  if (!(change > most)) return;
  const std::string_view what = p.q.question == Question::contact ? "depth" : "distance";
  out.flickers.push_back(
      report(p, Flicker::depth, frame, change - most,
             fmt::format("the {} goes from {:.9g} to {:.9g}; the motion changes it by at most {:.6g}", what,
                         *was, *is, p.least_change())));
}

void judge_verdicts(const Pair& p, int frame, FrameChange& out) {
  const auto &was = p.before.answer.overlap, &is = p.after.answer.overlap;
  if (!was || !is || *was == *is) return;
  const referee::PairTruth &t0 = p.before.truth.pair(0, p.q.a, p.q.b),
                           &t1 = p.after.truth.pair(0, p.q.a, p.q.b);
  if (t0.verdict != t1.verdict || t0.verdict == referee::Verdict::undecided) return;
  const referee::Bracket gap = *is == (t1.verdict == referee::Verdict::overlap) ? t0.gap : t1.gap;
  const double least = std::max(0.0, std::max(gap.lo, -gap.hi));
  out.flickers.push_back(
      report(p, Flicker::verdict, frame, least,
             fmt::format("the overlap is {} after it was {}; both frames {}, by at least {:.6g}",
                         *is ? "stated" : "denied", *was ? "stated" : "denied",
                         t1.verdict == referee::Verdict::overlap ? "overlap" : "are apart", least)));
}

using Points = std::vector<Vec3>;

Points points_of(const Observation& o) {
  Points all;
  for (const ManifoldPoint& m : o.manifold)
    if (m.position.allFinite()) all.push_back(m.position);
  return all;
}

double distance_from(const Vec3& p, const Points& all) {
  double least = (p - all.front()).norm();
  for (const Vec3& q : all) least = std::min(least, (p - q).norm());
  return least;
}

// The largest distance of a point of either set from the other.
double set_distance(const Points& x, const Points& y) {
  double worst = 0;
  for (const Vec3& p : x) worst = std::max(worst, distance_from(p, y));
  for (const Vec3& p : y) worst = std::max(worst, distance_from(p, x));
  return worst;
}

Points moved(const Carried& way, Points all) {
  for (Vec3& p : all) p = way.point(p);
  return all;
}

/// How far below the support planes corners of A and of B belong to the contact.
struct Slacks {
  double a, b;
};

referee::ContactRegion region(const Pair& p, const AnsweredFrame& f, const Slacks& slack) {
  return referee::contact_region(f.truth.placed(0, p.q.a), f.truth.placed(0, p.q.b), *f.answer.normal,
                                 slack.a, slack.b);
}

bool keeps_corners(const referee::ContactRegion& was, const referee::ContactRegion& is) {
  return was.kind == is.kind && was.kind != referee::ContactRegion::Kind::none &&
         was.vertices.size() == is.vertices.size();
}

// From what lies in one plane to all that lies deeper than the other body's plane, and just beyond each
// stated point: one that comes or goes with a corner of the bodies is no flicker. Of both bodies alike, or
// against the face of one.
std::vector<Slacks> region_slacks(const Pair& p) {
  constexpr int levels = 8;
  const double least = referee::contact_slack_factor * p.scale();
  const double most = std::max(2 * least, p.deepest());
  std::vector<double> slacks;
  for (int i = 0; i < levels; ++i)
    slacks.push_back(least * std::pow(most / least, static_cast<double>(i) / (levels - 1)));
  for (const AnsweredFrame* f : {&p.before, &p.after}) {
    if (!f->answer.depth) continue;
    for (const ManifoldPoint& m : f->answer.manifold)
      if (const double below = *f->answer.depth - m.depth; below > least && below < most)
        slacks.push_back(below + least / 2);
  }
  std::vector<Slacks> all;
  for (const double s : slacks) {
    all.push_back({s, s});
    if (s > least) all.insert(all.end(), {{least, s}, {s, least}});
  }
  return all;
}

// Whether holds(before, after) for the regions that the two frames have at some one slack: at the height of a
// corner of a body in either frame, or for what lies deeper than the other body's plane. An engine that takes
// corners up to some slack may have begun or ceased there to take one. Or for the corners of what one body
// has beyond the other's face, where edges begin or cease to cross the face's border.
template <class Holds>
bool holds_at_corners(const Pair& p, const Holds& holds) {
  const double least = referee::contact_slack_factor * p.scale(), most = p.deepest();
  const auto at = [&](const Slacks& before, const Slacks& after) {
    return holds(region(p, p.before, before).vertices, region(p, p.after, after).vertices);
  };
  for (const AnsweredFrame* f : {&p.before, &p.after}) {
    const Vec3& n = *f->answer.normal;
    for (const auto& [body, ahead] : {std::pair(p.q.a, n), std::pair(p.q.b, Vec3(-n))})
      for (const double below : referee::corner_heights(f->truth.placed(0, body), ahead))
        if (const double s = below + least / 2; s > least && s < most && at({s, s}, {s, s})) return true;
  }
  const double was = p.before.answer.depth.value_or(0), is = p.after.answer.depth.value_or(0);
  if (std::min(was, is) > least && (at({least, was}, {least, is}) || at({was, least}, {is, least})))
    return true;
  const auto beyond = [&](const AnsweredFrame& f, bool face_of_a) {
    const Placed a = f.truth.placed(0, p.q.a), b = f.truth.placed(0, p.q.b);
    const Vec3& n = *f.answer.normal;
    return face_of_a ? referee::corners_beyond_face(a, b, n, least)
                     : referee::corners_beyond_face(b, a, -n, least);
  };
  for (const bool face_of_a : {true, false}) {
    const auto deep_before = beyond(p.before, face_of_a), deep_after = beyond(p.after, face_of_a);
    if (deep_before && deep_after && holds(*deep_before, *deep_after)) return true;
  }
  return false;
}

// Whether the truth's normal leads from another kind of feature than before on either body: from an edge to a
// face, say.
bool switches_features(const Pair& p) {
  const double slack = referee::contact_slack_factor * p.scale();
  const auto has_normal = [&](const AnsweredFrame& f) {
    return f.truth.pair(0, p.q.a, p.q.b).normal.norm() > 0;
  };
  if (!has_normal(p.before) || !has_normal(p.after)) return false;
  const auto of = [&](const AnsweredFrame& f, int body, double side) {
    return feature(f.truth.placed(0, body), side * f.truth.pair(0, p.q.a, p.q.b).normal, slack);
  };
  return of(p.before, p.q.a, 1) != of(p.after, p.q.a, 1) || of(p.before, p.q.b, -1) != of(p.after, p.q.b, -1);
}

double rim_radius(const Shape& s) {
  return std::visit(
      []<class S>(const S& x) -> double {
        if constexpr (std::is_same_v<S, Cylinder> || std::is_same_v<S, Cone>)
          return x.radius;
        else if constexpr (requires { x.inner; })
          return rim_radius(Shape(x.inner));
        else
          return 0;
      },
      s);
}

// Whether more ends of rims are within some slack of a body's support plane after than before, or fewer. An
// engine that takes a rim only as a whole may have begun or ceased there to do so.
bool gains_rims(const Pair& p, bool more) {
  const double least = referee::contact_slack_factor * p.scale(), most = p.deepest();
  for (const bool is_a : {true, false}) {
    const int body = is_a ? p.q.a : p.q.b;
    if (rim_radius(p.after.truth.scene().shape_of(body)) == 0) continue;
    const auto heights = [&](const AnsweredFrame& f) {
      return referee::corner_heights(f.truth.placed(0, body), (is_a ? 1 : -1) * *f.answer.normal);
    };
    const auto within = [&](const std::vector<double>& h, double slack) {
      return std::count_if(h.begin(), h.end(), [&](double x) { return x <= slack; });
    };
    const auto was = heights(p.before), is = heights(p.after);
    const auto holds = [&](double before, double after) {
      const auto n = within(was, before), m = within(is, after);
      return more ? m > n : m < n;
    };
    for (const auto* all : {&was, &is})
      for (const double h : *all)
        if (h > least && h < most && holds(h, h)) return true;
    if (holds(p.before.answer.depth.value_or(0), p.after.answer.depth.value_or(0))) return true;
  }
  return false;
}

// Whether some slack gives the region more corners after than before, or fewer: as the points; or lets it
// grow, or shrink, farther than the bodies move.
bool gains_corners(const Pair& p, bool more) {
  const Vec3& n = *p.after.answer.normal;
  const double least = p.least_change() + referee::contact_slack_factor * p.scale();
  const auto grows = [&](const Points& was, const Points& is) {
    return is.size() > was.size() ||
           referee::spanned_length(is, n) > referee::spanned_length(was, n) + 2 * least;
  };
  return gains_rims(p, more) || holds_at_corners(p, [&](const Points& was, const Points& is) {
           return more ? grows(was, is) : grows(is, was);
         });
}

// How far the corners of the contact region move, seen in each of the three ways: the most over the regions
// that engines may mean. Empty if one of these regions gets other corners.
std::optional<std::array<double, 3>> moved_corners(const Pair& p) {
  std::array<double, 3> moved_most{};
  for (const Slacks& slack : region_slacks(p)) {
    const referee::ContactRegion was = region(p, p.before, slack), is = region(p, p.after, slack);
    if (!keeps_corners(was, is)) return std::nullopt;
    for (std::size_t k = 0; k < moved_most.size(); ++k)
      moved_most[k] = std::max(
          moved_most[k], set_distance(moved(p.ways[k], was.vertices), is.vertices) + was.error + is.error);
  }
  return moved_most;
}

// Whether the region jumps at least as far at one of these slacks.
bool is_jump_of_region(const Pair& p, double by) {
  return holds_at_corners(p, [&](const Points& was, const Points& is) {
    return !was.empty() && !is.empty() && std::all_of(p.ways.begin(), p.ways.end(), [&](const Carried& way) {
      return set_distance(moved(way, was), is) >= by;
    });
  });
}

// The numbers that the points of `is` have in `was`, if they are the same points and clearly so.
std::optional<std::vector<std::size_t>> places(const Points& was, const Points& is) {
  constexpr double clearly = 0.5;  // of the distance of the second nearest
  std::vector<std::size_t> numbers;
  for (const Vec3& p : is) {
    std::vector<std::pair<double, std::size_t>> near;
    for (std::size_t i = 0; i < was.size(); ++i) near.emplace_back((p - was[i]).norm(), i);
    std::sort(near.begin(), near.end());
    if (!(near[0].first < clearly * near[1].first)) return std::nullopt;
    numbers.push_back(near[0].second);
  }
  auto sorted = numbers;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < sorted.size(); ++i)
    if (sorted[i] != i) return std::nullopt;
  return numbers;
}

bool is_reordered(const Pair& p, const Points& was, const Points& is) {
  if (was.size() < 2) return false;
  return std::all_of(p.ways.begin(), p.ways.end(), [&](const Carried& way) {
    const auto numbers = places(moved(way, was), is);
    return numbers && !std::is_sorted(numbers->begin(), numbers->end());
  });
}

// A point that clearly stays where it is on a body, and gets another id.
struct Renamed {
  std::string_view body;  // "A" or "B"
  const ManifoldPoint *before, *after;
};

// The only one of the points within `same` of `place`, if no other is within `other`.
const ManifoldPoint* point_at(const Carried& way, const std::vector<ManifoldPoint>& was, const Vec3& place,
                              double same, double other) {
  const ManifoldPoint* found = nullptr;
  for (const ManifoldPoint& p : was) {
    const double apart = (way.point(p.position) - place).norm();
    if (!(apart <= other)) continue;
    if (found || !(apart <= same)) return nullptr;
    found = &p;
  }
  return found;
}

// A round face has no corners: engines may take any points of its rim, which a turn carries onto each other.
bool has_corners(const Shape& s) {
  return std::visit([](const auto& x) { return is_polytope_shape<std::decay_t<decltype(x)>>; }, s);
}

std::optional<Renamed> renamed_point(const Pair& p) {
  constexpr double clearly = 1e-3;  // of the scale
  const double same = 4 * (referee::contact_slack_factor * p.scale() + p.rounding());
  const double other = std::max(2 * same, clearly * p.scale());
  const Scene& s = p.after.truth.scene();
  if (!has_corners(s.shape_of(p.q.a)) || !has_corners(s.shape_of(p.q.b))) return std::nullopt;
  const auto is_alone = [&](const ManifoldPoint& m) {
    return std::none_of(
        p.after.answer.manifold.begin(), p.after.answer.manifold.end(),
        [&](const ManifoldPoint& x) { return &x != &m && (x.position - m.position).norm() <= other; });
  };
  for (const auto& [name, way] : {std::pair("A", p.ways[1]), std::pair("B", p.ways[2])}) {
    for (const ManifoldPoint& is : p.after.answer.manifold) {
      if (!is_alone(is)) continue;
      const ManifoldPoint* const was = point_at(way, p.before.answer.manifold, is.position, same, other);
      if (was && was->id && is.id && *was->id != *is.id) return Renamed{name, was, &is};
    }
  }
  return std::nullopt;
}

// How far a rim bulges between two points that stand for it, at most.
double bulge(const Pair& p) {
  constexpr double step = std::numbers::pi / 8;  // between the two
  const Scene& s = p.after.truth.scene();
  return std::max(rim_radius(s.shape_of(p.q.a)), rim_radius(s.shape_of(p.q.b))) * (1 - std::cos(step / 2));
}

// The largest distance of a point of either set from the hull of the other. A point that moves inside it, as
// the deepest of a face that rocks does, leaves the contact as it is.
double hull_distance(const Points& x, const Points& y, const Vec3& normal) {
  double worst = 0;
  for (const Vec3& p : x) worst = std::max(worst, referee::distance_from_span(p, y, normal));
  for (const Vec3& p : y) worst = std::max(worst, referee::distance_from_span(p, x, normal));
  return worst;
}

// How much farther the points move than the region's corners, at least, however they are carried along.
double excess_of_points(const Pair& p, const Points& was, const Points& is, double allowed) {
  const double slack = 4 * (referee::contact_slack_factor * p.scale() + p.rounding()) + allowed;
  const Vec3& normal = *p.after.answer.normal;
  std::array<double, 3> beyond{};
  for (std::size_t k = 0; k < beyond.size(); ++k)
    beyond[k] = hull_distance(moved(p.ways[k], was), is, normal) - p.ways[k].change - slack;
  if (!(*std::min_element(beyond.begin(), beyond.end()) > 0)) return 0;
  const auto of_region = moved_corners(p);
  if (!of_region) return 0;
  for (std::size_t k = 0; k < beyond.size(); ++k) beyond[k] -= (*of_region)[k];
  const double excess = *std::min_element(beyond.begin(), beyond.end());
  return excess > 0 && (switches_features(p) || is_jump_of_region(p, excess)) ? 0 : excess;
}

// By how much a point of the earlier frame gets deeper: how far the bodies move towards each other along the
// normal there, at least and at most, over the ways in which the normal can be carried along.
Interval<double> sinking(const Pair& p, const Vec3& at) {
  const Vec3 nearer = p.ways[1].point(at) - p.ways[2].point(at);
  const Vec3 n = p.before.answer.normal->normalized();
  Interval<double> r{infinity, -infinity};
  for (const Carried& way : p.ways) {
    const double by = (way.turn * n).dot(nearer);
    r = {std::min(r.lo, by), std::max(r.hi, by)};
  }
  return r;
}

std::size_t number_of(const Observation& o, const std::function<bool(const ManifoldPoint&)>& is_one) {
  return static_cast<std::size_t>(
      std::count_if(o.manifold.begin(), o.manifold.end(),
                    [&](const ManifoldPoint& m) { return m.position.allFinite() && is_one(m); }));
}

// Whether both bodies have left a point of contact sideways: A's surface there, moved with A, lies outside B
// in the other frame, and B's, moved with B, outside A. Where an edge of one crosses the border of a face of
// the other, which goes faster than either body.
bool is_left(const Pair& p, const ManifoldPoint& m, bool earlier, double slack) {
  const AnsweredFrame &here = earlier ? p.after : p.before, &there = earlier ? p.before : p.after;
  const Vec3 half = here.answer.normal->normalized() * (m.depth / 2);
  const auto is_outside = [&](const Vec3& end, const Carried& way, int body) {
    const Vec3 place = earlier ? way.earlier(end) : way.point(end);
    return there.truth.distance_to(0, body, place, slack).lo > slack;
  };
  return is_outside(m.position + half, p.ways[1], p.q.b) && is_outside(m.position - half, p.ways[2], p.q.a);
}

// Whether the points that come were not below the surface before, and those that go are not now: corners of
// one body that pass the other's plane, or edges that pass its border.
bool changes_at_surface(const Pair& p, std::size_t was, std::size_t is) {
  const double slack = referee::contact_slack_factor * p.scale() + 2 * p.rounding();
  const std::size_t stay = number_of(p.before.answer, [&](const ManifoldPoint& m) {
    return m.depth + sinking(p, m.position).lo > slack && !is_left(p, m, false, slack);
  });
  const std::size_t stayed = number_of(p.after.answer, [&](const ManifoldPoint& m) {
    const bool was_below = std::all_of(p.ways.begin() + 1, p.ways.end(), [&](const Carried& body) {
      return m.depth - sinking(p, body.earlier(m.position)).hi > slack;
    });
    return was_below && !is_left(p, m, true, slack);
  });
  return stay <= is && stayed <= was;
}

void judge_manifolds(const Pair& p, int frame, FrameChange& out) {
  const Points was = points_of(p.before.answer), is = points_of(p.after.answer);
  if (was.size() != is.size()) {
    // A rim has no corners to count.
    if (const double b = bulge(p); b > 0 && excess_of_points(p, was, is, b) == 0) return;
    if (changes_at_surface(p, was.size(), is.size()) || !moved_corners(p)) return;
    if (switches_features(p) || gains_corners(p, is.size() > was.size())) return;
    out.flickers.push_back(report(
        p, Flicker::count, frame, std::abs(static_cast<double>(is.size()) - static_cast<double>(was.size())),
        fmt::format("{} points after {}; the contact region keeps its corners", is.size(), was.size())));
    return;
  }
  if (is.empty()) return;
  // Many points of a contact with a rim stand for the rim, wherever they are on it.
  constexpr std::size_t many = 8;
  if (const double excess = excess_of_points(p, was, is, is.size() < many ? 0 : bulge(p)); excess > 0) {
    out.flickers.push_back(
        report(p, Flicker::points, frame, excess,
               fmt::format("the points move {:.6g} farther than the corners of the contact region", excess)));
    return;
  }
  if (const auto renamed = renamed_point(p); renamed && moved_corners(p))
    out.flickers.push_back(
        report(p, Flicker::ids, frame, 1,
               fmt::format("the point at {} stays where it is on {}; its id was {} and is {}",
                           vector_text(renamed->after->position), renamed->body, *renamed->before->id,
                           *renamed->after->id)));
  if (is_reordered(p, was, is))
    out.flickers.push_back(
        report(p, Flicker::order, frame, 0, "the points are the same, listed in another order"));
}

std::string with_and_without(std::string_view with, std::string_view without) {
  return fmt::format("{} after the earlier frames, {} without them", with, without);
}
std::string verdict_text(const Observation& o) {
  return !o.overlap ? "no verdict" : *o.overlap ? "overlap" : "apart";
}
std::string number_text(const std::optional<double>& x) {
  return x ? fmt::format("{:.9g}", *x) : "no number";
}
std::string normal_text(const Observation& o) {
  return o.normal ? "normal " + vector_text(*o.normal) : "no normal";
}
bool is_beyond(double tau, const std::optional<double>& x, const std::optional<double>& y) {
  return x.has_value() != y.has_value() || (x && !(std::abs(*x - *y) <= tau));
}
// A direction within τ of the best may be off by an angle of √(τ/L), to either side.
bool normals_differ(const std::optional<Vec3>& x, const std::optional<Vec3>& y, double tau_in_l) {
  return x.has_value() != y.has_value() || (x && !(angle_between(*x, *y) <= 2 * std::sqrt(tau_in_l)));
}

}  // namespace

FrameChange change_between(const AnsweredFrame& before, const AnsweredFrame& after, const Query& q,
                           const EngineCard& card, int frame) {
  FrameChange out;
  const Observation &was = before.answer, &is = after.answer;
  if (was.outcome != Outcome::answered || is.outcome != Outcome::answered) return out;
  out.compared = true;
  const Pair p{before, after, q, card, carried(before.truth.scene(), after.truth.scene(), q.a, q.b)};
  judge_verdicts(p, frame, out);
  if (has_surface(after.truth.scene(), q)) return out;
  if (q.question == Question::distance) judge_number(p, frame, was.distance, is.distance, out);
  if (q.question != Question::contact || !states_contact(was) || !states_contact(is)) return out;
  if (!p.overlap(before) || !p.overlap(after)) return out;
  judge_number(p, frame, was.depth, is.depth, out);
  if (judge_normals(p, frame, out)) judge_manifolds(p, frame, out);
  return out;
}

std::string difference_by_state(const EngineCard& card, Truth& truth, const Query& q,
                                const Observation& in_order, const Observation& alone) {
  if (in_order.outcome != alone.outcome)
    return with_and_without(to_string(in_order.outcome), to_string(alone.outcome));
  if (in_order.outcome != Outcome::answered) return "";
  const double l = truth.scale(q.a, q.b);
  const double tau = std::max(tau_of(card, in_order, truth.scene(), q.a, q.b, l),
                              tau_of(card, alone, truth.scene(), q.a, q.b, l));
  if (in_order.overlap != alone.overlap) {
    const referee::Bracket gap = truth.pair(0, q.a, q.b).gap;
    const bool is_within = std::max(gap.lo, -gap.hi) <= tau + contact_offset(card);
    return is_within ? "" : with_and_without(verdict_text(in_order), verdict_text(alone));
  }
  for (const auto& [x, y] :
       {std::pair(in_order.distance, alone.distance), std::pair(in_order.depth, alone.depth)})
    if (is_beyond(tau, x, y)) return with_and_without(number_text(x), number_text(y));
  if (normals_differ(in_order.normal, alone.normal, tau / l))
    return with_and_without(normal_text(in_order), normal_text(alone));
  // Kept points are what a documented tolerance is for: each was judged in its frame.
  if (believed_claim(card, in_order) > 0) return "";
  const Points x = points_of(in_order), y = points_of(alone);
  if (x.size() != y.size())
    return with_and_without(fmt::format("{} points", x.size()), fmt::format("{} points", y.size()));
  if (const double apart = x.empty() ? 0 : set_distance(x, y); !(apart <= tau + std::sqrt(tau * l)))
    return fmt::format("the points are {:.6g} apart from those without the earlier frames", apart);
  return "";
}

}  // namespace touchstone::fuzz
