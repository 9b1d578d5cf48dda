#include <fmt/format.h>

#include "core/base/input_error.h"
#include "oracles/reproducer/engine_source.h"
#include "oracles/reproducer/source_text.h"

namespace touchstone::fuzz {
namespace {

constexpr std::string_view code = R"(// ODE takes a unit quaternion, w first.
[[maybe_unused]] void place(dGeomID g, const double (&q)[4], const Vec& at) {
  double most = 0;
  for (const double c : q) most = std::fmax(most, std::fabs(c));
  dQuaternion unit = {q[3] / most, q[0] / most, q[1] / most, q[2] / most};
  dNormalize4(unit);
  dGeomSetQuaternion(g, unit);
  dGeomSetPosition(g, at[0], at[1], at[2]);
}

struct Wanted {
  dGeomID a, b;
  bool found;
};
[[maybe_unused]] void on_pair(void* data, dGeomID one, dGeomID two) {
  Wanted& w = *static_cast<Wanted*>(data);
  w.found = w.found || (one == w.a && two == w.b) || (one == w.b && two == w.a);
}

Answer ask() {
  dInitODE2(0);
  dAllocateODEDataForThread(dAllocateMaskAll);
  Answer x;
@BODY@  return x;
}
)";

std::string create(const Shape& shape) {
  if (const auto* s = std::get_if<Sphere>(&shape))
    return fmt::format("dCreateSphere(nullptr, {})", literal(s->radius));
  if (const auto* s = std::get_if<Box>(&shape))
    return fmt::format("dCreateBox(nullptr, {})", literals(2 * s->half_extents));
  if (const auto* s = std::get_if<Capsule>(&shape))
    return fmt::format("dCreateCapsule(nullptr, {}, {})", literal(s->radius), literal(2 * s->half_height));
  if (const auto* s = std::get_if<Cylinder>(&shape))
    return fmt::format("dCreateCylinder(nullptr, {}, {})", literal(s->radius), literal(2 * s->half_height));
  throw InputError("reproduce", "for ODE only spheres, boxes, capsules and cylinders can be written");
}

std::string geom(const EngineQuestion& q, int i) {
  return fmt::format("  dGeomID geom_{} = {};\n", i, create(q.scene.shape_of(i)));
}

std::string place(int i, const Pose& p) {
  const Quat& r = p.rotation;
  return fmt::format("  place(geom_{}, {{{}, {}, {}, {}}}, {{{}}});\n", i, literal(r.x), literal(r.y),
                     literal(r.z), literal(r.w), literals(p.translation));
}

std::string pair_question(const EngineQuestion& q) {
  std::string out;
  for (const int i : {q.a, q.b}) out += geom(q, i) + place(i, q.body(i).pose);
  return out + fmt::format(R"(  dContactGeom all[64];
  const int n = dCollide(geom_{}, geom_{}, 64, all, sizeof all[0]);
  x.overlap = n > 0;
  for (int i = 0; i < n; ++i) {{
    const dContactGeom& c = all[i];
    x.points.push_back({{c.pos[0], c.pos[1], c.pos[2]}});
    if (c.depth > x.depth) {{  // ODE's normal points from the second geometry into the first
      x.depth = c.depth;
      x.normal = {{-c.normal[0], -c.normal[1], -c.normal[2]}};
    }}
  }}
)",
                           q.a, q.b);
}

std::string space_of(std::string_view engine) {
  if (engine == "ode-hash") return "dHashSpaceCreate(nullptr)";
  if (engine == "ode-sap") return "dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ)";
  if (engine == "ode-simple") return "dSimpleSpaceCreate(nullptr)";
  return "dQuadTreeSpaceCreate(nullptr, centre, extents, 6)";
}

std::string candidates(const EngineQuestion& q) {
  std::string out;
  for (std::size_t i = 0; i < q.scene.bodies.size(); ++i)
    out += geom(q, static_cast<int>(i)) + place(static_cast<int>(i), q.scene.bodies[i].pose);
  if (q.engine == "ode-quadtree") out += "  const dVector3 centre = {}, extents = {1000, 1000, 1000};\n";
  out += fmt::format("  dSpaceID space = {};\n  Wanted wanted{{geom_{}, geom_{}, false}};\n",
                     space_of(q.engine), q.a, q.b);
  int k = 0;
  for (const Step& s : effective_script(q.scene)) {
    if (s.op == Step::Op::query) {
      out += "  wanted.found = false;\n  dSpaceCollide(space, &wanted, on_pair);\n";
      if (k++ == q.step) break;
      continue;
    }
    if (s.op == Step::Op::remove) out += fmt::format("  dSpaceRemove(space, geom_{});\n", s.body);
    if (s.op != Step::Op::remove) out += place(s.body, s.pose.value_or(q.body(s.body).pose));
    if (s.op == Step::Op::insert) out += fmt::format("  dSpaceAdd(space, geom_{});\n", s.body);
  }
  return out + "  x.overlap = wanted.found;\n";
}

EngineSource source(const EngineQuestion& q) {
  EngineSource s;
  s.compile = "-DdIDEDOUBLE -lode";
  s.includes = "#include <ode/ode.h>\n";
  s.code = filled(code, {{"BODY", q.question == Question::candidates ? candidates(q) : pair_question(q)}});
  return s;
}

}  // namespace

SourceWriter ode_source_writer() { return {{"ode", "ode-"}, source}; }

}  // namespace touchstone::fuzz
