// Evidence about the first contact of two bodies in motion (truth.md §4): planes that keep them apart from
// the start on, and a point that is in both at a later time.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "oracles/referee/referee.h"

namespace touchstone::referee {

/// All numbers are exact rationals "n/d" or "n", in the frame whose origin travels with that of B (its axes
/// are the world's): x = x_world - (B's translation + t·B's linear velocity).
struct ImpactCertificate {
  /// A plane at time t: A on direction·x <= offset, B on direction·x > offset. Between one key and the next
  /// direction and offset change linearly in t. Two keys of equal t: another plane takes over.
  struct Key {
    double t = 0;
    std::array<std::string, 3> direction;
    std::string offset;
  };
  using Track = std::vector<Key>;
  /// Every convex part of A (a triangle of a mesh) has a track that keeps it from every convex part of B.
  /// Each track goes from t = 0 to clear_until: no contact at any t in [0, clear_until]. None: nothing is
  /// claimed.
  std::vector<Track> tracks;
  double clear_until = 0;
  /// A point of both bodies at time t in [0,1].
  struct Contact {
    std::string t;
    std::array<std::string, 3> point;
  };
  std::optional<Contact> contact;
  /// At time t convex part a of A and part b of B (triangles of meshes; 0 of anything else) are at least
  /// inner.offset deep in each other: an inner polytope as in checker.h, in the frame above.
  struct Overlap {
    double t = 0;
    std::size_t part_a = 0, part_b = 0;
    Certificate inner;
  };
  std::optional<Overlap> overlap;
  bool claims_nothing() const { return tracks.empty() && !contact && !overlap; }
};
nlohmann::ordered_json to_json(const ImpactCertificate& c);
/// Reads what to_json wrote. Throws InputError when it is not such a certificate.
ImpactCertificate impact_certificate_from_json(const nlohmann::ordered_json& j);

/// For what judge_motion said of the same arguments; what it holds is accepted by `check` below. clear_until
/// is t_lo or a few units in the last place of its motion less, contact at t_hi or as little after it. Parts
/// that it cannot show are left out: a contact of a spinning body that has no inside, a graze without depth
/// while spinning, a spinning half-space.
ImpactCertificate impact_certificate(const Placed& a, const Motion& motion_a, const Placed& b,
                                     const Motion& motion_b, const TimeTruth& truth);

/// Adds that the bodies are (about) as deep in each other as deepest_before said; nothing where the checker does
/// not accept it, nor of half-spaces, whose common point says as much.
void add_overlap(ImpactCertificate& c, const Placed& a, const Motion& motion_a, const Placed& b,
                 const Motion& motion_b, const DepthInTime& deepest);

/// Whether all that the certificate claims holds for these bodies, in exact arithmetic (checker_motion.cpp).
/// False when it claims nothing. Throws InputError for a rational that is none.
bool check(const ImpactCertificate& c, const Placed& a, const Motion& motion_a, const Placed& b,
           const Motion& motion_b);

}  // namespace touchstone::referee
