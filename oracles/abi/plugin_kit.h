// Shared by the project's own C++ plug-ins: builds the C ABI's table from a class, turns exceptions into
// outcomes, fills in answers. A plug-in contains
//
//   struct Mine {
//     static std::vector<CardText> cards();          // one per engine
//     explicit Mine(unsigned engine);
//     void load(const ts_scene&, const ts_received&);      // may throw Unsupported or anything
//     void unload();
//     void ask(ts_question, int a, int b, ts_answer&, const ts_sink&);
//     // Optional: those after TS_SWEPT_CANDIDATES that `ask` takes.
//     static constexpr ts_question later_questions[] = {TS_WITHIN};
//     // Optional. What it throws makes the host ask about each pair alone.
//     void ask_many(const ts_batch&, ts_answer* answers, const ts_batch_sink&);
//   };
//   TS_PLUGIN(Mine)
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/math/aabb.h"
#include "core/math/pose.h"
#include "oracles/abi/touchstone_engine.h"

namespace touchstone::kit {

/// Thrown when the engine has no such query for these shapes.
struct Unsupported : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// For the default of a switch on the kind of a shape.
[[noreturn]] inline void no_such_shape(const char* library) {
  throw Unsupported(std::string(library) + " has no such shape");
}

/// A padded kind as the kind of its core, and where the radius of the ball around that is in ts_shape::size;
/// any other kind as itself, without a ball. The core's own numbers are the first ones of `size`.
struct Core {
  int kind;
  int ball = -1;
  double radius_of(const ts_shape& s) const { return ball < 0 ? 0 : s.size[ball]; }
};
/// For "more_shapes" of an engine that takes them all.
inline const std::vector<std::string> padded_shapes{"rounded_box", "padded_cylinder", "padded_cone",
                                                    "padded_ellipsoid", "padded_hull"};
inline Core core_of(int kind) {
  switch (kind) {
    case TS_ROUNDED_BOX:
      return {TS_BOX, 3};
    case TS_PADDED_CYLINDER:
      return {TS_CYLINDER, 2};
    case TS_PADDED_CONE:
      return {TS_CONE, 2};
    case TS_PADDED_ELLIPSOID:
      return {TS_ELLIPSOID, 3};
    case TS_PADDED_HULL:
      return {TS_HULL, 0};
    default:
      return {kind};
  }
}

/// The host's TS_ABI_MINOR; 0 when it is too old to report it.
inline std::uint32_t host_minor = 0;

/// The routine for two boxes that began in ODE and was copied into FCL, Bullet and DART keeps a face's normal
/// unless an edge's needs less depth by more than its `fudge_factor` of 1.05: up to this share of the least
/// depth more. FCL's box_box-inl.h: "used to prefer face-feature contact over edge-edge".
inline constexpr double face_preference = 0.05;

struct CardText {
  std::string name, library, version, settings;
  double unit_roundoff, tau_factor;
  std::string source;
  bool complete_manifolds = false;
  std::vector<std::string> more_shapes = {};  // a host of minor 0 or 1 is not told
  // A host of minor 0 to 2 is not told of what follows.
  std::vector<std::string> shapes = {};
  std::vector<std::pair<std::string, double>> unit_roundoffs = {}, depth_biases = {};
  double contact_offset = 0, sweep_skin = 0;
  bool separate_triangles = false;  // a host of minor 0 to 4 is not told
  std::string json() const {
    std::string out;
    const auto field = [&out](const char* key, const std::string& value) {
      out.append(out.empty() ? "{\"" : ",\"").append(key).append("\":\"");
      for (char c : value) {
        if (c == '"' || c == '\\') out.push_back('\\');
        out.push_back(c);
      }
      out.push_back('"');
    };
    field("name", name);
    field("library", library);
    field("version", version);
    field("settings", settings);
    field("source", source);
    char numbers[120];
    std::snprintf(numbers, sizeof numbers, ",\"unit_roundoff\":%.17g,\"tau_factor\":%.17g", unit_roundoff,
                  tau_factor);
    out.append(numbers);
    if (complete_manifolds) out.append(",\"complete_manifolds\":true");
    if (host_minor >= 2) add_names(out, "more_shapes", known_shapes());
    if (host_minor >= 3) {
      add_names(out, "shapes", shapes);
      add_numbers(out, "unit_roundoffs", unit_roundoffs);
      add_numbers(out, "depth_biases", depth_biases);
      if (contact_offset > 0) out.append(",\"contact_offset\":").append(text_of(contact_offset));
      if (sweep_skin > 0) out.append(",\"sweep_skin\":").append(text_of(sweep_skin));
    }
    if (host_minor >= 5 && separate_triangles) out.append(",\"separate_triangles\":true");
    return out.append("}");
  }

 private:
  // A host of minor 2 to 7 knows no padded shapes.
  std::vector<std::string> known_shapes() const {
    std::vector<std::string> known;
    for (const std::string& s : more_shapes)
      if (host_minor >= 8 || !s.starts_with("padded_")) known.push_back(s);
    return known;
  }
  static std::string text_of(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", x);
    return text;
  }
  static void add_names(std::string& out, const char* field, const std::vector<std::string>& names) {
    if (names.empty()) return;
    out.append(",\"").append(field).append("\":[");
    for (const std::string& s : names) out.append(&s == &names.front() ? "\"" : ",\"").append(s).append("\"");
    out.push_back(']');
  }
  static void add_numbers(std::string& out, const char* field,
                          const std::vector<std::pair<std::string, double>>& numbers) {
    if (numbers.empty()) return;
    out.append(",\"").append(field).append("\":{");
    for (const auto& entry : numbers)
      out.append(&entry == &numbers.front() ? "\"" : ",\"")
          .append(entry.first)
          .append("\":")
          .append(text_of(entry.second));
    out.push_back('}');
  }
};

/// τ of every oracle is this many unit roundoffs of its arithmetic times L, plus the tolerance that its
/// documentation claims. About 60 roundings lie between a pose and an answer of these engines; a further
/// factor of 4 keeps ordinary rounding out of the findings, and every known defect is larger by orders of
/// magnitude.
inline constexpr double oracle_tau_factor = 256;

/// Unit normals closer than this count as the same normal.
inline constexpr double same_normal = 1e-6;

/// The text, or, if it is longer than `bytes`, the text with files named without their directories: a message
/// that begins with a long path is not cut before the line that it is about.
inline std::string brief(const std::string& text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  std::string out;
  std::size_t word = 0;  // where the current word begins in `out`
  for (const char c : text) {
    if (c == '/')
      out.resize(word);
    else
      out += c;
    if (c == ' ' || c == '\n' || c == '"' || c == '(') word = out.size();
  }
  return out;
}

inline void set_detail(ts_answer& out, const std::string& text) {
  constexpr std::size_t most = sizeof out.detail - 1;
  const std::string shown = brief(text, most);
  const std::size_t n = std::min(shown.size(), most);
  std::memcpy(out.detail, shown.data(), n);
  out.detail[n] = 0;
}

inline Vec3 vec3(const double* p) { return {p[0], p[1], p[2]}; }
inline void store(const Vec3& v, double* out) { std::copy_n(v.data(), 3, out); }
inline Pose pose_of(const ts_pose& p) {
  return {vec3(p.translation), {p.rotation[0], p.rotation[1], p.rotation[2], p.rotation[3]}};
}
inline Motion motion_of(const ts_body& b) {
  return b.has_motion ? Motion{vec3(b.linear), vec3(b.angular)} : Motion{};
}

inline void set_overlap(ts_answer& out, bool overlap) {
  out.has |= TS_HAS_OVERLAP;
  out.overlap = overlap;
}
inline void set_distance(ts_answer& out, double d) {
  out.has |= TS_HAS_DISTANCE;
  out.distance = d;
}
inline void set_lower_bound(ts_answer& out, double d) {
  out.has |= TS_HAS_LOWER;
  out.lower = d;
}
inline void set_points(ts_answer& out, const Vec3& a, const Vec3& b) {
  out.has |= TS_HAS_POINTS;
  store(a, out.point_a);
  store(b, out.point_b);
}
inline void set_normal(ts_answer& out, const Vec3& n) {
  out.has |= TS_HAS_NORMAL;
  store(n, out.normal);
}
inline void set_depth(ts_answer& out, double d) {
  out.has |= TS_HAS_DEPTH;
  out.depth = d;
}
/// The depth of a manifold point whose own normal is `n`, in an answer that states the normal `stated`: NaN
/// if the two differ, because a depth along another normal says nothing about this answer.
inline double depth_along(const Vec3& stated, const Vec3& n, double depth) {
  return (n - stated).norm() <= same_normal ? depth : std::numeric_limits<double>::quiet_NaN();
}
/// A point of a manifold with the engine's name of the features that meet there.
inline void report_point(const ts_sink& sink, const Vec3& position, double depth, std::uint64_t id) {
  constexpr std::uint32_t minor_with_ids = 7;
  if (host_minor >= minor_with_ids)
    sink.named_point(sink.ctx, position.data(), depth, id);
  else
    sink.point(sink.ctx, position.data(), depth);
}
inline void set_toi(ts_answer& out, double t) {
  out.has |= TS_HAS_TOI;
  out.toi = t;
}

/// Pairs that a user of the engine would filter: both bodies in the same group, or listed as ignored.
class PairFilter {
 public:
  PairFilter() = default;
  explicit PairFilter(const ts_scene& scene) : scene_(&scene) {
    for (std::size_t i = 0; i < scene.ignored_count; ++i)
      ignored_.emplace_back(scene.ignored[2 * i], scene.ignored[2 * i + 1]);
    std::sort(ignored_.begin(), ignored_.end());
  }
  bool drops(int a, int b) const {
    const int ga = scene_->bodies[a].group, gb = scene_->bodies[b].group;
    return (ga >= 0 && ga == gb) || std::binary_search(ignored_.begin(), ignored_.end(),
                                                       std::pair<int, int>(std::min(a, b), std::max(a, b)));
  }
  /// Whether a broad phase reports the pair: neither dropped nor both static.
  bool is_reportable(int a, int b) const {
    return !(scene_->bodies[a].is_static && scene_->bodies[b].is_static) && !drops(a, b);
  }

 private:
  const ts_scene* scene_ = nullptr;
  std::vector<std::pair<int, int>> ignored_;
};

/// The box that contains the body of a step, one of the scene's that inserts or moves it; not a box if the
/// body's own numbers are none. The scene must be one that is asked for candidates (ts_scene::step_boxes).
inline Aabb box_of(const ts_scene& scene, const ts_step& step) {
  const ts_aabb& box = scene.step_boxes[&step - scene.steps];
  return {vec3(box.lower), vec3(box.upper)};
}

/// Runs the scene's script: apply(step) for every change, query(k) for the k-th query.
template <class Apply, class Query>
void run_script(const ts_scene& scene, Apply&& apply, Query&& query) {
  int k = 0;
  for (std::size_t i = 0; i < scene.step_count; ++i)
    if (scene.steps[i].op == TS_QUERY)
      query(k++);
    else
      apply(scene.steps[i]);
}

/// Reports that the engine holds `held` in place of the scene's shape `index`. A host without this callback
/// assumes that the engine holds the shape as sent.
inline void report_other_shape(const ts_received& to, int index, const ts_shape& held) {
  if (host_minor >= 1) to.other_shape(to.ctx, index, &held);
}

template <class Engine>
struct Table {
  static const std::vector<std::string>& cards() {
    static const std::vector<std::string> all = [] {
      std::vector<std::string> texts;
      for (const CardText& c : Engine::cards()) texts.push_back(c.json());
      return texts;
    }();
    return all;
  }
  static const char* card(std::uint32_t i) { return i < cards().size() ? cards()[i].c_str() : nullptr; }
  static ts_engine* create(std::uint32_t i) {
    return i < cards().size() ? reinterpret_cast<ts_engine*>(new Engine(i)) : nullptr;
  }
  static Engine& self(ts_engine* e) { return *reinterpret_cast<Engine*>(e); }
  static void destroy(ts_engine* e) { delete &self(e); }
  static void unload(ts_engine* e) { self(e).unload(); }
  static std::int32_t load(ts_engine* e, const ts_scene* scene, const ts_received* received, char* detail) {
    try {
      self(e).load(*scene, *received);
      return TS_ANSWERED;
    } catch (const Unsupported& why) {
      std::snprintf(detail, 256, "%s", why.what());
      return TS_UNSUPPORTED;
    } catch (const std::exception& why) {
      std::snprintf(detail, 256, "%s", why.what());
      return TS_THREW;
    }
  }
  /// Questions after TS_SWEPT_CANDIDATES are passed on to classes that list them.
  static bool knows(std::int32_t question) {
    if (question <= TS_SWEPT_CANDIDATES) return true;
    if constexpr (requires { Engine::later_questions; })
      return std::find(std::begin(Engine::later_questions), std::end(Engine::later_questions), question) !=
             std::end(Engine::later_questions);
    return false;
  }
  static void ask(ts_engine* e, std::int32_t question, std::int32_t a, std::int32_t b, ts_answer* out,
                  const ts_sink* sink) {
    try {
      if (!knows(question)) throw Unsupported("unknown question");
      out->outcome = TS_ANSWERED;
      self(e).ask(static_cast<ts_question>(question), a, b, *out, *sink);
    } catch (const Unsupported& why) {
      out->outcome = TS_UNSUPPORTED;
      out->has = 0;
      set_detail(*out, why.what());
    } catch (const std::exception& why) {
      out->outcome = TS_THREW;
      out->has = 0;
      set_detail(*out, why.what());
    }
  }
  static void ask_many(ts_engine* e, const ts_batch* batch, ts_answer* answers, const ts_batch_sink* sink) {
    self(e).ask_many(*batch, answers, *sink);
  }
  static constexpr bool takes_batches =
      requires(Engine & e, const ts_batch& batch, ts_answer* answers, const ts_batch_sink& sink) {
    e.ask_many(batch, answers, sink);
  };
  static const ts_plugin* plugin() {
    static const ts_plugin table = [] {
      ts_plugin t{TS_ABI_VERSION, static_cast<std::uint32_t>(cards().size()),
                  card,           create,
                  destroy,        load,
                  unload,         ask,
                  nullptr,        {}};
      if constexpr (takes_batches) t.ask_many = ask_many;
      return t;
    }();
    return &table;
  }
};

}  // namespace touchstone::kit

#define TS_PLUGIN(Engine)                                                                          \
  extern "C" void touchstone_host_v1(std::uint32_t minor) { touchstone::kit::host_minor = minor; } \
  extern "C" const ts_plugin* touchstone_plugin_v1(void) { return touchstone::kit::Table<Engine>::plugin(); }
