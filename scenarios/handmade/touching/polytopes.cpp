// Polytopes that share exactly a face, an edge or a point. All coordinates are exact, so the gap is exactly 0
// or exactly `hair`. The origin lies on a feature of GJK's simplex; these cases reveal signs decided by
// rounding.
#include "scenarios/handmade/build.h"
#include "scenarios/handmade/lists.h"

namespace touchstone::scenarios {
namespace {

const Box unit{Vec3(1, 1, 1)};
constexpr double hair = 0x1p-40;

// Roofs with ridges that cross at the origin: A's along x with A below, B's along y with B above.
Hull roof_up() {
  return make_hull({{-1, 0, 0}, {1, 0, 0}, {-1, -1, -1}, {-1, 1, -1}, {1, -1, -1}, {1, 1, -1}});
}
Hull roof_down() {
  return make_hull({{0, -1, 0}, {0, 1, 0}, {-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}, {1, 1, 1}});
}
Hull octahedron() { return make_hull({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}); }
Hull corner(double z) { return make_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, z}}); }

}  // namespace

List touching_polytopes() {
  const Vec3 x = Vec3::UnitX(), z = Vec3::UnitZ();
  return {
      pair("touching", "cubes_face_to_face", "equal cubes share a face exactly", {unit, at(0, 0, 0), {}},
           {unit, at(2, 0, 0), {}}, gap_is(0, 0, x, "half extents 1 + 1 = offset 2")),
      pair("touching", "cubes_edge_to_edge", "equal cubes share an edge exactly", {unit, at(0, 0, 0), {}},
           {unit, at(2, 2, 0), {}}, gap_is(0, 0, x, "1 + 1 = 2 along x and y")),
      pair("touching", "cubes_corner_to_corner", "equal cubes share one corner exactly",
           {unit, at(0, 0, 0), {}}, {unit, at(2, 2, 2), {}}, gap_is(0, 0, x, "1 + 1 = 2 along all axes")),
      pair("touching", "cubes_half_a_face", "equal cubes share half a face; edges lie inside faces",
           {unit, at(0, 0, 0), {}}, {unit, at(2, 1, 0.5), {}}, gap_is(0, 0, x, "1 + 1 = 2 along x")),
      pair("touching", "cubes_a_hair_apart", "gap of 2^-40 of the size", {unit, at(0, 0, 0), {}},
           {unit, at(2 + hair, 0, 0), {}}, gap_is(hair, 0, x, "offset - 2, exact")),
      pair("touching", "cubes_a_hair_inside", "overlap of 2^-40 of the size", {unit, at(0, 0, 0), {}},
           {unit, at(2 - hair, 0, 0), {}}, gap_is(-hair, 0, x, "offset - 2, exact")),
      pair("touching", "ridges_cross_in_a_point", "two edges touch in one interior point",
           {roof_up(), {}, {}}, {roof_down(), {}, {}},
           gap_is(0, 0, z, "A lies in z <= 0, B in z >= 0, both contain the origin")),
      pair("touching", "octahedron_tip_on_face", "a vertex stands on the middle of a face", {unit, {}, {}},
           {octahedron(), at(0.25, 0.125, 2), {}}, gap_is(0, 0, z, "face at z = 1, tip at 2 - 1")),
      pair("touching", "octahedron_tip_on_edge", "a vertex stands on an edge", {unit, {}, {}},
           {octahedron(), at(1, 0.125, 2), {}}, gap_is(0, 0, z, "face at z = 1, tip at 2 - 1")),
      pair("touching", "tetrahedra_share_a_face", "mirror images across a common triangle",
           {corner(-1), {}, {}}, {corner(1), {}, {}},
           gap_is(0, 0, z, "separated by z = 0, which contains the common face")),
      pair("touching", "hull_on_tilted_face", "a tilted face touches a corner in exact coordinates",
           {octahedron(), {}, {}},
           {make_hull({{1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2}}), at(-0.5, -0.75, -0.75), {}},
           // Face x+y+z = 1 of A; the corner (1,1,1) lands on (0.5, 0.25, 0.25), whose sum is 1.
           gap_is(0, 0, Vec3(1, 1, 1) / std::sqrt(3.0), "corner (0.5, 0.25, 0.25) lies on x+y+z = 1")),
  };
}

}  // namespace touchstone::scenarios
