// Finds certificates about the first contact of two bodies in motion.
#pragma once

#include "oracles/referee/referee.h"

namespace touchstone::referee {

/// Certifies the result of judge_motion for the same arguments. Every part of the certificate is accepted by
/// `checker::check`. clear_until is t_lo, or a few ulps of its motion less; the contact is at t_hi or as
/// little after it. Parts that cannot be shown are left out: a contact of a spinning body that has no
/// interior, a graze without depth while spinning, a spinning half-space.
ImpactCertificate impact_certificate(const Placed& a, const Motion& motion_a, const Placed& b,
                                     const Motion& motion_b, const TimeTruth& truth);

/// Adds evidence that the bodies are (about) as deep in each other as deepest_before reported. Adds nothing
/// if the checker rejects it, or for half-spaces, where the common point is evidence enough.
void add_overlap(ImpactCertificate& c, const Placed& a, const Motion& motion_a, const Placed& b,
                 const Motion& motion_b, const DepthInTime& deepest);

}  // namespace touchstone::referee
