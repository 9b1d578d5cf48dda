#include "core/base/input_error.h"
#include "oracles/abi/engine.h"
#include "scenarios/codec/value_codec.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

std::string error_of(const std::string& text) {
  try {
    card_from_json(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

EngineCard example() {
  return {"a \"b\"", "lib\\1", "1.2", "line\nbreak", 0x1p-24, 256, "page 7", false, {}};
}

}  // namespace

TEST_CASE("a card survives its JSON text exactly", "[oracles][card]") {
  EngineCard card = example();
  CHECK(card_from_json(to_json_text(card)) == card);
  card.complete_manifolds = true;
  CHECK(card_from_json(to_json_text(card)) == card);
  card.more_shapes = {ShapeKind::rounded_box};
  CHECK(card_from_json(to_json_text(card)) == card);
  card.more_shapes.clear();
  card.shapes = {ShapeKind::sphere, ShapeKind::mesh};
  card.unit_roundoffs = {{ShapeKind::hull, 0x1p-20}, {ShapeKind::mesh, 0x1p-22}};
  card.contact_offset = 0.02;
  card.sweep_skin = 1e-3;
  card.depth_biases = {{ShapeKind::box, ShapeKind::box, 0.05}, {ShapeKind::box, ShapeKind::hull, 0.25}};
  card.separate_triangles = true;
  card.times_include_pipe = true;
  CHECK(card_from_json(to_json_text(card)) == card);
}

TEST_CASE("a bad card names the field and the reason", "[oracles][card][bad-input]") {
  CHECK(error_of("{").find("not JSON") != std::string::npos);
  CHECK(error_of("[]").find("not a JSON object") != std::string::npos);
  const std::string good = to_json_text(example());
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string s = good;
    s.replace(s.find(from), from.size(), to);
    return error_of(s);
  };
  CHECK(with("\"version\"", "\"versoin\"") == "versoin: is not a field of an engine card");
  CHECK(with("\"version\":\"1.2\",", "") == "version: is missing from the engine card");
  CHECK(with("\"1.2\"", "12") == "version: is not a string");
  CHECK(with("256.0", "\"many\"") == "tau_factor: is not a number");
  CHECK(with("256.0", "-1") == "tau_factor: is not a positive finite number");
  CHECK(with("256.0", "1e300").find("tau_factor: is 1e+300; at most") == 0);
  CHECK(with("256.0", "1e6").find("tau_factor: is 1e+06; at most 16384") == 0);
  CHECK(with("5.960464477539063e-08", "0.5").find("unit_roundoff: is 0.5; at most") == 0);
  CHECK(
      with("5.960464477539063e-08", "0.001").find("tau_factor: times unit_roundoff is 0.256; at most 0.01") ==
      0);
  CHECK(with("\"source\"", "\"complete_manifolds\":1,\"source\"") ==
        "complete_manifolds: is neither true nor false");
  CHECK(with("\"source\"", "\"more_shapes\":\"rounded_box\",\"source\"") == "more_shapes: is not a list");
  for (const char* list : {"[\"sphere\"]", "[\"blob\"]", "[9]", "[[]]"})
    CHECK(with("\"source\"", "\"more_shapes\":" + std::string(list) + ",\"source\"") ==
          "more_shapes: lists something other than a kind of shape after the mesh");
  CHECK(with("256.0", "1e999").find("not JSON") != std::string::npos);
  const auto adding = [&](const std::string& field) { return with("\"source\"", field + ",\"source\""); };
  for (const char* list : {"{}", "[]", "\"sphere\""})
    CHECK(adding("\"shapes\":" + std::string(list)) == "shapes: is not a list of kinds of shapes");
  CHECK(adding(R"("shapes":["blob"])") == "shapes: names something other than a kind of shape: blob");
  CHECK(adding(R"("shapes":[1])") == "shapes: lists something other than a string");
  CHECK(adding(R"("shapes":["box","box"])") == "shapes: lists a kind twice: box");
  CHECK(adding(R"("shapes":["box"],"more_shapes":["rounded_box"])") == "shapes: excludes more_shapes");
  CHECK(adding(R"("unit_roundoffs":{"mesh":0.1})").starts_with("unit_roundoffs.mesh: is 0.1; at most"));
  CHECK(adding(R"("unit_roundoffs":{"mesh":1e-16})") == "unit_roundoffs.mesh: is less than unit_roundoff");
  CHECK(
      adding(R"("unit_roundoffs":{"mesh":1e-3})").starts_with("unit_roundoffs.mesh: times unit_roundoff is"));
  CHECK(adding(R"("unit_roundoffs":[1])") == "unit_roundoffs: is not an object");
  CHECK(adding(R"("contact_offset":-1)") == "contact_offset: is not a positive finite number");
  CHECK(adding(R"("sweep_skin":"1")") == "sweep_skin: is not a number");
  CHECK(
      adding(R"("depth_biases":{"box":0.1})").starts_with("depth_biases: has a name that is not two kinds"));
  CHECK(adding(R"("depth_biases":{"box hull":0.1,"hull box":0.1})") ==
        "depth_biases: lists a pair twice: hull box");
  CHECK(adding(R"("depth_biases":{"box box":0.5})") == "depth_biases: is 0.5; at most 0.25 is accepted");
  CHECK(adding(R"("times_include_pipe":1)") == "times_include_pipe: is neither true nor false");
  // A name is part of keys, file names and terminal output.
  for (const char* name : {"../victim", "/etc/x", "..", "", " x", "a\\nb", "\\u001b[2J", "caf\u00e9"})
    CHECK(with("a \\\"b\\\"", name).starts_with("name: "));
  CHECK(with("a \\\"b\\\"", std::string(65, 'x')).starts_with("name: must begin"));
  CHECK(with("a \\\"b\\\"", std::string(64, 'x')).empty());
  CHECK(with("page 7", std::string(1001, 'x')) == "source: is longer than 1000 bytes");
}
