// Ghost contacts at inner edges of a mesh (docs/truth.md §2): a body on coplanar triangles gets the normal of
// an edge or a corner between them, as if the triangle beyond it were not there.
//
// Where the surface is a plane as far as the body reaches through it, by r, the body leaves it by moving by r
// across the plane, and needs r/|n·m| along n, where m is the plane's normal. The error is the difference,
// the regret of a contact with the plane. On which side the body leaves is not judged: a surface has no
// inside, and engines may take a mesh's triangles to face one way.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fuzz/judge/check.h"
#include "oracles/referee/region/contact_region.h"

namespace touchstone::fuzz {
namespace {

std::optional<referee::FlatSurface> flat_part(const CheckInput& in, const StatedContact& c) {
  if (in.is_surface(c.a) == in.is_surface(c.b)) return std::nullopt;
  const int mesh = in.is_surface(c.a) ? c.a : c.b, body = in.is_surface(c.a) ? c.b : c.a;
  return referee::flat_surface(in.truth.placed(in.frame, mesh), in.truth.placed(in.frame, body));
}

double cosine_of(const referee::FlatSurface& flat, const Vec3& normal) {
  return std::min(1.0, std::abs(normal.dot(flat.normal)) / normal.norm());
}

// What is certain of it: the plane is known up to twice its reach only.
double regret_of(const referee::FlatSurface& flat, const Vec3& normal) {
  const double least_cosine = 0.5;  // twice the reach
  return flat.reach.lo / std::max(least_cosine, cosine_of(flat, normal)) - flat.reach.hi;
}

double degrees_off(const referee::FlatSurface& flat, const Vec3& normal) {
  return std::acos(cosine_of(flat, normal)) * 180 / std::numbers::pi;
}

Certificate plane_certificate(const referee::FlatSurface& flat) {
  Certificate r;
  r.kind = Certificate::Kind::depth_direction;
  r.direction = flat.normal;
  r.offset = flat.reach.hi;
  r.note =
      "the mesh is a plane across `direction` as far as the body reaches; moving the body by `offset` "
      "along `direction` or against it separates them";
  return r;
}

}  // namespace

bool judge_inner_edges(const CheckInput& in, CheckOutput& out, const StatedContact& c) {
  const std::optional<referee::FlatSurface> flat = flat_part(in, c);
  if (!flat) return false;
  const double l = in.truth.scale(c.a, c.b), tau = in.tau(c.a, c.b, l), regret = regret_of(*flat, *c.normal);
  if (regret > tau && takes_triangles_apart(in.card)) {
    out.not_judged("normal at an inner edge of a mesh, whose triangles the engine takes apart as documented",
                   true);
    return true;
  }
  out.error(regret, l, tau);
  if (regret > tau)
    out.fault(
        Fault::inner_edge, regret, l, {in.query.question, c.a, c.b},
        fmt::format("the mesh is flat under the body, which leaves it by moving by {:.9g} across; the "
                    "stated normal, {:.4g} degrees off, needs at least {:.6g} more: that of an inner edge",
                    flat->reach.hi, degrees_off(*flat, *c.normal), regret),
        plane_certificate(*flat));
  return true;
}

}  // namespace touchstone::fuzz
