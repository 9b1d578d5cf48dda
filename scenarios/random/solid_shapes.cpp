#include "scenarios/random/random_shape.h"

#include <cmath>
#include <map>
#include <numbers>

namespace touchstone::fuzz {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

void quad(Triangles& t, int a, int b, int c, int d) {
  t.push_back({a, b, c});
  t.push_back({a, c, d});
}

// Seen from the origin, no two triangles cover each other, whatever the radii.
TriangleMesh ball_or_star(Rng& rng, double least) {
  TriangleMesh m = octahedron();
  const auto size = rng.below(8);  // 8, 32 or, rarely, 128 triangles
  if (size >= 3) m = divided(m, true);
  if (size == 7) m = divided(m, true);
  for (Vec3& v : m.vertices) v *= rng.uniform(least, 1);
  return m;
}

// Eight corners from (-x, -y, -z) to (x, y, z): bit k of the number is the side along axis k.
void add_box(TriangleMesh& m, const Vec3& half, bool is_cavity) {
  const int o = static_cast<int>(m.vertices.size());
  for (int i = 0; i < 8; ++i)
    m.vertices.push_back(half.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  Triangles t;
  quad(t, 0, 4, 6, 2);
  quad(t, 1, 3, 7, 5);
  quad(t, 0, 1, 5, 4);
  quad(t, 2, 6, 7, 3);
  quad(t, 0, 2, 3, 1);
  quad(t, 4, 5, 7, 6);
  for (const auto& [a, b, c] : t) {
    if (is_cavity)
      m.triangles.push_back({o + a, o + c, o + b});
    else
      m.triangles.push_back({o + a, o + b, o + c});
  }
}

// A base whose corners are all seen from the first.
TriangleMesh prism(Rng& rng) {
  const double x = rng.uniform(0.2, 0.9), y = rng.uniform(0.2, 0.9), h = rng.uniform(0.2, 1);
  const double base[][2] = {{0, 0}, {1, 0}, {1, y}, {x, y}, {x, 1}, {0, 1}};
  TriangleMesh m;
  for (const double z : {-h / 2, h / 2})
    for (const auto& p : base) m.vertices.push_back({p[0] * 1.5 - 0.5, p[1] * 1.5 - 0.5, z});
  for (int i = 1; i + 1 < 6; ++i) {
    m.triangles.push_back({6, 6 + i, 7 + i});
    m.triangles.push_back({0, i + 1, i});
  }
  for (int i = 0; i < 6; ++i) quad(m.triangles, i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i);
  return m;
}

TriangleMesh ring(Rng& rng) {
  const int around = 5 + static_cast<int>(rng.below(5));
  const double thin = rng.uniform(0.15, 0.35), high = rng.uniform(0.1, 0.5);
  const double section[][2] = {{1 - thin, -high}, {1, -high}, {1, high}, {1 - thin, high}};
  TriangleMesh m;
  for (int i = 0; i < around; ++i) {
    const double angle = 2 * std::numbers::pi * i / around;
    for (const auto& p : section)
      m.vertices.push_back({p[0] * std::cos(angle), p[0] * std::sin(angle), p[1]});
  }
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < 4; ++k) {
      const int a = 4 * i, b = 4 * ((i + 1) % around), l = (k + 1) % 4;
      quad(m.triangles, a + k, b + k, b + l, a + l);
    }
  return m;
}

TriangleMesh box(Rng& rng, bool with_cavity) {
  const Vec3 half{rng.uniform(0.4, 1), rng.uniform(0.4, 1), rng.uniform(0.4, 1)};
  TriangleMesh m;
  add_box(m, half, false);
  if (with_cavity) add_box(m, half * rng.uniform(0.3, 0.8), true);
  return m;
}

TriangleMesh surface(Rng& rng) {
  switch (rng.below(8)) {
    case 0:
      return ball_or_star(rng, 1);
    case 1:
    case 2:
      return ball_or_star(rng, 0.5);
    case 3:
    case 4:
      return prism(rng);
    case 5:
      return ring(rng);
    case 6:
      return box(rng, true);
    default:
      return box(rng, false);
  }
}

}  // namespace

TriangleMesh octahedron() {
  return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

TriangleMesh divided(const TriangleMesh& m, bool round) {
  TriangleMesh r{m.vertices, {}};
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [it, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(r.vertices.size()));
    const Vec3 p = (m.vertices[static_cast<std::size_t>(a)] + m.vertices[static_cast<std::size_t>(b)]) / 2;
    if (is_new) r.vertices.push_back(round ? Vec3(p.normalized()) : p);
    return it->second;
  };
  for (const auto& [a, b, c] : m.triangles) {
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const std::array<int, 3>& t :
         {std::array{a, ab, ca}, std::array{b, bc, ab}, std::array{c, ca, bc}, std::array{ab, bc, ca}})
      r.triangles.push_back(t);
  }
  return r;
}

SolidMesh random_solid(Rng& rng, double scale) {
  TriangleMesh m = surface(rng);
  for (Vec3& v : m.vertices) v *= scale;
  return SolidMesh(std::move(m));
}

}  // namespace touchstone::fuzz
