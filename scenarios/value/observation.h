// What an engine answered, as plain values.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/outcome.h"
#include "scenarios/value/case.h"

namespace touchstone {

struct ManifoldPoint {
  Vec3 position = Vec3::Zero();  // world
  double depth = 0;
  std::optional<std::uint64_t> id{};  // the engine's name of the features that meet there; never compared
  bool operator==(const ManifoldPoint& o) const { return position == o.position && depth == o.depth; }
};

struct SceneContact {
  int a = 0, b = 0;  // a < b; normal from a to b
  Vec3 normal = Vec3::Zero();
  double depth = 0;
  bool operator==(const SceneContact& o) const {
    return a == o.a && b == o.b && normal == o.normal && depth == o.depth;
  }
};

/// One engine's answer to one query. An empty optional means "not given" and is not judged.
struct Observation {
  Outcome outcome = Outcome::unsupported;
  std::string detail;
  /// Of `within` and `contact_within`: whether the signed distance is at most the margin.
  std::optional<bool> overlap;
  std::optional<double> distance;                  // signed
  std::optional<double> lower_bound, upper_bound;  // of the signed distance
  std::optional<std::array<Vec3, 2>> witness;
  std::optional<Vec3> normal;  // A to B; of `ray`: of A's surface where it is hit, pointing out of A
  /// Of `distance`, with `normal`: the gradient of the signed distance by B's pose. `normal` is its
  /// derivative by translations of B, `moment` that by rotations of B about the origin of its frame, along
  /// world axes.
  std::optional<Vec3> moment;
  std::optional<bool> unique_gradient;  // whether the signed distance has no other gradient (truth.md §2)
  std::optional<double> depth;  // of `contact_within`, negative for bodies that are apart, as of its points
  std::vector<ManifoldPoint> manifold;
  std::optional<double> toi;  // empty when time_of_impact or ray is answered: "no hit"
  std::vector<std::vector<BodyPair>>
      candidate_pairs;  // per query step; as reported (unsorted, duplicates kept)
  std::vector<SceneContact> contacts;
  double claimed_tolerance = 0;
  std::int64_t elapsed_ns = 0;  // the engine's own time; never hashed or compared
  bool slow = false;            // took longer than the time limit; never hashed or compared
  std::string site;  // of a crash: "distance-inl.h:177", "libfcl:detail::collide"; empty when unknown
  bool operator==(const Observation& o) const {
    return outcome == o.outcome && detail == o.detail && overlap == o.overlap && distance == o.distance &&
           lower_bound == o.lower_bound && upper_bound == o.upper_bound && witness == o.witness &&
           normal == o.normal && moment == o.moment && unique_gradient == o.unique_gradient &&
           depth == o.depth && manifold == o.manifold && toi == o.toi &&
           candidate_pairs == o.candidate_pairs && contacts == o.contacts &&
           claimed_tolerance == o.claimed_tolerance && site == o.site;
  }
};

/// An observation without an answer.
inline Observation no_answer(Outcome outcome, std::string detail, std::string site = "") {
  Observation o;
  o.outcome = outcome;
  o.detail = std::move(detail);
  o.site = std::move(site);
  return o;
}

/// The scene as an engine received it: exact affine placements and shapes.
/// A body or shape that the engine did not report is empty and assumed to be as in the original scene.
struct ReceivedScene {
  std::vector<std::optional<Placement>> bodies;
  std::vector<std::optional<Shape>> shapes;
  bool operator==(const ReceivedScene&) const = default;
};

struct CaseObservations {
  ReceivedScene received;
  std::vector<Observation> answers;  // one per query, in order
};

}  // namespace touchstone
