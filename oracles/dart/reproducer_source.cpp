#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/base/input_error.h"
#include "oracles/reproducer/engine_source.h"
#include "oracles/reproducer/source_text.h"

namespace touchstone::fuzz {
namespace {

struct Backend {
  std::string_view engine, header, type, library;
};
constexpr Backend backends[] = {
    {"dart", "dart/collision/dart/DARTCollisionDetector.hpp", "DARTCollisionDetector", ""},
    {"dart-fcl", "dart/collision/fcl/FCLCollisionDetector.hpp", "FCLCollisionDetector", " -lfcl -lccd"},
    {"dart-fcl-mesh", "dart/collision/fcl/FCLCollisionDetector.hpp", "FCLCollisionDetector", " -lfcl -lccd"},
    {"dart-bullet", "dart/collision/bullet/BulletCollisionDetector.hpp", "BulletCollisionDetector",
     " -I/usr/include/bullet -ldart-collision-bullet -lBulletCollision -lLinearMath"},
    {"dart-ode", "dart/collision/ode/OdeCollisionDetector.hpp", "OdeCollisionDetector",
     " -ldart-collision-ode -lode"},
};

constexpr std::string_view includes = R"(#include <@HEADER@>
#include <dart/collision/CollisionGroup.hpp>
#include <dart/collision/CollisionObject.hpp>
#include <dart/dynamics/@A@Shape.hpp>
#include <dart/dynamics/@B@Shape.hpp>
#include <dart/dynamics/SimpleFrame.hpp>
#include <memory>
)";

constexpr std::string_view code = R"(struct Place {
  std::array<double, 9> rows;  // of the rotation
  Vec at;
};
dart::dynamics::SimpleFramePtr body(const dart::dynamics::ShapePtr& shape, const Place& p) {
  Eigen::Isometry3d placed = Eigen::Isometry3d::Identity();
  placed.linear() = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(p.rows.data());
  placed.translation() = Eigen::Map<const Eigen::Vector3d>(p.at.data());
  auto frame = dart::dynamics::SimpleFrame::createShared(dart::dynamics::Frame::World(), "body", placed);
  frame->setShape(shape);
  return frame;
}

Answer ask() {
  using namespace dart::dynamics;
  const auto a = body(std::make_shared<@SHAPE_A@>(@SIZES_A@), @POSE_A@);
  const auto b = body(std::make_shared<@SHAPE_B@>(@SIZES_B@), @POSE_B@);
  const auto detector = dart::collision::@TYPE@::create();
@SETTING@  const auto group = detector->createCollisionGroup(a.get(), b.get());
  Answer x;
@QUESTION@  return x;
}
)";

constexpr std::string_view setting =
    "  detector->setPrimitiveShapeType(dart::collision::FCLCollisionDetector::PRIMITIVE);\n";

// Bullet's contacts may be those of bodies that are apart.
constexpr std::string_view contact = R"(  dart::collision::CollisionResult result;
  x.overlap = group->collide(dart::collision::CollisionOption(), &result);
  for (const auto& c : result.getContacts()) {
    x.points.push_back({c.point[0], c.point[1], c.point[2]});
    if (c.penetrationDepth <= x.depth) continue;
    x.depth = c.penetrationDepth;
    // DART's normal points from the second object to the first.
    const double sign = c.collisionObject1->getShapeFrame() == a.get() ? -1 : 1;
    x.normal = {sign * c.normal[0], sign * c.normal[1], sign * c.normal[2]};
  }
@APART@)";
constexpr std::string_view apart = "  x.overlap = x.depth >= 0;\n";

// Without the bound, distances below 0 are reported as 0 (DistanceOption.hpp).
constexpr std::string_view distance = R"(  dart::collision::DistanceOption option;
  option.enableNearestPoints = true;
  option.distanceLowerBound = -std::numeric_limits<double>::infinity();
  dart::collision::DistanceResult result;
  x.distance = group->distance(option, &result);
  const bool is_first = result.shapeFrame1 == a.get();
  const Eigen::Vector3d p = is_first ? result.nearestPoint1 : result.nearestPoint2,
                        q = is_first ? result.nearestPoint2 : result.nearestPoint1;
  x.points = {{p[0], p[1], p[2]}, {q[0], q[1], q[2]}};
)";

// The name of DART's class before "Shape", and the arguments of its constructor: full lengths.
struct Made {
  std::string name, sizes;
};
std::string eigen(const Vec3& v) { return fmt::format("Eigen::Vector3d({})", literals(v)); }
Made made(const Shape& shape) {
  if (const auto* s = std::get_if<Sphere>(&shape)) return {"Sphere", literal(s->radius)};
  if (const auto* s = std::get_if<Box>(&shape)) return {"Box", eigen(2 * s->half_extents)};
  if (const auto* s = std::get_if<Ellipsoid>(&shape)) return {"Ellipsoid", eigen(2 * s->semi_axes)};
  const auto round = [](const std::string& name, const auto& s) {
    return Made{name, fmt::format("{}, {}", literal(s.radius), literal(2 * s.half_height))};
  };
  if (const auto* s = std::get_if<Capsule>(&shape)) return round("Capsule", *s);
  if (const auto* s = std::get_if<Cylinder>(&shape)) return round("Cylinder", *s);
  if (const auto* s = std::get_if<Cone>(&shape)) return round("Cone", *s);
  if (const auto* s = std::get_if<HalfSpace>(&shape)) {
    const double length = s->normal.stableNorm();
    return {"Plane", fmt::format("{}, {}", eigen(s->normal / length), literal(s->offset / length))};
  }
  throw InputError("reproduce", "for DART no programs with hulls or meshes are written");
}

std::string question(const EngineQuestion& q) {
  const bool is_bullet = q.engine == "dart-bullet";
  switch (q.question) {
    case Question::distance:
      return std::string(distance);
    case Question::overlap:
      if (!is_bullet) return "  x.overlap = group->collide();\n";
      [[fallthrough]];
    case Question::contact:
      return filled(contact, {{"APART", is_bullet ? std::string(apart) : ""}});
    default:
      throw InputError("reproduce", "DART answers overlap, contact and, with FCL, distance only");
  }
}

EngineSource source(const EngineQuestion& q) {
  const Backend& backend = *std::ranges::find(backends, q.engine, &Backend::engine);
  const Made a = made(q.scene.shape_of(q.a)), b = made(q.scene.shape_of(q.b));
  EngineSource s;
  s.compile = fmt::format("-I/usr/include/eigen3 -ldart{}", backend.library);
  s.includes = filled(includes, {{"HEADER", std::string(backend.header)}, {"A", a.name}, {"B", b.name}});
  s.code = filled(code, {{"SHAPE_A", a.name + "Shape"},
                         {"SIZES_A", a.sizes},
                         {"POSE_A", "Place" + pose_literal(q.body(q.a).pose)},
                         {"SHAPE_B", b.name + "Shape"},
                         {"SIZES_B", b.sizes},
                         {"POSE_B", "Place" + pose_literal(q.body(q.b).pose)},
                         {"TYPE", std::string(backend.type)},
                         {"SETTING", q.engine == "dart-fcl" ? std::string(setting) : ""},
                         {"QUESTION", question(q)}});
  return s;
}

}  // namespace

SourceWriter dart_source_writer() {
  SourceWriter w{{}, source};
  for (const Backend& b : backends) w.engines.push_back(b.engine);
  return w;
}

}  // namespace touchstone::fuzz
