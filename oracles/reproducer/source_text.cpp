#include "oracles/reproducer/source_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/input_error.h"

namespace touchstone::fuzz {

std::string filled(std::string_view text,
                   std::initializer_list<std::pair<std::string_view, std::string>> values) {
  std::string out(text);
  for (const auto& [name, value] : values) {
    const std::string token = fmt::format("@{}@", name);
    std::size_t at = out.find(token);
    if (at == std::string::npos) throw std::logic_error("no " + token + " in the text");
    for (; at != std::string::npos; at = out.find(token, at + value.size()))
      out.replace(at, token.size(), value);
  }
  return out;
}

std::string literal(double x) {
  if (std::isnan(x)) return "NAN";
  if (std::isinf(x)) return x > 0 ? "INFINITY" : "-INFINITY";
  std::string s = fmt::format("{}", x);
  if (s.find_first_of(".e") == std::string::npos) s += ".0";
  return s;
}

std::string literals(const Vec3& v) {
  return fmt::format("{}, {}, {}", literal(v.x()), literal(v.y()), literal(v.z()));
}

std::string pose_literal(const Pose& p) {
  const Mat3 r = rotation_matrix(p.rotation);
  return fmt::format("{{{{{}, {}, {}}}, {{{}}}}}", literals(r.row(0)), literals(r.row(1)), literals(r.row(2)),
                     literals(p.translation));
}

namespace {

constexpr std::string_view round_support = R"(  const double n = std::sqrt(dot(d, d));
  Vec p = n > 0 ? scaled(@RADIUS@ / n, d) : Vec{};
)";
constexpr std::string_view rim_support = R"(  const double n = std::hypot(d[0], d[1]);
  Vec p = n > 0 ? Vec{@RADIUS@ * d[0] / n, @RADIUS@ * d[1] / n, 0} : Vec{};
)";

struct LocalSupport {
  std::string operator()(const Sphere& s) const {
    return filled(round_support, {{"RADIUS", literal(s.radius)}});
  }
  std::string operator()(const Box& s) const {
    std::string out = "  Vec p;\n";
    for (int i = 0; i < 3; ++i)
      out += fmt::format("  p[{}] = std::copysign({}, d[{}]);\n", i, literal(s.half_extents[i]), i);
    return out;
  }
  std::string operator()(const Capsule& s) const {
    return filled(round_support, {{"RADIUS", literal(s.radius)}}) +
           fmt::format("  p[2] += std::copysign({}, d[2]);\n", literal(s.half_height));
  }
  std::string operator()(const Cylinder& s) const {
    return filled(rim_support, {{"RADIUS", literal(s.radius)}}) +
           fmt::format("  p[2] = std::copysign({}, d[2]);\n", literal(s.half_height));
  }
  std::string operator()(const Cone& s) const {
    return filled(rim_support, {{"RADIUS", literal(s.radius)}}) +
           fmt::format(
               "  p[2] = -{};\n  const Vec apex{{0, 0, {}}};\n  if (dot(apex, d) > dot(p, d)) p = apex;\n",
               literal(s.half_height), literal(s.half_height));
  }
  std::string operator()(const Ellipsoid& s) const {
    return fmt::format(
        "  const Vec axes{{{}}};\n  Vec p{{axes[0] * d[0], axes[1] * d[1], axes[2] * d[2]}};\n"
        "  const double n = std::sqrt(dot(p, p));\n"
        "  for (int i = 0; i < 3; ++i) p[i] = n > 0 ? axes[i] * p[i] / n : 0;\n",
        literals(s.semi_axes));
  }
  std::string operator()(const Hull& s) const {
    std::string out = "  static const Vec vertices[] = {";
    for (const Vec3& v : s.vertices) out += fmt::format("\n      {{{}}},", literals(v));
    return out +
           "};\n  Vec p = vertices[0];\n"
           "  for (const Vec& v : vertices)\n    if (dot(v, d) > dot(p, d)) p = v;\n";
  }
  std::string operator()(const RoundedBox& s) const { return with_ball(Box{s.half_extents}, s.radius); }
  template <class S>
  std::string operator()(const Padded<S>& s) const {
    return with_ball(s.inner, s.padding);
  }
  // No engine with a reproducer is sent the other shapes.
  template <class S>
  std::string operator()(const S&) const {
    throw InputError("reproduce", fmt::format("no support mapping of a {} is written", S::type));
  }

 private:
  template <class S>
  std::string with_ball(const S& core, double radius) const {
    return "  const auto core = [](const Vec& d) {\n" + (*this)(core) +
           "  return p;\n  };\n  Vec p = core(d);\n  const double length = std::sqrt(dot(d, d));\n" +
           fmt::format("  for (int i = 0; i < 3 && length > 0; ++i) p[i] += {} * d[i] / length;\n",
                       literal(radius));
  }
};

std::string number_text(double v) { return fmt::format("{}", v); }
std::string number_text(const Vec3& v) { return literals(v); }

// "capsule of radius 1, half height 2", by the shape's field table.
struct Description {
  template <class S>
  std::string operator()(const S& s) const {
    std::string out(S::type);
    const char* before = " of";
    for_each_field(s, [&](std::string_view name, const auto& v, Domain) {
      out += fmt::format("{} {} {}", before, name, number_text(v));
      before = ",";
    });
    std::replace(out.begin(), out.end(), '_', ' ');
    return out;
  }
  std::string operator()(const Hull& s) const { return fmt::format("hull of {} points", s.vertices.size()); }
  std::string operator()(const Padded<Hull>& s) const {
    return fmt::format("hull of {} points, padding {}", s.inner.vertices.size(), s.padding);
  }
  std::string operator()(const HalfSpace& s) const {
    return fmt::format("half-space ({})·x <= {}", literals(s.normal), s.offset);
  }
  std::string operator()(const TriangleMesh& s) const {
    return fmt::format("mesh of {} triangles", s.triangles.size());
  }
  std::string operator()(const SolidMesh& s) const {
    return fmt::format("solid mesh of {} triangles", s.triangles.size());
  }
};

}  // namespace

std::string js_array(const Vec3& v) { return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z()); }

std::string js_relative_translation(const EngineQuestion& q) {
  const auto linear = [&](int i) { return q.body(i).motion ? q.body(i).motion->linear : Vec3(Vec3::Zero()); };
  return js_array(linear(q.a) - linear(q.b));
}

bool has_support(const Shape& shape) { return is_convex(kind_of(shape)); }

std::string support_function(std::string_view name, const Shape& shape, const Pose& pose) {
  if (!has_support(shape)) return {};
  return filled(R"(// Support mapping of body @WHO@: a point of it farthest along `direction`.
Vec support_@WHO@(const Vec& direction) {
  static const Placement at = @POSE@;
  const Vec d = to_local(at, direction);
@LOCAL@  return to_world(at, p);
}

)",
                {{"WHO", std::string(name)},
                 {"POSE", pose_literal(pose)},
                 {"LOCAL", std::visit(LocalSupport{}, shape)}});
}

std::string describe(const Shape& shape) { return std::visit(Description{}, shape); }

}  // namespace touchstone::fuzz
