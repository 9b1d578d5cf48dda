#include "oracles/abi/plugin_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "scenarios/value/engine_card.h"

namespace touchstone {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

void copy3(const Vec3& v, double* out) { std::copy_n(v.data(), 3, out); }
Vec3 vec3(const double* p) { return {p[0], p[1], p[2]}; }

static_assert(shape_kind_count == TS_LAST_SHAPE + 1, "append the new kind to ts_shape_kind");
static_assert(static_cast<int>(last_common_shape) == TS_LAST_COMMON_SHAPE);

template <class T>
constexpr std::size_t places_of = std::is_same_v<T, double> ? 1
                                  : std::is_same_v<T, Vec3> ? 3
                                                            : 0;
template <class S, class T>
constexpr std::size_t places(const Field<S, T>&) {
  return places_of<T>;
}
template <class Outer, class S, class T>
constexpr std::size_t places(const InnerField<Outer, S, T>&) {
  return places_of<T>;
}
template <class... S>
constexpr bool fit_in_size(const std::variant<S...>*) {
  const auto total = [](const auto&... field) { return (places(field) + ... + 0); };
  return ((std::apply(total, S::fields()) <= std::extent_v<decltype(ts_shape::size)>)&&...);
}
static_assert(fit_in_size(static_cast<const Shape*>(nullptr)));

static_assert(sizeof(std::array<int, 3>) == 3 * sizeof(std::int32_t));

void point_at(const std::vector<std::array<int, 3>>& triangles, ts_shape& out) {
  out.triangles = triangles.empty() ? nullptr : triangles.front().data();
  out.triangle_count = triangles.size();
}

std::vector<double> flat(const std::vector<Vec3>& points) {
  std::vector<double> out;
  out.reserve(3 * points.size());
  for (const Vec3& p : points) out.insert(out.end(), {p.x(), p.y(), p.z()});
  return out;
}

ts_aabb to_abi(const Aabb& b) {
  ts_aabb out;
  copy3(b.lo, out.lower);
  copy3(b.hi, out.upper);
  return out;
}

ts_body to_abi(const Body& b) {
  ts_body out{};
  out.shape = b.shape;
  out.is_static = b.is_static;
  out.has_motion = b.motion.has_value();
  out.group = b.group;
  out.pose = pose_to(b.pose);
  if (b.motion) {
    copy3(b.motion->linear, out.linear);
    copy3(b.motion->angular, out.angular);
  }
  return out;
}

Shape mesh_of_kind(ShapeKind k, TriangleMesh m) {
  if (k == ShapeKind::solid_mesh) return SolidMesh(std::move(m));
  return m;
}

/// Rounded vertices form a different hull, with its own faces and dimension. Coordinates that overflowed to
/// infinity are kept as they are, without faces, because no hull can be built from them.
Shape with_vertices(const Shape& asked, std::vector<Vec3> vertices) {
  if (*vertices_if(asked) == vertices) return asked;
  if (const TriangleMesh* mesh = triangles_if(asked))
    return mesh_of_kind(kind_of(asked), {std::move(vertices), mesh->triangles});
  const bool finite =
      std::all_of(vertices.begin(), vertices.end(), [](const Vec3& v) { return v.allFinite(); });
  Shape shape = asked;
  Hull& h = *hull_if(shape);
  if (finite)
    h = make_hull(std::move(vertices));
  else
    h = {std::move(vertices), {}, 0};
  return shape;
}

std::vector<Vec3> points_from(const double* p, std::size_t count) {
  std::vector<Vec3> points;
  points.reserve(count);
  for (std::size_t k = 0; k < count; ++k) points.push_back(vec3(p + 3 * k));
  return points;
}

void get_sizes(const double* size, Shape& shape) {
  for_each_size(shape, [&](auto, double* numbers, std::size_t n) {
    std::copy_n(size, n, numbers);
    size += n;
  });
}

}  // namespace

std::optional<Shape> shape_from(const ts_shape& t) {
  if (t.kind < 0 || t.kind >= shape_kind_count) return std::nullopt;
  Shape s = shape_of_kind(static_cast<ShapeKind>(t.kind));
  get_sizes(t.size, s);
  if (!vertices_if(s)) return s;
  if (!t.vertices || t.vertex_count == 0) return std::nullopt;
  std::vector<Vec3> points = points_from(t.vertices, t.vertex_count);
  if (Hull* h = hull_if(s)) {
    h->vertices = {Vec3::Zero()};
    return with_vertices(s, std::move(points));
  }
  TriangleMesh m{std::move(points), {}};
  for (std::size_t k = 0; k < t.triangle_count; ++k) {
    const std::int32_t* c = t.triangles + 3 * k;
    for (int i = 0; i < 3; ++i)
      if (c[i] < 0 || static_cast<std::size_t>(c[i]) >= t.vertex_count) return std::nullopt;
    m.triangles.push_back({c[0], c[1], c[2]});
  }
  return mesh_of_kind(kind_of(s), std::move(m));
}

ts_pose pose_to(const Pose& p) {
  ts_pose out;
  copy3(p.translation, out.translation);
  out.rotation[0] = p.rotation.x;
  out.rotation[1] = p.rotation.y;
  out.rotation[2] = p.rotation.z;
  out.rotation[3] = p.rotation.w;
  return out;
}

ts_shape shape_to(const Shape& s, std::vector<double>& vertices) {
  ts_shape out{};
  out.kind = static_cast<std::int32_t>(s.index());
  double* size = out.size;
  for_each_size(s, [&](auto, const double* numbers, std::size_t n) { size = std::copy_n(numbers, n, size); });
  if (const std::vector<Vec3>* v = vertices_if(s)) {
    vertices = flat(*v);
    out.vertices = vertices.data();
    out.vertex_count = v->size();
  }
  if (const auto* h = hull_if(s)) {
    point_at(h->faces, out);
    out.dimension = h->dimension;
  }
  if (const TriangleMesh* m = triangles_if(s)) point_at(m->triangles, out);
  return out;
}

PluginScene::PluginScene(const Scene& scene, bool with_boxes) {
  vertices_.resize(scene.shapes.size());
  for (std::size_t i = 0; i < scene.shapes.size(); ++i)
    shapes_.push_back(shape_to(scene.shapes[i], vertices_[i]));
  for (const Body& b : scene.bodies) bodies_.push_back(to_abi(b));
  for (const Step& step : effective_script(scene)) {
    ts_step out{};
    ts_aabb box{};
    out.op = static_cast<std::int32_t>(step.op);
    out.body = step.body;
    if (step.op != Step::Op::query) {
      const Pose& pose = step.pose ? *step.pose : scene.bodies[static_cast<std::size_t>(step.body)].pose;
      out.pose = pose_to(pose);
      if (with_boxes && step.op != Step::Op::remove) box = to_abi(outer_box(scene.shape_of(step.body), pose));
    }
    steps_.push_back(out);
    if (with_boxes) boxes_.push_back(box);
  }
  for (auto [a, b] : scene.ignored) ignored_.insert(ignored_.end(), {a, b});
  view_ = {shapes_.data(),  shapes_.size(),       bodies_.data(),
           bodies_.size(),  steps_.data(),        steps_.size(),
           ignored_.data(), scene.ignored.size(), with_boxes ? boxes_.data() : nullptr,
           scene.margin};
}

ReceivedCollector::ReceivedCollector(const Scene& scene) : scene_(scene) {
  received_.shapes.resize(scene.shapes.size());
  received_.bodies.resize(scene.bodies.size());
}

// The callbacks are noexcept: an exception must not travel through a plug-in written in C.
ts_received ReceivedCollector::callbacks() {
  return {this,
          [](void* ctx, std::int32_t i, const double size[4], const double* vertices,
             std::size_t n) noexcept { static_cast<ReceivedCollector*>(ctx)->shape(i, size, vertices, n); },
          [](void* ctx, std::int32_t i, const double matrix[9], const double translation[3]) noexcept {
            static_cast<ReceivedCollector*>(ctx)->body(i, matrix, translation);
          },
          [](void* ctx, std::int32_t i, const ts_shape* held) noexcept {
            static_cast<ReceivedCollector*>(ctx)->other_shape(i, *held);
          }};
}

void ReceivedCollector::shape(int index, const double* size, const double* vertices,
                              std::size_t vertex_count) {
  if (index < 0 || static_cast<std::size_t>(index) >= scene_.shapes.size()) {
    ++rejected_;
    return;
  }
  const auto i = static_cast<std::size_t>(index);
  const Shape& asked = scene_.shapes[i];
  if (const std::vector<Vec3>* v = vertices_if(asked)) {
    const bool is_hull = hull_if(asked) != nullptr;
    if (!vertices || vertex_count == 0 || (!is_hull && vertex_count != v->size())) {
      ++rejected_;
      return;
    }
    Shape s = with_vertices(asked, points_from(vertices, vertex_count));
    if (size) get_sizes(size, s);
    received_.shapes[i] = std::move(s);
    return;
  }
  Shape s = asked;
  get_sizes(size, s);
  received_.shapes[i] = std::move(s);
}

void ReceivedCollector::other_shape(int index, const ts_shape& held) {
  const bool exists = index >= 0 && static_cast<std::size_t>(index) < scene_.shapes.size();
  std::optional<Shape> s = exists ? shape_from(held) : std::nullopt;
  if (s)
    received_.shapes[static_cast<std::size_t>(index)] = std::move(s);
  else
    ++rejected_;
}

void ReceivedCollector::body(int index, const double* matrix, const double* translation) {
  if (index < 0 || static_cast<std::size_t>(index) >= scene_.bodies.size()) {
    ++rejected_;
    return;
  }
  Placement p;
  for (int r = 0; r < 3; ++r) p.matrix.row(r) = vec3(matrix + 3 * r);
  p.translation = vec3(translation);
  received_.bodies[static_cast<std::size_t>(index)] = p;
}

ts_answer blank_answer() {
  ts_answer blank{};
  blank.outcome = TS_UNSUPPORTED;
  blank.distance = blank.depth = blank.toi = blank.lower = blank.upper = nan_value;
  for (double* v : {blank.point_a, blank.point_b, blank.normal, blank.moment}) std::fill_n(v, 3, nan_value);
  return blank;
}

void AnswerCollector::add_point(const double position[3], double depth, std::optional<std::uint64_t> id) {
  seen_.manifold.push_back({vec3(position), depth, id});
}

AnswerCollector::AnswerCollector(int body_count, int query_step_count)
    : bodies_(body_count), answer_(blank_answer()) {
  seen_.candidate_pairs.resize(static_cast<std::size_t>(query_step_count));
}

ts_sink AnswerCollector::callbacks() {
  return {this,
          [](void* ctx, const double position[3], double depth) noexcept {
            static_cast<AnswerCollector*>(ctx)->add_point(position, depth);
          },
          [](void* ctx, std::int32_t k, std::int32_t a, std::int32_t b) noexcept {
            auto& c = *static_cast<AnswerCollector*>(ctx);
            const bool good =
                c.is_pair(a, b) && k >= 0 && static_cast<std::size_t>(k) < c.seen_.candidate_pairs.size();
            if (!good)
              c.fault_ = "names a candidate pair or a query step that does not exist";
            else
              c.seen_.candidate_pairs[static_cast<std::size_t>(k)].push_back(std::minmax(a, b));
          },
          [](void* ctx, std::int32_t a, std::int32_t b, const double normal[3], double depth) noexcept {
            auto& c = *static_cast<AnswerCollector*>(ctx);
            const Vec3 n = vec3(normal);
            if (!c.is_pair(a, b))
              c.fault_ = "names a contact of bodies that do not exist";
            else
              c.seen_.contacts.push_back({std::min(a, b), std::max(a, b), a < b ? n : Vec3(-n), depth});
          },
          [](void* ctx, const double position[3], double depth, std::uint64_t id) noexcept {
            static_cast<AnswerCollector*>(ctx)->add_point(position, depth, id);
          }};
}

Observation AnswerCollector::take(Question question) {
  Observation o = std::move(seen_);
  const ts_answer& a = answer_;
  o.detail.assign(a.detail, strnlen(a.detail, sizeof a.detail));
  if (a.outcome < TS_ANSWERED || a.outcome > TS_THREW) fault_ = "has an outcome that does not exist";
  if (fault_) {
    Observation broken;
    broken.outcome = Outcome::invalid_answer;
    broken.detail = std::string("the answer ") + fault_;
    return broken;
  }
  o.outcome = static_cast<Outcome>(a.outcome);
  if (a.has & TS_HAS_OVERLAP) o.overlap = a.overlap != 0;
  if (a.has & TS_HAS_DISTANCE) o.distance = a.distance;
  if (a.has & TS_HAS_POINTS) o.witness = {vec3(a.point_a), vec3(a.point_b)};
  if (a.has & TS_HAS_NORMAL) o.normal = vec3(a.normal);
  if (a.has & TS_HAS_DEPTH) o.depth = a.depth;
  if (a.has & TS_HAS_TOI) o.toi = a.toi;
  if (a.has & TS_HAS_LOWER) o.lower_bound = a.lower;
  if (a.has & TS_HAS_UPPER) o.upper_bound = a.upper;
  if (a.has & TS_HAS_MOMENT) o.moment = vec3(a.moment);
  if (a.has & TS_HAS_UNIQUE) o.unique_gradient = a.unique_gradient != 0;
  if (std::isfinite(a.claimed_tolerance) && a.claimed_tolerance > 0)
    o.claimed_tolerance = a.claimed_tolerance;
  if (a.ns > 0) o.elapsed_ns = a.ns;
  if (!is_broad_question(question) || o.outcome != Outcome::answered) o.candidate_pairs.clear();
  return o;
}

}  // namespace touchstone
