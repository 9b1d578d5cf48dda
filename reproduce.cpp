// libccd 2.1 (libccd-gjk): libccd-gjk.contact.normal_not_unit.box-box.algorithm.solid.gross
// the normal has length nan
//
//   g++ -std=c++17 reproduce.cpp -o reproduce -lccd && ./reproduce
//
// Exit code 0: the answer is right; 1: it is wrong (other findings are that the engine crashes or never returns). The
// expected result is certain: it was computed in exact arithmetic.
// A: box of half extents 10.0, 10.0, 10.0
// B: box of half extents 5.0, 5.0, 5.0
#include <ccd/ccd.h>
#include <ccd/vec3.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <utility>
#include <vector>

namespace {

using Vec = std::array<double, 3>;

[[maybe_unused]] double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
[[maybe_unused]] Vec scaled(double s, const Vec& a) { return {s * a[0], s * a[1], s * a[2]}; }

struct Placement {
  double rotation[9];  // by rows
  Vec translation;
};
[[maybe_unused]] Vec to_world(const Placement& t, const Vec& p) {
  const double* r = t.rotation;
  return {r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + t.translation[0],
          r[3] * p[0] + r[4] * p[1] + r[5] * p[2] + t.translation[1],
          r[6] * p[0] + r[7] * p[1] + r[8] * p[2] + t.translation[2]};
}
[[maybe_unused]] Vec to_local(const Placement& t, const Vec& d) {
  const double* r = t.rotation;
  return {r[0] * d[0] + r[3] * d[1] + r[6] * d[2], r[1] * d[0] + r[4] * d[1] + r[7] * d[2],
          r[2] * d[0] + r[5] * d[1] + r[8] * d[2]};
}

// Support mapping of body a: a point of it farthest along `direction`.
Vec support_a(const Vec& direction) {
  static const Placement at = {{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}, {0.0, 0.0, 0.0}};
  const Vec d = to_local(at, direction);
  Vec p;
  p[0] = std::copysign(10.0, d[0]);
  p[1] = std::copysign(10.0, d[1]);
  p[2] = std::copysign(10.0, d[2]);
  return to_world(at, p);
}

// Support mapping of body b: a point of it farthest along `direction`.
Vec support_b(const Vec& direction) {
  static const Placement at = {{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}, {14.0, 14.0, 14.0}};
  const Vec d = to_local(at, direction);
  Vec p;
  p[0] = std::copysign(5.0, d[0]);
  p[1] = std::copysign(5.0, d[1]);
  p[2] = std::copysign(5.0, d[2]);
  return to_world(at, p);
}

// The engine's answer. Normals point from A to B.
struct Answer {
  bool overlap = false, hit = false;  // hit: the engine reports an impact, at the time `impact`
  double distance = INFINITY, depth = -INFINITY, impact = NAN;
  Vec normal{}, on_a{}, on_b{};
  std::vector<Vec> points;
};

void support1(const void*, const ccd_vec3_t* d, ccd_vec3_t* out) {
  const Vec p = support_a({d->v[0], d->v[1], d->v[2]});
  ccdVec3Set(out, p[0], p[1], p[2]);
}
void support2(const void*, const ccd_vec3_t* d, ccd_vec3_t* out) {
  const Vec p = support_b({d->v[0], d->v[1], d->v[2]});
  ccdVec3Set(out, p[0], p[1], p[2]);
}
void center_a(const void*, ccd_vec3_t* out) { ccdVec3Set(out, 0.0, 0.0, 0.0); }
void center_b(const void*, ccd_vec3_t* out) { ccdVec3Set(out, 14.0, 14.0, 14.0); }

Answer ask() {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = support1;
  ccd.support2 = support2;
  ccd.center1 = center_a;
  ccd.center2 = center_b;
  Answer x;
  ccd_real_t depth = NAN;
  ccd_vec3_t direction, position;
  ccdVec3Set(&direction, NAN, NAN, NAN);
  ccdVec3Set(&position, NAN, NAN, NAN);
  x.overlap = ccdGJKPenetration(nullptr, nullptr, &ccd, &depth, &direction, &position) == 0;
  if (x.overlap) {
    x.depth = depth;
    x.normal = {direction.v[0], direction.v[1], direction.v[2]};
    x.points = {{position.v[0], position.v[1], position.v[2]}};
  }
  return x;
}

// Moving B by width(n) along n separates the bodies; moving it by less does not. So a depth with normal n must
// equal width(n), and width(n) must be the minimum over n, which is certainly within [0.9999999999999998, 1.0000000000000002].
double width(const Vec& n) { return dot(n, support_a(n)) - dot(n, support_b(scaled(-1, n))); }

bool check(const Answer& x) {
  std::printf("says: %s, depth %.17g, normal (%.17g, %.17g, %.17g)\n", x.overlap ? "overlap" : "apart", x.depth,
              x.normal[0], x.normal[1], x.normal[2]);
  std::printf("expected: overlap, depth within [%.17g, %.17g], tolerance %g\n", 0.9999999999999998, 1.0000000000000002, 0.00010000000068918983);
  if (!x.overlap) return false;
  const double length = std::sqrt(dot(x.normal, x.normal));
  if (!(std::fabs(length - 1) <= 1e-6)) {
    std::printf("the normal has length %.17g\n", length);
    return false;
  }
  const double w = width(x.normal);
  std::printf("the reported normal needs a depth of %.17g\n", w);
  return std::fabs(x.depth - w) <= 0.00010000000068918983 && w <= 1.0000000000000002 + 0.00010000000068918983;
}

}  // namespace

int main() {
  try {
    const bool right = check(ask());
    std::puts(right ? "right" : "WRONG");
    return right ? 0 : 1;
  } catch (const std::exception& e) {
    std::printf("WRONG: threw: %s\n", e.what());
    return 1;
  }
}
