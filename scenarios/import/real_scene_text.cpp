// The grammar of scene.txt, one statement per line.
#include "core/base/input_error.h"
#include "scenarios/import/real_scene.h"
#include "scenarios/import/text_lines.h"
#include "scenarios/text/printable.h"

namespace touchstone {
namespace {

struct Counts {
  int shapes = 0, bodies = 0, moving = 0, fixed = 0, ignored = 0, frames = 0, columns = 0;
};

constexpr int max_count = 1 << 20;

// counts shapes S bodies B dynamic D static T ignore I frames F cols C
Counts read_counts(TextLines& in) {
  in.need("the counts");
  in.need_tokens(15);
  const std::string_view names[] = {"shapes", "bodies", "dynamic", "static", "ignore", "frames", "cols"};
  int v[7];
  for (std::size_t i = 0; i < 7; ++i) {
    if (in.token(0) != "counts" || in.token(1 + 2 * i) != names[i])
      in.fail("expected: counts shapes S bodies B dynamic D static T ignore I frames F cols C");
    v[i] = in.integer(2 + 2 * i, 0, max_count);
  }
  const Counts c{v[0], v[1], v[2], v[3], v[4], v[5], v[6]};
  if (c.bodies != c.moving + c.fixed) in.fail("bodies is not dynamic + static");
  if (c.columns != 7 && c.columns != 13) in.fail("cols must be 7 or 13");
  return c;
}

Shape read_hull(TextLines& in) {
  in.need_tokens(4);
  const int n = in.integer(3, 1, max_count);
  std::vector<Vec3> vertices;
  for (int i = 0; i < n; ++i) {
    in.need("a vertex of the hull");
    in.need_tokens(3);
    vertices.push_back(in.vec3(0));
  }
  return make_hull(std::move(vertices));
}

Shape read_shape(TextLines& in, int id) {
  in.need("a shape");
  if (in.token(0) != "shape" || in.integer(1) != id) in.fail("expected: shape " + std::to_string(id));
  const std::string type(in.token(2));
  const auto radius_and_height = [&](auto shape) {
    in.need_tokens(5);
    shape.radius = in.number(3);
    shape.half_height = in.number(4);
    return Shape(shape);
  };
  if (type == "hull") return read_hull(in);
  if (type == "box") {
    in.need_tokens(6);
    return Shape(Box{in.vec3(3)});
  }
  if (type == "sphere") {
    in.need_tokens(4);
    return Shape(Sphere{in.number(3)});
  }
  if (type == "capsule") return radius_and_height(Capsule{});
  if (type == "cylinder") return radius_and_height(Cylinder{});
  if (type == "cone") return radius_and_height(Cone{});
  in.fail("unknown shape \"" + type + "\"");
}

RealBody read_body(TextLines& in, int id, bool is_static, int shape_count) {
  in.need("a body");
  if (in.token(0) != "body" || in.integer(1) != id) in.fail("expected: body " + std::to_string(id));
  if (in.token(2) != (is_static ? "static" : "dynamic"))
    in.fail("moving bodies come first; this one must be " + std::string(is_static ? "static" : "dynamic"));
  in.need_tokens(is_static ? 12 : 5);
  RealBody b;
  b.name = printable(in.token(3));
  b.is_static = is_static;
  const int geoms = in.integer(4, 1, max_count);
  if (is_static) b.pose = {in.vec3(5), in.quat(8)};
  for (int i = 0; i < geoms; ++i) {
    in.need("a geom");
    if (in.token(0) != "geom") in.fail("expected: geom");
    in.need_tokens(9);
    b.geoms.push_back({in.integer(1, 0, shape_count - 1), {in.vec3(2), in.quat(5)}});
  }
  return b;
}

BodyPair read_ignored(TextLines& in, int bodies) {
  in.need("an ignored pair");
  if (in.token(0) != "ignore") in.fail("expected: ignore <i> <j>");
  in.need_tokens(3);
  const int i = in.integer(1, 0, bodies - 1);
  return {i, in.integer(2, i + 1, bodies - 1)};
}

}  // namespace

RealSceneText read_real_scene_text(const std::filesystem::path& file) {
  TextLines in(file, ' ');
  in.need("cdh-scene 1");
  if (in.token_count() != 2 || in.token(0) != "cdh-scene" || in.integer(1) != 1)
    in.fail("expected: cdh-scene 1");
  in.need("the name");
  if (in.token(0) != "name") in.fail("expected: name <word>");
  in.need_tokens(2);
  RealSceneText r;
  RealScene& s = r.scene;
  s.name = printable(in.token(1));
  const Counts c = read_counts(in);
  r.moving = c.moving;
  r.frames = c.frames;
  r.columns = c.columns;
  for (int i = 0; i < c.shapes; ++i) {
    Shape shape = read_shape(in, i);
    try {
      validate(shape);
    } catch (const InputError& e) {
      in.fail(e.what());
    }
    s.shapes.push_back(std::move(shape));
  }
  for (int i = 0; i < c.bodies; ++i) s.bodies.push_back(read_body(in, i, i >= c.moving, c.shapes));
  for (int i = 0; i < c.ignored; ++i) s.ignored.push_back(read_ignored(in, c.bodies));
  in.need("end");
  if (in.token(0) != "end") in.fail("expected: end");
  if (in.next()) in.fail("there is more after the end");
  return r;
}

}  // namespace touchstone
