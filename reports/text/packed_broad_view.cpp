// reports/web/src/broad/data.ts unpacks what is packed here.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "reports/text/web_page.h"

namespace touchstone::reports {
namespace {

using SortedJson = nlohmann::json;

// The page stores lengths as whole steps from `origin`, finer than any screen can show. An infinite end is
// null.
struct Ruler {
  double origin = 0, step = 1;
  std::optional<std::int64_t> operator()(double x) const {
    constexpr double far = 1e15;  // steps: whole numbers that JavaScript stores exactly
    if (!std::isfinite(x)) return std::nullopt;
    return std::llround(std::clamp((x - origin) / step, -far, far));
  }
};

std::array<double, 6> ends(const Aabb& b) {
  return {b.lo.x(), b.lo.y(), b.lo.z(), b.hi.x(), b.hi.y(), b.hi.z()};
}

Ruler ruler_for(const fuzz::BroadView& view) {
  constexpr double steps = 1e5;  // over the whole scene
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  for (const auto& f : view.frames)
    for (const auto& b : f.boxes)
      for (const double x : b ? ends(*b) : std::array<double, 6>{})
        if (b && std::isfinite(x)) {
          lo = std::min(lo, x);
          hi = std::max(hi, x);
        }
  if (!(hi > lo) || !std::isfinite(hi - lo)) return {};
  return {lo, (hi - lo) / steps};
}

// A box as differences from `last`, its ends in the previous frame.
SortedJson packed(const Aabb& b, const Ruler& ruler, std::array<std::int64_t, 6>& last) {
  SortedJson j = SortedJson::array();
  const auto all = ends(b);
  for (std::size_t k = 0; k < 6; ++k) {
    const auto x = ruler(all[k]);
    j.push_back(x ? SortedJson(*x - last[k]) : SortedJson());
    if (x) last[k] = *x;
  }
  return j;
}

// Sorted pairs (a, b), a < b: a as the difference from the previous a, b from the previous b or from a new a.
SortedJson packed(const std::vector<BodyPair>& pairs) {
  SortedJson j = SortedJson::array();
  int last_a = 0, last_b = 0;
  for (const auto& [a, b] : pairs) {
    if (a != last_a) last_b = a;
    j.push_back(a - last_a);
    j.push_back(b - last_b);
    last_a = a;
    last_b = b;
  }
  return j;
}

SortedJson packed_nodes(const std::vector<std::vector<Aabb>>& levels, const Ruler& ruler) {
  SortedJson j = SortedJson::array();
  for (const auto& level : levels) {
    SortedJson& boxes = j.emplace_back(SortedJson::array());
    for (const Aabb& b : level) {
      std::array<std::int64_t, 6> none{};
      boxes.push_back(packed(b, ruler, none));
    }
  }
  return j;
}

}  // namespace

SortedJson packed_broad_view(const fuzz::BroadView& view) {
  const Ruler ruler = ruler_for(view);
  SortedJson j = fuzz::to_json(view);
  j["origin"] = ruler.origin;
  j["step"] = ruler.step;
  std::vector<std::array<std::int64_t, 6>> last(view.bodies.size());
  for (std::size_t i = 0; i < view.frames.size(); ++i) {
    const auto& f = view.frames[i];
    SortedJson& frame = j["frames"][i];
    for (std::size_t b = 0; b < f.boxes.size(); ++b)
      if (f.boxes[b]) frame["boxes"][b] = packed(*f.boxes[b], ruler, last[b]);
    frame["kept"] = packed(f.kept);
    for (std::size_t m = 0; m < f.looks.size(); ++m) {
      frame["looks"][m]["nodes"] = packed_nodes(f.looks[m].nodes, ruler);
      frame["looks"][m]["pruned"] = packed(f.looks[m].pruned);
    }
  }
  return j;
}

}  // namespace touchstone::reports
