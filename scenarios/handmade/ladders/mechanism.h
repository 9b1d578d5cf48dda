// Mechanisms: the ways in which collision engines fail that cases aim at. Cases of the corpus carry the name
// of one.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace touchstone::scenarios {

struct Mechanism {
  std::string_view name, line;
};

inline constexpr auto mechanisms = std::to_array<Mechanism>({
    {"aligned-simplex", "equal or centred shapes: the origin lies on features of the first simplex"},
    {"tiny-angle", "axes almost parallel: cross products of edges are noise"},
    {"kissing-faces", "faces touch or nearly touch"},
    {"kissing-edges", "edges touch or nearly touch"},
    {"kissing-tip", "a vertex touches or nearly touches a face, an edge or a vertex"},
    {"edge-against-face", "an edge direction beats the face directions by little"},
    {"coincident-centres", "round shapes with equal or almost equal centres"},
    {"centre-on-surface", "the centre or core of a round shape lies on the other's surface, or almost"},
    {"centre-inside", "the centre or core of a round shape lies inside the other shape"},
    {"round-on-flat", "a round shape touches or nearly touches a flat one"},
    {"round-on-round", "round shapes touch or nearly touch"},
    {"parallel-cap", "a flat cap almost parallel to a face"},
    {"coaxial-rims", "circular rims that coincide or cross"},
    {"sharp-tip", "cones and slender ellipsoids: strong curvature at the contact"},
    {"rounded-edge", "boxes with a radius, down to radii that hardly count"},
    {"absolute-tolerance", "a scene in another unit: fixed tolerances are too coarse"},
    {"far-from-origin", "coordinates far larger than the shapes: cancellation"},
    {"size-ratio", "a small shape against a large one"},
    {"slender", "rods and needles of large aspect ratio"},
    {"thin-plate", "plates whose thickness is far less than their width"},
    {"collision-margin", "gaps and sizes near to fixed collision margins"},
    {"rounding-depth", "an overlap or gap near to the rounding of the coordinates"},
    {"tied-directions", "several directions of least depth tie, exactly or almost"},
    {"off-centre", "the way out is not along the line of centres"},
    {"containment", "one shape inside the other"},
    {"coplanar-faces", "several pairs of faces lie in common planes"},
    {"duplicate-vertices", "hulls with repeated or almost repeated vertices"},
    {"noisy-faces", "hulls whose faces are coplanar up to rounding"},
    {"flat-shape", "shapes without volume"},
    {"needle-face", "hulls with needle-shaped faces"},
    {"zero-size", "sizes of zero: points, segments, rectangles"},
    {"quaternion-length", "quaternions that are not of unit length"},
    {"iteration-limit", "many steps of a search are needed"},
    {"argument-order", "a routine that depends on which body is first"},
    {"lattice", "coordinates on a lattice: ties in every comparison"},
    {"tunnelling", "a fast body and a thin obstacle"},
    {"grazing-motion", "paths that just meet or just miss"},
    {"start-touching", "contact at the start of the step"},
    {"start-overlapping", "overlap at the start of the step"},
    {"end-of-step", "contact at the end of the step, or just after it"},
    {"no-relative-motion", "bodies that move together or not at all"},
    {"tiny-motion", "motions of denormal or very small length"},
    {"high-speed", "motions far longer than the shapes"},
    {"large-target", "a small moving body and a target of large extent"},
    {"sliding-motion", "motion along a face or an edge"},
    {"rotation", "contact that rotation brings about"},
    {"fast-rotation", "turns of many radians in a step"},
    {"separating-motion", "bodies that move apart"},
    {"vertex-path", "first contact of a vertex, an edge or a corner on the path"},
    {"motion-scale", "a motion in another unit"},
    {"campaign", "found by a random campaign; the comment says what the answer depends on"},
});

constexpr const Mechanism* mechanism_named(std::string_view name) {
  const auto* it =
      std::find_if(mechanisms.begin(), mechanisms.end(), [&](const Mechanism& m) { return m.name == name; });
  return it == mechanisms.end() ? nullptr : it;
}

}  // namespace touchstone::scenarios
