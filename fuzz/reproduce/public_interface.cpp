#include "fuzz/reproduce/other_programs.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/input_error.h"
#include "oracles/abi/pipe_scene.h"
#include "oracles/abi/plugin_scene.h"
#include "oracles/reproducer/source_text.h"

namespace touchstone::fuzz {
namespace {

constexpr std::string_view code = R"(const char* const library = @LIBRARY@;
const char* const engine_name = @ENGINE@;

@SCENE@
// What the engine reports beside its answer.
struct Reported {
  Answer answer;
};
Vec vec(const double p[3]) { return {p[0], p[1], p[2]}; }
void report_point(void* ctx, const double p[3], double) { static_cast<Reported*>(ctx)->answer.points.push_back(vec(p)); }
void report_pair(void* ctx, int32_t query, int32_t a, int32_t b) {
  if (query == @STEP@ && ((a == @A@ && b == @B@) || (a == @B@ && b == @A@))) static_cast<Reported*>(ctx)->answer.overlap = true;
}
void report_contact(void* ctx, int32_t a, int32_t b, const double normal[3], double depth) {
  Answer& x = static_cast<Reported*>(ctx)->answer;
  const bool same = a == @A@ && b == @B@, exchanged = a == @B@ && b == @A@;
  if ((!same && !exchanged) || (x.overlap && x.depth >= depth)) return;
  x.overlap = true;
  x.depth = depth;
  x.normal = scaled(same ? 1 : -1, vec(normal));
}

const ts_plugin& load_plugin() {
  void* const file = dlopen(library, RTLD_NOW | RTLD_LOCAL);
  if (!file) throw std::runtime_error(dlerror());
  using Tell = void (*)(uint32_t);
  if (const auto tell = reinterpret_cast<Tell>(dlsym(file, "touchstone_host_v1"))) tell(TS_ABI_MINOR);
  using Entry = const ts_plugin* (*)();
  const auto entry = reinterpret_cast<Entry>(dlsym(file, "touchstone_plugin_v1"));
  if (!entry) throw std::runtime_error("not a plug-in");
  return *entry();
}

uint32_t number_of_engine(const ts_plugin& plugin) {
  const std::string name = std::string(1, '"') + engine_name + '"';
  for (uint32_t i = 0; i < plugin.engine_count; ++i)
    if (std::string(plugin.card(i)).find(name) != std::string::npos) return i;
  throw std::runtime_error("the plug-in has no such engine");
}

Answer ask() {
  const ts_plugin& plugin = load_plugin();
  ts_engine* const engine = plugin.create(number_of_engine(plugin));
  Reported reported;
  ts_received received{};
  received.shape = [](void*, int32_t, const double*, const double*, size_t) {};
  received.body = [](void*, int32_t, const double*, const double*) {};
  received.other_shape = [](void*, int32_t, const ts_shape*) {};
  char detail[256] = {};
  if (plugin.load(engine, &scene, &received, detail) != TS_ANSWERED) throw std::runtime_error(detail);
  ts_answer a{};
  a.outcome = TS_UNSUPPORTED;
  a.distance = a.depth = a.toi = NAN;
  for (int k = 0; k < 3; ++k) a.point_a[k] = a.point_b[k] = a.normal[k] = NAN;
  ts_sink sink{};
  sink.ctx = &reported;
  sink.point = report_point;
  sink.named_point = [](void* ctx, const double* position, double depth, uint64_t) {
    report_point(ctx, position, depth);
  };
  sink.pair = report_pair;
  sink.contact = report_contact;
  plugin.ask(engine, @QUESTION@, @A@, @B@, &a, &sink);
  if (a.outcome != TS_ANSWERED) throw std::runtime_error("outcome " + std::to_string(a.outcome) + " " + a.detail);
  Answer x = reported.answer;
  if (a.has & TS_HAS_OVERLAP) x.overlap = a.overlap != 0;
  if (a.has & TS_HAS_DISTANCE) x.distance = a.distance;
  if (a.has & TS_HAS_DEPTH) x.depth = a.depth;
  if (a.has & TS_HAS_TOI) x.impact = a.toi;
  if (a.has & TS_HAS_NORMAL) x.normal = vec(a.normal);
  if (a.has & TS_HAS_POINTS) x.points = {vec(a.point_a), vec(a.point_b)};
  return x;
}
)";

constexpr std::string_view includes = R"(#include <dlfcn.h>
#include <stdexcept>
#include <string>
#include "oracles/abi/touchstone_engine.h"
)";

std::string string_literal(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out.push_back('\\');
    // Octal, of three digits: what follows cannot become part of it.
    if (static_cast<unsigned char>(c) < ' ')
      out += fmt::format("\\{:03o}", static_cast<unsigned>(c));
    else
      out.push_back(c);
  }
  return out + '"';
}

std::string list(const double* numbers, std::size_t n) {
  std::string out = "{";
  for (std::size_t i = 0; i < n; ++i) out += (i ? ", " : "") + literal(numbers[i]);
  return out + "}";
}
std::string list(const std::int32_t* numbers, std::size_t n) {
  std::string out = "{";
  for (std::size_t i = 0; i < n; ++i) out += (i ? ", " : "") + std::to_string(numbers[i]);
  return out + "}";
}
std::string pose(const ts_pose& p) {
  return fmt::format("{{{}, {}}}", list(p.translation, 3), list(p.rotation, 4));
}

/// An array of the rows, or of one empty row if there is none.
std::string array(std::string_view type, std::string_view name, const std::string& rows) {
  return fmt::format("const {} {}[] = {{{}}};\n", type, name, rows.empty() ? "{}" : "\n" + rows);
}

std::string shape_rows(const ts_scene& s, std::string& arrays) {
  std::string rows;
  for (std::size_t i = 0; i < s.shape_count; ++i) {
    const ts_shape& x = s.shapes[i];
    const std::string vertices = x.vertex_count ? fmt::format("vertices_{}", i) : "nullptr";
    const std::string triangles = x.triangle_count ? fmt::format("triangles_{}", i) : "nullptr";
    if (x.vertex_count)
      arrays += fmt::format("const double {}[] = {};\n", vertices, list(x.vertices, 3 * x.vertex_count));
    if (x.triangle_count)
      arrays += fmt::format("const int32_t {}[] = {};\n", triangles, list(x.triangles, 3 * x.triangle_count));
    rows += fmt::format("    {{{}, {}, {}, {}, {}, {}, {}}},\n", x.kind, x.dimension, list(x.size, 4),
                        vertices, x.vertex_count, triangles, x.triangle_count);
  }
  return rows;
}

std::string scene_source(const ts_scene& s) {
  std::string out, bodies, steps, boxes;
  const std::string shapes = shape_rows(s, out);
  for (std::size_t i = 0; i < s.body_count; ++i) {
    const ts_body& b = s.bodies[i];
    bodies += fmt::format("    {{{}, {}, {}, {}, {}, {}, {}}},\n", b.shape, b.is_static, b.has_motion,
                          b.group, pose(b.pose), list(b.linear, 3), list(b.angular, 3));
  }
  for (std::size_t i = 0; i < s.step_count; ++i) {
    steps += fmt::format("    {{{}, {}, {}}},\n", s.steps[i].op, s.steps[i].body, pose(s.steps[i].pose));
    boxes += fmt::format("    {{{}, {}}},\n", list(s.step_boxes[i].lower, 3), list(s.step_boxes[i].upper, 3));
  }
  out += array("ts_shape", "shapes", shapes) + array("ts_body", "bodies", bodies) +
         array("ts_step", "steps", steps) + array("ts_aabb", "boxes", boxes) +
         fmt::format("const int32_t ignored[] = {};\n",
                     s.ignored_count ? list(s.ignored, 2 * s.ignored_count) : "{0}");
  return out + fmt::format(
                   "const ts_scene scene = {{shapes, {}, bodies, {}, steps, {}, ignored, {}, boxes, {}}};\n",
                   s.shape_count, s.body_count, s.step_count, s.ignored_count, literal(s.margin));
}

}  // namespace

EngineSource plugin_source(const EngineQuestion& q, const PluginFile& plugin) {
  const PluginScene scene(q.scene, /*with_boxes=*/true);
  return {fmt::format("-I {} -ldl", plugin.include), std::string(includes),
          filled(code, {{"LIBRARY", string_literal(plugin.library)},
                        {"ENGINE", string_literal(plugin.engine)},
                        {"SCENE", scene_source(scene.view())},
                        {"STEP", std::to_string(std::max(q.step, 0))},
                        {"QUESTION", std::to_string(static_cast<int>(q.question))},
                        {"A", std::to_string(q.a)},
                        {"B", std::to_string(q.b)}})};
}

std::string pipe_lines(const EngineQuestion& q, const std::string& expected) try {
  const PluginScene scene(q.scene);
  pipe::Json ask = {{"ask", std::string(to_string(q.question))}};
  if (is_pair_question(q.question)) {
    ask["a"] = q.a;
    ask["b"] = q.b;
  }
  ask["expected"] = expected;
  return pipe::Json{{"scene", pipe::scene_of(scene.view())}}.dump() + "\n" + ask.dump() + "\n";
} catch (const pipe::NotFinite&) {
  throw InputError("reproduce", "JSON cannot represent a number of the scene that is not finite");
}

}  // namespace touchstone::fuzz
