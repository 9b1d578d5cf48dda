#include "core/narrow/pair_table.h"

#include <algorithm>
#include <array>

#include "core/narrow/filtered/closed_forms.h"
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

template <class R>
void capsules(const PlacedShape& a, const PlacedShape& b, filtered::Asked asked, filtered::Answer<R>& out,
              filtered::PairScene<R>& scene) {
  if (filtered::capsule_capsule<R>(*a.shape, a.pose, *b.shape, b.pose, asked, out))
    scene.contact = filtered::ContactForm::segments;
}

/// Empty: no algorithm. Where both (A, B) and (B, A) are empty, the pair is unsupported.
struct Row {
  PairFunction wide = nullptr;
  filtered::Function<double> f64 = nullptr;
  filtered::Function<float> f32 = nullptr;
};

constexpr std::size_t kinds = shape_kind_count;
using Table = std::array<std::array<Row, kinds>, kinds>;

template <class S>
constexpr std::size_t index_of = [] {
  constexpr auto is_s =
      touchstone::detail::per_shape([]<class T>(std::type_identity<T>) { return std::is_same_v<S, T>; });
  return static_cast<std::size_t>(std::ranges::find(is_s, true) - is_s.begin());
}();

// clang-format off
#define TS_ROW(wide, form) Row{&on_cores<&wide>, &filtered::form<double>, &filtered::form<float>}
#define TS_CLOSED(form) \
  Row{&on_cores<&form>, &filtered::closed<double, &filtered::form<double>>, \
      &filtered::closed<float, &filtered::form<float>>}
// clang-format on

// What the types alone decide. Two convex shapes have a row in one order only.
template <class A, class B>
constexpr Row general_row() {
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

template <class A, class B>
constexpr void set(Table& t, const Row& row) {
  static_assert(index_of<A> <= index_of<B>, "the general row of two convex shapes is in this order");
  t[index_of<A>][index_of<B>] = row;
}

constexpr Table make_table() {
  Table t = touchstone::detail::per_shape([]<class A>(std::type_identity<A>) {
    return touchstone::detail::per_shape([]<class B>(std::type_identity<B>) { return general_row<A, B>(); });
  });
  set<HalfSpace, TriangleMesh>(t, {&half_space_mesh, nullptr, nullptr});
  set<Sphere, Sphere>(t, TS_CLOSED(sphere_sphere));
  set<Sphere, Capsule>(t, TS_CLOSED(sphere_capsule));
  set<Sphere, Box>(t, TS_CLOSED(sphere_box));
  set<Capsule, Capsule>(t, {&on_cores<&capsule_capsule>, &capsules<double>, &capsules<float>});
  set<Box, Box>(t, TS_ROW(separate_convex, box_box));
  set<Box, Capsule>(t, TS_ROW(separate_convex, box_and_capsule));
  return t;
}

constexpr Table table = make_table();

// The row of the pair, and whether it is that of (B, A).
struct Entry {
  const Row& row;
  bool mirrored;
};
Entry find_row(std::size_t a, std::size_t b) {
  const bool mirrored = !table[a][b].wide;
  return {mirrored ? table[b][a] : table[a][b], mirrored};
}

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
  return function_of<R>(find_row(static_cast<std::size_t>(a), static_cast<std::size_t>(b)).row) != nullptr;
}

template <class R>
void separate_fast(const PlacedShape& a, const PlacedShape& b, filtered::Asked asked, FastAnswer<R>& out) {
  const Entry e = find_row(a.shape->index(), b.shape->index());
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

Separation separate_placed(const Shape& a, const WideFrame& fa, const Shape& b, const WideFrame& fb) {
  const Entry e = find_row(a.index(), b.index());
  if (!e.row.wide) return {.outcome = Outcome::unsupported};
  return e.mirrored ? mirrored(e.row.wide(b, fb, a, fa)) : e.row.wide(a, fa, b, fb);
}

// 2026-11-22, a cylinder's rim 1.1e-14 deep in a box of size 1, one of 900 pairs with graduated depths:
// relative to A's origin the search stalls between both verdicts; relative to B's it finds the depth to
// 4e-20. So the search is repeated relative to B when it fails relative to A.
Separation separate(const Shape& a, const WideFrame& fa, const Shape& b, const WideFrame& fb) {
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
