#include "core/narrow/pair_table.h"

#include <array>

#include "core/narrow/mesh.h"
#include "core/narrow/pair/capsule_capsule.h"
#include "core/narrow/pair/half_space.h"
#include "core/narrow/pair/sphere_box.h"
#include "core/narrow/pair/sphere_capsule.h"
#include "core/narrow/pair/sphere_sphere.h"

namespace touchstone::narrow {
namespace {

using PairFunction = Separation (*)(const Shape&, const WideFrame&, const Shape&, const WideFrame&);
using CoreFunction = Separation (*)(const ConvexCore<Wide>&, const ConvexCore<Wide>&);

template <CoreFunction f>
Separation on_cores(const Shape& a, const WideFrame& fa, const Shape& b, const WideFrame& fb) {
  return f(make_core(a, fa), make_core(b, fb));
}

Separation convex_half_space(const Shape& a, const WideFrame& fa, const Shape& b, const WideFrame& fb) {
  return convex_plane(make_core(a, fa), place(std::get<HalfSpace>(b), fb));
}

Separation half_space_mesh(const Shape& a, const WideFrame& fa, const Shape& b, const WideFrame& fb) {
  const auto used = used_vertices(std::get<TriangleMesh>(b));
  return mirrored(convex_plane(vertices_core(used, fb), place(std::get<HalfSpace>(a), fa)));
}

Separation convex_mesh(const Shape& a, const WideFrame& fa, const Shape& b, const WideFrame& fb) {
  return core_mesh(make_core(a, fa), std::get<TriangleMesh>(b), fb);
}

Separation unsupported(const Shape&, const WideFrame&, const Shape&, const WideFrame&) {
  Separation s;
  s.outcome = Outcome::unsupported;
  return s;
}

constexpr std::size_t kinds = shape_kind_count;
using Table = std::array<std::array<PairFunction, kinds>, kinds>;

constexpr std::size_t at(ShapeKind k) { return static_cast<std::size_t>(k); }

constexpr Table make_table() {
  Table t{};
  for (auto& row : t) row.fill(&on_cores<&separate_convex>);
  for (std::size_t i = 0; i < kinds; ++i) {
    t[i][at(ShapeKind::half_space)] = &convex_half_space;
    t[i][at(ShapeKind::mesh)] = &convex_mesh;
  }
  t[at(ShapeKind::half_space)][at(ShapeKind::half_space)] = &unsupported;
  t[at(ShapeKind::half_space)][at(ShapeKind::mesh)] = &half_space_mesh;
  t[at(ShapeKind::mesh)][at(ShapeKind::mesh)] = &unsupported;
  t[at(ShapeKind::sphere)][at(ShapeKind::sphere)] = &on_cores<&sphere_sphere>;
  t[at(ShapeKind::sphere)][at(ShapeKind::capsule)] = &on_cores<&sphere_capsule>;
  t[at(ShapeKind::sphere)][at(ShapeKind::box)] = &on_cores<&sphere_box>;
  t[at(ShapeKind::capsule)][at(ShapeKind::capsule)] = &on_cores<&capsule_capsule>;
  return t;
}

constexpr Table table = make_table();

}  // namespace

Separation separate_placed(const Shape& a, const WideFrame& fa, const Shape& b, const WideFrame& fb) {
  const std::size_t i = a.index(), j = b.index();
  return i <= j ? table[i][j](a, fa, b, fb) : mirrored(table[j][i](b, fb, a, fa));
}

Separation separate(const Shape& a, const WideFrame& fa, const Shape& b, const WideFrame& fb) {
  return separate_placed(a, {fa.rotation, WideVec::Zero()}, b,
                         {fb.rotation, fb.translation - fa.translation});
}

}  // namespace touchstone::narrow
