#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/case_argument.h"
#include "cli/command.h"
#include "cli/engine_catalog.h"
#include "cli/import_options.h"
#include "cli/output.h"
#include "cli/page_contents.h"
#include "core/base/input_error.h"
#include "reports/text/web_page.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/import/real_scene.h"
#include "scenarios/text/printable.h"
#include "scenarios/value/moving_pairs.h"

namespace touchstone::cli {
namespace {

struct ViewOptions {
  std::string scene, out;
  std::vector<std::string> methods{"automatic", "sort_and_sweep", "hierarchical_grid",
                                   "bounding_volume_hierarchy"};
  int frames = 100;
  std::string engines = "all";
  bool broad = false, json = false;
  WorkerLimits limits;
  ImportOptions import;
};

// A file, the name of a scenario, or the directory of a recorded scene, as for replay.
Scene scene_named(const ViewOptions& o) {
  if (is_recording(o.scene)) {
    const RealScene real = load_real_scene(o.scene);
    Scene scene = real.script(0, std::min(o.frames, real.frame_count()) - 1);
    scene.name = real.name;
    return scene;
  }
  Case c = case_argument(o.scene, o.import).c;
  if (c.scene.name.empty()) c.scene.name = std::filesystem::path(o.scene).stem().string();
  return c.scene;
}

int view_case(const ViewOptions& o) {
  const StoredCase stored = case_argument(o.scene, o.import);
  if (const std::string words = words_on_impacts_not_asked(stored.c); !words.empty())
    fmt::print(stderr, "{}\n", words);
  const fuzz::Json page = case_page(o.scene, stored, o.engines, o.limits);
  if (o.json) fmt::print("{}\n", page.dump(1));
  if (o.out.empty()) return exit_clean;
  if (!write_page("case", page.dump(), o.out)) return exit_failed;
  if (!o.json) fmt::print("{}: open it in a browser\n", o.out);
  return exit_clean;
}

// False if the page is not built. Its data is then written in full: what a page gets is rounded.
bool write_broad_page(const fuzz::BroadView& view, const std::string& out) {
  const auto whole = std::filesystem::path(out).replace_extension(".json");
  if (!std::filesystem::exists(built_page("broad"))) write_file(whole, fuzz::to_json(view).dump());
  return write_page("broad", reports::packed_broad_view(view).dump(), out, whole);
}

int view_broad(const ViewOptions& o) {
  const fuzz::BroadView view =
      fuzz::broad_view(scene_named(o), o.methods, static_cast<std::size_t>(o.frames));
  if (view.frames.empty())
    throw InputError(o.scene, "has no query in its script, so there is nothing to show");
  const auto& last = view.frames.back();
  if (o.json)
    fmt::print("{}\n", fuzz::to_json(view).dump(1));
  else
    fmt::print("{}: {} bodies, {} queries; the last one kept {} of {} pairs\n", printable(view.name),
               view.bodies.size(), view.frames.size(), last.kept.size(), last.all_pairs);
  if (o.out.empty()) return exit_clean;
  if (!write_broad_page(view, o.out)) return exit_failed;
  if (!o.json) fmt::print("{}: open it in a browser\n", o.out);
  return exit_clean;
}

int run(const ViewOptions& o) {
  if (o.out.empty() && !o.json) throw InputError("view", "needs a file for the page: -o FILE");
  prepare_output(o.out);
  return o.broad ? view_broad(o) : view_case(o);
}

}  // namespace

Run declare_view(CLI::App& app) {
  auto o = std::make_shared<ViewOptions>();
  app.add_option(
         "scene", o->scene,
         "case or scene file, robot or world file, name of a scenario, or directory of a recorded scene "
         "(scene.txt, frames.npy)")
      ->required();
  app.add_option("--engines", o->engines, "engines to query: names, plug-in paths, all")
      ->capture_default_str();
  add_case_seconds(app, o->limits);
  add_import_options(app, o->import);
  app.add_flag(
      "--broad", o->broad,
      "show the broad phase instead of the answers: boxes, intervals, cells or trees, candidate pairs "
      "kept and pruned");
  app.add_option("-o,--out", o->out, "file for the page (self-contained HTML)");
  app.add_option("--method", o->methods, "broad phases to show, separated by commas")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  app.add_option("--frames", o->frames, "number of queries to show, from the first")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_flag("--json", o->json, "the page's data as one JSON document on stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
