#include "scenarios/import/model/import.h"

#include <algorithm>
#include <array>

#include "core/base/input_error.h"
#include "scenarios/import/mesh_import.h"
#include "scenarios/import/model/names.h"
#include "scenarios/import/model/readers.h"
#include "scenarios/import/text_lines.h"
#include "scenarios/text/printable.h"

namespace touchstone {
namespace {

constexpr std::size_t most_moves = 2'000'000;

// By its root element.
Model read_xml(const std::filesystem::path& file, ImportContext& context) {
  return XmlFile(file).root().name() == "robot" ? read_urdf(file, context) : read_mjcf(file, context);
}

struct Format {
  std::string_view ending, words;
  Model (*read)(const std::filesystem::path&, ImportContext&);
};
constexpr auto formats = std::to_array<Format>({
    {".urdf", "urdf", read_urdf},
    {".xacro", "", read_urdf},
    {".xml", "xml (MJCF or URDF)", read_xml},
    {".mjcf", "mjcf", read_mjcf},
    {".sdf", "sdf", read_sdf},
    {".world", "world (SDFormat)", read_sdf},
    {".scene", "scene (MoveIt)", read_planning_scene},
    {".obj", "obj", read_mesh_model},
    {".stl", "stl", read_mesh_model},
    {".ply", "ply", read_mesh_model},
    {".dae", "dae", read_mesh_model},
    {".gltf", "gltf", read_gltf},
    {".glb", "glb", read_gltf},
});

const Format* format_of(const std::filesystem::path& file) {
  const std::string ending = lower_extension(file);
  const auto it =
      std::find_if(formats.begin(), formats.end(), [&](const Format& f) { return f.ending == ending; });
  return it == formats.end() ? nullptr : &*it;
}

void check_size(const Model& m, const std::string& file) {
  std::size_t shapes = 0;
  for (const ModelLink& l : m.links) shapes += l.shapes.size();
  if (m.links.size() > most_links || shapes > most_shapes)
    throw InputError(file, "has " + std::to_string(m.links.size()) + " links with " + std::to_string(shapes) +
                               " shapes; at most " + std::to_string(most_links) + " and " +
                               std::to_string(most_shapes) + " are read");
}

void set_joint(const Model& model, Configuration& to, const std::string& text) {
  const std::size_t equals = text.rfind('=');
  const auto value =
      equals == std::string::npos ? std::nullopt : numbers_in(std::string_view(text).substr(equals + 1));
  const std::string place = "--joint " + printable(text);
  if (!value || value->size() != 1) throw InputError(place, "expected NAME=VALUE with a finite number");
  set_variable(model, to, text.substr(0, equals), (*value)[0], place);
}

std::string without_blanks(std::string_view s) {
  const std::size_t first = s.find_first_not_of(" \t\"");
  if (first == std::string_view::npos) return "";
  return std::string(s.substr(first, s.find_last_not_of(" \t\"") - first + 1));
}

void pad_shapes(Model& m, double padding) {
  for (ModelLink& link : m.links)
    for (ModelShape& s : link.shapes) {
      auto larger = padded(s.shape, padding);
      if (!larger)
        throw InputError("--padding", "the mesh of link " + printable(link.name) +
                                          " cannot be padded; --convex replaces meshes by their hulls");
      s.shape = *std::move(larger);
    }
}

bool is_time(const std::string& column) { return column == "time" || column == "t" || column == "stamp"; }

}  // namespace

bool is_importable(const std::filesystem::path& file) { return format_of(file) != nullptr; }

std::string importable_endings() {
  std::string list;
  for (const Format& f : formats)
    if (!f.words.empty()) list += (list.empty() ? "" : ", ") + std::string(f.words);
  return list;
}

ImportedModel import_model(const std::filesystem::path& file, const ImportOptions& options) {
  const Format* format = format_of(file);
  if (!format)
    throw InputError(file.string(), "is none of the files that can be imported: " + importable_endings());
  ImportContext context(options);
  ImportedModel r;
  r.file = file.string();
  r.model = format->read(file, context);
  if (options.padding != 0) pad_shapes(r.model, options.padding);
  check_size(r.model, file.string());
  const bool is_urdf =
      format->read == read_urdf || (format->read == read_xml && XmlFile(file).root().name() == "robot");
  if (!options.srdf.empty()) {
    if (!is_urdf) throw InputError("--srdf", "belongs to a URDF file, and " + file.string() + " is none");
    add_srdf(r.model, options.srdf, context);
  } else if (is_urdf) {
    r.adjacent_filters = filter_adjacent(r.model);
  }
  Configuration first = standard_configuration(r.model);
  if (!options.state.empty()) set_state(r.model, first, options.state, "--state " + printable(options.state));
  for (const std::string& text : options.joints) set_joint(r.model, first, text);
  if (options.trajectory.empty())
    r.configurations.push_back(std::move(first));
  else
    r.configurations = read_trajectory(r.model, first, options.trajectory, options.trajectory_text);
  r.notes = context.notes();
  return r;
}

Model read_mesh_model(const std::filesystem::path& file, ImportContext& context) {
  Model m;
  m.name = file.stem().string();
  m.links.emplace_back().name = m.name;
  m.links[0].shapes.push_back({"", context.mesh(file, Vec3::Ones(), false, file.string()), {}});
  return m;
}

Scene scene_of(const ImportedModel& imported) {
  try {
    Scene scene = scene_of(imported.model, imported.configurations);
    validate(scene);
    return scene;
  } catch (const InputError& e) {
    throw InputError(imported.file + ": " + e.place(), e.reason());
  }
}

std::vector<Configuration> read_trajectory(const Model& model, const Configuration& standard,
                                           const std::filesystem::path& file, const std::string& text) {
  TextLines in = text.empty() ? TextLines(file, ',') : TextLines(file, text, ',');
  in.need("a header with the names of joints");
  std::vector<std::string> columns;
  Configuration scratch = standard;
  for (std::size_t i = 0; i < in.token_count(); ++i) {
    columns.push_back(without_blanks(in.token(i)));
    if (is_time(columns.back())) continue;
    if (std::count(columns.begin(), columns.end(), columns.back()) > 1)
      in.fail("two columns are called " + printable(columns.back()));
    set_variable(model, scratch, columns.back(), 0, in.place());
  }
  std::vector<Configuration> rows;
  while (in.next()) {
    in.need_tokens(columns.size());
    Configuration row = standard;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const auto v = numbers_in(in.token(i));
      if (!v || v->size() != 1) in.fail(printable(in.token(i)) + " is not a finite number");
      if (!is_time(columns[i])) set_variable(model, row, columns[i], (*v)[0], in.place());
    }
    rows.push_back(std::move(row));
    if (rows.size() * model.links.size() > most_moves)
      in.fail("the trajectory has more than " + std::to_string(most_moves) + " moves of links");
  }
  if (rows.empty()) in.fail("the trajectory has no rows");
  return rows;
}

void add_world(ImportedModel& robot, const ImportedModel& other) {
  Model& m = robot.model;
  const Configuration& at = other.configurations[0];
  const std::vector<Pose> poses = link_poses(other.model, at);
  const int first = static_cast<int>(m.links.size());
  const std::vector<char> anchored = anchored_links(m);
  for (std::size_t i = 0; i < other.model.links.size(); ++i) {
    ModelLink link = other.model.links[i];
    link.parent = -1;
    link.joint = -1;
    link.pose = poses[i];
    link.is_anchored = true;
    m.links.push_back(std::move(link));
  }
  const int n = static_cast<int>(m.links.size());
  for (int b = first; b < n; ++b)
    for (int a = 0; a < b; ++a)
      if (a >= first || anchored[static_cast<std::size_t>(a)]) add_filter(m, a, b);
  sort_filters(m);
  check_size(m, m.name);
}

}  // namespace touchstone
