// EngineCard ↔ JSON. Parsing is strict: the card carries the engine's tolerance claims, and a misspelt field
// would silently change a verdict.
#include "scenarios/codec/value_codec.h"

#include <algorithm>
#include <array>
#include <cmath>
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
constexpr const char* shapes_field = "more_shapes";
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

// These texts are shown to people, also on a terminal.
constexpr std::size_t max_text_bytes = 1000;

bool is_known(std::string_view key) {
  for (const auto& f : text_fields)
    if (key == f.name) return true;
  for (const auto& f : number_fields)
    if (key == f.name) return true;
  return key == complete_field || key == shapes_field;
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

double positive_number_of(const Json& j, const char* field, double most) {
  if (!j.contains(field)) throw InputError(field, "is missing from the engine card");
  if (!j[field].is_number()) throw InputError(field, "is not a number");
  const double x = j[field].get<double>();
  if (!(x > 0 && std::isfinite(x))) throw InputError(field, "is not a positive finite number");
  if (x > most) throw InputError(field, too_large(x, most));
  return x;
}

ShapeKind shape_named(const Json& name) {
  for (int k = static_cast<int>(last_common_shape) + 1; k < shape_kind_count; ++k)
    if (name == type_name(static_cast<ShapeKind>(k))) return static_cast<ShapeKind>(k);
  throw InputError(shapes_field, "lists something other than a kind of shape after the " +
                                     std::string(type_name(last_common_shape)));
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
  if (card.tau_factor * card.unit_roundoff > most_of_l)
    throw InputError("tau_factor",
                     "times unit_roundoff " + too_large(card.tau_factor * card.unit_roundoff, most_of_l));
  if (j.contains(complete_field)) {
    if (!j[complete_field].is_boolean()) throw InputError(complete_field, "is neither true nor false");
    card.complete_manifolds = j[complete_field].get<bool>();
  }
  if (j.contains(shapes_field)) {
    if (!j[shapes_field].is_array()) throw InputError(shapes_field, "is not a list");
    for (const Json& name : j[shapes_field]) card.more_shapes.push_back(shape_named(name));
  }
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
  for (const ShapeKind k : card.more_shapes) j[shapes_field].push_back(type_name(k));
  return j.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace touchstone
