#include "scenarios/codec/value_codec.h"

#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/base/input_error.h"

namespace touchstone {
namespace {

using Kind = Certificate::Kind;
constexpr auto kind_names = std::to_array<std::pair<std::string_view, Kind>>({
    {"none", Kind::none},
    {"separating_plane", Kind::separating_plane},
    {"common_point", Kind::common_point},
    {"depth_direction", Kind::depth_direction},
    {"inner_polytope", Kind::inner_polytope},
    {"closed_form", Kind::closed_form},
});

Kind kind_named(const std::string& s) {
  for (const auto& [name, kind] : kind_names)
    if (s == name) return kind;
  throw InputError("kind", "is not a kind of certificate (" + s + ")");
}

std::string_view name_of(Kind k) {
  for (const auto& [name, kind] : kind_names)
    if (k == kind) return name;
  return "none";
}

using Json = nlohmann::ordered_json;

// The library would iterate over an object's values, and treat null and strings as empty or as one item.
const Json& array_of(const Json& j, const char* name) {
  const Json& array = j.at(name);
  if (!array.is_array()) throw InputError(name, "is not an array");
  return array;
}

double number_of(const Json& j, const char* name) {
  if (!j.is_number()) throw InputError(name, "is not a number");
  return j.get<double>();
}

Vec3 vector_of(const Json& j) {
  if (!j.is_array() || j.size() != 3 || !j[0].is_number() || !j[1].is_number() || !j[2].is_number())
    throw InputError("", "a vector of a certificate has three numbers");
  return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()};
}

// The library rounds or wraps numbers that are not valid indices.
template <class Index, std::size_t N>
std::array<Index, N> indices_of(const Json& j, const char* name) {
  std::array<Index, N> r{};
  if (!j.is_array() || j.size() != N) throw InputError(name, "has the wrong number of indices");
  for (std::size_t i = 0; i < N; ++i) {
    const bool fits = j[i].is_number_unsigned() &&
                      j[i].get<std::uint64_t>() <= std::uint64_t{std::numeric_limits<int>::max()};
    if (!fits) throw InputError(name, "holds an invalid index");
    r[i] = j[i].get<Index>();
  }
  return r;
}

Json list(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

std::array<std::string, 3> rationals_of(const Json& j, const char* name) {
  if (!j.is_array() || j.size() != 3) throw InputError(name, "must have three rational numbers");
  return {j[0].get<std::string>(), j[1].get<std::string>(), j[2].get<std::string>()};
}

// The library's message without its prefix.
std::string message_of(const nlohmann::json::exception& e) {
  const std::string s = e.what();
  const auto bracket = s.find("] ");
  return bracket == std::string::npos ? s : s.substr(bracket + 2);
}

// Our certificates have some thousands of digits at most. Checking one beyond this limit takes longer than a
// person would wait.
constexpr std::size_t max_total_digits = 2'000'000;

void require_readable_size(const nlohmann::ordered_json& rationals) {
  std::size_t digits = 0;
  for (const auto& r : rationals) digits += r.is_string() ? r.get_ref<const std::string&>().size() : 0;
  if (digits > max_total_digits) throw InputError("rationals", "have too many digits in total");
}

}  // namespace

nlohmann::ordered_json to_json(const Certificate& c) {
  nlohmann::ordered_json j;
  j["kind"] = name_of(c.kind);
  const bool plane = c.kind == Kind::separating_plane;
  const bool direction = c.kind == Kind::depth_direction;
  // Write each number once: when there are rationals, the doubles are only their roundings.
  if (!c.rationals.empty()) {
    j["rationals"] = c.rationals;
  } else {
    if (plane || direction) j["direction"] = list(c.direction);
    if (plane || direction || c.kind == Kind::inner_polytope) j["offset"] = c.offset;
    if (c.kind == Kind::common_point) j["point"] = list(c.point);
  }
  if (!c.support_pairs.empty()) {
    j["support_pairs"] = nlohmann::ordered_json::array();
    for (const auto& [p, q] : c.support_pairs) j["support_pairs"].push_back({list(p), list(q)});
    j["facets"] = c.facets;
  }
  if (!c.note.empty()) j["note"] = c.note;
  return j;
}

Certificate certificate_from_json(const nlohmann::ordered_json& j) {
  try {
    Certificate c;
    c.kind = kind_named(j.at("kind").get<std::string>());
    const bool plane = c.kind == Kind::separating_plane, point = c.kind == Kind::common_point;
    if ((plane || point) && j.contains("rationals")) {
      require_readable_size(array_of(j, "rationals"));
      c.rationals = j.at("rationals").get<std::vector<std::string>>();
      if (c.rationals.empty()) throw InputError("rationals", "is empty");
    } else if (point) {
      c.point = vector_of(j.at("point"));
    }
    if ((plane && c.rationals.empty()) || c.kind == Kind::depth_direction)
      c.direction = vector_of(j.at("direction"));
    const bool has_offset =
        (plane && c.rationals.empty()) || c.kind == Kind::depth_direction || c.kind == Kind::inner_polytope;
    if (has_offset) c.offset = number_of(j.at("offset"), "offset");
    if (c.kind == Kind::inner_polytope) {
      for (const auto& p : array_of(j, "support_pairs"))
        c.support_pairs.push_back({vector_of(p.at(0)), vector_of(p.at(1))});
      for (const auto& f : array_of(j, "facets")) c.facets.push_back(indices_of<int, 3>(f, "facets"));
    }
    return c;
  } catch (const nlohmann::json::exception& e) {
    throw InputError("certificate", "cannot be read: " + message_of(e));
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
      c.clear_until = number_of(j.at("clear_until"), "clear_until");
      for (const auto& keys : array_of(j, "planes")) {
        if (!keys.is_array()) throw InputError("planes", "is not an array of arrays");
        auto& track = c.tracks.emplace_back();
        for (const auto& k : keys)
          track.push_back({number_of(k.at("t"), "t"), rationals_of(k.at("direction"), "direction"),
                           k.at("offset").get<std::string>()});
      }
      if (c.tracks.empty()) throw InputError("planes", "is empty");
    }
    if (j.contains("contact"))
      c.contact = {j.at("contact").at("t").get<std::string>(),
                   rationals_of(j.at("contact").at("point"), "point")};
    if (j.contains("overlap")) {
      const auto& o = j.at("overlap");
      const auto parts = indices_of<std::size_t, 2>(o.at("parts"), "parts");
      c.overlap = {number_of(o.at("t"), "t"), parts[0], parts[1], certificate_from_json(o.at("depth"))};
    }
    return c;
  } catch (const nlohmann::json::exception& e) {
    throw InputError("certificate", "cannot be read: " + message_of(e));
  }
}

}  // namespace touchstone
