// EngineCard ↔ JSON. Parsing is strict: the card carries the engine's tolerance claims, and a misspelt field
// would silently change a verdict.
#include "scenarios/codec/value_codec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/base/exact_text.h"
#include "core/base/input_error.h"
#include "scenarios/text/printable.h"
#include "scenarios/value/engine_card.h"

namespace touchstone {
namespace {

using Json = nlohmann::ordered_json;

struct TextField {
  const char* name;
  std::string EngineCard::*member;
};
struct NumberField {
  const char* name;
  double EngineCard::*member;
  double most;
};
constexpr const char* complete_field = "complete_manifolds";
constexpr const char* more_shapes_field = "more_shapes";
constexpr const char* shapes_field = "shapes";
constexpr const char* roundoffs_field = "unit_roundoffs";
constexpr const char* biases_field = "depth_biases";
constexpr const char* separate_field = "separate_triangles";
constexpr const char* pipe_field = "times_include_pipe";
constexpr std::array text_fields{
    TextField{"name", &EngineCard::name}, TextField{"library", &EngineCard::library},
    TextField{"version", &EngineCard::version}, TextField{"settings", &EngineCard::settings},
    TextField{"source", &EngineCard::source}};
// Bounds on what an engine may claim about itself, because every verdict would believe it: the coarsest
// arithmetic is bfloat16's, 2⁻⁸; an answer takes no more than some thousands of roundings; and both together
// explain at most a hundredth of L.
constexpr std::array number_fields{NumberField{"unit_roundoff", &EngineCard::unit_roundoff, 0x1p-8},
                                   NumberField{"tau_factor", &EngineCard::tau_factor, 0x1p14}};
constexpr double most_of_l = 1e-2;  // as above
struct LengthField {
  const char* name;
  double EngineCard::*member;
};
constexpr std::array length_fields{LengthField{"contact_offset", &EngineCard::contact_offset},
                                   LengthField{"sweep_skin", &EngineCard::sweep_skin}};
// Bias of the routines that prefer faces of boxes: 5 % (Bullet and ODE, dBoxBox2). A bias of a quarter is
// already another direction than that of least depth.
constexpr double most_bias = 0.25;

// These texts are shown to people, also on a terminal.
constexpr std::size_t max_text_bytes = 1000;

bool is_known(std::string_view key) {
  for (const auto& f : text_fields)
    if (key == f.name) return true;
  for (const auto& f : number_fields)
    if (key == f.name) return true;
  for (const auto& f : length_fields)
    if (key == f.name) return true;
  for (const char* name : {complete_field, more_shapes_field, shapes_field, roundoffs_field, biases_field,
                           separate_field, pipe_field})
    if (key == name) return true;
  return false;
}

std::string text_of(const Json& j, const char* field) {
  if (!j.contains(field)) throw InputError(field, "is missing from the engine card");
  if (!j[field].is_string()) throw InputError(field, "is not a string");
  std::string text = j[field].get<std::string>();
  if (text.size() > max_text_bytes)
    throw InputError(field, "is longer than " + std::to_string(max_text_bytes) + " bytes");
  return printable(text, "\n");
}

std::string too_large(double x, double most) {
  return "is " + to_text(x) + "; at most " + to_text(most) + " is accepted";
}

double positive_number(const Json& j, const std::string& place, double most) {
  if (!j.is_number()) throw InputError(place, "is not a number");
  const double x = j.get<double>();
  if (!(x > 0 && std::isfinite(x))) throw InputError(place, "is not a positive finite number");
  if (x > most) throw InputError(place, too_large(x, most));
  return x;
}

double positive_number_of(const Json& j, const char* field, double most) {
  if (!j.contains(field)) throw InputError(field, "is missing from the engine card");
  return positive_number(j[field], field, most);
}

void require_tau(const EngineCard& card, double unit_roundoff, const char* field) {
  if (card.tau_factor * unit_roundoff > most_of_l)
    throw InputError(field, "times unit_roundoff " + too_large(card.tau_factor * unit_roundoff, most_of_l));
}

bool flag_of(const Json& j, const char* field) {
  if (!j.contains(field)) return false;
  if (!j[field].is_boolean()) throw InputError(field, "is neither true nor false");
  return j[field].get<bool>();
}

ShapeKind kind_named(std::string_view name, const char* field) {
  for (int k = 0; k < shape_kind_count; ++k)
    if (name == type_name(static_cast<ShapeKind>(k))) return static_cast<ShapeKind>(k);
  throw InputError(field, "names something other than a kind of shape: " +
                              printable(std::string(name.substr(0, max_engine_name_bytes))));
}

ShapeKind later_shape_named(const Json& name) {
  for (int k = static_cast<int>(last_common_shape) + 1; k < shape_kind_count; ++k)
    if (name == type_name(static_cast<ShapeKind>(k))) return static_cast<ShapeKind>(k);
  throw InputError(more_shapes_field, "lists something other than a kind of shape after the " +
                                          std::string(type_name(last_common_shape)));
}

void read_shapes(const Json& j, EngineCard& card) {
  if (j.contains(more_shapes_field)) {
    if (!j[more_shapes_field].is_array()) throw InputError(more_shapes_field, "is not a list");
    for (const Json& name : j[more_shapes_field]) card.more_shapes.push_back(later_shape_named(name));
  }
  if (!j.contains(shapes_field)) return;
  const Json& list = j[shapes_field];
  if (!list.is_array() || list.empty()) throw InputError(shapes_field, "is not a list of kinds of shapes");
  if (!card.more_shapes.empty()) throw InputError(shapes_field, "excludes more_shapes");
  for (const Json& name : list) {
    if (!name.is_string()) throw InputError(shapes_field, "lists something other than a string");
    const ShapeKind kind = kind_named(name.get_ref<const std::string&>(), shapes_field);
    if (std::ranges::find(card.shapes, kind) != card.shapes.end())
      throw InputError(shapes_field, "lists a kind twice: " + std::string(type_name(kind)));
    card.shapes.push_back(kind);
  }
  std::ranges::sort(card.shapes);
}

void read_roundoffs(const Json& j, EngineCard& card) {
  if (!j.contains(roundoffs_field)) return;
  if (!j[roundoffs_field].is_object()) throw InputError(roundoffs_field, "is not an object");
  for (const auto& [name, value] : j[roundoffs_field].items()) {
    const ShapeKind kind = kind_named(name, roundoffs_field);
    const std::string place = std::string(roundoffs_field) + "." + name;
    const double u = positive_number(value, place, number_fields[0].most);
    if (u < card.unit_roundoff) throw InputError(place, "is less than unit_roundoff");
    require_tau(card, u, place.c_str());
    card.unit_roundoffs.push_back({kind, u});
  }
  std::ranges::sort(card.unit_roundoffs, {}, &KindRoundoff::kind);
}

void read_biases(const Json& j, EngineCard& card) {
  if (!j.contains(biases_field)) return;
  if (!j[biases_field].is_object()) throw InputError(biases_field, "is not an object");
  for (const auto& [names, value] : j[biases_field].items()) {
    const std::size_t space = names.find(' ');
    if (space == std::string::npos)
      throw InputError(biases_field, "has a name that is not two kinds of shapes, as in \"box box\"");
    const std::string_view all = names;
    const auto [a, b] = std::minmax(
        {kind_named(all.substr(0, space), biases_field), kind_named(all.substr(space + 1), biases_field)});
    const auto same = [a = a, b = b](const DepthBias& x) { return x.a == a && x.b == b; };
    if (std::ranges::any_of(card.depth_biases, same))
      throw InputError(biases_field, "lists a pair twice: " + names);
    card.depth_biases.push_back({a, b, positive_number(value, biases_field, most_bias)});
  }
  std::ranges::sort(card.depth_biases, {}, [](const DepthBias& x) { return std::pair(x.a, x.b); });
}

}  // namespace

EngineCard card_from_json(const std::string& text) {
  const Json j = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (j.is_discarded()) throw InputError("", "the engine card is not JSON");
  if (!j.is_object()) throw InputError("", "the engine card is not a JSON object");
  for (const auto& [key, value] : j.items())
    if (!is_known(key)) throw InputError(key, "is not a field of an engine card");
  EngineCard card;
  for (const auto& f : text_fields) card.*f.member = text_of(j, f.name);
  for (const auto& f : number_fields) card.*f.member = positive_number_of(j, f.name, f.most);
  require_tau(card, card.unit_roundoff, "tau_factor");
  card.complete_manifolds = flag_of(j, complete_field);
  card.separate_triangles = flag_of(j, separate_field);
  card.times_include_pipe = flag_of(j, pipe_field);
  read_shapes(j, card);
  read_roundoffs(j, card);
  read_biases(j, card);
  for (const auto& f : length_fields)
    if (j.contains(f.name))
      card.*f.member = positive_number(j[f.name], f.name, std::numeric_limits<double>::max());
  if (card.name.empty()) throw InputError("name", "is empty");
  if (!is_engine_name(card.name))
    throw InputError(
        "name", "must begin with a letter or digit and be at most 64 printable ASCII characters, no / or \\");
  return card;
}

std::string to_json_text(const EngineCard& card) {
  Json j;
  j["name"] = card.name;
  j["library"] = card.library;
  j["version"] = card.version;
  j["settings"] = card.settings;
  j["unit_roundoff"] = card.unit_roundoff;
  j["tau_factor"] = card.tau_factor;
  j["source"] = card.source;
  if (card.complete_manifolds) j[complete_field] = true;
  for (const ShapeKind k : card.more_shapes) j[more_shapes_field].push_back(type_name(k));
  for (const ShapeKind k : card.shapes) j[shapes_field].push_back(type_name(k));
  for (const KindRoundoff& r : card.unit_roundoffs)
    j[roundoffs_field][std::string(type_name(r.kind))] = r.unit_roundoff;
  for (const auto& f : length_fields)
    if (card.*f.member > 0) j[f.name] = card.*f.member;
  for (const DepthBias& d : card.depth_biases)
    j[biases_field][std::string(type_name(d.a)) + " " + std::string(type_name(d.b))] = d.share;
  if (card.separate_triangles) j[separate_field] = true;
  if (card.times_include_pipe) j[pipe_field] = true;
  return j.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace touchstone
