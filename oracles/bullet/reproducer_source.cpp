#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/base/input_error.h"
#include "oracles/abi/height_field.h"
#include "oracles/reproducer/engine_source.h"
#include "oracles/reproducer/source_text.h"

namespace touchstone::fuzz {
namespace {

std::string scalar(double x) { return fmt::format("btScalar({})", literal(x)); }
// The declaration of the broad phase, for engines that are a broad phase only; otherwise empty.
std::string phase_of(const EngineQuestion& q);

std::string vector(const Vec3& v) {
  return fmt::format("btVector3({}, {}, {})", scalar(v.x()), scalar(v.y()), scalar(v.z()));
}
std::string transform(const Pose& p) {
  const Quat q = normalized(p.rotation);
  return fmt::format("btTransform(btQuaternion({}, {}, {}, {}), {})", scalar(q.x), scalar(q.y), scalar(q.z),
                     scalar(q.w), vector(p.translation));
}

// Statements that create `shape_<i>`. The margin is set last, except for a hull, whose AABB is computed with
// the margin that is set when its points are added.
struct Maker {
  std::size_t i;
  bool tuned;
  std::string plain(const std::string& type, const std::string& arguments, bool margin = true) const {
    return fmt::format("  {0} shape_{1}({2});\n{3}", type, i, arguments,
                       tuned && margin ? fmt::format("  shape_{}.setMargin(0);\n", i) : "");
  }
  std::string margin(double m) const { return fmt::format("  shape_{}.setMargin({});\n", i, scalar(m)); }
  std::string hull(const std::vector<Vec3>& vertices, const std::string& with_margin) const {
    std::string out = fmt::format("  btConvexHullShape shape_{};\n", i) + with_margin;
    for (const Vec3& v : vertices) out += fmt::format("  shape_{}.addPoint({}, false);\n", i, vector(v));
    return out + fmt::format("  shape_{}.recalcLocalAabb();\n", i);
  }
  std::string operator()(const Sphere& s) const { return plain("btSphereShape", scalar(s.radius), false); }
  std::string operator()(const Capsule& s) const {
    return plain("btCapsuleShapeZ", scalar(s.radius) + ", 2 * " + scalar(s.half_height), false);
  }
  std::string operator()(const Box& s) const { return plain("btBoxShape", vector(s.half_extents)); }
  std::string operator()(const Cylinder& s) const {
    return plain("btCylinderShapeZ", vector({s.radius, s.radius, s.half_height}));
  }
  std::string operator()(const Cone& s) const {
    return plain("btConeShapeZ", scalar(s.radius) + ", 2 * " + scalar(s.half_height));
  }
  std::string operator()(const HalfSpace& s) const {
    const double length = s.normal.stableNorm();
    return plain("btStaticPlaneShape", vector(s.normal / length) + ", " + scalar(s.offset / length));
  }
  std::string operator()(const Hull& s) const {
    return hull(s.vertices, tuned ? fmt::format("  shape_{}.setMargin(0);\n", i) : "");
  }
  // A padding is the margin, also of a tuned engine.
  std::string operator()(const RoundedBox& s) const {
    std::vector<Vec3> corners;
    for (const double x : {-1, 1})
      for (const double y : {-1, 1})
        for (const double z : {-1, 1}) corners.emplace_back(s.half_extents.cwiseProduct(Vec3(x, y, z)));
    return hull(corners, margin(s.radius));
  }
  std::string operator()(const Padded<Hull>& s) const { return hull(s.inner.vertices, margin(s.padding)); }
  std::string operator()(const Padded<Cylinder>& s) const {
    const auto sum = [&](double x) { return scalar(x) + " + " + scalar(s.padding); };
    return plain("btCylinderShapeZ",
                 fmt::format("btVector3({0}, {0}, {1})", sum(s.inner.radius), sum(s.inner.half_height)),
                 false) +
           margin(s.padding);
  }
  std::string operator()(const Padded<Cone>& s) const {
    return plain("btConeShapeZ", scalar(s.inner.radius) + ", 2 * " + scalar(s.inner.half_height), false) +
           margin(s.padding);
  }
  std::string height_field(const TriangleMesh& s, const kit::HeightField& f) const {
    std::string out = fmt::format("  const btScalar heights_{}[] = {{", i);
    double highest = 0;
    for (const Vec3& v : s.vertices) {
      out += (&v == &s.vertices.front() ? "" : ", ") + scalar(v.z());
      highest = std::max(highest, std::abs(v.z()));
    }
    // The middle of the limits is at the origin.
    return out + "};\n" +
           plain("btHeightfieldTerrainShape", fmt::format("{0}, {1}, heights_{2}, -{3}, {3}, 2, true",
                                                          f.columns, f.rows, i, scalar(highest))) +
           fmt::format("  shape_{}.setLocalScaling({});\n", i, vector({f.cell[0], f.cell[1], 1}));
  }
  std::string operator()(const TriangleMesh& s) const {
    if (const auto field = kit::height_field_of(s)) return height_field(s, *field);
    std::string out = fmt::format("  btTriangleMesh triangles_{};\n", i);
    for (const auto& t : s.triangles) {
      const auto corner = [&](std::size_t k) { return vector(s.vertices[static_cast<std::size_t>(t[k])]); };
      out += fmt::format(
          "  triangles_{}.addTriangle({},\n                           {},\n                           {});\n",
          i, corner(0), corner(1), corner(2));
    }
    return out + plain("btBvhTriangleMeshShape", fmt::format("&triangles_{}, true", i));
  }
  template <class S>
  std::string operator()(const S&) const {
    throw InputError("reproduce", fmt::format("Bullet has no {}", S::type));
  }
};

constexpr std::string_view helpers =
    R"([[maybe_unused]] Vec vec(const btVector3& v) { return {double(v.x()), double(v.y()), double(v.z())}; }

struct World {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btCollisionWorld world{&dispatcher, &broadphase, &configuration};
};

// Bullet's normals point from its body 1 to its body 0; ours from A to B.
[[maybe_unused]] void take(Answer& x, const btManifoldPoint& p, bool swapped) {
  const double distance = p.getDistance();
  if (distance <= 0) x.points.push_back(vec(swapped ? p.getPositionWorldOnA() : p.getPositionWorldOnB()));
  if (distance >= x.distance) return;
  x.distance = distance;
  x.overlap = distance <= 0;
  x.depth = -distance;
  x.normal = vec(swapped ? p.m_normalWorldOnB : -p.m_normalWorldOnB);
  x.on_a = vec(swapped ? p.getPositionWorldOnB() : p.getPositionWorldOnA());
  x.on_b = vec(swapped ? p.getPositionWorldOnA() : p.getPositionWorldOnB());
}

)";

constexpr std::string_view query_helper = R"(struct Collect : btCollisionWorld::ContactResultCallback {
  Answer x;
  const btCollisionObject* a = nullptr;
  btScalar addSingleResult(btManifoldPoint& p, const btCollisionObjectWrapper* zero, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    take(x, p, zero->getCollisionObject() != a);
    return 0;
  }
};

Answer query(btCollisionWorld& world, btCollisionObject& a, btCollisionObject& b) {
  Collect collect;
  collect.a = &a;
  collect.m_closestDistanceThreshold = @THRESHOLD@;
  world.contactPairTest(&a, &b, collect);
  return collect.x;
}

)";

constexpr std::string_view simulate = R"(  w.world.performDiscreteCollisionDetection();
  for (int i = 0; i < w.dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& m = *w.dispatcher.getManifoldByIndexInternal(i);
    const bool straight = m.getBody0() == &@A@ && m.getBody1() == &@B@;
    const bool swapped = m.getBody0() == &@B@ && m.getBody1() == &@A@;
    for (int k = 0; (straight || swapped) && k < m.getNumContacts(); ++k) {
      const btManifoldPoint& p = m.getContactPoint(k);
      @CHILDREN@take(x, p, swapped);
    }
  }
)";

constexpr std::string_view find_pair = R"(  w.world.updateAabbs();
  w.world.computeOverlappingPairs();
  {
    const btBroadphasePairArray& pairs = w.world.getPairCache()->getOverlappingPairArray();
    found = false;
    for (int i = 0; i < pairs.size(); ++i) {
      const void* one = pairs[i].m_pProxy0->m_clientObject;
      const void* two = pairs[i].m_pProxy1->m_clientObject;
      found = found || (one == &object_@A@ && two == &object_@B@) || (one == &object_@B@ && two == &object_@A@);
    }
  }
)";

std::string with_names(std::string_view text, const EngineQuestion& q) {
  return filled(text, {{"A", std::to_string(q.a)}, {"B", std::to_string(q.b)}});
}

std::string object(const EngineQuestion& q, int i) {
  return fmt::format(
      "  btCollisionObject object_{0};\n  object_{0}.setCollisionShape(&shape_{1});\n"
      "  object_{0}.setWorldTransform({2});\n",
      i, q.body(i).shape, transform(q.body(i).pose));
}

std::string shapes_of(const EngineQuestion& q, const std::vector<int>& bodies) {
  std::string out;
  std::vector<int> made;
  for (const int i : bodies) {
    const int s = q.body(i).shape;
    if (std::find(made.begin(), made.end(), s) != made.end()) continue;
    made.push_back(s);
    out += std::visit(Maker{static_cast<std::size_t>(s), q.tuned() || !phase_of(q).empty()},
                      q.scene.shapes[static_cast<std::size_t>(s)]);
  }
  return out;
}

bool is_sim(const EngineQuestion& q) { return q.engine.find("-sim") != std::string_view::npos; }

// The object that has a body's shape, and the number of the shape if the object is a compound.
struct Holder {
  std::string object;
  int child = -1;
};

std::string simulated(const Holder& a, const Holder& b) {
  std::string children;
  const auto only = [&](const Holder& h, std::string_view index, std::string_view other) {
    if (h.child >= 0)
      children += fmt::format("if ((swapped ? p.{} : p.{}) != {}) continue;\n      ", other, index, h.child);
  };
  only(a, "m_index0", "m_index1");
  only(b, "m_index1", "m_index0");
  return filled(simulate, {{"A", a.object}, {"B", b.object}, {"CHILDREN", children}});
}

std::string pair_question(const EngineQuestion& q) {
  std::string out = shapes_of(q, {q.a, q.b}) + object(q, q.a) + object(q, q.b);
  if (is_sim(q))
    return out +
           fmt::format(
               "  w.world.addCollisionObject(&object_{});\n  w.world.addCollisionObject(&object_{});\n", q.a,
               q.b) +
           simulated({"object_" + std::to_string(q.a)}, {"object_" + std::to_string(q.b)}) +
           fmt::format(
               "  w.world.removeCollisionObject(&object_{});\n  w.world.removeCollisionObject(&object_{});\n",
               q.a, q.b);
  return out + fmt::format("  x = query(w.world, object_{}, object_{});\n", q.a, q.b);
}

// Sweeps one body against the other at rest, as the adapter does: the one that rotates, or the convex one.
std::string impact(const EngineQuestion& q) {
  const auto motion = [&](int i) { return q.body(i).motion.value_or(Motion{}); };
  const bool sweep_b = !motion(q.b).angular.isZero(0) || !has_support(q.scene.shape_of(q.a));
  const int mover = sweep_b ? q.b : q.a, target = sweep_b ? q.a : q.b;
  Motion relative = motion(mover);
  relative.linear -= motion(target).linear;
  const Pose start = q.body(mover).pose;
  return shapes_of(q, {q.a, q.b}) + object(q, target) +
         fmt::format(R"(  w.world.addCollisionObject(&object_{0});
  const btTransform from = {1};
  const btTransform to = {2};
  btCollisionWorld::ClosestConvexResultCallback closest(from.getOrigin(), to.getOrigin());
  w.world.convexSweepTest(&shape_{3}, from, to, closest);
  w.world.removeCollisionObject(&object_{0});
  x.hit = closest.hasHit();
  if (x.hit) x.impact = closest.m_closestHitFraction;
)",
                     target, transform(start), transform(pose_at(start, relative, 1)), q.body(mover).shape);
}

std::string all_objects(const EngineQuestion& q) {
  std::vector<int> bodies;
  for (std::size_t i = 0; i < q.scene.bodies.size(); ++i) bodies.push_back(static_cast<int>(i));
  std::string out = shapes_of(q, bodies);
  for (const int i : bodies) out += object(q, i);
  return out;
}

std::string candidates(const EngineQuestion& q) {
  std::string out = all_objects(q) + "  bool found = false;\n";
  std::vector<bool> present(q.scene.bodies.size());
  int k = 0;
  for (const Step& s : effective_script(q.scene)) {
    if (s.op == Step::Op::insert || s.op == Step::Op::move)
      out += fmt::format("  object_{}.setWorldTransform({});\n", s.body,
                         transform(s.pose.value_or(q.body(s.body).pose)));
    if (s.op == Step::Op::insert) out += fmt::format("  w.world.addCollisionObject(&object_{});\n", s.body);
    if (s.op == Step::Op::remove)
      out += fmt::format("  w.world.removeCollisionObject(&object_{});\n", s.body);
    if (s.op != Step::Op::query) {
      present[static_cast<std::size_t>(s.body)] = s.op != Step::Op::remove;
      continue;
    }
    out += with_names(find_pair, q);
    if (k++ == q.step) break;
  }
  for (std::size_t i = 0; i < present.size(); ++i)
    if (present[i]) out += fmt::format("  w.world.removeCollisionObject(&object_{});\n", i);
  return out + "  x.overlap = found;\n";
}

// The convex bodies of each group as one object, as the adapter makes them for the simulation; all others as
// they are.
std::vector<Holder> holders(const EngineQuestion& q, std::string& out) {
  std::vector<Holder> all;
  std::map<int, int> convex_in, children;
  const auto is_part = [&](int i) {
    return is_sim(q) && q.body(i).group >= 0 && has_support(q.scene.shape_of(i));
  };
  const auto count = static_cast<int>(q.scene.bodies.size());
  for (int i = 0; i < count; ++i) convex_in[q.body(i).group] += is_part(i);
  for (int i = 0; i < count; ++i) {
    const int group = q.body(i).group;
    if (!is_part(i) || convex_in[group] < 2) {
      all.push_back({fmt::format("object_{}", i)});
      continue;
    }
    if (children[group] == 0)
      out += fmt::format(
          "  btCompoundShape compound_{0};\n  btCollisionObject link_{0};\n"
          "  link_{0}.setWorldTransform(object_{1}.getWorldTransform());\n"
          "  link_{0}.setCollisionShape(&compound_{0});\n",
          group, i);
    out += fmt::format(
        "  compound_{0}.addChildShape(link_{0}.getWorldTransform().inverse() * "
        "object_{1}.getWorldTransform(), &shape_{2});\n",
        group, i, q.body(i).shape);
    all.push_back({fmt::format("link_{}", group), children[group]++});
  }
  return all;
}

std::string for_each_object(const std::vector<Holder>& all, std::string_view call) {
  std::string out;
  for (const Holder& h : all)
    if (h.child <= 0) out += fmt::format("  w.world.{}(&{});\n", call, h.object);
  return out;
}

std::string scene_contacts(const EngineQuestion& q) {
  std::string out = all_objects(q);
  const std::vector<Holder> all = holders(q, out);
  out += for_each_object(all, "addCollisionObject");
  if (is_sim(q))
    out += simulated(all[static_cast<std::size_t>(q.a)], all[static_cast<std::size_t>(q.b)]);
  else
    out += "  bool found = false;\n" + with_names(find_pair, q) +
           fmt::format("  if (found) x = query(w.world, object_{}, object_{});\n", q.a, q.b);
  return out + for_each_object(all, "removeCollisionObject");
}

// The broad phases as separate engines, under the names used for certification.
constexpr std::string_view phase_head = R"(  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  @PHASE@;
  btBroadphaseProxy* proxy[@COUNT@] = {};
  int number[@COUNT@] = {};
  [[maybe_unused]] const auto box_of = [](const btCollisionShape& shape, const btTransform& at, btVector3& lo, btVector3& hi) {
    shape.getAabb(at, lo, hi);
  };
  // The AABB of an axis-aligned box, without the additional rounding of btBoxShape's margin.
  [[maybe_unused]] const auto corners = [](const btVector3& h, const btTransform& at, btVector3& lo, btVector3& hi) {
    lo = at.getOrigin() - h;
    hi = at.getOrigin() + h;
  };
)";

std::string phase_of(const EngineQuestion& q) {
  const std::string name(q.engine.substr(std::string_view("bullet-f64-").size()));
  const std::string world = "btVector3(-1000, -1000, -1000), btVector3(1000, 1000, 1000), 16384";
  if (name == "dbvt") return "btDbvtBroadphase phase";
  if (name == "axis-sweep") return "btAxisSweep3 phase(" + world + ")";
  if (name == "axis-sweep-32") return "bt32BitAxisSweep3 phase(" + world + ")";
  return name == "simple" ? "btSimpleBroadphase phase(16384)" : "";
}

// A statement that sets lo and hi to the AABB of body i at a pose.
std::string box_of(const EngineQuestion& q, int i, const Pose& pose) {
  const auto* box = std::get_if<Box>(&q.scene.shape_of(i));
  const Quat& r = pose.rotation;
  const bool thirds = r.x == r.y && r.y == r.z && (r.w == r.x || r.w == -r.x);
  if (!box || (!thirds && !(r.x == 0 && r.y == 0 && r.z == 0)))
    return fmt::format("  box_of(object_{}.getCollisionShape()[0], {}, lo, hi);\n", i, transform(pose));
  const Vec3& h = box->half_extents;
  const Vec3 turned = !thirds || r.x == 0 ? h
                      : r.w == r.x        ? Vec3(h.z(), h.x(), h.y())
                                          : Vec3(h.y(), h.z(), h.x());
  return fmt::format("  corners({}, {}, lo, hi);\n", vector(turned), transform({pose.translation, {}}));
}

std::string phase_candidates(const EngineQuestion& q) {
  std::vector<int> bodies;
  for (std::size_t i = 0; i < q.scene.bodies.size(); ++i) bodies.push_back(static_cast<int>(i));
  std::string out =
      filled(phase_head, {{"PHASE", phase_of(q)}, {"COUNT", std::to_string(q.scene.bodies.size())}});
  out += all_objects(q) + "  btVector3 lo, hi;\n";
  int k = 0;
  for (const Step& s : effective_script(q.scene)) {
    if (s.op == Step::Op::insert || s.op == Step::Op::move)
      out += box_of(q, s.body, s.pose.value_or(q.body(s.body).pose));
    const std::string p = fmt::format("proxy[{}]", s.body);
    const bool fixed = s.body >= 0 && q.body(s.body).is_static;
    if (s.op == Step::Op::insert)
      out += fmt::format(
          "  {0} = phase.createProxy(lo, hi, BOX_SHAPE_PROXYTYPE, &number[{1}], {2}, {3}, &dispatcher);\n", p,
          s.body, fixed ? "btBroadphaseProxy::StaticFilter" : "btBroadphaseProxy::DefaultFilter",
          fixed ? "btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter"
                : "btBroadphaseProxy::AllFilter");
    if (s.op == Step::Op::move) out += fmt::format("  phase.setAabb({}, lo, hi, &dispatcher);\n", p);
    if (s.op == Step::Op::remove) out += fmt::format("  phase.destroyProxy({}, &dispatcher);\n", p);
    if (s.op != Step::Op::query) continue;
    out += "  phase.calculateOverlappingPairs(&dispatcher);\n";
    if (k++ == q.step) break;
  }
  return out +
         fmt::format(
             "  const auto& pairs = phase.getOverlappingPairCache()->getOverlappingPairArray();\n"
             "  for (int i = 0; i < pairs.size(); ++i) {{\n"
             "    const auto *one = pairs[i].m_pProxy0, *two = pairs[i].m_pProxy1;\n"
             "    if ((one == proxy[{0}] && two == proxy[{1}]) || (one == proxy[{1}] && two == proxy[{0}])) "
             "x.overlap = true;\n  }}\n",
             q.a, q.b);
}

bool is_phase(const EngineQuestion& q) { return q.question == Question::candidates && !phase_of(q).empty(); }

std::string body_of(const EngineQuestion& q) {
  if (is_phase(q)) return phase_candidates(q);
  if (q.question == Question::time_of_impact) return impact(q);
  if (q.question == Question::candidates) return candidates(q);
  if (q.question == Question::scene_contacts) return scene_contacts(q);
  return pair_question(q);
}

std::string includes_of_fields(const EngineQuestion& q) {
  const bool any = std::ranges::any_of(q.scene.shapes, [](const Shape& s) {
    const auto* m = std::get_if<TriangleMesh>(&s);
    return m && kit::height_field_of(*m);
  });
  return any ? "#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>\n" : "";
}

EngineSource source(const EngineQuestion& q) {
  const bool f64 = q.engine.starts_with("bullet-f64");
  EngineSource out;
  out.compile =
      f64 ? "-DBT_USE_DOUBLE_PRECISION -I/usr/include/bullet -lBulletCollision-float64 -lLinearMath-float64"
          : "-I/usr/include/bullet -lBulletCollision -lLinearMath";
  out.includes = "#include <btBulletCollisionCommon.h>\n";
  out.point_a = "x.on_a";
  out.point_b = "x.on_b";
  out.code = std::string(helpers);
  if (!is_sim(q) && q.question != Question::time_of_impact && q.question != Question::candidates)
    out.code += filled(query_helper,
                       {{"THRESHOLD", q.question == Question::distance ? "btScalar(BT_LARGE_FLOAT)" : "0"}});
  if (is_phase(q)) out.includes += "#include <BulletCollision/BroadphaseCollision/btSimpleBroadphase.h>\n";
  out.includes += includes_of_fields(q);
  out.code += "Answer ask() {\n  [[maybe_unused]] World w;\n  Answer x;\n" + body_of(q) + "  return x;\n}\n";
  return out;
}

}  // namespace

SourceWriter bullet_source_writer() { return {{"bullet-"}, source}; }

}  // namespace touchstone::fuzz
