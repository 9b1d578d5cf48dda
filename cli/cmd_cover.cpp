#include <fmt/format.h>
#include <algorithm>

#include "cli/command.h"
#include "cli/output.h"
#include "cli/progress_line.h"
#include "core/base/input_error.h"
#include "fuzz/cover/cover.h"
#include "reports/text/text.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/import/mesh_import.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {
namespace {

using fuzz::Cover;

struct CoverArguments {
  std::string mesh, pieces, out;
  bool json = false;
};

std::string point(const Vec3& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(), p.z()); }

std::string range(const referee::Bracket& b) {
  return b.lo == b.hi ? fmt::format("{:.6g}", b.lo) : fmt::format("{:.6g} to {:.6g}", b.lo, b.hi);
}

std::string verdict_words(const Cover& c) {
  if (c.interrupted) return "not decided: interrupted";
  if (c.covers())
    return fmt::format("yes: every point of {} is in a piece (exact arithmetic)",
                       reports::counted(c.triangles, "triangle", "triangles"));
  return fmt::format("no: {} of {} have points in no piece (exact arithmetic)",
                     reports::grouped(c.uncovered.size()),
                     reports::counted(c.triangles, "triangle", "triangles"));
}

std::string volume_words(const Cover& c) {
  std::string words = range(c.union_volume) + " in the pieces";
  if (!c.mesh_volume) return words;
  const double mesh = *c.mesh_volume;
  return words + fmt::format(", {:.6g} in the mesh: {:.4g} % to {:.4g} % more", mesh,
                             100 * (c.union_volume.lo - mesh) / mesh,
                             100 * (c.union_volume.hi - mesh) / mesh);
}

std::string text_of(const CoverArguments& o, const Cover& c) {
  const auto line = [](const std::string& label, const std::string& words) {
    constexpr std::size_t label_width = 14;
    return reports::labelled(label, label_width, words);
  };
  std::string s = reports::wrapped(fmt::format("{} by {} of {}", printable(o.mesh),
                                               reports::counted(c.pieces, "convex piece", "convex pieces"),
                                               printable(o.pieces)),
                                   79, 2) +
                  "\n";
  s += line("covered", verdict_words(c));
  if (c.witness)
    s += line("witness", fmt::format("{} of triangle {} is in no piece (rounded; --json has it exactly)",
                                     point(c.witness->rounded), c.witness->triangle));
  if (!c.uncovered.empty())
    s += line("sticks out",
              fmt::format("by {} at most, at {}", range(c.sticks_out.bracket), point(c.sticks_out.at)));
  if (c.reaches_beyond)
    s += line("pieces reach", fmt::format("{} beyond the mesh at most, at {}",
                                          range(c.reaches_beyond->bracket), point(c.reaches_beyond->at)));
  else
    s += line("pieces reach", "not measured: the mesh is not closed, and so has no inside");
  return s + line("volume", volume_words(c)) + "  lengths in the unit of the files\n";
}

int verdict_on(const CoverArguments& o, const Cover& c) {
  std::string why = c.interrupted ? "interrupted"
                    : c.covers()  ? "it covers the mesh"
                                  : "the mesh sticks out of it";
  const int code = c.interrupted ? exit_failed : c.covers() ? exit_clean : exit_wrong;
  fmt::print(o.json ? stderr : stdout, "exit code {} is about {}: {}\n", code, printable(o.pieces), why);
  return code;
}

int run(const CoverArguments& o) {
  prepare_output(o.out);
  catch_stop_signals();
  MeshImport as_written;
  as_written.keep_up_axis = true;
  const TriangleMesh mesh = load_mesh(o.mesh, as_written);
  std::vector<std::vector<Vec3>> points;
  std::vector<std::string> names;
  for (MeshPart& part : load_mesh_parts(o.pieces, as_written)) {
    names.push_back(o.pieces + ": piece " + std::to_string(names.size()) +
                    (part.name.empty() ? "" : " (" + printable(part.name) + ")"));
    points.push_back(std::move(part.mesh.vertices));
  }
  ProgressLine progress;
  const Cover c = fuzz::cover(
      mesh, points, names,
      [&](std::string_view what, std::size_t done, std::size_t of) { progress.show(what, done, of); },
      interrupted);
  progress.clear();
  const std::string json = fuzz::to_json(c).dump(1) + "\n";
  if (!o.out.empty()) write_file(o.out, json);
  fmt::print("{}", o.json ? json : text_of(o, c));
  return verdict_on(o, c);
}

}  // namespace

Run declare_cover(CLI::App& app) {
  auto o = std::make_shared<CoverArguments>();
  app.add_option("mesh", o->mesh, "mesh: obj, stl, ply, dae")->required();
  app.add_option("pieces", o->pieces,
                 "mesh file whose objects are the pieces; each stands for its convex hull")
      ->required();
  app.add_option("-o,--out", o->out, "file for the result (JSON)");
  app.add_flag("--json", o->json, "the result as JSON on stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
