#include "cli/import_options.h"

#include <fmt/format.h>

#include "cli/mcap_trajectory.h"
#include "core/base/input_error.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {

void add_import_options(CLI::App& app, ImportOptions& to) {
  constexpr const char* group = "Robots and worlds";
  app.add_option("--srdf", to.srdf, "SRDF of a URDF file: disabled collisions, named states")->group(group);
  app.add_option("--joint", to.joints, "value of a joint, NAME=VALUE (radians, metres); may be repeated")
      ->allow_extra_args(false)
      ->group(group);
  app.add_option("--state", to.state, "named state: GROUP/STATE of an SRDF, keyframe of an MJCF file")
      ->group(group);
  app.add_option("--trajectory", to.trajectory,
                 "CSV file whose header names joints, or MCAP recording with joint states; each row is a "
                 "step of the scene's script")
      ->group(group);
  app.add_option("--package-path", to.package_paths,
                 "folder with the packages of package:// and model:// paths")
      ->allow_extra_args(false)
      ->group(group);
  app.add_flag("--lenient", to.lenient, "leave out, with a warning, what a scene cannot represent")
      ->group(group);
  app.add_flag("--convex", to.convex_meshes, "replace meshes by their convex hulls")->group(group);
  app.add_option("--padding", to.padding, "add all points within this distance (metres) to every shape")
      ->check(CLI::NonNegativeNumber)
      ->group(group);
}

void require_importable(const std::string& text, const ImportOptions& o) {
  const bool given = !o.srdf.empty() || !o.joints.empty() || !o.state.empty() || !o.trajectory.empty() ||
                     !o.package_paths.empty() || o.lenient || o.convex_meshes || o.padding != 0;
  if (given && !is_importable(text))
    throw InputError(text, "is not a robot, world or mesh file (" + importable_endings() +
                               "), to which the options --srdf, --joint, --state, --trajectory, "
                               "--package-path, --lenient, --convex and --padding belong");
}

void print_import_notes(const std::string& file, const ImportedModel& imported) {
  if (imported.notes.empty()) return;
  fmt::print(stderr, "touchstone: {}: warning: {} left out\n", printable(file),
             imported.notes.size() == 1 ? "1 element" : fmt::format("{} elements", imported.notes.size()));
  for (const ImportNote& n : imported.notes)
    fmt::print(stderr, "  {}: {}\n", printable(n.place), printable(n.reason));
}

StoredCase imported_case(const std::string& file, const ImportOptions& options) {
  const ImportedModel imported = import_model(file, with_trajectory_text(options));
  print_import_notes(file, imported);
  StoredCase s;
  s.c.scene = scene_of(imported);
  s.c.id = s.c.scene.name;
  s.c.queries = default_queries(s.c.scene);
  s.source = "import of " + std::filesystem::path(file).filename().string();
  return s;
}

}  // namespace touchstone::cli
