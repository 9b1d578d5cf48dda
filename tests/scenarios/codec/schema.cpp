// The published schema and the codec describe the same language.
#include <algorithm>
#include <set>

#include "scenarios/codec/json_file.h"
#include "scenarios/codec/scene_codec.h"
#include "scenarios/codec/scene_fields.h"
#include "tests/scenarios/codec/mini_schema.h"
#include "tests/scenarios/import/expect_error.h"
#include "tests/scenarios/import/sample_scenes.h"

using namespace touchstone;
using test::Json;

namespace {

const Json& schema() {
  static const Json s =
      parse_json(read_file(TS_SOURCE_DIR "/scenarios/codec/scene.schema.json"), "scene.schema.json");
  return s;
}

std::string violation(const Json& value) { return test::schema_violation(schema(), schema(), value); }

bool codec_accepts(const Json& value) {
  return test::refusal([&] { scene_from_json(value); }) == "(accepted)";
}

std::set<std::string> fields_in_schema(const Json& object) {
  std::set<std::string> names;
  for (const auto& [key, value] : object["properties"].items()) names.insert(key);
  return names;
}

std::set<std::string> as_set(std::span<const std::string_view> names) { return {names.begin(), names.end()}; }

template <std::size_t I = 0, class F>
void for_each_shape_type(F&& f) {
  if constexpr (I < std::variant_size_v<Shape>) {
    f(std::variant_alternative_t<I, Shape>{});
    for_each_shape_type<I + 1>(f);
  }
}

// Visits every object inside `j`, with a copy of the whole that the caller may change through it.
void for_each_object_path(const Json& j, const Json::json_pointer& at, std::vector<Json::json_pointer>& out) {
  if (j.is_object()) {
    out.push_back(at);
    for (const auto& [key, value] : j.items()) for_each_object_path(value, at / key, out);
  } else if (j.is_array()) {
    for (std::size_t i = 0; i < j.size(); ++i) for_each_object_path(j[i], at / i, out);
  }
}

Scene full_scene() {
  Rng rng(11);
  Scene s = test::nasty_scene(rng);
  s.name = "full";
  s.bodies.resize(3);
  for (Body& b : s.bodies) {
    b.name = "b";
    b.shape = 0;
    b.group = 2;
    b.is_static = true;
    b.pose = {Vec3(1, 2, 3), {0, 0, 1, 1}};
    b.motion = Motion{Vec3(1, 0, 0), Vec3(0, 1, 0)};
  }
  s.ignored = {{0, 1}};
  s.script = {{Step::Op::insert, 0, s.bodies[0].pose},
              {Step::Op::move, 0, s.bodies[0].pose},
              {Step::Op::remove, 0, std::nullopt},
              {}};
  return s;
}

}  // namespace

TEST_CASE("the schema lists exactly the fields that the codec knows", "[scene][schema]") {
  const Json& defs = schema()["$defs"];
  CHECK(fields_in_schema(schema()) == as_set(scene_fields::scene));
  CHECK(fields_in_schema(defs["body"]) == as_set(scene_fields::body));
  CHECK(fields_in_schema(defs["pose"]) == as_set(scene_fields::pose));
  CHECK(fields_in_schema(defs["motion"]) == as_set(scene_fields::motion));
  for (std::size_t i = 0; i < scene_fields::op_names.size(); ++i)
    CHECK(fields_in_schema(defs[scene_fields::op_names[i]]) == as_set(scene_fields::of_op[i]));
  std::set<std::string> refs;
  for (const Json& ref : defs["shape"]["oneOf"]) refs.insert(ref["$ref"].get<std::string>());
  // Another way to write a mesh or a solid mesh.
  CHECK(refs.erase("#/$defs/declared_mesh") == 1);
  CHECK(refs.erase("#/$defs/height_field") == 1);
  CHECK(refs.size() == std::variant_size_v<Shape>);
  int shapes = 0;
  for_each_shape_type([&](auto shape) {
    using S = decltype(shape);
    std::set<std::string> names{"type"};
    for_each_field(shape, [&](auto name, auto&, Domain) { names.insert(std::string(name)); });
    INFO(S::type);
    CHECK(refs.count("#/$defs/" + std::string(S::type)) == 1);
    auto allowed = names;
    if (!has_triangles<S>) allowed.insert("padding");
    CHECK(fields_in_schema(defs[S::type]) == allowed);
    CHECK(defs[S::type]["properties"]["type"]["const"] == S::type);
    CHECK(as_set(std::vector<std::string_view>(names.begin(), names.end())) ==
          defs[S::type]["required"].template get<std::set<std::string>>());
    ++shapes;
  });
  CHECK(shapes == shape_kind_count);
}

TEST_CASE("what the codec writes conforms to the schema", "[scene][schema]") {
  Rng rng(12);
  int scenes = 0;
  for (; scenes < 200; ++scenes) {
    const Scene s = test::nasty_scene(rng);
    REQUIRE(violation(to_json(s)) == "");
    REQUIRE(violation(parse_json(to_text(s))) == "");
  }
  CHECK(scenes == 200);
  CHECK(violation(to_json(full_scene())) == "");
}

TEST_CASE("codec and schema agree on every unknown, missing and mistyped field", "[scene][schema]") {
  const Json good = to_json(full_scene());
  REQUIRE(violation(good) == "");
  REQUIRE(codec_accepts(good));
  std::vector<Json::json_pointer> objects;
  for_each_object_path(good, Json::json_pointer(), objects);
  int unknown = 0, missing = 0, mistyped = 0, disagreements = 0;
  const auto compare = [&](const Json& changed, bool must_fail, const std::string& what) {
    const bool schema_ok = violation(changed).empty(), codec_ok = codec_accepts(changed);
    INFO(what << ": schema " << schema_ok << ", codec " << codec_ok);
    CHECK(schema_ok == codec_ok);
    disagreements += schema_ok != codec_ok;
    if (must_fail) CHECK(!codec_ok);
  };
  for (const auto& at : objects) {
    Json changed = good;
    changed[at]["no_such_field"] = 1;
    compare(changed, true, "unknown field in " + at.to_string());
    ++unknown;
    for (const auto& [key, value] : good[at].items()) {
      Json without = good;
      without[at].erase(key);
      if (at.empty() && key == "script") continue;  // optional: nothing to refuse
      compare(without, false, "without " + at.to_string() + "/" + key);
      ++missing;
      Json wrong = good;
      wrong[at][key] = value.is_object() ? Json("text") : Json::object();
      compare(wrong, true, "mistyped " + at.to_string() + "/" + key);
      ++mistyped;
    }
  }
  INFO(unknown << " unknown, " << missing << " missing, " << mistyped << " mistyped");
  CHECK(unknown > 15);
  CHECK(missing > 40);
  CHECK(mistyped > 40);
  CHECK(disagreements == 0);
}
