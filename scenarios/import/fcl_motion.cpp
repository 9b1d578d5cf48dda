#include "scenarios/import/fcl_motion.h"

#include <cmath>

#include "core/base/input_error.h"
#include "scenarios/import/mesh_import.h"
#include "scenarios/import/text_lines.h"

namespace touchstone {
namespace {

// The worst printed rotation of the set is off by 1e-6 in R^T R - 1; a hundred times that is not explained by
// rounding.
constexpr double max_rotation_defect = 1e-4;

Placement read_placement(const TextLines& in, std::size_t first) {
  Placement p;
  p.translation = in.vec3(first);
  for (int i = 0; i < 9; ++i) p.matrix(i / 3, i % 3) = in.number(first + 3 + static_cast<std::size_t>(i));
  const double defect = (p.matrix.transpose() * p.matrix - Mat3::Identity()).cwiseAbs().maxCoeff();
  if (defect > max_rotation_defect || p.matrix.determinant() < 0) in.fail("the matrix is not a rotation");
  return p;
}

}  // namespace

Quat quaternion_of(const Mat3& r) {
  const double trace = r.trace();
  Quat q;
  if (trace >= r.diagonal().maxCoeff()) {
    q = {r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1), 1 + trace};
  } else if (r(0, 0) >= r(1, 1) && r(0, 0) >= r(2, 2)) {
    q = {1 + 2 * r(0, 0) - trace, r(1, 0) + r(0, 1), r(2, 0) + r(0, 2), r(2, 1) - r(1, 2)};
  } else if (r(1, 1) >= r(2, 2)) {
    q = {r(1, 0) + r(0, 1), 1 + 2 * r(1, 1) - trace, r(2, 1) + r(1, 2), r(0, 2) - r(2, 0)};
  } else {
    q = {r(2, 0) + r(0, 2), r(2, 1) + r(1, 2), 1 + 2 * r(2, 2) - trace, r(1, 0) - r(0, 1)};
  }
  return normalized(q);
}

Scene FclMotion::frame(int f) const {
  if (f < 0 || f >= frame_count())
    throw InputError(name,
                     "frame " + std::to_string(f) + " is outside 0.." + std::to_string(frame_count() - 1));
  const FclFrame& at = frames[static_cast<std::size_t>(f)];
  Scene s;
  s.name = name + "/" + std::to_string(f);
  s.shapes = {mesh_a, mesh_b};
  for (const Placement* p : {&at.a, &at.b}) {
    Body b;
    b.shape = static_cast<int>(s.bodies.size());
    b.pose = {p->translation, quaternion_of(p->matrix)};
    b.is_static = true;
    s.bodies.push_back(b);
  }
  return s;
}

FclMotion load_fcl_motion(const std::filesystem::path& directory) {
  FclMotion m;
  m.name = directory.filename().string();
  m.mesh_a = load_mesh(directory / "obj1.obj");
  m.mesh_b = load_mesh(directory / "obj2.obj");
  TextLines in(directory / "frames.csv", ',');
  in.need_header(
      "frame,time,p1x,p1y,p1z,r1_00,r1_01,r1_02,r1_10,r1_11,r1_12,r1_20,r1_21,r1_22,p2x,p2y,p2z,r2_00,r2_01,"
      "r2_02,"
      "r2_10,r2_11,r2_12,r2_20,r2_21,r2_22");
  while (in.next()) {
    in.need_tokens(26);
    m.frames.push_back({in.number(1), read_placement(in, 2), read_placement(in, 14)});
  }
  return m;
}

}  // namespace touchstone
