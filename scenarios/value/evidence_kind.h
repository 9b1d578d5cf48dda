// The kinds of evidence behind a broad-phase certificate.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace touchstone {

/// What candidates must contain. boxes: every overlapping pair of the given boxes, which the subject's
/// arithmetic represents exactly; bodies: every pair of bodies that truly overlap, whatever boxes the subject
/// computes.
enum class BroadLevel : std::uint8_t { boxes, bodies };
inline constexpr auto level_names = std::to_array<std::string_view>({"boxes", "bodies"});
static_assert(level_names.size() == static_cast<std::size_t>(BroadLevel::bodies) + 1);
constexpr std::string_view to_string(BroadLevel l) { return level_names[static_cast<std::size_t>(l)]; }

enum class EvidenceKind : std::uint8_t { exhaustive, adversarial, temporal, random };
inline constexpr auto evidence_kind_names =
    std::to_array<std::string_view>({"exhaustive", "adversarial", "temporal", "random"});
static_assert(evidence_kind_names.size() == static_cast<std::size_t>(EvidenceKind::random) + 1);
constexpr std::string_view to_string(EvidenceKind k) {
  return evidence_kind_names[static_cast<std::size_t>(k)];
}

}  // namespace touchstone
