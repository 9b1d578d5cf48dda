#include "reports/record/observation_json.h"

#include <cmath>

#include "core/base/exact_text.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/printable.h"

namespace touchstone::fuzz {

Json number(double x) {
  if (std::isfinite(x)) return x;
  return to_text(x);
}

std::string csv_cells(const Json& cells) {
  std::string text;
  for (const Json& cell : cells) {
    if (!text.empty()) text += ',';
    text += json_text(cell);
  }
  return text;
}

Json vector(const Vec3& v) { return Json::array({number(v.x()), number(v.y()), number(v.z())}); }

Json to_json(const Observation& o) {
  Json j;
  j["outcome"] = to_string(o.outcome);
  if (!o.detail.empty()) j["detail"] = valid_utf8(o.detail);
  if (!o.site.empty()) j["site"] = o.site;
  if (o.overlap) j["overlap"] = *o.overlap;
  if (o.distance) j["distance"] = number(*o.distance);
  if (o.witness) j["witness"] = Json::array({vector((*o.witness)[0]), vector((*o.witness)[1])});
  if (o.normal) j["normal"] = vector(*o.normal);
  if (o.moment) j["moment"] = vector(*o.moment);
  if (o.unique_gradient) j["unique_gradient"] = *o.unique_gradient;
  if (o.depth) j["depth"] = number(*o.depth);
  for (const ManifoldPoint& p : o.manifold) {
    Json point{{"position", vector(p.position)}, {"depth", number(p.depth)}};
    if (p.id) point["id"] = *p.id;
    j["manifold"].push_back(std::move(point));
  }
  if (o.toi) j["toi"] = number(*o.toi);
  if (o.lower_bound) j["lower_bound"] = number(*o.lower_bound);
  if (o.upper_bound) j["upper_bound"] = number(*o.upper_bound);
  for (const auto& set : o.candidate_pairs) {
    Json pairs = Json::array();
    for (const auto& [a, b] : set) pairs.push_back({a, b});
    j["candidate_pairs"].push_back(std::move(pairs));
  }
  for (const SceneContact& c : o.contacts)
    j["contacts"].push_back(
        {{"a", c.a}, {"b", c.b}, {"normal", vector(c.normal)}, {"depth", number(c.depth)}});
  if (o.claimed_tolerance != 0) j["claimed_tolerance"] = number(o.claimed_tolerance);
  return j;
}

Json to_json(const ReceivedScene& r) {
  Json j = Json::object();
  for (std::size_t i = 0; i < r.bodies.size(); ++i) {
    if (!r.bodies[i]) continue;
    const Placement& p = *r.bodies[i];
    Json m = Json::array();
    for (int row = 0; row < 3; ++row) m.push_back(vector(p.matrix.row(row).transpose()));
    j["bodies"].push_back({{"body", i}, {"matrix", std::move(m)}, {"translation", vector(p.translation)}});
  }
  return j;
}

}  // namespace touchstone::fuzz
