#include "scenarios/exhaustive/suites.h"

#include <cmath>
#include <limits>

namespace touchstone::fuzz {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

using Coordinate = double (*)(Rng&, const Draw&);

double whole(Rng& rng, int most) {
  return static_cast<double>(rng.below(2 * static_cast<std::uint64_t>(most) + 1)) - most;
}

double stepped(double x, int steps, Scalar scalar) {
  for (int k = 0; k < std::abs(steps); ++k) x = next_number(x, steps, scalar);
  return x;
}

// Multiples of powers of two, at which cells of any typical size begin, and their neighbours.
double on_a_border(Rng& rng, const Draw& d) {
  const double cell = std::ldexp(1.0, static_cast<int>(rng.below(9)) - 4);
  const double x = whole(rng, 4) * cell;
  return rng.chance(0.3) && x != 0 ? stepped(x, static_cast<int>(rng.below(5)) - 2, d.scalar) : x;
}

double beside_a_number(Rng& rng, const Draw& d) {
  const double n = whole(rng, 3);
  const double x = nearest(n + (rng.chance(0.5) ? 0.1 : 0.5), d.scalar);
  return stepped(x, static_cast<int>(rng.below(9)) - 4, d.scalar);
}

double of_any_size(Rng& rng, const Draw&) {
  const int sign = rng.sign();
  const int e = static_cast<int>(rng.below(21)) - 10;
  return sign * std::ldexp(1.0 + static_cast<double>(rng.below(8)) / 8, e);
}

double near_zero(Rng& rng, const Draw& d) {
  const double least = d.scalar == Scalar::float64 ? 0x1p-1074 : 0x1p-149;
  const double normal = d.scalar == Scalar::float64 ? 0x1p-1022 : 0x1p-126;
  const double n = whole(rng, 4);
  const auto kind = rng.below(4);
  if (kind == 0) return n * normal;
  if (kind == 1) return n < 0 ? -0.0 : 0.0;
  return 2 * n * least;
}

double far_away(Rng& rng, const Draw& d) {
  const int e = d.scalar == Scalar::float64 ? 20 + static_cast<int>(rng.below(25))
                                            : 8 + static_cast<int>(rng.below(10));
  const int sign = rng.sign();
  return sign * std::ldexp(1.0, e) + whole(rng, 4) / 2;
}

double huge(Rng& rng, const Draw& d) {
  const int e = d.scalar == Scalar::float64 ? 980 : 100;
  const double n = whole(rng, 7);
  return n * std::ldexp(1.0, e + static_cast<int>(rng.below(3)));
}

// Ends are drawn with repetition from a few values, so that ties are frequent.
std::optional<Placing> draw_box(Rng& rng, const Draw& d, Coordinate coordinate,
                                const std::vector<Aabb>& others) {
  Aabb box;
  for (int k = 0; k < 3; ++k) {
    double x = coordinate(rng, d), y = coordinate(rng, d);
    if (!others.empty() && rng.chance(0.5)) {
      const Aabb& o = others[rng.below(others.size())];
      x = rng.chance(0.5) ? o.lo[k] : o.hi[k];
    }
    if (rng.chance(0.05)) y = x;
    box.lo[k] = std::min(x, y);
    box.hi[k] = std::max(x, y);
  }
  return placing_of(box, d.scalar);
}

void draw_boxes(Rng& rng, const Draw& d, Coordinate coordinate, std::uint64_t least, std::uint64_t most,
                Scene& s) {
  const std::uint64_t n = least + rng.below(most - least + 1);
  std::vector<Aabb> placed;
  while (placed.size() < n) {
    const auto p = draw_box(rng, d, coordinate, placed);
    if (!p) continue;
    add_box(s, *p, rng.chance(0.15));
    placed.push_back({p->t - p->h, p->t + p->h});
  }
}

// Inserts all and queries; then removes some, moves some to the place of another, and queries after each.
void short_script(Rng& rng, Scene& s) {
  insert_all(s);
  step_query(s);
  std::vector<bool> present(s.bodies.size(), true);
  for (std::uint64_t k = rng.below(5); k > 0; --k) {
    const auto b = rng.below(s.bodies.size());
    const int body = static_cast<int>(b);
    if (!present[b]) {
      step_insert(s, body);
      present[b] = true;
    } else if (rng.chance(0.5)) {
      step_remove(s, body);
      present[b] = false;
    } else {
      step_move(s, body, s.bodies[b].pose);
    }
    step_query(s);
  }
}

void hard(const Draw& d, std::uint64_t index, Case& out, std::string_view name, Coordinate coordinate) {
  Rng rng = Rng::stream(d.seed ^ (name.size() * 0x9e3779b97f4a7c15ULL), index);
  draw_boxes(rng, d, coordinate, 2, 8, out.scene);
  short_script(rng, out.scene);
  out.queries = {{Question::candidates, -1, -1}};
}

}  // namespace

void cell_borders(const Draw& d, std::uint64_t i, Case& out) { hard(d, i, out, "1", on_a_border); }
void touching_by_an_ulp(const Draw& d, std::uint64_t i, Case& out) { hard(d, i, out, "22", beside_a_number); }
void sizes_far_apart(const Draw& d, std::uint64_t i, Case& out) { hard(d, i, out, "333", of_any_size); }
void zeros_and_denormals(const Draw& d, std::uint64_t i, Case& out) { hard(d, i, out, "4444", near_zero); }
void far_from_the_origin(const Draw& d, std::uint64_t i, Case& out) { hard(d, i, out, "55555", far_away); }
void huge_coordinates(const Draw& d, std::uint64_t i, Case& out) { hard(d, i, out, "666666", huge); }

// Half-spaces perpendicular to an axis: boxes infinite on five sides.
void unbounded(const Draw& d, std::uint64_t index, Case& out) {
  Rng rng = Rng::stream(d.seed + 7, index);
  draw_boxes(rng, d, on_a_border, 2, 6, out.scene);
  for (std::uint64_t k = 1 + rng.below(2); k > 0; --k) {
    Body b;
    b.shape = static_cast<int>(out.scene.shapes.size());
    b.is_static = true;
    const auto axis = static_cast<Eigen::Index>(rng.below(3));
    const double sign = rng.sign();
    out.scene.shapes.push_back(HalfSpace{Vec3::Unit(axis) * sign, 0});
    b.pose.translation = Vec3::Constant(on_a_border(rng, d));
    out.scene.bodies.push_back(std::move(b));
  }
  short_script(rng, out.scene);
  out.queries = {{Question::candidates, -1, -1}};
}

// Boxes that meet, and one body whose box is invalid, inserted before, between or after them, moved, and
// possibly removed again.
void no_boxes(const Draw& d, std::uint64_t index, Case& out) {
  Rng rng = Rng::stream(d.seed + 8, index);
  Scene& s = out.scene;
  draw_boxes(rng, d, on_a_border, 2, 5, s);
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(), inf, -inf};
  Placing p{Vec3::Zero(), Vec3::Ones()};
  const auto axis = static_cast<Eigen::Index>(rng.below(3));
  const auto kind = rng.below(5);
  if (kind < 3) p.t[axis] = bad[kind];
  if (kind == 3) p.h[axis] = -1;
  if (kind == 4) p.h[axis] = bad[rng.below(2)];
  const auto n = s.bodies.size(), when = rng.below(n + 1);
  const int none = add_box(s, p);
  for (std::size_t i = 0; i <= n; ++i) {
    if (i == when) step_insert(s, none);
    if (i < n) step_insert(s, static_cast<int>(i));
  }
  step_query(s);
  const auto moved = rng.below(n);
  step_move(s, static_cast<int>(moved), s.bodies[rng.below(n)].pose);
  step_query(s);
  if (rng.chance(0.5)) {
    step_remove(s, none);
    step_query(s);
  }
  out.queries = {{Question::candidates, -1, -1}};
}

}  // namespace touchstone::fuzz
