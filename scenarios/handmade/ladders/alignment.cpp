// Polytopes that are aligned exactly or almost, and that touch exactly or almost.
#include "scenarios/handmade/ladders/parts.h"

namespace touchstone::scenarios {
namespace {

Scene stack_shifted(double x) { return two(cube_of(0.5), {}, cube_of(0.5), at(x, 0, 0.875)); }
Scene stack_yawed(double a) { return two(cube_of(0.5), {}, cube_of(0.5), at(0, 0, 0.875, about_z(a))); }
Scene stack_tilted(double a) { return two(cube_of(0.5), {}, cube_of(0.5), at(0, 0, 0.875, about_y(a))); }
Scene beside_tilted(double a) { return two(cube_of(0.5), {}, cube_of(0.5), at(1.25, 0.25, 0, about_y(a))); }
Scene faces(double gap) { return two(cube_of(0.5), {}, cube_of(0.5), at(0.25, 0.125, 1 + gap)); }
Scene faces_turned(double gap) {
  const Vec3 z = rotation_matrix(skew_turn) * Vec3(0.25, 0.125, 1 + gap);
  return two(cube_of(0.5), at(0, 0, 0, skew_turn), cube_of(0.5), at(z.x(), z.y(), z.z(), skew_turn));
}

/// A ridge along x at z = 1.
Hull ridge_along_x() {
  return make_hull(
      {{-2, 0, 1}, {2, 0, 1}, {-2, 0, -1}, {2, 0, -1}, {-2, 1, 0}, {2, 1, 0}, {-2, -1, 0}, {2, -1, 0}});
}
Hull octahedron() { return make_hull({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}); }

Scene edges_crossed(double gap) {
  return two(ridge_along_x(), {}, ridge_along_x(), at(0.25, 0.5, 2 + gap, quarter_turn_z));
}
Scene edges_parallel(double gap) { return two(ridge_along_x(), {}, ridge_along_x(), at(0.5, 0, 2 + gap)); }
Scene edges_nearly_parallel(double a) {
  return two(ridge_along_x(), {}, ridge_along_x(), at(0.25, 0, 1.9375, about_z(a)));
}
Scene edge_on_face(double gap) { return two(cube_of(2), {}, ridge_along_x(), at(0.25, 0.5, 3 + gap)); }
Scene tip_on_face(double gap) { return two(cube_of(1), {}, octahedron(), at(0.25, -0.125, 2 + gap)); }
Scene tip_on_edge(double gap) { return two(ridge_along_x(), {}, octahedron(), at(0.25, 0, 2 + gap)); }
Scene tip_on_tip(double gap) { return two(octahedron(), {}, octahedron(), at(0, 0, 2 + gap)); }
Scene corner_on_corner(double gap) { return two(cube_of(1), {}, cube_of(1), at(2, 2, 2 + gap)); }

Scene edges_beat_faces(double depth) {
  const Box beam{Vec3(1, 1, 1)};
  const double reach = std::sqrt(2.0);
  return two(beam, at(0, 0, 0, about_x(std::atan(1.0))), beam,
             at(0.125, 0.25, 2 * reach - depth, about_y(std::atan(1.0))));
}

}  // namespace

std::vector<Ladder> alignment_ladders() {
  const std::vector<double> offsets{0, 1e-17, 1e-16, 1e-15, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3, 0.0625};
  const std::vector<double> angles{0, 1e-17, 1e-16, 1e-13, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2};
  const std::vector<double> gaps{-0.0625, -1e-3, -1e-6, -1e-9, -1e-12, -0x1p-52, 0,
                                 0x1p-52, 1e-12, 1e-9,  1e-6,  1e-3,   0.0625};
  return {
      {"stacked-cubes-shifted", "aligned-simplex", "equal cubes an eighth deep, shifted sideways by v",
       offsets, stack_shifted},
      {"stacked-cubes-yawed", "aligned-simplex", "equal cubes an eighth deep, turned by v about the normal",
       angles, stack_yawed},
      {"stacked-cubes-tilted", "tiny-angle", "equal cubes an eighth deep, the upper one tilted by v", angles,
       stack_tilted},
      {"cubes-beside-tilted", "tiny-angle", "cubes a quarter apart, one of them tilted by v", angles,
       beside_tilted},
      {"faces-at-gap", "kissing-faces", "cubes face to face with gap v", gaps, faces},
      {"turned-faces-at-gap", "kissing-faces", "cubes face to face with gap v, both turned", gaps,
       faces_turned},
      {"crossed-edges-at-gap", "kissing-edges", "ridges that cross at a right angle with gap v", gaps,
       edges_crossed},
      {"parallel-edges-at-gap", "kissing-edges", "parallel ridges with gap v", gaps, edges_parallel},
      {"edge-on-face-at-gap", "kissing-edges", "a ridge on a face with gap v", gaps, edge_on_face},
      {"ridges-nearly-parallel", "tiny-angle", "ridges a sixteenth deep that cross at angle v", angles,
       edges_nearly_parallel},
      {"tip-on-face-at-gap", "kissing-tip", "the tip of an octahedron on a face with gap v", gaps,
       tip_on_face},
      {"tip-on-edge-at-gap", "kissing-tip", "the tip of an octahedron on a ridge with gap v", gaps,
       tip_on_edge},
      {"tip-on-tip-at-gap", "kissing-tip", "tip to tip with gap v", gaps, tip_on_tip},
      {"corner-on-corner-at-gap", "kissing-tip", "cubes corner to corner, raised by v", gaps,
       corner_on_corner},
      {"edges-beat-faces",
       "edge-against-face",
       "edges that cross, v deep",
       {1e-6, 1e-3, 0.0625, 0.25, 0.5, 0.75, 1, 1.25},
       edges_beat_faces},
  };
}

}  // namespace touchstone::scenarios
