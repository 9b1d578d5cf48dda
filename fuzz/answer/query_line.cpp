#include "fuzz/answer/query_line.h"

#include <array>

#include "core/base/exact_text.h"
#include "core/base/input_error.h"
#include "fuzz/answer/body_text.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/codec/scene_codec.h"

namespace touchstone::fuzz {
namespace {

using Json = nlohmann::ordered_json;

constexpr auto body_fields = std::to_array<std::string_view>({"shape", "pose", "motion"});
constexpr auto plain_fields =
    std::to_array<std::string_view>({"type", "numbers", "triangles", "pose", "motion"});
constexpr auto line_fields =
    std::to_array<std::string_view>({"touchstone_query", "a", "b", "answer", "engine"});

// Items from..to of a list of numbers.
Json part(const Json& list, std::size_t from, std::size_t to) {
  Json r = Json::array();
  for (std::size_t i = from; i < to; ++i) r.push_back(list[i]);
  return r;
}

// Rows of three.
Json rows(const JsonReader& r) {
  const Json& list = r.json();
  if (!list.is_array() || list.size() % 3 != 0) r.fail("must be a list of numbers, three for each row");
  Json all = Json::array();
  for (std::size_t i = 0; i < list.size(); i += 3) all.push_back(part(list, i, i + 3));
  return all;
}

// The fields of a shape from its numbers: as in the text form, through the text form's own table.
Json plain_shape(const JsonReader& r) {
  const std::string type = r["type"].string();
  const JsonReader numbers = r["numbers"];
  if (type == type_name(ShapeKind::mesh) || type == type_name(ShapeKind::solid_mesh))
    return {{"type", type}, {"vertices", rows(numbers)}, {"triangles", rows(r["triangles"])}};
  if (r.has("triangles")) r["triangles"].fail("belongs to meshes");
  if (type == type_name(ShapeKind::hull)) return {{"type", type}, {"vertices", rows(numbers)}};
  std::string text = type;
  for (const JsonReader& x : numbers.items()) {
    text += ' ';
    text += to_text(x.number());
  }
  return body_from_text(text, r.place())["shape"];
}

Json plain_body(const JsonReader& r) {
  r.require_object(plain_fields);
  Json body{{"shape", plain_shape(r)}};
  if (r.has("pose")) {
    const JsonReader pose = r["pose"];
    (void)pose.items(7);
    body["pose"] = {{"translation", part(pose.json(), 0, 3)}, {"rotation", part(pose.json(), 3, 7)}};
  }
  if (r.has("motion")) {
    const JsonReader motion = r["motion"];
    (void)motion.items(6);
    body["motion"] = {{"linear", part(motion.json(), 0, 3)}, {"angular", part(motion.json(), 3, 6)}};
  }
  return body;
}

Json body_json(const Json& j, const std::string& place, const char* name) {
  if (j.is_string()) return body_from_text(j.get_ref<const std::string&>(), json_place(place, name));
  const JsonReader r(j, place, name);
  if (r.has("numbers")) return plain_body(r);
  if (r.has("type")) return {{"shape", j}};
  r.require_object(body_fields);
  (void)r["shape"];  // fails when it is missing
  return j;
}

}  // namespace

Scene scene_of_bodies(nlohmann::ordered_json a, nlohmann::ordered_json b, const std::string& place) {
  Json scene{{"touchstone_scene", 1}, {"shapes", Json::array()}, {"bodies", Json::array()}};
  for (const auto& [given, name] : {std::pair(&a, "a"), std::pair(&b, "b")}) {
    Json body = body_json(*given, place, name);
    scene["shapes"].push_back(std::move(body["shape"]));
    body["shape"] = scene["shapes"].size() - 1;
    scene["bodies"].push_back(std::move(body));
  }
  return scene_from_json(scene, place);
}

QueryLine query_line_from_json(const nlohmann::ordered_json& j, const std::string& place) {
  const JsonReader r(j, place);
  r.require_object(line_fields);
  if (r.has("touchstone_query") && r["touchstone_query"].integer() != 1)
    r["touchstone_query"].fail("is a version that this build does not know");
  QueryLine line;
  line.scene = scene_of_bodies(r["a"].json(), r["b"].json(), place);
  if (r.has("answer")) line.answer = stated_answer_from_json(r["answer"]);
  if (r.has("engine")) line.engine = r["engine"].string();
  return line;
}

}  // namespace touchstone::fuzz
