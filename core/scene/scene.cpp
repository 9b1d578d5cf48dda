#include "core/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/hash.h"
#include "core/base/input_error.h"

namespace touchstone {
namespace {

std::string at(const char* list, std::size_t i) { return std::string(list) + "[" + std::to_string(i) + "]"; }

void check_finite(const Vec3& v, const std::string& place) {
  if (!v.allFinite()) throw InputError(place, "is not finite");
}

void check_pose(const Pose& p, const std::string& place) {
  check_finite(p.translation, place + ".translation");
  const Quat& q = p.rotation;
  if (!(std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z) && std::isfinite(q.w)))
    throw InputError(place + ".rotation", "is not finite");
  if (q.x == 0 && q.y == 0 && q.z == 0 && q.w == 0)
    throw InputError(place + ".rotation", "is the zero quaternion, which denotes no rotation");
}

void check_body(const Scene& s, std::size_t i) {
  const Body& b = s.bodies[i];
  const std::string place = at("bodies", i);
  if (b.shape < 0 || b.shape >= static_cast<int>(s.shapes.size()))
    throw InputError(place + ".shape", "index " + std::to_string(b.shape) + " is outside 0.." +
                                           std::to_string(static_cast<int>(s.shapes.size()) - 1));
  check_pose(b.pose, place + ".pose");
  if (b.motion) {
    check_finite(b.motion->linear, place + ".motion.linear");
    check_finite(b.motion->angular, place + ".motion.angular");
    const ShapeKind k = kind_of(s.shape_of(static_cast<int>(i)));
    const bool moves = !b.motion->linear.isZero(0) || !b.motion->angular.isZero(0);
    if (moves && !is_convex(k))
      throw InputError(place + ".motion", "a " + std::string(type_name(k)) + " is a static shape and cannot move");
  }
}

void check_script(const Scene& s) {
  std::vector<bool> present(s.bodies.size(), false);
  for (std::size_t i = 0; i < s.script.size(); ++i) {
    const Step& step = s.script[i];
    const std::string place = at("script", i);
    if (step.pose) check_pose(*step.pose, place + ".pose");
    if (step.op == Step::Op::query) continue;
    if (step.body < 0 || step.body >= static_cast<int>(s.bodies.size()))
      throw InputError(place + ".body", "index " + std::to_string(step.body) + " is not a body");
    const auto b = static_cast<std::size_t>(step.body);
    if (step.op == Step::Op::insert) {
      if (present[b]) throw InputError(place, "inserts body " + std::to_string(b) + ", which is present already");
      present[b] = true;
      continue;
    }
    if (!present[b]) throw InputError(place, "names body " + std::to_string(b) + ", which is not present");
    if (step.op == Step::Op::remove) present[b] = false;
    if (step.op == Step::Op::move && !step.pose) throw InputError(place + ".pose", "a move needs a pose");
  }
}

struct HashField {
  Hasher& h;
  void operator()(double v) const { h.add(v); }
  void operator()(const Vec3& v) const { h.add(v.x()).add(v.y()).add(v.z()); }
  void operator()(const std::vector<Vec3>& v) const {
    h.add(v.size());
    for (const Vec3& p : v) (*this)(p);
  }
  void operator()(const std::vector<std::array<int, 3>>& v) const {
    h.add(v.size());
    for (const auto& t : v) h.add(t[0]).add(t[1]).add(t[2]);
  }
  void operator()(const Pose& p) const {
    (*this)(p.translation);
    h.add(p.rotation.x).add(p.rotation.y).add(p.rotation.z).add(p.rotation.w);
  }
};

}  // namespace

void validate(const Scene& s) {
  for (std::size_t i = 0; i < s.shapes.size(); ++i) try {
      validate(s.shapes[i]);
    } catch (const InputError& e) {
      throw e.within(at("shapes", i));
    }
  for (std::size_t i = 0; i < s.bodies.size(); ++i) check_body(s, i);
  const int n = static_cast<int>(s.bodies.size());
  for (std::size_t i = 0; i < s.ignored.size(); ++i) {
    const auto [a, b] = s.ignored[i];
    if (a < 0 || b >= n || a >= b) throw InputError(at("ignored", i), "is not a pair of bodies i < j");
  }
  check_script(s);
  if (!std::isfinite(s.margin)) throw InputError("margin", "is not finite");
}

std::uint64_t hash(const Scene& s) {
  Hasher h;
  const HashField field{h};
  h.add(s.shapes.size());
  for (const Shape& shape : s.shapes) {
    h.add(shape.index());
    std::visit([&](const auto& x) { for_each_field(x, [&](auto, const auto& v, Domain) { field(v); }); }, shape);
  }
  h.add(s.bodies.size());
  for (const Body& b : s.bodies) {
    h.add(b.shape);
    field(b.pose);
    h.add(b.motion.has_value());
    if (b.motion) {
      field(b.motion->linear);
      field(b.motion->angular);
    }
    h.add(b.is_static).add(b.group);
  }
  for (auto [a, b] : s.ignored) h.add(a).add(b);
  for (const Step& step : s.script) {
    h.add(static_cast<int>(step.op)).add(step.body).add(step.pose.has_value());
    if (step.pose) field(*step.pose);
  }
  if (s.margin != 0) h.add(s.margin);
  return h.value();
}

bool is_filtered(const Scene& s, int a, int b) {
  if (a > b) std::swap(a, b);
  const int ga = s.bodies[static_cast<std::size_t>(a)].group, gb = s.bodies[static_cast<std::size_t>(b)].group;
  return (ga >= 0 && ga == gb) || std::binary_search(s.ignored.begin(), s.ignored.end(), BodyPair{a, b});
}

std::vector<Step> effective_script(const Scene& s) {
  if (!s.script.empty()) return s.script;
  std::vector<Step> steps;
  steps.reserve(s.bodies.size() + 1);
  for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i) steps.push_back({Step::Op::insert, i, std::nullopt});
  steps.push_back({Step::Op::query, -1, std::nullopt});
  return steps;
}

double scale_of_pair(const Scene& s, int a, int b) {
  double l = std::abs(s.margin);
  Vec3 apart_at_start = Vec3::Zero(), apart_at_end = Vec3::Zero();
  for (int i : {a, b}) {
    const Body& body = s.bodies[static_cast<std::size_t>(i)];
    const Shape& shape = s.shape_of(i);
    const Vec3& start = body.pose.translation;
    const Vec3 end = body.motion ? Vec3(start + body.motion->linear) : start;
    apart_at_start = start - apart_at_start;
    apart_at_end = end - apart_at_end;
    // `extent` is half of a shape's length.
    l = std::max({l, 2 * extent(shape), start.cwiseAbs().maxCoeff(), end.cwiseAbs().maxCoeff()});
    if (const auto* h = std::get_if<HalfSpace>(&shape))
      l = std::max(l, std::abs(h->offset) / h->normal.stableNorm());
    // Vertices far from the body's origin count as coordinates.
    if (vertices_if(shape)) l = std::max(l, bounding_radius(shape));
  }
  l = std::max(std::max(l, apart_at_start.stableNorm()), apart_at_end.stableNorm());
  return std::min(l, std::numeric_limits<double>::max());  // the length may overflow
}

Scene extract_pair(const Scene& s, int a, int b) {
  Scene r;
  r.name = s.name;
  r.margin = s.margin;
  for (int i : {a, b}) {
    Body body = s.bodies[static_cast<std::size_t>(i)];
    body.shape = static_cast<int>(r.shapes.size());
    body.group = -1;
    r.shapes.push_back(s.shape_of(i));
    r.bodies.push_back(std::move(body));
  }
  return r;
}

}  // namespace touchstone
