#include "oracles/dart/shapes.h"

#include <algorithm>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/CapsuleShape.hpp>
#include <dart/dynamics/ConeShape.hpp>
#include <dart/dynamics/CylinderShape.hpp>
#include <dart/dynamics/EllipsoidShape.hpp>
#include <dart/dynamics/PlaneShape.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <memory>

namespace touchstone::dart_adapter {
namespace {

namespace dynamics = dart::dynamics;

bool has_positive_sizes(const ts_shape& s, int count) {
  return std::all_of(s.size, s.size + count, [](double x) { return x > 0; });
}

// Shape's setters assert positive sizes.
bool has_size(const ts_shape& s) {
  switch (s.kind) {
    case TS_SPHERE:
      return has_positive_sizes(s, 1);
    case TS_CAPSULE:
    case TS_CYLINDER:
    case TS_CONE:
      return has_positive_sizes(s, 2);
    case TS_BOX:
    case TS_ELLIPSOID:
      return has_positive_sizes(s, 3);
    default:
      return s.kind == TS_HALF_SPACE;
  }
}

struct KindRow {
  int kind;
  const char* name;
};
constexpr KindRow kind_rows[] = {{TS_SPHERE, "sphere"},        {TS_BOX, "box"},   {TS_CAPSULE, "capsule"},
                                 {TS_CYLINDER, "cylinder"},    {TS_CONE, "cone"}, {TS_ELLIPSOID, "ellipsoid"},
                                 {TS_HALF_SPACE, "half_space"}};

}  // namespace

std::vector<std::string> shapes_of(Backend backend) {
  switch (backend) {
    case Backend::own:
      return {"sphere", "box"};
    case Backend::fcl:
      return {"sphere", "box", "cylinder", "ellipsoid", "half_space"};
    case Backend::fcl_mesh:  // a half-space becomes a square of side 1000
      return {"sphere", "box", "cylinder", "ellipsoid"};
    case Backend::bullet:  // an ellipsoid becomes a mesh that cannot be read back
      return {"sphere", "box", "capsule", "cylinder", "cone", "half_space"};
    case Backend::ode:
      return {"sphere", "box", "capsule", "cylinder", "half_space"};
  }
  return {};
}

bool takes(Backend backend, const ts_shape& s) {
  const auto row = std::ranges::find(kind_rows, s.kind, &KindRow::kind);
  if (row == std::end(kind_rows)) return false;
  const std::vector<std::string> names = shapes_of(backend);
  return std::ranges::find(names, row->name) != names.end() && has_size(s);
}

dynamics::ShapePtr make_shape(Backend backend, const ts_shape& s) {
  if (!takes(backend, s)) return nullptr;
  const double* z = s.size;
  const Vec3 sizes = kit::vec3(z);
  switch (s.kind) {
    case TS_SPHERE:
      return std::make_shared<dynamics::SphereShape>(z[0]);
    case TS_BOX:
      return std::make_shared<dynamics::BoxShape>(2 * sizes);
    case TS_CAPSULE:
      return std::make_shared<dynamics::CapsuleShape>(z[0], 2 * z[1]);
    case TS_CYLINDER:
      return std::make_shared<dynamics::CylinderShape>(z[0], 2 * z[1]);
    case TS_CONE:
      return std::make_shared<dynamics::ConeShape>(z[0], 2 * z[1]);
    case TS_ELLIPSOID:
      return std::make_shared<dynamics::EllipsoidShape>(2 * sizes);
    default: {
      const double length = sizes.stableNorm();
      return std::make_shared<dynamics::PlaneShape>(Vec3(sizes / length), z[3] / length);
    }
  }
}

dynamics::SimpleFramePtr make_frame(const dynamics::ShapePtr& shape, const ts_pose& pose) {
  const Pose p = kit::pose_of(pose);
  Eigen::Isometry3d placed = Eigen::Isometry3d::Identity();
  placed.linear() = rotation_matrix(p.rotation);
  placed.translation() = p.translation;
  auto frame = dynamics::SimpleFrame::createShared(dynamics::Frame::World(), "body", placed);
  frame->setShape(shape);
  return frame;
}

void report_body(int index, Backend backend, const dynamics::SimpleFrame& frame, const ts_received& to) {
  const Eigen::Isometry3d& held = frame.getWorldTransform();
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = held.linear();
  Vec3 translation = held.translation();
  if (backend == Backend::bullet) {
    rows = rows.cast<float>().cast<double>();
    translation = translation.cast<float>().cast<double>();
  }
  to.body(to.ctx, index, rows.data(), translation.data());
}

void report_floats(int index, const ts_shape& s, const ts_received& to) {
  double held[4] = {s.size[0], s.size[1], s.size[2], s.size[3]};
  if (s.kind == TS_HALF_SPACE) {
    const double length = kit::vec3(s.size).stableNorm();
    for (double& x : held) x /= length;
  }
  for (double& x : held) x = static_cast<float>(x);
  to.shape(to.ctx, index, held, nullptr, 0);
}

}  // namespace touchstone::dart_adapter
