#include "core/narrow/pair_table.h"

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

Separation unsupported(const Shape&, const WideFrame&, const Shape&, const WideFrame&) {
  Separation s;
  s.outcome = Outcome::unsupported;
  return s;
}

template <class R>
void capsules(const PlacedShape& a, const PlacedShape& b, filtered::Asked asked, filtered::Answer<R>& out,
              filtered::PairScene<R>& scene) {
  if (filtered::capsule_capsule<R>(*a.shape, a.pose, *b.shape, b.pose, asked, out))
    scene.contact = filtered::ContactForm::segments;
}

struct Row {
  PairFunction wide;
  filtered::Function<double> f64;
  filtered::Function<float> f32;
};

constexpr std::size_t kinds = shape_kind_count;
using Table = std::array<std::array<Row, kinds>, kinds>;

constexpr std::size_t at(ShapeKind k) { return static_cast<std::size_t>(k); }

// Whether the table has a row for (a, b) rather than for (b, a): convex shapes come first, then by number.
constexpr bool in_order(std::size_t a, std::size_t b) {
  const bool x = is_convex(static_cast<ShapeKind>(a)), y = is_convex(static_cast<ShapeKind>(b));
  return x == y ? a <= b : x;
}

// clang-format off
#define TS_ROW(wide, form) Row{&on_cores<&wide>, &filtered::form<double>, &filtered::form<float>}
#define TS_CLOSED(form) \
  Row{&on_cores<&form>, &filtered::closed<double, &filtered::form<double>>, \
      &filtered::closed<float, &filtered::form<float>>}
// clang-format on

constexpr Table make_table() {
  using K = ShapeKind;
  Table t{};
  for (auto& row : t) row.fill(TS_ROW(separate_convex, convex_pair));
  for (std::size_t i = 0; i < kinds; ++i) {
    t[i][at(K::half_space)] = {&convex_half_space, &filtered::convex_half_space<double>,
                               &filtered::convex_half_space<float>};
    t[i][at(K::mesh)] = {&convex_mesh, &filtered::convex_mesh<double>, nullptr};
  }
  t[at(K::half_space)][at(K::half_space)] = {&unsupported, nullptr, nullptr};
  t[at(K::half_space)][at(K::mesh)] = {&half_space_mesh, nullptr, nullptr};
  t[at(K::mesh)][at(K::mesh)] = {&unsupported, nullptr, nullptr};
  t[at(K::sphere)][at(K::sphere)] = TS_CLOSED(sphere_sphere);
  t[at(K::sphere)][at(K::capsule)] = TS_CLOSED(sphere_capsule);
  t[at(K::sphere)][at(K::box)] = TS_CLOSED(sphere_box);
  t[at(K::capsule)][at(K::capsule)] = {&on_cores<&capsule_capsule>, &capsules<double>, &capsules<float>};
  t[at(K::box)][at(K::box)] = TS_ROW(separate_convex, box_box);
  t[at(K::box)][at(K::capsule)] = TS_ROW(separate_convex, box_and_capsule);
  return t;
}

constexpr Table table = make_table();

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
  return function_of<R>(in_order(at(a), at(b)) ? table[at(a)][at(b)] : table[at(b)][at(a)]) != nullptr;
}

template <class R>
void separate_fast(const PlacedShape& a, const PlacedShape& b, filtered::Asked asked, FastAnswer<R>& out) {
  const std::size_t i = a.shape->index(), j = b.shape->index();
  out.mirrored = !in_order(i, j);
  const filtered::Function<R> f = function_of<R>(out.mirrored ? table[j][i] : table[i][j]);
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
  const std::size_t i = a.index(), j = b.index();
  return in_order(i, j) ? table[i][j].wide(a, fa, b, fb) : mirrored(table[j][i].wide(b, fb, a, fa));
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
