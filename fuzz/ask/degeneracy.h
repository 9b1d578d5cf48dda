// Whether a case has a shape without volume: engines fail on those in their own ways, so a finding about
// solid bodies and one about flat bodies are two findings.
#pragma once

#include <algorithm>

#include "scenarios/value/case.h"

namespace touchstone::fuzz {

namespace degeneracy_detail {
inline bool is_zero(double v) { return v == 0; }
inline bool is_zero(const Vec3& v) { return (v.array() == 0).any(); }
template <class T>
bool is_zero(const std::vector<T>&) {
  return false;
}
}  // namespace degeneracy_detail

/// A size that is zero, or a hull that is flat. A mesh has no volume to lose, a half-space no size.
inline bool is_flat(const Shape& shape) {
  if (const auto* h = hull_if(shape)) return h->dimension < 3;
  return std::visit(
      [](const auto& s) {
        bool flat = false;
        for_each_field(s, [&](auto, const auto& value, Domain d) {
          if (d == Domain::non_negative || d == Domain::positive) flat |= degeneracy_detail::is_zero(value);
        });
        return flat;
      },
      shape);
}

/// For the two bodies if a and b name bodies, else for all shapes: "flat" or "solid".
inline std::string_view degeneracy_of(const Case& c, int a, int b) {
  const int n = static_cast<int>(c.scene.bodies.size());
  const bool flat = a >= 0 && b >= 0 && a < n && b < n
                        ? is_flat(c.scene.shape_of(a)) || is_flat(c.scene.shape_of(b))
                        : std::any_of(c.scene.shapes.begin(), c.scene.shapes.end(),
                                      [](const Shape& s) { return is_flat(s); });
  return flat ? "flat" : "solid";
}

}  // namespace touchstone::fuzz
