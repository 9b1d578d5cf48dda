// Certificates: evidence that a claim about two bodies is true, as plain values. oracles/referee finds them,
// oracles/checker verifies them, scenarios/codec writes and reads them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/math/pose.h"
#include "core/shape/shape.h"

namespace touchstone {

/// A shape at an exact place: a Pose (any non-zero quaternion gives a rational rotation) or an affine
/// Placement.
struct Placed {
  const Shape* shape = nullptr;
  std::variant<Pose, Placement> pose;
};

template <class S>
bool is(const Placed& p) {
  return std::holds_alternative<S>(*p.shape);
}

/// Evidence that a reader can check by hand from the scene alone. All numbers are exact doubles in the world
/// frame.
struct Certificate {
  enum class Kind { none, separating_plane, common_point, depth_direction, inner_polytope, closed_form };
  Kind kind = Kind::none;
  Vec3 direction =
      Vec3::Zero();   // separating_plane: A on the side direction·x <= offset, B on direction·x > offset
  double offset = 0;  // depth_direction: depth <= offset; inner_polytope: depth >= offset
  Vec3 point = Vec3::Zero();  // common_point, if one with double coordinates exists
  /// "n/d", when doubles do not suffice. common_point: x, y, z; separating_plane: direction x, y, z, offset,
  /// repeated when a mesh needs several planes.
  std::vector<std::string> rationals;
  /// inner_polytope: vertices of the Minkowski difference A-B, as pairs of support points, and the facets.
  std::vector<std::array<Vec3, 2>> support_pairs;
  std::vector<std::array<int, 3>> facets;
  std::string note;
};

/// Evidence about the first contact of two moving bodies (truth.md §4): planes that separate them from the
/// start on, and a point that is in both at a later time. All numbers are exact rationals "n/d" or "n", in
/// the frame whose origin moves with that of B and whose axes are the world's: x = x_world - (B's translation
/// + t·B's linear velocity).
struct ImpactCertificate {
  /// A plane at time t: A on direction·x <= offset, B on direction·x > offset. Between keys,
  /// direction and offset change linearly in t. Two keys with the same t switch to another plane.
  struct Key {
    double t = 0;
    std::array<std::string, 3> direction;
    std::string offset;
  };
  using Track = std::vector<Key>;
  /// Every pair of a convex part of A and one of B (triangles of meshes) has a track that separates it. Each
  /// track covers t = 0 to clear_until: no contact at any t in [0, clear_until]. Without tracks, nothing is
  /// claimed.
  std::vector<Track> tracks;
  double clear_until = 0;
  /// A point of both bodies at time t in [0,1].
  struct Contact {
    std::string t;
    std::array<std::string, 3> point;
  };
  std::optional<Contact> contact;
  /// At time t, convex part a of A and part b of B (triangles of meshes; 0 for other shapes) overlap by a
  /// depth of at least inner.offset: an inner polytope as in checker.h, in the frame above.
  struct Overlap {
    double t = 0;
    std::size_t part_a = 0, part_b = 0;
    Certificate inner;
  };
  std::optional<Overlap> overlap;
  bool claims_nothing() const { return tracks.empty() && !contact && !overlap; }
};

// The kinds of evidence behind a broad-phase certificate.

/// What candidates must contain. boxes: every overlapping pair of the given boxes, which the subject's
/// arithmetic represents exactly; bodies: every pair of bodies that truly overlap, whatever boxes the subject
/// computes.
enum class BroadLevel : std::uint8_t { boxes, bodies };
inline constexpr auto level_names = std::to_array<std::string_view>({"boxes", "bodies"});
static_assert(level_names.size() == static_cast<std::size_t>(BroadLevel::bodies) + 1);
constexpr std::string_view to_string(BroadLevel l) { return level_names[static_cast<std::size_t>(l)]; }

enum class SuiteKind : std::uint8_t { exhaustive, adversarial, temporal, random };
inline constexpr auto suite_kind_names =
    std::to_array<std::string_view>({"exhaustive", "adversarial", "temporal", "random"});
static_assert(suite_kind_names.size() == static_cast<std::size_t>(SuiteKind::random) + 1);
constexpr std::string_view to_string(SuiteKind k) { return suite_kind_names[static_cast<std::size_t>(k)]; }

}  // namespace touchstone
