#include "core/narrow/mesh_contacts.h"

#include <algorithm>
#include <tuple>

#include "core/narrow/filtered/query.h"
#include "core/narrow/mesh.h"
#include "core/narrow/mesh_pairs.h"
#include "core/narrow/narrow_phase.h"
#include "core/narrow/unit_scale.h"

namespace touchstone {
namespace {

Shape triangle_of(const TriangleMesh& m, std::int32_t triangle) {
  const auto c = narrow::corners(m, static_cast<std::size_t>(triangle));
  return TriangleMesh{{c[0], c[1], c[2]}, {{0, 1, 2}}};
}

MeshContacts at_unit_size(const PlacedShape& a, const PlacedShape& b, double size) {
  const int e = -std::ilogb(size);
  const narrow::ScaledPair<PlacedShape> pair(a, b, e);
  MeshContacts r = mesh_contacts(pair.a, pair.b);
  for (TriangleContact& c : r.contacts) {
    c.depth = std::ldexp(c.depth, -e);
    c.position = pair.origin + narrow::scaled(c.position, -e);
  }
  return r;
}

}  // namespace

MeshContacts mesh_contacts(const PlacedShape& a, const PlacedShape& b) {
  MeshContacts r;
  if (kind_of(*a.shape) != ShapeKind::mesh || kind_of(*b.shape) != ShapeKind::mesh) {
    r.outcome = Outcome::unsupported;
    return r;
  }
  const auto at = narrow::filtered::relative(narrow::filtered::rounded_pose<double>(a.pose),
                                             narrow::filtered::rounded_pose<double>(b.pose));
  const narrow::MeshScene m(a, b, at.b_to_a, at.offset);
  if (const double most = m.largest_length(); most > 0 && !m.in_range()) return at_unit_size(a, b, most);
  for (const narrow::TrianglePair& p :
       triangle_pairs(m, narrow::PairsWanted::meeting, m.displacement).pairs) {
    const Shape x = triangle_of(m.a, p.a), y = triangle_of(m.b, p.b);
    const ContactAnswer c = contact({&x, a.pose}, {&y, b.pose});
    if (c.outcome != Outcome::answered) r.outcome = c.outcome;
    if (c.outcome == Outcome::answered && c.overlap)
      r.contacts.push_back({p.a, p.b, c.normal, c.depth, c.manifold[0].position});
  }
  std::sort(r.contacts.begin(), r.contacts.end(), [](const TriangleContact& x, const TriangleContact& y) {
    return std::tie(x.a, x.b) < std::tie(y.a, y.b);
  });
  return r;
}

}  // namespace touchstone
