// Certificates read back from what to_json wrote; those of motions both ways.
#include <nlohmann/json.hpp>

#include "core/base/input_error.h"
#include "oracles/referee/checker.h"
#include "oracles/referee/checker_set.h"
#include "oracles/referee/impact_certificate.h"

namespace touchstone::referee {
namespace {

Certificate::Kind kind_named(const std::string& s) {
  using K = Certificate::Kind;
  constexpr std::pair<std::string_view, K> names[] = {{"none", K::none},
                                                      {"separating_plane", K::separating_plane},
                                                      {"common_point", K::common_point},
                                                      {"depth_direction", K::depth_direction},
                                                      {"inner_polytope", K::inner_polytope},
                                                      {"closed_form", K::closed_form}};
  for (const auto& [name, kind] : names)
    if (s == name) return kind;
  throw InputError("kind", "is not a kind of certificate (" + s + ")");
}

Vec3 vector_of(const nlohmann::ordered_json& j) {
  if (!j.is_array() || j.size() != 3) throw InputError("", "a vector of a certificate has three numbers");
  return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()};
}

}  // namespace

checker::Q checker::rational_of(const std::string& s) {
  const bool plain = !s.empty() && s.find_first_not_of("-0123456789/") == std::string::npos &&
                     s.back() != '/' && s.find("/0") == std::string::npos;
  try {
    if (plain) return checker::Q(s);
  } catch (const std::exception&) {
  }
  throw InputError("", "is not a rational number \"n/d\" (" + s + ")");
}

Certificate certificate_from_json(const nlohmann::ordered_json& j) {
  try {
    Certificate c;
    c.kind = kind_named(j.at("kind").get<std::string>());
    using K = Certificate::Kind;
    const bool plane = c.kind == K::separating_plane, point = c.kind == K::common_point;
    if ((plane || point) && j.contains("rationals")) {
      c.rationals = j.at("rationals").get<std::vector<std::string>>();
      if (c.rationals.empty()) throw InputError("rationals", "is empty");
    } else if (point) {
      c.point = vector_of(j.at("point"));
    }
    if ((plane && c.rationals.empty()) || c.kind == K::depth_direction)
      c.direction = vector_of(j.at("direction"));
    const bool has_offset =
        (plane && c.rationals.empty()) || c.kind == K::depth_direction || c.kind == K::inner_polytope;
    if (has_offset) c.offset = j.at("offset").get<double>();
    if (c.kind == K::inner_polytope) {
      for (const auto& p : j.at("support_pairs"))
        c.support_pairs.push_back({vector_of(p.at(0)), vector_of(p.at(1))});
      c.facets = j.at("facets").get<std::vector<std::array<int, 3>>>();
    }
    return c;
  } catch (const nlohmann::json::exception& e) {
    throw InputError("certificate", std::string("cannot be read: ") + e.what());
  }
}

nlohmann::ordered_json to_json(const ImpactCertificate& c) {
  nlohmann::ordered_json j = {{"kind", "impact"}};
  if (!c.tracks.empty()) {
    j["clear_until"] = c.clear_until;
    j["planes"] = nlohmann::ordered_json::array();
    for (const auto& track : c.tracks) {
      nlohmann::ordered_json keys = nlohmann::ordered_json::array();
      for (const auto& k : track)
        keys.push_back({{"t", k.t}, {"direction", k.direction}, {"offset", k.offset}});
      j["planes"].push_back(std::move(keys));
    }
  }
  if (c.contact) j["contact"] = {{"t", c.contact->t}, {"point", c.contact->point}};
  if (c.overlap)
    j["overlap"] = {{"t", c.overlap->t},
                    {"parts", {c.overlap->part_a, c.overlap->part_b}},
                    {"depth", to_json(c.overlap->inner)}};
  return j;
}

ImpactCertificate impact_certificate_from_json(const nlohmann::ordered_json& j) {
  try {
    if (j.at("kind") != "impact") throw InputError("kind", "is not \"impact\"");
    ImpactCertificate c;
    if (j.contains("planes")) {
      c.clear_until = j.at("clear_until").get<double>();
      for (const auto& keys : j.at("planes")) {
        auto& track = c.tracks.emplace_back();
        for (const auto& k : keys)
          track.push_back({k.at("t").get<double>(), k.at("direction").get<std::array<std::string, 3>>(),
                           k.at("offset").get<std::string>()});
      }
      if (c.tracks.empty()) throw InputError("planes", "is empty");
    }
    if (j.contains("contact"))
      c.contact = {j.at("contact").at("t").get<std::string>(),
                   j.at("contact").at("point").get<std::array<std::string, 3>>()};
    if (j.contains("overlap")) {
      const auto& o = j.at("overlap");
      const auto parts = o.at("parts").get<std::array<std::size_t, 2>>();
      c.overlap = {o.at("t").get<double>(), parts[0], parts[1], certificate_from_json(o.at("depth"))};
    }
    return c;
  } catch (const nlohmann::json::exception& e) {
    throw InputError("certificate", std::string("cannot be read: ") + e.what());
  }
}

}  // namespace touchstone::referee
