#include "reports/record/broad_view.h"

#include <cmath>

namespace touchstone::fuzz {
namespace {

using SortedJson = nlohmann::json;

SortedJson ends(const Vec3& v) {
  SortedJson j = SortedJson::array();
  for (int k = 0; k < 3; ++k) j.push_back(std::isfinite(v[k]) ? SortedJson(v[k]) : SortedJson());
  return j;
}

SortedJson box(const Aabb& b) { return {ends(b.lo), ends(b.hi)}; }

SortedJson look(const BroadView::Look& l) {
  SortedJson grids = SortedJson::array(), nodes = SortedJson::array();
  for (const auto& g : l.grids)
    grids.push_back({{"along", g.along}, {"origin", g.origin}, {"cell", g.cell}, {"count", g.count}});
  for (const auto& level : l.nodes) {
    SortedJson boxes = SortedJson::array();
    for (const Aabb& b : level) boxes.push_back(box(b));
    nodes.push_back(boxes);
  }
  return {{"explanation", l.explanation}, {"sweep_axis", l.sweep_axis}, {"grids", grids}, {"nodes", nodes},
          {"considered", l.considered},   {"pruned", l.pruned}};
}

}  // namespace

SortedJson to_json(const BroadView& v) {
  SortedJson frames = SortedJson::array();
  for (const auto& f : v.frames) {
    SortedJson boxes = SortedJson::array(), looks = SortedJson::array();
    for (const auto& b : f.boxes) boxes.push_back(b ? box(*b) : SortedJson());
    for (const auto& l : f.looks) looks.push_back(look(l));
    frames.push_back({{"boxes", boxes},
                      {"kept", f.kept},
                      {"all_pairs", f.all_pairs},
                      {"overlap_on_axis", f.overlap_on_axis},
                      {"looks", looks}});
  }
  return {
      {"name", v.name}, {"bodies", v.bodies}, {"fixed", v.fixed}, {"methods", v.methods}, {"frames", frames}};
}

}  // namespace touchstone::fuzz
