// Closed box { |x_i| <= half_extents_i }. A zero half extent gives a rectangle, a segment or a point.
#pragma once

#include <tuple>

#include "core/math/pose.h"
#include "core/shape/field.h"

namespace touchstone {

struct Box {
  Vec3 half_extents = Vec3::Zero();
  static constexpr std::string_view type = "box";
  static constexpr auto fields() {
    return std::tuple{Field{"half_extents", &Box::half_extents, Domain::non_negative}};
  }
  bool operator==(const Box& o) const { return half_extents == o.half_extents; }
};

inline Vec3 support(const Box& b, const Vec3& d) {
  const Vec3& h = b.half_extents;
  return {d.x() < 0 ? -h.x() : h.x(), d.y() < 0 ? -h.y() : h.y(), d.z() < 0 ? -h.z() : h.z()};
}

}  // namespace touchstone
