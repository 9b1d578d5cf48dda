#include "core/narrow/pair_table.h"

#include "core/narrow/filtered/closed_forms.h"
#include "core/narrow/mesh.h"
#include "core/narrow/pair/capsule_capsule.h"
#include "core/narrow/pair/half_space.h"
#include "core/narrow/pair/sphere_box.h"
#include "core/narrow/pair/sphere_capsule.h"
#include "core/narrow/pair/sphere_sphere.h"
#include "core/narrow/shape_pairs.h"

namespace touchstone::narrow {
namespace {

using PairFunction = Separation (*)(const ShapeRef&, const WideFrame&, const ShapeRef&, const WideFrame&);
using CoreFunction = Separation (*)(const ConvexCore<Wide>&, const ConvexCore<Wide>&);

template <CoreFunction f>
Separation on_cores(const ShapeRef& a, const WideFrame& fa, const ShapeRef& b, const WideFrame& fb) {
  return f(make_core(a, fa), make_core(b, fb));
}

Separation convex_half_space(const ShapeRef& a, const WideFrame& fa, const ShapeRef& b, const WideFrame& fb) {
  return convex_plane(make_core(a, fa), place(std::get<HalfSpace>(*b.shape), fb));
}

Separation half_space_mesh(const ShapeRef& a, const WideFrame& fa, const ShapeRef& b, const WideFrame& fb) {
  const WidePlane plane = place(std::get<HalfSpace>(*a.shape), fa);
  if (b.collider) return mirrored(convex_plane(vertices_core(b.collider->used_vertices(), fb), plane));
  const auto used = used_vertices(std::get<TriangleMesh>(*b.shape));
  return mirrored(convex_plane(vertices_core(used, fb), plane));
}

Separation convex_mesh(const ShapeRef& a, const WideFrame& fa, const ShapeRef& b, const WideFrame& fb) {
  return core_mesh(make_core(a, fa), std::get<TriangleMesh>(*b.shape), fb);
}

template <class R>
void capsules(const PlacedShape& a, const PlacedShape& b, filtered::Asked asked, filtered::Answer<R>& out,
              filtered::PairScene<R>& scene) {
  if (filtered::capsule_capsule<R>(*a.shape, a.pose, *b.shape, b.pose, asked, out))
    scene.contact = filtered::ContactForm::segments;
}

struct Row {
  PairFunction wide = nullptr;
  filtered::Function<double> f64 = nullptr;
  filtered::Function<float> f32 = nullptr;
  constexpr explicit operator bool() const { return wide != nullptr; }
};

// clang-format off
#define TS_ROW(wide, form) Row{&on_cores<&wide>, &filtered::form<double>, &filtered::form<float>}
#define TS_CLOSED(form) \
  Row{&on_cores<&form>, &filtered::closed<double, &filtered::form<double>>, \
      &filtered::closed<float, &filtered::form<float>>}
// clang-format on

// What the types alone decide. Two convex shapes have a row in one order only.
struct General {
  template <class A, class B>
  constexpr Row row() const {
    if constexpr (!is_convex_shape<A>)
      return {};
    else if constexpr (is_convex_shape<B>)
      return index_of<A> <= index_of<B> ? TS_ROW(separate_convex, convex_pair) : Row{};
    else if constexpr (std::is_same_v<B, HalfSpace>)
      return {&convex_half_space, &filtered::convex_half_space<double>, &filtered::convex_half_space<float>};
    else if constexpr (std::is_same_v<B, TriangleMesh>)
      return {&convex_mesh, &filtered::convex_mesh<double>, nullptr};
    else
      return {};
  }
};

template <class A, class B>
constexpr void set(PairTable<Row>& t, const Row& row) {
  static_assert(index_of<A> <= index_of<B>, "the general row of two convex shapes is in this order");
  t.set<A, B>(row);
}

constexpr PairTable<Row> make_table() {
  PairTable<Row> t{General()};
  set<HalfSpace, TriangleMesh>(t, {&half_space_mesh, nullptr, nullptr});
  set<TriangleMesh, TriangleMesh>(t, {&mesh_mesh, &filtered::mesh_mesh<double>, nullptr});
  set<Sphere, Sphere>(t, TS_CLOSED(sphere_sphere));
  set<Sphere, Capsule>(t, TS_CLOSED(sphere_capsule));
  set<Sphere, Box>(t, TS_CLOSED(sphere_box));
  set<Capsule, Capsule>(t, {&on_cores<&capsule_capsule>, &capsules<double>, &capsules<float>});
  set<Box, Box>(t, TS_ROW(separate_convex, box_box));
  set<Box, Capsule>(t, TS_ROW(separate_convex, box_and_capsule));
  return t;
}

constexpr PairTable<Row> table = make_table();
using Entry = PairTable<Row>::Entry;

template <class R>
filtered::Function<R> function_of(const Row& row) {
  if constexpr (sizeof(R) == sizeof(double))
    return row.f64;
  else
    return row.f32;
}

}  // namespace

template <class R>
bool has_fast(ShapeKind a, ShapeKind b) {
  return function_of<R>(table.find(static_cast<std::size_t>(a), static_cast<std::size_t>(b)).row) != nullptr;
}

template <class R>
void separate_fast(const PlacedShape& a, const PlacedShape& b, filtered::Asked asked, FastAnswer<R>& out) {
  const Entry e = table.find(a.shape->index(), b.shape->index());
  out.mirrored = e.mirrored;
  const filtered::Function<R> f = function_of<R>(e.row);
  if (!f) return;
  if (!out.mirrored) return f(a, b, asked, out.answer, out.scene);
  filtered::Answer<R>& r = out.answer;
  r.normal = r.a = r.b = V3<R>::Zero();
  f(b, a, asked, r, out.scene);
  const V3<R> shift = b.pose.translation.cast<R>() - a.pose.translation.cast<R>();
  r.normal = -r.normal;
  r.a += shift;
  r.b += shift;
  r.a.swap(r.b);
}

template bool has_fast<double>(ShapeKind, ShapeKind);
template bool has_fast<float>(ShapeKind, ShapeKind);
template void separate_fast(const PlacedShape&, const PlacedShape&, filtered::Asked, FastAnswer<double>&);
template void separate_fast(const PlacedShape&, const PlacedShape&, filtered::Asked, FastAnswer<float>&);

Separation separate_placed(const ShapeRef& a, const WideFrame& fa, const ShapeRef& b, const WideFrame& fb) {
  const Entry e = table.find(a.shape->index(), b.shape->index());
  if (!e.row.wide) return {.outcome = Outcome::unsupported};
  return e.mirrored ? mirrored(e.row.wide(b, fb, a, fa)) : e.row.wide(a, fa, b, fb);
}

// 2026-11-22, a cylinder's rim 1.1e-14 deep in a box of size 1, one of 900 pairs with graduated depths:
// relative to A's origin the search stalls between both verdicts; relative to B's it finds the depth to
// 4e-20. So the search is repeated relative to B when it fails relative to A.
Separation separate(const ShapeRef& a, const WideFrame& fa, const ShapeRef& b, const WideFrame& fb) {
  const WideVec b_from_a = fb.translation - fa.translation;
  const Separation s = separate_placed(a, {fa.rotation, WideVec::Zero()}, b, {fb.rotation, b_from_a});
  if (s.outcome != Outcome::not_converged) return s;
  Separation other =
      mirrored(separate_placed(b, {fb.rotation, WideVec::Zero()}, a, {fa.rotation, WideVec(-b_from_a)}));
  if (other.outcome != Outcome::answered) return s;
  other.a += b_from_a;
  other.b += b_from_a;
  return other;
}

}  // namespace touchstone::narrow
