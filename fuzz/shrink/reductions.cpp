#include "fuzz/shrink/reductions.h"

#include <algorithm>
#include <cmath>

#include "core/base/input_error.h"
#include "scenarios/value/invalid_numbers.h"

namespace touchstone::fuzz {

std::vector<double*> lengths(Case& c) {
  std::vector<double*> out;
  const auto add = [&](Vec3& v) {
    for (double& x : v) out.push_back(&x);
  };
  for (Shape& s : c.scene.shapes) {
    if (auto* h = std::get_if<HalfSpace>(&s))
      out.push_back(&h->offset);
    else
      for (double* x : numbers(s)) out.push_back(x);
  }
  for (Body& b : c.scene.bodies) {
    add(b.pose.translation);
    if (b.motion) add(b.motion->linear);
  }
  for (Step& s : c.scene.script)
    if (s.pose) add(s.pose->translation);
  out.push_back(&c.scene.margin);
  return out;
}

namespace {

template <class T>
void erase_range(std::vector<T>& v, std::size_t first, std::size_t n) {
  const auto at = v.begin() + static_cast<std::ptrdiff_t>(first);
  v.erase(at, at + static_cast<std::ptrdiff_t>(std::min(n, v.size() - first)));
}

// --- bodies, with everything that refers to them

std::optional<Case> drop_bodies(const Case& c, std::size_t, std::size_t first, std::size_t n) {
  const std::size_t end = std::min(first + n, c.scene.bodies.size());
  const auto gone = [&](int b) { return b >= static_cast<int>(first) && b < static_cast<int>(end); };
  const auto renumbered = [&](int b) {
    return b < static_cast<int>(first) ? b : b - static_cast<int>(end - first);
  };
  Case r = c;
  erase_range(r.scene.bodies, first, end - first);
  for (Query& q : r.queries) {
    if (!is_pair_question(q.question)) continue;
    if (gone(q.a) || gone(q.b)) return std::nullopt;
    q.a = renumbered(q.a);
    q.b = renumbered(q.b);
  }
  std::erase_if(r.scene.script, [&](const Step& s) { return s.op != Step::Op::query && gone(s.body); });
  for (Step& s : r.scene.script)
    if (s.op != Step::Op::query) s.body = renumbered(s.body);
  std::erase_if(r.scene.ignored, [&](const BodyPair& p) { return gone(p.first) || gone(p.second); });
  for (BodyPair& p : r.scene.ignored) p = {renumbered(p.first), renumbered(p.second)};
  return r;
}

// --- vertices of hulls and triangles of meshes: one list per shape

std::size_t shapes(const Case& c) { return c.scene.shapes.size(); }

std::size_t hull_vertices(const Case& c, std::size_t i) {
  const auto* h = hull_if(c.scene.shapes[i]);
  return h == nullptr ? 0 : h->vertices.size();
}

std::optional<Case> drop_vertices(const Case& c, std::size_t i, std::size_t first, std::size_t n) {
  if (n >= hull_vertices(c, i)) return std::nullopt;
  Case r = c;
  auto& h = *hull_if(r.scene.shapes[i]);
  erase_range(h.vertices, first, n);
  h = make_hull(std::move(h.vertices));
  return r;
}

std::size_t mesh_triangles(const Case& c, std::size_t i) {
  const auto* m = std::get_if<TriangleMesh>(&c.scene.shapes[i]);
  return m == nullptr ? 0 : m->triangles.size();
}

// Also drops the vertices that are no longer used.
std::optional<Case> drop_triangles(const Case& c, std::size_t i, std::size_t first, std::size_t n) {
  if (n >= mesh_triangles(c, i)) return std::nullopt;
  Case r = c;
  auto& m = std::get<TriangleMesh>(r.scene.shapes[i]);
  erase_range(m.triangles, first, n);
  std::vector<int> renumbered(m.vertices.size(), -1);
  std::vector<Vec3> used;
  for (auto& t : m.triangles)
    for (int& v : t) {
      int& to = renumbered[static_cast<std::size_t>(v)];
      if (to < 0) {
        to = static_cast<int>(used.size());
        used.push_back(m.vertices[static_cast<std::size_t>(v)]);
      }
      v = to;
    }
  m.vertices = std::move(used);
  return r;
}

std::size_t one(const Case&) { return 1; }

constexpr ListPart parts_table[] = {
    {"queries", one, [](const Case& c, std::size_t) { return c.queries.size(); },
     [](const Case& c, std::size_t, std::size_t first, std::size_t n) -> std::optional<Case> {
       if (n >= c.queries.size()) return std::nullopt;
       Case r = c;
       erase_range(r.queries, first, n);
       return r;
     }},
    {"bodies", one, [](const Case& c, std::size_t) { return c.scene.bodies.size(); }, drop_bodies},
    {"steps", one, [](const Case& c, std::size_t) { return c.scene.script.size(); },
     [](const Case& c, std::size_t, std::size_t first, std::size_t n) -> std::optional<Case> {
       Case r = c;
       erase_range(r.scene.script, first, n);
       return r;
     }},
    {"filters", one, [](const Case& c, std::size_t) { return c.scene.ignored.size(); },
     [](const Case& c, std::size_t, std::size_t first, std::size_t n) -> std::optional<Case> {
       Case r = c;
       erase_range(r.scene.ignored, first, n);
       return r;
     }},
    {"vertices", shapes, hull_vertices, drop_vertices},
    {"triangles", shapes, mesh_triangles, drop_triangles},
};

// --- single elements

template <class F>
void for_each_body(const Case& c, std::vector<Case>& out, F&& change) {
  for (std::size_t i = 0; i < c.scene.bodies.size(); ++i) {
    Case r = c;
    if (change(r, r.scene.bodies[i])) out.push_back(std::move(r));
  }
}

void drop_unused_shapes(const Case& c, std::vector<Case>& out) {
  std::vector<int> renumbered(c.scene.shapes.size(), -1);
  Case r = c;
  r.scene.shapes.clear();
  for (Body& b : r.scene.bodies) {
    int& to = renumbered[static_cast<std::size_t>(b.shape)];
    if (to < 0) {
      to = static_cast<int>(r.scene.shapes.size());
      r.scene.shapes.push_back(c.scene.shape_of(&b - r.scene.bodies.data()));
    }
    b.shape = to;
  }
  out.push_back(std::move(r));
}

void remove_motion(const Case& c, std::vector<Case>& out) {
  for_each_body(c, out, [](Case&, Body& b) {
    if (!b.motion) return false;
    b.motion.reset();
    return true;
  });
  for_each_body(c, out, [](Case&, Body& b) {
    if (!b.motion) return false;
    b.motion->angular.setZero();
    return true;
  });
  for_each_body(c, out, [](Case&, Body& b) {
    if (!b.motion) return false;
    b.motion->linear.setZero();
    return true;
  });
}

// Subtracts one body's linear velocity from all: only relative motion matters.
void move_only_one(const Case& c, std::vector<Case>& out) {
  for_each_body(c, out, [](Case& r, Body& b) {
    if (!b.motion) return false;
    const Vec3 v = b.motion->linear;
    for (Body& each : r.scene.bodies) {
      if (!each.motion) each.motion = Motion{};
      each.motion->linear -= v;
      if (*each.motion == Motion{}) each.motion.reset();
    }
    return true;
  });
}

void plain_bodies(const Case& c, std::vector<Case>& out) {
  Case r = c;
  r.scene.name.clear();
  for (Body& b : r.scene.bodies) {
    b.name.clear();
    b.group = -1;
  }
  out.push_back(r);
  for_each_body(c, out, [](Case&, Body& b) {
    if (b.name.empty()) return false;
    b.name.clear();
    return true;
  });
  for_each_body(c, out, [](Case&, Body& b) {
    if (b.group == -1) return false;
    b.group = -1;
    return true;
  });
  for_each_body(c, out, [](Case&, Body& b) {
    if (!b.is_static) return false;
    b.is_static = false;
    return true;
  });
}

void remove_rotation(const Case& c, std::vector<Case>& out) {
  Case r = c;
  for (Body& b : r.scene.bodies) b.pose.rotation = {};
  for (Step& s : r.scene.script)
    if (s.pose) s.pose->rotation = {};
  out.push_back(r);
  for_each_body(c, out, [](Case&, Body& b) {
    if (b.pose.rotation == Quat{}) return false;
    b.pose.rotation = {};
    return true;
  });
}

// Transforms the case into a body's frame: the body is at the origin, and upright if `turned`.
Case seen_from(const Case& c, const Pose& origin, bool turned) {
  Case r = c;
  const Transform t = to_transform(origin);
  const Quat q = normalized(origin.rotation), inverse{-q.x, -q.y, -q.z, q.w};
  const auto change = [&](Pose& p) {
    const bool is_origin = p == origin;
    p.translation -= t.translation;
    if (!turned) return;
    p.translation = t.rotation.transpose() * p.translation;
    p.rotation = is_origin ? Quat{} : inverse * p.rotation;
  };
  for (Body& b : r.scene.bodies) {
    change(b.pose);
    if (!turned || !b.motion) continue;
    b.motion->linear = t.rotation.transpose() * b.motion->linear;
    b.motion->angular = t.rotation.transpose() * b.motion->angular;
  }
  for (Step& s : r.scene.script)
    if (s.pose) change(*s.pose);
  return r;
}

void move_to_origin(const Case& c, std::vector<Case>& out) {
  for (bool turned : {true, false})
    for (const Body& b : c.scene.bodies)
      if (std::isfinite(b.pose.translation.sum())) out.push_back(seen_from(c, b.pose, turned));
}

void drop_insert_poses(const Case& c, std::vector<Case>& out) {
  for (std::size_t i = 0; i < c.scene.script.size(); ++i) {
    if (!c.scene.script[i].pose || c.scene.script[i].op != Step::Op::insert) continue;
    Case r = c;
    r.scene.script[i].pose.reset();
    out.push_back(std::move(r));
  }
}

Shape solid_tetrahedron() {
  return SolidMesh(TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}});
}

void plain_shapes(const Case& c, std::vector<Case>& out) {
  for (std::size_t i = 0; i < c.scene.shapes.size(); ++i)
    for (const Shape& simple : {Shape(Sphere{1}), Shape(Box{Vec3::Ones()}), solid_tetrahedron()}) {
      const bool is_other_mesh = is_mesh(simple) && kind_of(simple) != kind_of(c.scene.shapes[i]);
      if (c.scene.shapes[i] == simple || is_other_mesh) continue;
      Case r = c;
      r.scene.shapes[i] = simple;
      out.push_back(std::move(r));
    }
}

constexpr std::size_t max_shared_shapes = 8;  // shapes that are tried as the shape of all bodies

// Gives all bodies the same shape.
void shared_shape(const Case& c, std::vector<Case>& out) {
  if (c.scene.shapes.size() < 2) return;
  for (std::size_t i = 0; i < c.scene.shapes.size() && i < max_shared_shapes; ++i) {
    Case r = c;
    for (Body& b : r.scene.bodies) b.shape = 0;
    r.scene.shapes = {c.scene.shapes[i]};
    out.push_back(std::move(r));
  }
}

// Rounding may overflow, and no hull can be built from non-finite numbers.
void propose_renewed(std::vector<Case>& out, Case r) {
  try {
    renew(r);
  } catch (const InputError&) {
    return;
  }
  out.push_back(std::move(r));
}

// Scales lengths by the power of two that brings the largest number to about 1; exact.
void scale_to_one(const Case& c, std::vector<Case>& out) {
  Case r = c;
  double largest = 0;
  for (const double* x : numbers(r)) largest = std::max(largest, std::abs(*x));
  if (!(largest > 0) || !std::isfinite(largest)) return;
  const double factor = std::ldexp(1.0, -std::ilogb(largest));
  if (!std::isfinite(factor)) return;
  for (double* x : lengths(r)) *x *= factor;
  propose_renewed(out, std::move(r));
}

constexpr Simplification simplifications_table[] = {
    {"unused shapes", drop_unused_shapes},  {"plain bodies", plain_bodies},
    {"no motion", remove_motion},           {"one moves", move_only_one},
    {"poses of bodies", drop_insert_poses}, {"shared shape", shared_shape},
    {"plain shapes", plain_shapes},         {"upright", remove_rotation},
    {"near the origin", move_to_origin},    {"about one", scale_to_one},
};

constexpr int coarse_bits[] = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 40, 46, 50};

}  // namespace

std::span<const ListPart> list_parts() { return parts_table; }
std::span<const Simplification> simplifications() { return simplifications_table; }

double rounded_to(double v, int significant) {
  if (v == 0 || !std::isfinite(v)) return v;
  int exponent = 0;
  const double m = std::frexp(v, &exponent);
  const double r = std::ldexp(std::nearbyint(std::ldexp(m, significant)), exponent - significant);
  return std::isfinite(r) ? r : v;
}

std::vector<Case> round_all(const Case& c) {
  std::vector<Case> out;
  for (int bits : coarse_bits) {
    Case r = c;
    for (double* x : numbers(r)) *x = rounded_to(*x, bits);
    propose_renewed(out, std::move(r));
  }
  return out;
}

std::vector<Case> round_one(const Case& c, std::size_t i) {
  std::vector<Case> out;
  Case probe = c;
  const auto all = numbers(probe);
  if (i >= all.size()) return out;
  const double v = *all[i];
  std::vector<double> values{0.0, v < 0 ? -1.0 : 1.0, std::nearbyint(v)};
  for (int bits : coarse_bits) values.push_back(rounded_to(v, bits));
  std::erase_if(values, [&](double w) { return bits_of(w) >= bits_of(v) && !(w == 1 && v != 1); });
  std::stable_sort(values.begin(), values.end(), [](double x, double y) { return bits_of(x) < bits_of(y); });
  values.erase(std::unique(values.begin(), values.end()), values.end());
  for (double w : values) {
    *all[i] = w;
    propose_renewed(out, probe);
  }
  return out;
}

std::vector<Case> smaller_and_valid(const Case& c, std::vector<Case> proposals) {
  const CaseSize m = measure(c);
  const bool invalid = !invalid_numbers(c.scene).empty();
  std::erase_if(proposals, [&](const Case& p) {
    if (!(measure(p) < m)) return true;
    try {
      validate(invalid ? without_invalid_numbers(p.scene) : p.scene);
    } catch (const InputError&) {
      return true;
    }
    return !has_what_is_asked(p);
  });
  return proposals;
}

}  // namespace touchstone::fuzz
