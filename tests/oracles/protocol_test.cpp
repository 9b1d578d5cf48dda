#include "oracles/abi/protocol.h"

#include <cmath>
#include <limits>
#include <optional>

#include "core/base/hash.h"
#include "core/math/rng.h"
#include "core/scene/scene.h"
#include "oracles/abi/plugin_scene.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::protocol;

namespace {

Vec3 any_vector(Rng& rng) {
  const auto x = [&] {
    return rng.chance(0.1) ? -0.0 : std::ldexp(rng.uniform(-1, 1), static_cast<int>(rng.below(80)) - 40);
  };
  return {x(), x(), x()};
}

std::vector<Vec3> any_points(Rng& rng, std::size_t n) {
  std::vector<Vec3> v(n);
  for (Vec3& p : v) p = rng.unit_vector();
  return v;
}

Shape any_shape(Rng& rng) {
  const double a = rng.uniform(0.1, 2), b = rng.uniform(0.1, 2);
  switch (rng.below(11)) {
    case 0:
      return Sphere{a};
    case 1:
      return Box{Vec3(a, b, a)};
    case 2:
      return Capsule{a, b};
    case 3:
      return Cylinder{a, b};
    case 4:
      return Cone{a, b};
    case 5:
      return Ellipsoid{Vec3(a, b, b)};
    case 6:
      return make_hull(any_points(rng, 4 + rng.below(10)));
    case 7:
      return HalfSpace{any_vector(rng), a};
    case 8:
      return RoundedBox{Vec3(a, b, a), b};
    case 9:
      return SolidMesh(TriangleMesh{any_points(rng, 4), {{0, 1, 2}, {1, 2, 3}}});
    default:
      return TriangleMesh{any_points(rng, 4), {{0, 1, 2}, {1, 2, 3}}};
  }
}

Scene any_scene(Rng& rng) {
  Scene s;
  const std::size_t shapes = 1 + rng.below(3), bodies = 2 + rng.below(4);
  for (std::size_t i = 0; i < shapes; ++i) s.shapes.push_back(any_shape(rng));
  for (std::size_t i = 0; i < bodies; ++i) {
    Body b;
    b.shape = static_cast<int>(rng.below(shapes));
    b.pose = {any_vector(rng), rng.rotation()};
    if (rng.chance(0.5)) b.motion = Motion{any_vector(rng), any_vector(rng)};
    b.is_static = rng.chance(0.5);
    b.group = static_cast<int>(rng.below(3)) - 1;
    s.bodies.push_back(b);
  }
  if (rng.chance(0.5)) s.ignored = {{0, 1}};
  if (rng.chance(0.5)) {
    s.script = {
        {Step::Op::insert, 0, std::nullopt}, {Step::Op::insert, 1, Pose{any_vector(rng), rng.rotation()}},
        {Step::Op::query, -1, std::nullopt}, {Step::Op::move, 1, Pose{}},
        {Step::Op::remove, 0, std::nullopt}, {Step::Op::query, -1, std::nullopt}};
  }
  if (rng.chance(0.5)) s.margin = rng.uniform(-1, 1);
  return s;
}

Observation any_observation(Rng& rng) {
  Observation o;
  o.outcome = static_cast<Outcome>(rng.below(7));
  o.detail = std::string(rng.below(40), 'd');
  const auto maybe = [&](auto& field, auto value) {
    if (rng.chance(0.5)) field = value;
  };
  maybe(o.overlap, rng.chance(0.5));
  maybe(o.distance, rng.uniform(-1, 1));
  maybe(o.witness, std::array<Vec3, 2>{any_vector(rng), any_vector(rng)});
  maybe(o.normal, any_vector(rng));
  maybe(o.depth, std::numeric_limits<double>::infinity());
  maybe(o.toi, rng.uniform());
  maybe(o.lower_bound, rng.uniform(-1, 1));
  maybe(o.upper_bound, rng.uniform(-1, 1));
  maybe(o.moment, any_vector(rng));
  maybe(o.unique_gradient, rng.chance(0.5));
  for (std::size_t i = rng.below(3); i > 0; --i) {
    o.manifold.push_back({any_vector(rng), rng.uniform()});
    if (rng.chance(0.5)) o.manifold.back().id = rng.next();
  }
  for (std::size_t i = rng.below(3); i > 0; --i) o.candidate_pairs.push_back({{0, 1}, {2, 7}});
  for (std::size_t i = rng.below(3); i > 0; --i) o.contacts.push_back({0, 1, any_vector(rng), rng.uniform()});
  o.claimed_tolerance = rng.uniform();
  o.elapsed_ns = static_cast<std::int64_t>(rng.below(1000000));
  return o;
}

using Ids = std::vector<std::optional<std::uint64_t>>;
Ids ids_of(const Observation& o) {
  Ids all;
  for (const ManifoldPoint& p : o.manifold) all.push_back(p.id);
  return all;
}

std::vector<Query> any_queries(Rng& rng) {
  std::vector<Query> q;
  for (std::size_t i = rng.below(5); i > 0; --i)
    q.push_back({static_cast<Question>(rng.below(question_names.size())), static_cast<int>(rng.below(5)),
                 static_cast<int>(rng.below(5))});
  return q;
}

/// The payload of the only frame in `bytes`.
std::string payload_of(const std::string& bytes, Type type) {
  FrameReader frames;
  frames.append(bytes.data(), bytes.size());
  const auto frame = frames.next();
  REQUIRE(frame);
  REQUIRE(frame->type == type);
  return std::string(frame->payload);
}

/// Reads the whole stream and decodes each payload. The number of frames, or nothing if the stream is
/// malformed.
std::optional<int> consume(const std::string& bytes, const Scene& scene) {
  try {
    FrameReader frames;
    frames.append(bytes.data(), bytes.size());
    int n = 0;
    for (; const auto f = frames.next(); ++n) {
      if (f->type == Type::hello) decode_hello(f->payload);
      if (f->type == Type::question) decode_question(f->payload);
      if (f->type == Type::received) decode_received(f->payload, scene);
      if (f->type == Type::answer) decode_answer(f->payload);
    }
    return n;
  } catch (const Malformed&) {
    return std::nullopt;
  }
}

ReceivedScene any_received(Rng& rng, const Scene& scene) {
  ReceivedScene r;
  for (const Shape& s : scene.shapes) r.shapes.push_back(rng.chance(0.5) ? std::optional(s) : std::nullopt);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    std::optional<Placement> p;
    if (rng.chance(0.7)) p = Placement{rotation_matrix(rng.rotation()), any_vector(rng)};
    r.bodies.push_back(p);
  }
  return r;
}

}  // namespace

TEST_CASE("questions keep every number, face and step of their scene", "[oracles][protocol]") {
  Rng rng(1);
  int hulls = 0;
  for (int i = 0; i < 2000; ++i) {
    const Scene scene = any_scene(rng);
    const auto queries = any_queries(rng);
    std::string bytes;
    append(bytes, QuestionRef{77, 3, scene, queries, 0x41, true});
    const QuestionMessage m = decode_question(payload_of(bytes, Type::question));
    REQUIRE(m.scene == scene);
    REQUIRE(hash(m.scene) == hash(scene));
    REQUIRE((m.queries == queries && m.sequence == 77 && m.first_query == 3));
    for (std::size_t k = 0; k < scene.shapes.size(); ++k)
      if (const auto* h = std::get_if<Hull>(&scene.shapes[k])) {
        const Hull& got = std::get<Hull>(m.scene.shapes[k]);
        REQUIRE((got.faces == h->faces && got.dimension == h->dimension));
        ++hulls;
      }
  }
  CHECK(hulls > 200);
}

TEST_CASE("answers, received scenes and hellos round-trip", "[oracles][protocol]") {
  Rng rng(2);
  for (int i = 0; i < 2000; ++i) {
    const Observation o = any_observation(rng);
    std::string bytes;
    append(bytes, AnswerMessage{5, 6, o});
    const AnswerMessage a = decode_answer(payload_of(bytes, Type::answer));
    REQUIRE(ids_of(a.observation) == ids_of(o));
    REQUIRE(
        (a.observation == o && a.observation.elapsed_ns == o.elapsed_ns && a.sequence == 5 && a.query == 6));
    const Scene scene = any_scene(rng);
    const ReceivedScene received = any_received(rng, scene);
    bytes.clear();
    append(bytes, ReceivedMessage{9, received});
    REQUIRE(decode_received(payload_of(bytes, Type::received), scene).scene == received);
  }
  const Hello hello{{"{}", "two"}, 1, "error", "read-only", true};
  std::string bytes;
  append(bytes, hello);
  CHECK(decode_hello(payload_of(bytes, Type::hello)) == hello);
}

TEST_CASE("the margin and bounds pass through the C ABI", "[oracles][abi]") {
  Scene scene;
  scene.margin = -0.25;
  CHECK(PluginScene(scene).view().margin == -0.25);
  AnswerCollector collector(2, 0);
  ts_answer& a = collector.answer();
  CHECK(std::isnan(a.lower));
  CHECK(std::isnan(a.upper));
  a.outcome = TS_ANSWERED;
  a.has = TS_HAS_LOWER | TS_HAS_UPPER;
  a.lower = 1;
  a.upper = 2;
  const Observation o = collector.take(Question::bounded_distance);
  CHECK(o.lower_bound == 1);
  CHECK(o.upper_bound == 2);
  CHECK(!o.distance);
}

TEST_CASE("gradients pass through the C ABI", "[oracles][abi]") {
  AnswerCollector collector(2, 0);
  ts_answer& a = collector.answer();
  CHECK(std::isnan(a.moment[2]));
  a.outcome = TS_ANSWERED;
  a.has = TS_HAS_MOMENT | TS_HAS_UNIQUE;
  std::copy_n(std::array{1.0, 2.0, 3.0}.data(), 3, a.moment);
  a.unique_gradient = 1;
  const Observation o = collector.take(Question::distance);
  CHECK(o.moment == Vec3(1, 2, 3));
  CHECK(o.unique_gradient == true);
}

TEST_CASE("ids of points pass through the C ABI", "[oracles][abi]") {
  AnswerCollector collector(2, 0);
  const ts_sink sink = collector.callbacks();
  const double at[] = {1, 2, 3};
  constexpr std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();
  sink.named_point(sink.ctx, at, 0.5, largest);
  sink.point(sink.ctx, at, 0.25);
  sink.named_point(sink.ctx, at, 0.125, 0);
  collector.answer().outcome = TS_ANSWERED;
  const Observation o = collector.take(Question::contact);
  CHECK(ids_of(o) == Ids{largest, std::nullopt, 0});
  REQUIRE(o.manifold.size() == 3);
  CHECK(o.manifold[0] == ManifoldPoint{Vec3(1, 2, 3), 0.5});
}

TEST_CASE("shapes pass through the C ABI and back", "[oracles][abi]") {
  Rng rng(6);
  for (int i = 0; i < 500; ++i) {
    const Scene scene = any_scene(rng);
    const PluginScene sent(scene);
    for (std::size_t k = 0; k < scene.shapes.size(); ++k) {
      const ts_shape& s = sent.view().shapes[k];
      REQUIRE(s.kind == static_cast<int>(kind_of(scene.shapes[k])));
      REQUIRE(shape_from(s) == scene.shapes[k]);
    }
  }
  Scene one;
  one.shapes = {RoundedBox{{1, 2, 3}, 0.5}};
  const PluginScene sent(one);
  const ts_shape& s = sent.view().shapes[0];
  CHECK(s.kind == TS_ROUNDED_BOX);
  CHECK((s.size[0] == 1 && s.size[1] == 2 && s.size[2] == 3 && s.size[3] == 0.5));
  ReceivedCollector held(one);
  const ts_received callbacks = held.callbacks();
  const double size[4] = {1, 2, 3.5, 0.25};
  callbacks.shape(callbacks.ctx, 0, size, nullptr, 0);
  CHECK(held.take().shapes[0] == Shape(RoundedBox{{1, 2, 3.5}, 0.25}));
  Scene solid;
  solid.shapes = {SolidMesh(TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                         {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}})};
  const PluginScene sent_solid(solid);
  const ts_shape& t = sent_solid.view().shapes[0];
  CHECK((t.kind == TS_SOLID_MESH && t.triangle_count == 4 && t.vertex_count == 4));
  ReceivedCollector held_solid(solid);
  const ts_received solid_callbacks = held_solid.callbacks();
  const double moved[] = {0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 1};
  solid_callbacks.shape(solid_callbacks.ctx, 0, size, moved, 4);
  const Shape received = *held_solid.take().shapes[0];
  CHECK((kind_of(received) == ShapeKind::solid_mesh && triangles_if(received)->vertices[1].x() == 2));
  ts_shape unknown = s;
  for (const int kind : {-1, TS_LAST_SHAPE + 1}) {
    unknown.kind = kind;
    CHECK_FALSE(shape_from(unknown));
  }
}

namespace {

using Extended3 = Eigen::Matrix<long double, 3, 1>;

// A point of the body farthest along some direction, moved to its pose; in extended precision.
Extended3 point_of(const Body& b, const Shape& shape, Rng& rng) {
  const Vec3 local = std::visit(
      [&](const auto& s) -> Vec3 {
        if constexpr (requires { support(s, Vec3()); })
          return support(s, rng.unit_vector());
        else
          return (*vertices_if(shape))[rng.below(vertices_if(shape)->size())];
      },
      shape);
  const Quat& q = b.pose.rotation;
  const Eigen::Quaternion<long double> turn(static_cast<long double>(q.w), static_cast<long double>(q.x),
                                            static_cast<long double>(q.y), static_cast<long double>(q.z));
  return turn.normalized() * Extended3(local.cast<long double>()) + b.pose.translation.cast<long double>();
}

}  // namespace

TEST_CASE("the box of a step contains the body", "[oracles][abi]") {
  Rng rng(8);
  int tight = 0, checked = 0;
  for (int i = 0; i < 400; ++i) {
    Scene scene = any_scene(rng);
    scene.script.clear();
    for (Body& b : scene.bodies) {
      b.pose.translation = rng.vector(1e-3, 1e3);
      b.pose.rotation = rng.chance(0.3) ? Quat{} : rng.rotation();
      if (rng.chance(0.5))
        b.pose.rotation = {3 * b.pose.rotation.x, 3 * b.pose.rotation.y, 3 * b.pose.rotation.z,
                           3 * b.pose.rotation.w};
    }
    CHECK(PluginScene(scene).view().step_boxes == nullptr);
    const PluginScene sent(scene, true);
    for (std::size_t k = 0; k < sent.view().step_count; ++k) {
      const ts_step& step = sent.view().steps[k];
      if (step.op == TS_QUERY) continue;
      const Body& b = scene.bodies[static_cast<std::size_t>(step.body)];
      const Shape& shape = scene.shape_of(step.body);
      const ts_aabb& box = sent.view().step_boxes[k];
      if (!is_bounded(kind_of(shape))) {
        CHECK(std::isinf(box.lower[0]));
        continue;
      }
      double widest = 0, nearest = HUGE_VAL;
      for (int n = 0; n < 40; ++n) {
        const Extended3 p = point_of(b, shape, rng);
        for (int axis = 0; axis < 3; ++axis) {
          REQUIRE(p[axis] >= static_cast<long double>(box.lower[axis]));
          REQUIRE(p[axis] <= static_cast<long double>(box.upper[axis]));
          widest = std::max(widest, box.upper[axis] - box.lower[axis]);
          nearest =
              std::min(nearest, static_cast<double>(static_cast<long double>(box.upper[axis]) - p[axis]));
        }
      }
      ++checked;
      tight += nearest <= 0.2 * widest;
    }
  }
  CHECK(checked > 200);
  CHECK(tight > checked / 2);  // none of them is the whole space
}

TEST_CASE("boxes of boxes are exact, and those of no bodies are no boxes", "[oracles][abi]") {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Pose at;
  at.translation = {1, 2, 3};
  CHECK(outer_box(Box{{1, 2, 4}}, at) == Aabb{{0, 0, -1}, {2, 4, 7}});
  CHECK(outer_box(Box{{inf, 1, 1}}, at) == Aabb{{-inf, 1, 2}, {inf, 3, 4}});
  CHECK(outer_box(HalfSpace{{0, 0, 1}, 0}, at).hi == Vec3(inf, inf, inf));
  const Aabb inverted = outer_box(Box{{-1, 1, 1}}, at);
  CHECK(inverted.hi.x() < inverted.lo.x());
  CHECK(std::isnan(outer_box(Box{{std::nan(""), 1, 1}}, at).lo.x()));
  at.rotation = {1, 0, 0, 1};
  CHECK(outer_box(Box{{inf, 1, 1}}, at).lo == Vec3(-inf, -inf, -inf));
  // One third and its double are no doubles: the box is rounded outward, by one number at most.
  Pose third;
  third.translation = Vec3::Constant(1.0 / 3);
  const Aabb box = outer_box(Sphere{0.1}, third);
  const long double exact = static_cast<long double>(1.0 / 3) + static_cast<long double>(0.1);
  CHECK(static_cast<long double>(box.hi.x()) >= exact);
  CHECK(static_cast<long double>(std::nextafter(box.hi.x(), 0)) < exact);
}

TEST_CASE("frames may arrive in pieces of any size", "[oracles][protocol]") {
  Rng rng(3);
  std::string bytes;
  for (std::uint32_t i = 0; i < 200; ++i) append(bytes, AnswerMessage{1, i, any_observation(rng)});
  FrameReader frames;
  std::uint32_t next = 0;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t n = std::min<std::size_t>(1 + rng.below(300), bytes.size() - at);
    frames.append(bytes.data() + at, n);
    at += n;
    while (const auto f = frames.next()) REQUIRE(decode_answer(f->payload).query == next++);
  }
  CHECK(next == 200);
}

TEST_CASE("damaged messages are malformed or different messages, nothing worse",
          "[oracles][protocol][fuzz]") {
  Rng rng(4);
  int malformed = 0, accepted = 0;
  for (int i = 0; i < 30000; ++i) {
    const Scene scene = any_scene(rng);
    std::string bytes;
    switch (rng.below(4)) {
      case 0:
        append(bytes, Hello{{"{}", "x"}, 0, ""});
        break;
      case 1:
        append(bytes, QuestionRef{1, 0, scene, any_queries(rng)});
        break;
      case 2:
        append(bytes, ReceivedMessage{1, any_received(rng, scene)});
        break;
      default:
        append(bytes, AnswerMessage{1, 0, any_observation(rng)});
        break;
    }
    const std::size_t header = rng.chance(0.2) ? 0 : 16;
    for (std::uint64_t flips = 1 + rng.below(2); flips > 0; --flips) {
      // Lengths and tags lie among many more bytes of doubles, so aim at small bytes.
      std::size_t at = header + rng.below(bytes.size() - header);
      for (int tries = 0; tries < 3 && static_cast<unsigned char>(bytes[at]) > 16; ++tries)
        at = header + rng.below(bytes.size() - header);
      bytes[at] = static_cast<char>(rng.chance(0.5) ? 0xff : rng.next());
    }
    consume(bytes, scene) ? ++accepted : ++malformed;
  }
  INFO("malformed " << malformed << ", accepted " << accepted);
  CHECK(malformed > 9000);
  CHECK(accepted > 9000);
}

TEST_CASE("a truncated message is never accepted", "[oracles][protocol]") {
  Rng rng(5);
  int cut = 0;
  for (int i = 0; i < 60; ++i) {
    const Scene scene = any_scene(rng);
    std::string bytes;
    append(bytes, QuestionRef{1, 0, scene, any_queries(rng)});
    const std::string payload = payload_of(bytes, Type::question);
    for (std::size_t n = 0; n < payload.size(); n += 1 + rng.below(7), ++cut)
      REQUIRE_THROWS_AS(decode_question(std::string_view(payload).substr(0, n)), Malformed);
    REQUIRE_THROWS_AS(decode_question(payload + "x"), Malformed);
  }
  CHECK(cut > 2000);
}

TEST_CASE("noise is refused at its first bytes", "[oracles][protocol][fuzz]") {
  Rng rng(6);
  for (int i = 0; i < 5000; ++i) {
    std::string noise(1 + rng.below(100), ' ');
    for (char& c : noise) c = static_cast<char>(rng.next());
    if (noise[0] == 'T') continue;
    REQUIRE_FALSE(consume(noise, Scene{}));
  }
}

TEST_CASE("an announced length allocates nothing", "[oracles][protocol]") {
  std::string bytes;
  append(bytes, AnswerMessage{1, 0, Observation{}});
  const std::uint32_t most = max_payload_bytes, more = max_payload_bytes + 1;
  FrameReader waits, refuses;
  std::memcpy(bytes.data() + 8, &most, sizeof most);
  waits.append(bytes.data(), bytes.size());
  CHECK_FALSE(waits.next());
  std::memcpy(bytes.data() + 8, &more, sizeof more);
  refuses.append(bytes.data(), bytes.size());
  CHECK_THROWS_AS(refuses.next(), Malformed);
  // A list length inside a payload.
  std::string payload;
  Writer(payload).count(0xffffffff);
  CHECK_THROWS_AS(decode_hello(payload), Malformed);
}
