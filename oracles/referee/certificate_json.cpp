// Certificates read back from what to_json wrote; those of motions both ways.
#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

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

using Json = nlohmann::ordered_json;

// The library would take a member's value for an item, and null and words for none.
const Json& array_of(const Json& j, const char* name) {
  const Json& array = j.at(name);
  if (!array.is_array()) throw InputError(name, "is no array");
  return array;
}

double number_of(const Json& j, const char* name) {
  if (!j.is_number()) throw InputError(name, "is no number");
  return j.get<double>();
}

Vec3 vector_of(const Json& j) {
  if (!j.is_array() || j.size() != 3 || !j[0].is_number() || !j[1].is_number() || !j[2].is_number())
    throw InputError("", "a vector of a certificate has three numbers");
  return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()};
}

// The library rounds and wraps what is no index.
template <class Index, std::size_t N>
std::array<Index, N> indices_of(const Json& j, const char* name) {
  std::array<Index, N> r{};
  if (!j.is_array() || j.size() != N) throw InputError(name, "has another number of indices");
  for (std::size_t i = 0; i < N; ++i) {
    const bool fits = j[i].is_number_unsigned() &&
                      j[i].get<std::uint64_t>() <= std::uint64_t{std::numeric_limits<int>::max()};
    if (!fits) throw InputError(name, "holds what is no index");
    r[i] = j[i].get<Index>();
  }
  return r;
}

std::array<std::string, 3> words_of(const Json& j, const char* name) {
  if (!j.is_array() || j.size() != 3) throw InputError(name, "has three rational numbers");
  return {j[0].get<std::string>(), j[1].get<std::string>(), j[2].get<std::string>()};
}

// Without the library's name and number.
std::string said(const nlohmann::json::exception& e) {
  const std::string s = e.what();
  const auto bracket = s.find("] ");
  return bracket == std::string::npos ? s : s.substr(bracket + 2);
}

// A certificate of ours has some thousands of digits at most; beyond, to check one takes longer than a person
// waits.
constexpr std::size_t max_digits = 50'000, max_digits_in_all = 2'000'000;

// Digits without leading zeros.
bool is_whole(std::string_view s) {
  return !s.empty() && s.size() <= max_digits && (s.size() == 1 || s[0] != '0') &&
         s.find_first_not_of("0123456789") == std::string_view::npos;
}

void require_readable_size(const nlohmann::ordered_json& rationals) {
  std::size_t digits = 0;
  for (const auto& r : rationals) digits += r.is_string() ? r.get_ref<const std::string&>().size() : 0;
  if (digits > max_digits_in_all) throw InputError("rationals", "have more digits in all than are read");
}

}  // namespace

// Lowest terms are not asked for, but a denominator has no sign and is not zero: GMP takes both for granted.
checker::Q checker::rational_of(const std::string& s) {
  using Integer =
      boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;
  const auto slash = std::min(s.find('/'), s.size());
  const std::string numerator = s.substr(0, slash),
                    denominator = slash < s.size() ? s.substr(slash + 1) : "1";
  if (is_whole(std::string_view(numerator).substr(numerator.starts_with('-') ? 1 : 0)) &&
      is_whole(denominator) && denominator != "0")
    return Q(Integer(numerator), Integer(denominator));
  constexpr std::size_t shown = 40;
  throw InputError("", "is not a rational number \"n/d\" of at most " + std::to_string(max_digits) +
                           " digits (" + (s.size() > shown ? s.substr(0, shown) + "..." : s) + ")");
}

Certificate certificate_from_json(const nlohmann::ordered_json& j) {
  try {
    Certificate c;
    c.kind = kind_named(j.at("kind").get<std::string>());
    using K = Certificate::Kind;
    const bool plane = c.kind == K::separating_plane, point = c.kind == K::common_point;
    if ((plane || point) && j.contains("rationals")) {
      require_readable_size(array_of(j, "rationals"));
      c.rationals = j.at("rationals").get<std::vector<std::string>>();
      if (c.rationals.empty()) throw InputError("rationals", "is empty");
    } else if (point) {
      c.point = vector_of(j.at("point"));
    }
    if ((plane && c.rationals.empty()) || c.kind == K::depth_direction)
      c.direction = vector_of(j.at("direction"));
    const bool has_offset =
        (plane && c.rationals.empty()) || c.kind == K::depth_direction || c.kind == K::inner_polytope;
    if (has_offset) c.offset = number_of(j.at("offset"), "offset");
    if (c.kind == K::inner_polytope) {
      for (const auto& p : array_of(j, "support_pairs"))
        c.support_pairs.push_back({vector_of(p.at(0)), vector_of(p.at(1))});
      for (const auto& f : array_of(j, "facets")) c.facets.push_back(indices_of<int, 3>(f, "facets"));
    }
    return c;
  } catch (const nlohmann::json::exception& e) {
    throw InputError("certificate", "cannot be read: " + said(e));
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
        if (!keys.is_array()) throw InputError("planes", "is no array of arrays");
        auto& track = c.tracks.emplace_back();
        for (const auto& k : keys)
          track.push_back({number_of(k.at("t"), "t"), words_of(k.at("direction"), "direction"),
                           k.at("offset").get<std::string>()});
      }
      if (c.tracks.empty()) throw InputError("planes", "is empty");
    }
    if (j.contains("contact"))
      c.contact = {j.at("contact").at("t").get<std::string>(),
                   words_of(j.at("contact").at("point"), "point")};
    if (j.contains("overlap")) {
      const auto& o = j.at("overlap");
      const auto parts = indices_of<std::size_t, 2>(o.at("parts"), "parts");
      c.overlap = {number_of(o.at("t"), "t"), parts[0], parts[1], certificate_from_json(o.at("depth"))};
    }
    return c;
  } catch (const nlohmann::json::exception& e) {
    throw InputError("certificate", "cannot be read: " + said(e));
  }
}

}  // namespace touchstone::referee
