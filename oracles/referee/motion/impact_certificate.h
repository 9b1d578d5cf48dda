// Finds certificates about the first contact of two bodies in motion.
#pragma once

#include "oracles/referee/referee.h"

namespace touchstone::referee {

/// For what judge_motion said of the same arguments; what it holds is accepted by `check` below. clear_until
/// is t_lo or a few units in the last place of its motion less, contact at t_hi or as little after it. Parts
/// that it cannot show are left out: a contact of a spinning body that has no inside, a graze without depth
/// while spinning, a spinning half-space.
ImpactCertificate impact_certificate(const Placed& a, const Motion& motion_a, const Placed& b,
                                     const Motion& motion_b, const TimeTruth& truth);

/// Adds that the bodies are (about) as deep in each other as deepest_before said; nothing where the checker
/// does not accept it, nor of half-spaces, whose common point says as much.
void add_overlap(ImpactCertificate& c, const Placed& a, const Motion& motion_a, const Placed& b,
                 const Motion& motion_b, const DepthInTime& deepest);

}  // namespace touchstone::referee
