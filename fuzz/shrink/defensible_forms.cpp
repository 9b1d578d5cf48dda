#include "fuzz/shrink/defensible.h"

#include <cmath>
#include <optional>

#include "core/base/input_error.h"
#include "fuzz/ask/degeneracy.h"
#include "fuzz/shrink/reductions.h"
#include "oracles/referee/referee.h"
#include "scenarios/random/numbers.h"

namespace touchstone::fuzz {
namespace {

constexpr double target_gaps[] = {-0.05, 0.05, -0.25, 0.25, -0.1};  // shares of the smaller body's size
constexpr double shape_factors[] = {1.05, 0.95, 1.25, 0.75, 1.5, 0.5};
constexpr double restored_size = 0.5;     // of a size that is (nearly) zero in a scene about one
constexpr double through_share = 0.5;     // how far an approach goes on after the contact
constexpr int plain_bits[] = {12, 4};     // to which numbers are rounded
constexpr double least_direction = 1e-6;  // origins nearer than this give no direction

// Hulls are renewed; a case that is no valid scene is left out.
void keep_valid(std::vector<Case>& out, Case c) {
  try {
    renew(c);
    validate(c.scene);
  } catch (const InputError&) {
    return;
  }
  if (has_what_is_asked(c)) out.push_back(std::move(c));
}

// The first body is at the origin, and the largest length about 1.
Case near_one(Case c) {
  if (c.scene.script.empty() && !c.scene.bodies.empty()) {
    const Vec3 origin = c.scene.bodies.front().pose.translation;
    for (Body& b : c.scene.bodies) b.pose.translation -= origin;
  }
  double largest = 0;
  for (const double* x : lengths(c)) largest = std::max(largest, std::abs(*x));
  if (!(largest > 0) || !std::isfinite(largest)) return c;
  const int exponent = -std::ilogb(largest);
  for (double* x : lengths(c)) *x = std::ldexp(*x, exponent);
  return c;
}

// --- numbers and volume

void restore_volume(Shape& s) {
  if (auto* h = hull_if(s)) {
    if (h->dimension == 3) return;
    const double size = std::max(extent(s), restored_size);
    const Vec3 apex = h->vertices.front();
    for (Eigen::Index k = 0; k < 3; ++k) h->vertices.emplace_back(apex + size * Vec3::Unit(k));
    return;
  }
  for (double* x : sizes_of(s))
    if (*x < least_plain_number) *x = restored_size;
}

Case with_volume(Case c) {
  for (Shape& s : c.scene.shapes) restore_volume(s);
  return c;
}

// Sizes are raised rather than dropped: a body without a size has no volume.
Case without_small_numbers(Case c) {
  for (Shape& s : c.scene.shapes)
    for (double* x : sizes_of(s))
      if (*x != 0 && *x < least_plain_number) *x = least_plain_number;
  for (double* x : numbers(c))
    if (std::abs(*x) < least_plain_number) *x = 0;
  return c;
}

// Forms with other numbers of about the same bodies.
std::vector<Case> plain_forms(const Case& c) {
  std::vector<Case> forms;
  keep_valid(forms, c);
  const Case about_one = near_one(c);
  keep_valid(forms, without_small_numbers(about_one));
  for (const int bits : plain_bits) {
    Case rounded = about_one;
    for (double* x : numbers(rounded)) *x = rounded_to(*x, bits);
    keep_valid(forms, without_small_numbers(std::move(rounded)));
  }
  if (degeneracy_of(c, -1, -1) == "flat") keep_valid(forms, without_small_numbers(with_volume(about_one)));
  return forms;
}

// --- the distance of the pair

struct AskedPair {
  int a = 0, b = 1;
  bool is_moving = false;
};

std::optional<AskedPair> pair_of(const Case& c) {
  for (const Query& q : c.queries)
    if (is_pair_question(q.question)) return AskedPair{q.a, q.b, is_motion_question(q.question)};
  if (c.scene.bodies.size() != 2 || !c.scene.script.empty()) return std::nullopt;
  return AskedPair{0, 1, has_swept_candidates_query(c)};
}

Body& body_of(Case& c, int i) { return c.scene.bodies[static_cast<std::size_t>(i)]; }

Placed placed_in(const Case& c, int i) {
  return {&c.scene.shape_of(i), c.scene.bodies[static_cast<std::size_t>(i)].pose};
}

// From A to B: the referee's normal and the line of centres.
std::vector<Vec3> directions(const Case& c, const AskedPair& p) {
  std::vector<Vec3> all;
  const auto add = [&](const Vec3& d) {
    if (d.allFinite() && d.norm() > least_direction) all.emplace_back(d.normalized());
  };
  add(referee::judge_pair(placed_in(c, p.a), placed_in(c, p.b)).normal);
  add(c.scene.bodies[static_cast<std::size_t>(p.b)].pose.translation -
      c.scene.bodies[static_cast<std::size_t>(p.a)].pose.translation);
  if (all.empty()) all.emplace_back(Vec3::UnitX());
  return all;
}

// A body that can move gets the velocity with which the pair meets within the step.
void approach(Case& c, const AskedPair& p, const Vec3& n, double gap, double size) {
  const Vec3 course = -(2 * gap + through_share * size) * n;
  const bool is_b_free = is_convex(kind_of(c.scene.shape_of(p.b)));
  Body &mover = body_of(c, is_b_free ? p.b : p.a), &other = body_of(c, is_b_free ? p.a : p.b);
  const Vec3 common = other.motion ? other.motion->linear : Vec3(Vec3::Zero());
  if (!mover.motion) mover.motion = Motion{};
  mover.motion->linear = common + (is_b_free ? course : Vec3(-course));
}

void move_pair(const Case& c, const AskedPair& p, std::vector<Case>& out) {
  const double size = smaller_size(c.scene, p.a, p.b);
  for (const Vec3& n : directions(c, p)) {
    const referee::Bracket width = referee::width(placed_in(c, p.a), placed_in(c, p.b), n);
    const double overlap = (width.lo + width.hi) / 2;
    if (!std::isfinite(overlap)) continue;
    for (const double share : target_gaps) {
      if (p.is_moving && share < 0) continue;
      Case moved = c;
      body_of(moved, p.b).pose.translation += (overlap + share * size) * n;
      keep_valid(out, without_small_numbers(moved));
      if (!p.is_moving) continue;
      approach(moved, p, n, share * size, size);
      keep_valid(out, without_small_numbers(std::move(moved)));
    }
  }
}

// --- shapes a little larger or smaller: bodies that touch then overlap or part, in any scene

void resize(Shape& s, double factor) {
  const bool has_vertices = vertices_if(s) != nullptr;
  for (double* x : has_vertices ? numbers(s) : sizes_of(s)) *x *= factor;
}

void resize_shapes(const Case& c, std::vector<Case>& out) {
  for (const double factor : shape_factors) {
    Case resized = c;
    for (Shape& s : resized.scene.shapes) resize(s, factor);
    keep_valid(out, std::move(resized));
  }
}

}  // namespace

std::vector<Case> defensible_forms(const Case& c) {
  std::vector<Case> out;
  const std::vector<Case> plain = plain_forms(c);
  for (const Case& form : plain) out.push_back(form);
  for (const Case& form : plain) {
    if (const auto pair = pair_of(form)) move_pair(form, *pair, out);
    resize_shapes(form, out);
  }
  return out;
}

}  // namespace touchstone::fuzz
