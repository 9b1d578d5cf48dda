// Every number that the project chooses: unit, scale law, reason, and the test that bites when it is wrong. A comparison
// divides by a stated scale; nothing here is an absolute length.
#pragma once

namespace touchstone::tolerance {

/// τ of our own core, in units of (unit roundoff 2⁻⁵³ · L): wrong beyond 128·2⁻⁵³·L = 64·ε·L (issue: 64·ε·L in double).
/// About 30 roundings lie between a pose and a depth; the factor leaves a margin of 4. Bites: fuzz with the core as subject.
inline constexpr double core_tau_factor = 128;

}  // namespace touchstone::tolerance
