// Contacts of recorded piles at rest, from frame to frame: how much the answers change beyond the motion of
// the bodies. A pair counts when it touches in both frames and has moved by at most 1 mm (sizes are about 0.5
// m).
#include <algorithm>
#include <filesystem>
#include <vector>

#include "core/narrow/narrow_phase.h"
#include "scenarios/import/real_scene.h"
#include "tests/support/catch.h"
#include "tests/support/shared_data.h"
#include "tests/support/skip.h"

using namespace touchstone;

namespace {

struct Jitter {
  long pairs = 0, flips = 0, other_ids = 0, points = 0;
  std::vector<double> normal,
      point;  // beyond the bodies' own rotation and step; only of pairs that keep their normal and ids
};

struct Touching {
  std::size_t a, b;
  ContactAnswer before, after;
};

double ball(const Shape& s) {
  if (const auto* h = std::get_if<Hull>(&s)) {
    double most = 0;
    for (const Vec3& v : h->vertices) most = std::max(most, v.norm());
    return most;
  }
  return std::sqrt(3.0) * extent(s);
}

ContactAnswer ask(const Scene& s, std::size_t a, std::size_t b) {
  return contact({&s.shape_of(static_cast<int>(a)), s.bodies[a].pose},
                 {&s.shape_of(static_cast<int>(b)), s.bodies[b].pose});
}

std::vector<Touching> touching(const Scene& from, const Scene& to) {
  std::vector<double> radius;
  for (std::size_t i = 0; i < from.bodies.size(); ++i)
    radius.push_back(ball(from.shape_of(static_cast<int>(i))));
  std::vector<Touching> all;
  for (std::size_t a = 0; a < from.bodies.size(); ++a)
    for (std::size_t b = a + 1; b < from.bodies.size(); ++b) {
      const Vec3 d = from.bodies[b].pose.translation - from.bodies[a].pose.translation;
      if (!(d.norm() < radius[a] + radius[b])) continue;
      Touching t{a, b, ask(from, a, b), {}};
      if (t.before.outcome != Outcome::answered || !t.before.overlap) continue;
      t.after = ask(to, a, b);
      if (t.after.outcome == Outcome::answered && t.after.overlap) all.push_back(t);
    }
  return all;
}

std::vector<std::uint32_t> ids(const Manifold& m) {
  std::vector<std::uint32_t> r;
  for (const ContactPoint& p : m) r.push_back(p.feature);
  std::sort(r.begin(), r.end());
  return r;
}

// From the nearest segment between two points of the manifold. Crossings of nearly parallel edges run along
// the border of the same region, far and rightly.
double distance_from(const Manifold& m, const Vec3& p) {
  double nearest = 1e9;
  for (const ContactPoint& from : m)
    for (const ContactPoint& to : m) {
      const Vec3 e = to.position - from.position;
      const double length = e.squaredNorm();
      const double share = length > 0 ? std::clamp((p - from.position).dot(e) / length, 0.0, 1.0) : 0.0;
      nearest = std::min(nearest, (from.position + share * e - p).norm());
    }
  return nearest;
}

// Upper bound on how far a point of a body, within its ball, has moved.
double step_of(const Scene& from, const Scene& to, std::size_t i, double& turn) {
  const Pose &p = from.bodies[i].pose, &q = to.bodies[i].pose;
  const double angle = (rotation_matrix(q.rotation) - rotation_matrix(p.rotation)).norm();
  turn = std::max(turn, angle);
  return (q.translation - p.translation).norm() + angle * ball(from.shape_of(static_cast<int>(i)));
}

void compare(const Scene& from, const Scene& to, Jitter& j) {
  for (const Touching& t : touching(from, to)) {
    double turn = 0;
    const double step = std::max(step_of(from, to, t.a, turn), step_of(from, to, t.b, turn));
    if (step > 1e-3) continue;
    ++j.pairs;
    const double off = (t.after.normal - t.before.normal).norm();
    if (off > 0.1) {
      ++j.flips;
      continue;
    }
    j.normal.push_back(std::max(0.0, off - turn));
    if (ids(t.before.manifold) != ids(t.after.manifold)) {
      ++j.other_ids;
      continue;
    }
    for (const ContactPoint& p : t.after.manifold) {
      j.point.push_back(std::max(0.0, distance_from(t.before.manifold, p.position) - step));
      ++j.points;
    }
  }
}

double quantile(std::vector<double> v, double q) {
  if (v.empty()) return 0;
  std::sort(v.begin(), v.end());
  return v[static_cast<std::size_t>(q * static_cast<double>(v.size() - 1))];
}

Jitter measure(const char* name, int first, int last) {
  const RealScene s = load_real_scene(test::shared_data() / "scenes" / name);
  Jitter j;
  Scene from = s.frame(first);
  for (int f = first; f < last; ++f) {
    Scene to = s.frame(f + 1);
    compare(from, to, j);
    from = std::move(to);
  }
  WARN(name << ": " << j.pairs << " pairs, " << j.flips << " other normals, " << j.other_ids << " other ids, "
            << j.points << " points; normal off by " << quantile(j.normal, 0.5) << ", "
            << quantile(j.normal, 0.99) << ", " << quantile(j.normal, 1) << "; point by "
            << quantile(j.point, 0.5) << ", " << quantile(j.point, 0.99) << ", " << quantile(j.point, 1));
  return j;
}

}  // namespace

TEST_CASE("contacts of piles at rest do not change from frame to frame", "[narrow][manifold][data]") {
  const auto scenes = test::shared_data() / "scenes";
  if (!std::filesystem::exists(scenes)) return test::skip(scenes.string() + " is absent");
  // The rest is geometry: deepest points of rocking cylinders, contacts that end at nearly parallel edges.
  for (const Jitter& j : {measure("stack_smash", 0, 9), measure("pile_mixed", 90, 99)}) {
    CHECK(j.pairs > 1000);
    CHECK(j.points > j.pairs);
    CHECK(j.flips * 1000 <= j.pairs);
    CHECK(quantile(j.normal, 0.5) <= 1e-12);
    CHECK(quantile(j.normal, 0.99) <= 1e-3);
    CHECK(quantile(j.point, 0.5) <= 1e-12);
    CHECK(quantile(j.point, 0.99) <= 1e-3);
  }
}
