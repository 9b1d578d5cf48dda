#include "reports/plan/plan.h"

#include <array>

#include "core/base/input_error.h"
#include "core/broad/catalog.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/codec/scene_codec.h"

namespace touchstone::fuzz {
namespace {

std::string pair_name(std::size_t a, std::size_t b) {
  return std::string(type_name(static_cast<ShapeKind>(a)))
      .append(1, '-')
      .append(type_name(static_cast<ShapeKind>(b)));
}

// The simpler shapes as a scene: body k has shape k and its pose in the body that it replaces.
Json simpler_to_json(const Fidelity& f) {
  Scene s;
  Json of = Json::array(), errors = Json::array();
  for (std::size_t i = 0; i < f.simpler.size(); ++i) {
    if (!f.simpler[i]) continue;
    Body b;
    b.shape = static_cast<int>(s.shapes.size());
    b.pose = f.simpler[i]->in_body;
    s.shapes.push_back(f.simpler[i]->shape);
    s.bodies.push_back(b);
    of.push_back(i);
    errors.push_back(f.simpler[i]->error);
  }
  if (s.shapes.empty()) return nullptr;
  return {{"of_shape", std::move(of)}, {"error", std::move(errors)}, {"scene", touchstone::to_json(s)}};
}

void read_simpler(const JsonReader& j, Fidelity& f) {
  const Scene s = scene_from_json(j["scene"].json(), j["scene"].place());
  std::vector<std::uint64_t> of;
  std::vector<double> errors;
  for (const JsonReader& shape : j["of_shape"].items()) of.push_back(count_of(shape));
  for (const JsonReader& error : j["error"].items()) errors.push_back(error.number());
  if (of.size() != s.bodies.size() || errors.size() != of.size())
    j.fail("of_shape, error and scene.bodies differ in length");
  for (std::size_t k = 0; k < of.size(); ++k) {
    constexpr std::size_t max_shapes = 1U << 18;
    if (of[k] >= max_shapes || !(errors[k] >= 0)) j.fail("a shape or an error is out of range");
    if (f.simpler.size() <= of[k]) f.simpler.resize(of[k] + 1);
    f.simpler[of[k]] = SimplerShape{s.shape_of(static_cast<int>(k)), s.bodies[k].pose, errors[k]};
  }
}

constexpr auto arithmetic_names = std::to_array<std::string_view>({"double", "double alone", "float"});
static_assert(arithmetic_names.size() == static_cast<std::size_t>(Arithmetic::float32) + 1);

Arithmetic arithmetic_of(const JsonReader& j) {
  const std::string name = j.string();
  for (std::size_t i = 0; i < arithmetic_names.size(); ++i)
    if (arithmetic_names[i] == name) return static_cast<Arithmetic>(i);
  j.fail("is not one of: double, double alone, float");
}

PairMethod method_of(const JsonReader& j) {
  return {j["balls_first"].boolean(), arithmetic_of(j["arithmetic"])};
}

Json method_json(const PairMethod& m) {
  return {{"balls_first", m.balls_first}, {"arithmetic", to_string(m.arithmetic)}};
}

}  // namespace

std::string_view to_string(Arithmetic a) { return arithmetic_names[static_cast<std::size_t>(a)]; }

Json to_json(const Fidelity& f) {
  Json methods = Json::object();
  for (std::size_t a = 0; a < f.method.size(); ++a)
    for (std::size_t b = a; b < f.method.size(); ++b)
      if (f.method[a][b] != PairMethod{}) methods[pair_name(a, b)] = method_json(f.method[a][b]);
  return {{"error", f.error},
          {"margin", f.margin},
          {"verdict_only", f.verdict_only},
          {"broad_phase", f.broad_phase},
          {"loose_boxes", f.loose_boxes},
          {"solid_meshes", f.solid_meshes},
          {"remember", f.remember},
          {"sweep_share", f.sweep.share},
          {"methods", std::move(methods)},
          {"simpler", simpler_to_json(f)}};
}

Fidelity fidelity_from_json(const Json& json, const std::string& place) {
  const JsonReader j(json, place);
  Fidelity f;
  f.error = j["error"].number();
  f.broad_phase = j["broad_phase"].string();
  f.remember = j["remember"].boolean();
  f.solid_meshes = j["solid_meshes"].boolean();
  f.loose_boxes = j["loose_boxes"].boolean();
  f.sweep.share = j["sweep_share"].number();
  if (j.has("margin")) f.margin = j["margin"].number();  // plans made before there were margins have none
  if (j.has("verdict_only")) f.verdict_only = j["verdict_only"].boolean();
  if (!(f.margin >= 0)) j["margin"].fail("must not be negative");
  if (!(f.error > 0) || !(f.sweep.share > 0)) j.fail("error and sweep_share must be positive");
  if (!broad::make_broad_phase(f.broad_phase))
    j["broad_phase"].fail("no broad phase is called '" + f.broad_phase + "'");
  const JsonReader methods = j["methods"];
  methods.require_object();
  std::size_t read = 0;
  for (std::size_t a = 0; a < f.method.size(); ++a)
    for (std::size_t b = a; b < f.method.size(); ++b)
      if (const std::string pair = pair_name(a, b); methods.has(pair)) {
        f.method[a][b] = method_of(methods[pair]);
        ++read;
      }
  if (read != methods.json().size()) methods.fail("names a pair of shapes that does not exist");
  if (!j["simpler"].json().is_null()) read_simpler(j["simpler"], f);
  return f;
}

}  // namespace touchstone::fuzz
