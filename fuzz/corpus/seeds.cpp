#include "fuzz/corpus/corpus_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>

#include "core/base/input_error.h"
#include "fuzz/answer/query_line.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/exhaustive/evidence.h"
#include "scenarios/handmade/ladders/ladder.h"
#include "scenarios/handmade/ladders/mechanism.h"
#include "scenarios/handmade/scenario.h"
#include "scenarios/random/family.h"

namespace touchstone::fuzz::corpus {
namespace {

bool is_convex_pair(const Scene& s) {
  return s.bodies.size() == 2 && s.script.empty() && is_convex(kind_of(s.shape_of(0))) &&
         is_convex(kind_of(s.shape_of(1)));
}

// Nothing but the two bodies: no names, no groups.
Scene bare(const Scene& s) {
  Scene r;
  for (int i : {0, 1}) {
    const Body& from = s.bodies[static_cast<std::size_t>(i)];
    Body b;
    b.shape = i;
    b.pose = from.pose;
    b.motion = from.motion;
    r.shapes.push_back(s.shape_of(i));
    r.bodies.push_back(std::move(b));
  }
  return r;
}

// --- ladders

Part from_ladders() {
  Part part{"ladders", {}};
  for (const scenarios::Ladder& l : scenarios::ladders())
    for (const double v : l.values)
      part.seeds.push_back({fmt::format("ladders/{}/{}", l.name, v), fmt::format("{}; v = {}", l.line, v),
                            std::string(l.mechanism), "ladder", bare(l.make(v))});
  return part;
}

// --- handmade scenarios

struct MechanismOf {
  std::string_view begins, mechanism;  // of a scenario's name, or of its folder when no name fits
};
constexpr auto mechanism_of_scenarios = std::to_array<MechanismOf>({
    {"cubes_a_hair", "kissing-faces"},
    {"cubes_corner", "kissing-tip"},
    {"cubes_edge", "kissing-edges"},
    {"cubes_half", "kissing-faces"},
    {"cubes_touch", "far-from-origin"},
    {"ridges_cross", "kissing-edges"},
    {"ridges_nearly", "tiny-angle"},
    {"octahedron", "kissing-tip"},
    {"tetrahedra", "kissing-faces"},
    {"spheres_", "round-on-round"},
    {"sphere_on_rounded", "rounded-edge"},
    {"sphere_on", "round-on-flat"},
    {"sphere_centre", "centre-on-surface"},
    {"sphere_just", "centre-on-surface"},
    {"sphere_inside", "centre-inside"},
    {"capsules_side", "round-on-round"},
    {"capsules_crossed_through", "coincident-centres"},
    {"capsules_crossed", "round-on-round"},
    {"capsules_nearly", "tiny-angle"},
    {"capsule_end", "round-on-flat"},
    {"cylinder_on", "round-on-flat"},
    {"cylinder_lies", "round-on-flat"},
    {"cylinders_end", "coaxial-rims"},
    {"cylinders_rim", "coaxial-rims"},
    {"cone_tip", "sharp-tip"},
    {"ellipsoids_tip", "sharp-tip"},
    {"rounded_box", "rounded-edge"},
    {"concentric", "coincident-centres"},
    {"nearly_concentric", "coincident-centres"},
    {"coaxial", "coaxial-rims"},
    {"cube_in_cube", "tied-directions"},
    {"same_", "coincident-centres"},
    {"beams_", "off-centre"},
    {"post_", "off-centre"},
    {"nested", "coplanar-faces"},
    {"edges_beat", "edge-against-face"},
    {"stacked_cubes_tilt", "tiny-angle"},
    {"stacked", "aligned-simplex"},
    {"plates_tilted", "tiny-angle"},
    {"cubes_deep", "tied-directions"},
    {"needle", "slender"},
    {"rods", "slender"},
    {"long_rod", "slender"},
    {"millimetre", "absolute-tolerance"},
    {"micrometre", "absolute-tolerance"},
    {"nanometre", "absolute-tolerance"},
    {"cubes_of", "absolute-tolerance"},
    {"pebble", "size-ratio"},
    {"cube_on_huge", "size-ratio"},
    {"small_", "size-ratio"},
    {"segment", "flat-shape"},
    {"vertex_hull", "flat-shape"},
    {"point_", "zero-size"},
});
constexpr auto mechanism_of_folders = std::to_array<MechanismOf>({
    {"deep", "containment"},
    {"degenerate", "duplicate-vertices"},
    {"far", "far-from-origin"},
    {"motion", "vertex-path"},
    {"thin", "thin-plate"},
    {"touching", "kissing-faces"},
});

// Empty: no mechanism is known.
std::string_view mechanism_of(const scenarios::Scenario& s) {
  if (s.folder != "motion")
    for (const MechanismOf& m : mechanism_of_scenarios)
      if (s.name.starts_with(m.begins)) return m.mechanism;
  for (const MechanismOf& m : mechanism_of_folders)
    if (s.folder == m.begins) return m.mechanism;
  return "";
}

Part from_scenarios() {
  Part part{"handmade", {}};
  for (const scenarios::Scenario& s : scenarios::catalog()) {
    const Scene scene = s.make().scene;
    const std::string_view mechanism = mechanism_of(s);
    if (is_convex_pair(scene) && !mechanism.empty())
      part.seeds.push_back({"handmade/" + s.name, s.line, std::string(mechanism), "scenario", bare(scene)});
  }
  return part;
}

// --- the lattice

// Pairs of boxes by the orders of their ends, evenly sampled, and random shapes on a lattice of 1/8.
Part from_lattice() {
  constexpr std::uint64_t boxes = 48, shapes = 160;
  Part part{"lattice", {}};
  for (const EvidenceRow& e : all_evidence()) {
    if (e.name != "orders_of_two") continue;
    for (std::uint64_t i = 0; i < boxes; ++i) {
      const Scene s = evidence_case(e, {}, i, boxes).scene;
      part.seeds.push_back({fmt::format("lattice/orders/{}", i), "boxes whose ends are ordered in one way",
                            "lattice", "lattice", bare(s)});
    }
  }
  constexpr std::uint64_t seed = 1;
  for (std::uint64_t i = 0; i < shapes; ++i) {
    const Scene s = make_case(seed, i, "lattice").scene;
    if (is_convex_pair(s))
      part.seeds.push_back(
          {fmt::format("lattice/shapes/{}", i), "shapes on a lattice of 1/8", "lattice", "lattice", bare(s)});
  }
  return part;
}

// --- files of seeds

constexpr auto seed_fields =
    std::to_array<std::string_view>({"id", "comment", "mechanism", "source", "a", "b"});

Part from_file(const std::filesystem::path& file) {
  Part part{file.stem().string(), {}};
  const auto j = load_json(file);
  const JsonReader r(j, file.string());
  for (const JsonReader& s : r["seeds"].items()) {
    s.require_object(seed_fields);
    const Scene scene = scene_of_bodies(s["a"].json(), s["b"].json(), s.place());
    if (!is_convex_pair(scene)) s.fail("the corpus has bounded convex shapes only");
    part.seeds.push_back({part.name + "/" + s["id"].string(), s["comment"].string(), s["mechanism"].string(),
                          s["source"].string(), bare(scene)});
  }
  return part;
}

void require_sound(const std::vector<Part>& parts) {
  std::set<std::string> ids;
  for (const Part& p : parts)
    for (const Seed& s : p.seeds) {
      if (!scenarios::mechanism_named(s.mechanism))
        throw InputError(s.id, fmt::format("{} is not the name of a mechanism", s.mechanism));
      if (!ids.insert(s.id).second) throw InputError(s.id, "is the id of two cases");
      validate(s.scene);
    }
}

}  // namespace

std::vector<Part> all_parts(const std::filesystem::path& directory) {
  std::vector<Part> parts{from_ladders(), from_scenarios(), from_lattice()};
  if (!std::filesystem::is_directory(directory)) throw InputError(directory.string(), "is not a directory");
  for (const auto& entry : std::filesystem::directory_iterator(directory))
    if (entry.path().extension() == ".json") parts.push_back(from_file(entry.path()));
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.name < b.name; });
  require_sound(parts);
  return parts;
}

std::vector<Question> questions_about(const Scene& s) {
  if (s.bodies[0].motion || s.bodies[1].motion) return {Question::time_of_impact};
  return {Question::overlap, Question::distance, Question::contact};
}

Case as_case(const std::string& id, Scene scene) {
  Case c;
  c.id = id;
  c.family = "corpus";
  for (const Question q : questions_about(scene)) c.queries.push_back({q, 0, 1});
  c.scene = std::move(scene);
  return c;
}

}  // namespace touchstone::fuzz::corpus
