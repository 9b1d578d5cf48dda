#include <fmt/format.h>

#include "core/base/input_error.h"
#include "oracles/reproducer/engine_source.h"
#include "oracles/reproducer/source_text.h"

namespace touchstone::fuzz {
namespace {

std::string points(const std::vector<Vec3>& vertices) {
  std::string out;
  for (const Vec3& v : vertices) out += fmt::format("\n      {{{}}},", literals(v));
  return out;
}

std::string triples(const std::vector<std::array<int, 3>>& faces, std::string_view before) {
  std::string out;
  for (const auto& f : faces)
    out += fmt::format("\n      {}{}, {}, {}{}", before, f[0], f[1], f[2], before == "{" ? "}," : ",");
  return out;
}

struct Maker {
  std::string operator()(const Sphere& s) const {
    return fmt::format("std::make_shared<fcl::Sphered>({})", literal(s.radius));
  }
  std::string operator()(const Box& s) const {
    return fmt::format("std::make_shared<fcl::Boxd>({})", literals(2 * s.half_extents));
  }
  std::string operator()(const Capsule& s) const { return round("Capsule", s.radius, s.half_height); }
  std::string operator()(const Cylinder& s) const { return round("Cylinder", s.radius, s.half_height); }
  std::string operator()(const Cone& s) const { return round("Cone", s.radius, s.half_height); }
  std::string operator()(const Ellipsoid& s) const {
    return fmt::format("std::make_shared<fcl::Ellipsoidd>({})", literals(s.semi_axes));
  }
  std::string operator()(const Hull& s) const {
    return fmt::format("convex({{{}}}, {{{}}}, {})", points(s.vertices), triples(s.faces, "3, "),
                       s.faces.size());
  }
  std::string operator()(const HalfSpace& s) const {
    return fmt::format("std::make_shared<fcl::Halfspaced>(fcl::Vector3d({}), {})", literals(s.normal),
                       literal(s.offset));
  }
  std::string operator()(const TriangleMesh& s) const {
    return fmt::format("mesh({{{}}}, {{{}}})", points(s.vertices), triples(s.triangles, "{"));
  }
  template <class S>
  std::string operator()(const S&) const {
    throw InputError("reproduce",
                     fmt::format("FCL has no {}: no program that checks this fault is written", S::type));
  }
  static std::string round(std::string_view name, double radius, double half) {
    return fmt::format("std::make_shared<fcl::{}d>({}, {})", name, literal(radius), literal(2 * half));
  }
};

constexpr std::string_view shape_helpers = R"(using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

[[maybe_unused]] Geometry convex(const std::vector<fcl::Vector3d>& vertices, const std::vector<int>& faces, int count) {
  return std::make_shared<fcl::Convexd>(std::make_shared<const std::vector<fcl::Vector3d>>(vertices), count,
                                        std::make_shared<const std::vector<int>>(faces));
}

[[maybe_unused]] Geometry mesh(const std::vector<fcl::Vector3d>& vertices,
                               const std::vector<std::array<std::size_t, 3>>& faces) {
  auto m = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  std::vector<fcl::Triangle> triangles;
  for (const auto& f : faces) triangles.emplace_back(f[0], f[1], f[2]);
  m->beginModel();
  m->addSubModel(vertices, triangles);
  m->endModel();
  return m;
}

fcl::Transform3d transform(const Placement& p) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) t.linear()(i, j) = p.rotation[3 * i + j];
    t.translation()[i] = p.translation[i];
  }
  return t;
}

[[maybe_unused]] Vec vec(const fcl::Vector3d& v) { return {v[0], v[1], v[2]}; }

)";

constexpr std::string_view contact_helper =
    R"(// The deepest contact. FCL puts a mesh first, whatever the order of the arguments; the normal is reversed then.
Answer contact(const fcl::CollisionGeometryd* a, const fcl::Transform3d& ta, const fcl::CollisionGeometryd* b,
               const fcl::Transform3d& tb) {
  fcl::CollisionRequestd request;
  request.gjk_solver_type = fcl::@SOLVER@;
  request.gjk_tolerance = @TOLERANCE@;
  request.enable_contact = true;
  request.num_max_contacts = 256;
  fcl::CollisionResultd result;
  fcl::collide(a, ta, b, tb, request, result);
  Answer x;
  x.overlap = result.isCollision();
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    const fcl::Contactd& c = result.getContact(i);
    x.points.push_back(vec(c.pos));
    if (x.depth >= c.penetration_depth) continue;
    x.depth = c.penetration_depth;
    const bool swapped = c.o1 == b && c.o2 == a && a != b;
    x.normal = vec(swapped ? fcl::Vector3d(-c.normal) : fcl::Vector3d(c.normal));
  }
@REFINE@  return x;
}

)";

constexpr std::string_view refine = R"(  if (x.overlap) {  // normal and depth from the signed distance
    fcl::DistanceRequestd exact(/*enable_nearest_points=*/true, /*enable_signed_distance=*/true);
    exact.distance_tolerance = 1e-7;
    exact.gjk_solver_type = fcl::@SOLVER@;
    fcl::DistanceResultd d;
    fcl::distance(a, ta, b, tb, exact, d);
    const fcl::Vector3d across = d.nearest_points[0] - d.nearest_points[1];
    if (d.min_distance < 0 && across.norm() > 0) {
      x.normal = vec(across / across.norm());
      x.depth = -d.min_distance;
    }
  }
)";

constexpr std::string_view ask_overlap = R"(Answer ask() {
  fcl::CollisionRequestd request;
  request.gjk_solver_type = fcl::@SOLVER@;
  request.gjk_tolerance = @TOLERANCE@;
  fcl::CollisionResultd result;
  fcl::collide(shape_a.get(), transform(at_a), shape_b.get(), transform(at_b), request, result);
  Answer x;
  x.overlap = result.isCollision();
  return x;
}
)";

constexpr std::string_view ask_contact =
    R"(Answer ask() { return contact(shape_a.get(), transform(at_a), shape_b.get(), transform(at_b)); }
)";

constexpr std::string_view ask_distance = R"(Answer ask() {
  fcl::DistanceRequestd request(/*enable_nearest_points=*/true, /*enable_signed_distance=*/@SIGNED@);
  request.distance_tolerance = @TOLERANCE@;
  request.gjk_solver_type = fcl::@SOLVER@;
  fcl::DistanceResultd result;
  fcl::distance(shape_a.get(), transform(at_a), shape_b.get(), transform(at_b), request, result);
@AGAIN@  // FCL puts a mesh first, whatever the order of the arguments, and its nearest point too.
  if (result.o1 == shape_b.get()) std::swap(result.nearest_points[0], result.nearest_points[1]);
  Answer x;
  x.distance = result.min_distance;
  x.overlap = x.distance <= 0;
  x.points = {vec(result.nearest_points[0]), vec(result.nearest_points[1])};
  return x;
}
)";

constexpr std::string_view distance_again =
    R"(  if (result.min_distance < 0) {  // the unsigned query reports an overlap, but not its depth
    fcl::DistanceRequestd exact(/*enable_nearest_points=*/true, /*enable_signed_distance=*/true);
    exact.distance_tolerance = 1e-7;
    exact.gjk_solver_type = fcl::@SOLVER@;
    result = fcl::DistanceResultd();
    fcl::distance(shape_a.get(), transform(at_a), shape_b.get(), transform(at_b), exact, result);
  }
)";

constexpr std::string_view ask_impact = R"(const Placement end_a = @END_A@;
const Placement end_b = @END_B@;

Answer ask() {
  fcl::ContinuousCollisionRequestd request;
  request.gjk_solver_type = fcl::@SOLVER@;
  fcl::ContinuousCollisionResultd result;
@CALL@  Answer x;
  x.hit = result.is_collide;
  if (x.hit) x.impact = result.time_of_contact;
  return x;
}
)";

constexpr std::string_view naive_call = R"(  request.ccd_motion_type = fcl::@MOTION@;
  fcl::continuousCollide(shape_a.get(), transform(at_a), transform(end_a), shape_b.get(), transform(at_b),
                         transform(end_b), request, result);
)";

constexpr std::string_view advancing_call = R"(  request.ccd_motion_type = fcl::CCDM_LINEAR;
  request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  const auto motion = [](const Placement& from, const Placement& to) {
    const fcl::Transform3d p = transform(from), q = transform(to);
    return fcl::InterpMotion<double>(p.linear(), p.translation(), q.linear(), q.translation(), fcl::Vector3d::Zero());
  };
  const auto move_a = motion(at_a, end_a), move_b = motion(at_b, end_b);
  fcl::continuousCollide(shape_a.get(), &move_a, shape_b.get(), &move_b, request, result);
)";

// Scripts: one object per body, statements per step.
constexpr std::string_view scene_head = R"(const Geometry shapes[] = {@SHAPES@
};

Answer ask() {
  Answer x;
  fcl::DynamicAABBTreeCollisionManagerd manager;
  std::unique_ptr<fcl::CollisionObjectd> object[@COUNT@];
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> former;  // the manager may still refer to them
  const auto insert = [&](int i, int shape, const Placement& at) {
    if (object[i]) former.push_back(std::move(object[i]));
    object[i] = std::make_unique<fcl::CollisionObjectd>(shapes[shape], transform(at));
    object[i]->computeAABB();
    manager.registerObject(object[i].get());
  };
  [[maybe_unused]] const auto move = [&](int i, const Placement& at) {
    object[i]->setTransform(transform(at));
    object[i]->computeAABB();
    manager.update(object[i].get());
  };
  [[maybe_unused]] const auto remove = [&](int i) { manager.unregisterObject(object[i].get()); };
)";

// The managers as separate engines, under the names used for certification: the initial objects are
// registered in one call, update() is called once after moves, setup() before a query.
constexpr std::string_view manager_head = R"(const Geometry shapes[] = {@SHAPES@
};

Answer ask() {
  Answer x;
  @MANAGER@;
  std::unique_ptr<fcl::CollisionObjectd> object[@COUNT@];
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> former;  // the manager may still refer to them
  std::vector<fcl::CollisionObjectd*> first;
  bool started = false, moved = false;
  const auto start = [&] {
    if (started) return;
    started = true;
    manager.registerObjects(first);
    manager.setup();
  };
  const auto update = [&] {
    if (moved) manager.update();
    moved = false;
  };
  const auto insert = [&](int i, int shape, const Placement& at) {
    update();
    if (object[i]) former.push_back(std::move(object[i]));
    object[i] = std::make_unique<fcl::CollisionObjectd>(shapes[shape], transform(at));
    object[i]->computeAABB();
    if (started)
      manager.registerObject(object[i].get());
    else
      first.push_back(object[i].get());
  };
  [[maybe_unused]] const auto move = [&](int i, const Placement& at) {
    start();
    object[i]->setTransform(transform(at));
    object[i]->computeAABB();
    @MOVED@;
  };
  [[maybe_unused]] const auto remove = [&](int i) {
    update();
    start();
    manager.unregisterObject(object[i].get());
  };
)";

// Follows either head.
constexpr std::string_view script_query = R"(  struct Wanted {
    const fcl::CollisionObjectd *a, *b;
    bool found;
  } wanted{};
  const auto query = [&] {
    wanted = {object[@A@].get(), object[@B@].get(), false};
@BEFORE@    manager.setup();
    manager.collide(&wanted, [](fcl::CollisionObjectd* one, fcl::CollisionObjectd* two, void* data) {
      Wanted& w = *static_cast<Wanted*>(data);
      w.found = w.found || (one == w.a && two == w.b) || (one == w.b && two == w.a);
      return false;
    });
  };
)";

// Whether a read of freed memory has a visible effect depends on what the heap did with it; this makes it
// visible.
constexpr std::string_view freed_is_overwritten = R"(#include <malloc.h>

#include <cstdlib>
#include <new>

// Overwrites freed memory, so that a use after free becomes visible.
void operator delete[](void* p) noexcept {
  volatile unsigned char* bytes = static_cast<unsigned char*>(p);
  for (std::size_t i = 0, n = malloc_usable_size(p); i < n; ++i) bytes[i] = 0xff;
  std::free(p);
}
void operator delete[](void* p, std::size_t) noexcept { operator delete[](p); }
void* operator new[](std::size_t n) {
  if (void* p = std::malloc(n > 0 ? n : 1)) return p;
  throw std::bad_alloc();
}
)";

struct ManagerRow {
  std::string_view engine, declaration;
};
constexpr ManagerRow managers[] = {
    {"fcl-naive", "fcl::NaiveCollisionManagerd manager"},
    {"fcl-sap", "fcl::SaPCollisionManagerd manager"},
    {"fcl-ssap", "fcl::SSaPCollisionManagerd manager"},
    {"fcl-interval-tree", "fcl::IntervalTreeCollisionManagerd manager"},
    {"fcl-spatial-hash",
     "fcl::SpatialHashingCollisionManagerd<> manager(1.0, fcl::Vector3d::Constant(-1000), "
     "fcl::Vector3d::Constant(1000))"},
    {"fcl-dynamic-tree", "fcl::DynamicAABBTreeCollisionManagerd manager"},
    {"fcl-dynamic-tree-array", "fcl::DynamicAABBTreeCollisionManager_Arrayd manager"},
};
constexpr std::string_view one_by_one = "-update-one";  // suffix of engines that call update(object)

std::string manager_of(std::string_view engine) {
  if (engine.ends_with(one_by_one)) engine.remove_suffix(one_by_one.size());
  for (const ManagerRow& row : managers)
    if (row.engine == engine) return std::string(row.declaration);
  return "";
}

// The settings used by campaigns: as shipped, or tuned.
std::string tolerance(const EngineQuestion& q) { return q.tuned() ? "1e-12" : "1e-6"; }
std::string solver(const EngineQuestion& q) {
  return q.engine.starts_with("fcl-indep") ? "GST_INDEP" : "GST_LIBCCD";
}
bool libccd(const EngineQuestion& q) { return !q.engine.starts_with("fcl-indep"); }

std::string pair_head(const EngineQuestion& q) {
  return fmt::format(
      "const Geometry shape_a = {};\nconst Geometry shape_b = {};\nconst Placement at_a = {};\nconst "
      "Placement at_b = "
      "{};\n\n",
      std::visit(Maker{}, q.scene.shape_of(q.a)), std::visit(Maker{}, q.scene.shape_of(q.b)),
      pose_literal(q.body(q.a).pose), pose_literal(q.body(q.b).pose));
}

std::string contact_function(const EngineQuestion& q) {
  const bool refined =
      q.tuned() && libccd(q) && has_support(q.scene.shape_of(q.a)) && has_support(q.scene.shape_of(q.b));
  return filled(
      contact_helper,
      {{"REFINE", refined ? std::string(refine) : ""}, {"SOLVER", solver(q)}, {"TOLERANCE", tolerance(q)}});
}

std::string impact(const EngineQuestion& q) {
  const auto motion = [&](int i) { return q.body(i).motion.value_or(Motion{}); };
  const auto end = [&](int i) { return pose_literal(pose_at(q.body(i).pose, motion(i), 1)); };
  const bool turns = !motion(q.a).angular.isZero(0) || !motion(q.b).angular.isZero(0);
  const std::string call = q.tuned() ? std::string(advancing_call)
                                     : filled(naive_call, {{"MOTION", turns ? "CCDM_LINEAR" : "CCDM_TRANS"}});
  return filled(ask_impact,
                {{"END_A", end(q.a)}, {"END_B", end(q.b)}, {"CALL", call}, {"SOLVER", solver(q)}});
}

std::string distance(const EngineQuestion& q) {
  const bool again = q.tuned() && libccd(q);
  return filled(ask_distance, {{"SIGNED", q.tuned() ? "false" : "true"},
                               {"TOLERANCE", tolerance(q)},
                               {"AGAIN", again ? std::string(distance_again) : ""},
                               {"SOLVER", solver(q)}});
}

// update(object) after each move, or update() once after the moves.
std::string manager_text(std::string_view engine) {
  return filled(manager_head, {{"MANAGER", manager_of(engine)},
                               {"MOVED", engine.ends_with(one_by_one) ? "manager.update(object[i].get())"
                                                                      : "moved = true"}});
}

std::string scene(const EngineQuestion& q) {
  std::string shapes, out;
  for (const Shape& s : q.scene.shapes) shapes += fmt::format("\n    {},", std::visit(Maker{}, s));
  const bool managed = !manager_of(q.engine).empty();
  out = filled((managed ? manager_text(q.engine) : std::string(scene_head)) + std::string(script_query),
               {{"SHAPES", shapes},
                {"BEFORE", managed ? "    start();\n    update();\n" : ""},
                {"COUNT", std::to_string(q.scene.bodies.size())},
                {"A", std::to_string(q.a)},
                {"B", std::to_string(q.b)}});
  if (q.question == Question::scene_contacts) {
    for (std::size_t i = 0; i < q.scene.bodies.size(); ++i)
      out += fmt::format("  insert({}, {}, {});\n", i, q.scene.bodies[i].shape,
                         pose_literal(q.scene.bodies[i].pose));
    return out + fmt::format(
                     "  query();\n  if (!wanted.found) return x;\n"
                     "  const auto &a = *object[{}], &b = *object[{}];\n"
                     "  return contact(a.collisionGeometry().get(), a.getTransform(), "
                     "b.collisionGeometry().get(), b.getTransform());\n}}\n",
                     q.a, q.b);
  }
  int k = 0;
  for (const Step& step : effective_script(q.scene)) {
    const Body* b = step.body >= 0 ? &q.body(step.body) : nullptr;
    if (step.op == Step::Op::insert)
      out += fmt::format("  insert({}, {}, {});\n", step.body, b->shape,
                         pose_literal(step.pose.value_or(b->pose)));
    if (step.op == Step::Op::move)
      out += fmt::format("  move({}, {});\n", step.body, pose_literal(*step.pose));
    if (step.op == Step::Op::remove) out += fmt::format("  remove({});\n", step.body);
    if (step.op != Step::Op::query) continue;
    out += "  query();\n";
    if (k++ == q.step) break;
  }
  return out + "  x.overlap = wanted.found;\n  return x;\n}\n";
}

EngineSource source(const EngineQuestion& q) {
  EngineSource out;
  out.compile = "-I/usr/include/eigen3 -lfcl -lccd";
  out.includes = "#include <fcl/fcl.h>\n\n#include <memory>\n";
  if (q.engine == "fcl-dynamic-tree-array") out.includes += freed_is_overwritten;
  out.code = std::string(shape_helpers);
  const bool pair = is_pair_question(q.question);
  if (pair) out.code += pair_head(q);
  if (q.question == Question::contact || q.question == Question::scene_contacts)
    out.code += contact_function(q);
  if (!pair) out.code += scene(q);
  if (q.question == Question::overlap)
    out.code += filled(ask_overlap, {{"SOLVER", solver(q)}, {"TOLERANCE", tolerance(q)}});
  if (q.question == Question::contact) out.code += ask_contact;
  if (q.question == Question::distance) out.code += distance(q);
  if (q.question == Question::time_of_impact) out.code += impact(q);
  return out;
}

}  // namespace

SourceWriter fcl_source_writer() { return {{"fcl-"}, source}; }

}  // namespace touchstone::fuzz
