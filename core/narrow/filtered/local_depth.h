// A local minimum of the support function of B − A (for bodies that meet, the depth; for others, minus the
// distance, and then the only minimum), and how far it is proven to be the least. An expanding polytope needs
// about fifty support points to close on a curved boundary, most of them for the last digits. Here the
// touching features (core/shape/feature.h) are guessed, the direction is found by Newton's method, and the
// proof is a curvature argument.
//
// C = B − A, h its support function, m a unit direction with h(m) = d, w a point of C along m, v = w − d m.
// Bodies that lie in C and contain w bound h from below on the great circle m(θ) = m cos θ + t sin θ, t unit
// and orthogonal to m:
//
// * a ball of radius ρ that touches C from inside at w: ρ + (d − ρ) cos θ + v·t sin θ.
// * a disc of radius r and axis a, w on its rim: its part r |P m(θ)| has x = P m(θ) with x'' = −x, so that
//   |x|'' + |x| = |x × x'|²/|x|³ >= (a·(m × t))²/X³, X the largest |x| in question, at most 1. By comparison
//   the bound of the ball with ρ = r (a·(m × t))²/X³. Parts of a sum add.
// * a segment along e, orthogonal to m, that extends k to both sides of w:
//   d cos θ + k |e·t| sin θ + v·t sin θ, and |e·t| >= (e·t)²; a face that extends k to all sides: the same
//   without e.
//
// With S(t), K(t) the sums of these quadratic forms and x = tan(θ/2), h >= d − δ follows from
// (S − d) x² + (K − |v|) x + δ (1 + x²)/2 >= 0. For 0 <= x <= T, with μ the least of S + K/T − d over t:
// where μ > 0, δ = |v|²/(2 μ) suffices, and δ = |v| + 2 max(0, −μ) always does (minima that form a ring have
// μ = 0). This covers the cap θ <= 2 atan T. Beyond it, the farthest point q of C along −m, with H = −q·m and
// Q = |q + H m|, gives h >= −H cos θ − Q sin θ, which increases from 90° on and reaches d at
// T = (Q + √(Q² + H² − d²))/(H − d): with that T the minimum is global. With a smaller T, the expanding
// polytope skips the cap.
//
// Outcomes: found or not; `global`, or with the cap of its proof. Everything about features is a guess until
// the support points of both bodies have confirmed it.
#pragma once

#include "core/narrow/filtered/difference.h"

namespace touchstone::narrow::filtered {

template <class R>
struct LocalDepth {
  bool found = false, global = false;
  R upper = 0, lower = 0;  // over all directions in the cap, or over all
  R tangent = 0;           // T
  V3<R> outward, a, w;     // as in Depth
};

template <class R>
class LocalMinimum {
  using Feature = convex::Feature<R>;
  using FeatureKind = convex::FeatureKind;
  using Cap = convex::Cap<R>;
  using Form = convex::TangentForm<R>;

 public:
  LocalMinimum(const Difference<R>& d, R size)
      : d_(d),
        level_(rounding::feature_height * u<R> * size),
        slight_(rounding::certain_height * u<R> * size) {}

  /// Starts from a facet of support points with unit outward normal n and the weights of the origin's foot in
  /// it.
  bool find(const std::array<Vertex<R>, 3>& facet, const std::array<R, 3>& weight, const V3<R>& n) {
    std::array<V3<R>, 3> a, b;
    V3<R> foot_a = V3<R>::Zero(), foot_b = V3<R>::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] = facet[k].a;
      b[k] = d_.at.b_to_a.transpose() * (facet[k].w + facet[k].a - d_.at.offset);
      foot_a += weight[k] * a[k];
      foot_b += weight[k] * b[k];
    }
    // Snaps to the exact corners: B's points went through two rotations.
    for (V3<R>& p : b) p = ask(1, [&](const auto& core) { return core.snap(p); });
    m_ = n;
    suggest(0, a, foot_a);
    suggest(1, b, foot_b);
    for (int round = 0; round < rounds; ++round) {
      if (!turn_direction() || !m_.allFinite()) {
        if (!try_disc(n)) return false;
        continue;
      }
      const Verdict v = confirm();
      if (v == Verdict::confirmed) return true;
      if (v == Verdict::refuted) return false;
    }
    return false;
  }

  /// Results of find(): h, m, w and w's point of A.
  R height() const { return upper_; }
  const V3<R>& outward() const { return m_; }
  const V3<R>& point() const { return w_; }
  const V3<R>& on_a() const { return placed_[0].p; }

  /// For bodies that meet: proves how far it is the least.
  LocalDepth<R> certify() const {
    LocalDepth<R> r;
    r.found = true;
    r.upper = upper_;
    r.outward = m_;
    r.a = placed_[0].p;
    r.w = w_;
    level_points(r);
    const V3<R> x = m_.unitOrthogonal(), y = m_.cross(x), q = d_.support(-m_).w;
    const R far = -q.dot(m_), off = (q + far * m_).squaredNorm(), d = upper_;
    if (!(far > d + slight_)) return r;
    const R tilt = unevenness();
    const convex::Tangents<R> at[2] = {{in(0, m_), in(0, x), in(0, y)}, {in(1, m_), in(1, x), in(1, y)}};
    const R behind =
        (std::sqrt(off) + std::sqrt(off + far * far - d * d)) / (far - d) * (1 + rounding::formula * u<R>);
    for (R part = 1; part > least_part; part /= 2) {
      const R t = behind * part;
      Form ball, reach;
      for (int i = 0; i < 2; ++i) add_side(i, x, y, at[i], Cap(t), part / 2, ball, reach);
      ball.xx += reach.xx / t;
      ball.xy += reach.xy / t;
      ball.yy += reach.yy / t;
      const R mu = ball.least() - d;
      const R rest_sq = rest_.squaredNorm();
      const bool curved = mu > d / 64 + slight_;
      if (!curved && !(mu > -level_)) continue;
      r.tangent = t;
      r.global = part == 1;
      r.lower = d - tilt -
                (curved ? rest_sq / (2 * mu) : std::sqrt(rest_sq) + 2 * std::max<R>(0, -mu) + level_ / 4);
      return r;
    }
    return r;
  }

 private:
  static constexpr int rounds = 5, steps = 12;
  // Sine to a circle's axis below which the direction has no azimuth to start from.
  static constexpr R pole_sine = R(0.01);
  // Smallest cap worth proving, as a share of the one that makes the minimum global.
  static constexpr R least_part = R(0.001);
  enum class Verdict { confirmed, revised, refuted };

  const ConvexBody<R>& body(int side) const { return side == 0 ? d_.a : d_.b; }
  template <class F>
  [[gnu::always_inline]] decltype(auto) ask(int side, F&& f) const {
    return on_core(body(side), f);
  }
  template <class F>
  [[gnu::always_inline]] void if_curved(int side, F&& f) const {
    on_core(body(side), [&]<class C>(const C& core) {
      if constexpr (!C::is_polytope) f(core);
    });
  }
  [[gnu::always_inline]] V3<R> in(int side, const V3<R>& m) const {
    return side == 0 ? V3<R>(-m) : V3<R>(d_.at.b_to_a.transpose() * m);
  }
  V3<R> out(int side, const V3<R>& v) const { return side == 0 ? V3<R>(-v) : V3<R>(d_.at.b_to_a * v); }

  void suggest(int i, const std::array<V3<R>, 3>& q, const V3<R>& foot) {
    const V3<R> d = in(i, m_);
    feature_[i] = ask(i, [&](const auto& core) { return core.suggest(q, foot, d, level_); });
  }

  // If a rim has no minimum near n, its disc may have one.
  bool try_disc(const V3<R>& n) {
    m_ = n;
    for (int i = 0; i < 2; ++i)
      if (ask(i, [&](const auto& core) { return core.use_disc(feature_[i], in(i, n)); })) return true;
    return false;
  }

  void place_both() {
    for (int i = 0; i < 2; ++i)
      placed_[i] = ask(i, [&](const auto& core) { return core.locate(feature_[i], in(i, m_)); });
    w_ = d_.at.b_to_a * placed_[1].p + d_.at.offset - placed_[0].p;
  }

  // ---- the direction

  bool turn_direction() {
    V3<R> c[2];
    R s[2], k = 1;
    int circles = 0;
    for (int i = 0; i < 2; ++i) {
      const Feature& f = feature_[i];
      if (f.kind == FeatureKind::face) {
        m_ = out(i, f.c);
        place_both();
        return true;
      }
      if (f.kind == FeatureKind::edge) {
        c[circles] = out(i, f.c);
        s[circles++] = f.s;
        k = f.k;
      }
    }
    if (circles == 2) return intersect_circles(c, s);
    return circles == 1 ? minimise_on_circle(c[0], s[0], k) : minimise_freely();
  }

  // The intersection of two circles of directions; the nearer of the two.
  bool intersect_circles(const V3<R>* c, const R* s) {
    const R x = c[0].dot(c[1]);
    const V3<R> q = c[0].cross(c[1]);
    const R qq = q.squaredNorm();
    if (!(qq > R(tolerance::parallel_sine_sq))) return false;
    const V3<R> p = (c[0] * (s[0] - x * s[1]) + c[1] * (s[1] - x * s[0])) / qq;
    const R rest = 1 - p.squaredNorm();
    if (!(rest > 0)) return false;
    const V3<R> up = q * std::sqrt(rest / qq);
    m_ = (p + (up.dot(m_) < 0 ? V3<R>(-up) : up)).normalized();
    place_both();
    if (s[0] != 0 || s[1] != 0) level_edges();
    return true;
  }

  // Small circles lose digits in `intersect_circles`: one Newton step on m·e = 0, whose gradient is e, since
  // a generator rotates with m along the rim and the rim is orthogonal to m.
  void level_edges() {
    const V3<R> e[2] = {out(0, feature_[0].e), out(1, feature_[1].e)};
    const R g = e[0].dot(e[1]), det = 1 - g * g, p = m_.dot(e[0]), q = m_.dot(e[1]);
    if (!(det > R(tolerance::parallel_sine_sq))) return;
    m_ = (m_ - (e[0] * (p - g * q) + e[1] * (q - g * p)) / det).normalized();
    place_both();
  }

  // The derivative of both support points, over tangents x, y.
  Form second_derivative(const V3<R>& x, const V3<R>& y) const {
    Form sum;
    for (int i = 0; i < 2; ++i)
      if_curved(i,
                [&](const auto& core) { core.add_second_derivative(placed_[i], in(i, x), in(i, y), sum); });
    return sum;
  }

  bool minimise_on_circle(const V3<R>& c, R s, R k) {
    for (int i = 0; i < steps; ++i) {
      const V3<R> flat = m_ - c * c.dot(m_);
      const R length = flat.norm();
      if (!(length > pole_sine)) return false;
      const V3<R> r = flat * (k / length), along = c.cross(r);
      m_ = r + c * s;
      place_both();
      if (std::abs(w_.dot(along)) <= level_ / 4) return true;  // a ring of minima has no curvature
      const R second = second_derivative(along, along).xx - w_.dot(r);
      if (!(second > 0)) return false;
      const R step = std::clamp(-w_.dot(along) / second, R(-0.5), R(0.5));
      if (std::abs(step) <= u<R>) return true;
      m_ += along * step;
      if (step * step < u<R>) {
        const V3<R> last = m_ - c * c.dot(m_);
        m_ = last * (k / last.norm()) + c * s;
        place_both();
        return true;
      }
    }
    return false;
  }

  bool minimise_freely() {
    for (int i = 0; i < steps; ++i) {
      place_both();
      const V3<R> x = m_.unitOrthogonal(), y = m_.cross(x);
      const R h = m_.dot(w_), gx = x.dot(w_), gy = y.dot(w_);
      if (std::abs(gx) + std::abs(gy) <= level_ / 4) return true;
      const Form second = second_derivative(x, y);
      const R xx = second.xx - h, xy = second.xy, yy = second.yy - h, det = xx * yy - xy * xy;
      if (!(xx > 0 && det > 0)) return false;
      R sx = (xy * gy - yy * gx) / det, sy = (xy * gx - xx * gy) / det;
      const R size = std::sqrt(sx * sx + sy * sy);
      if (size > R(0.5)) {
        sx *= R(0.5) / size;
        sy *= R(0.5) / size;
      }
      m_ = (m_ + x * sx + y * sy).normalized();
      if (size * size < u<R>) {
        place_both();
        return true;
      }
    }
    return false;
  }

  // ---- verification against both bodies

  Verdict confirm() {
    bool revised = false;
    for (int i = 0; i < 2; ++i) {
      const V3<R> d = in(i, m_), s = support_local<R>(body(i), d);
      if (i == 0)
        support_ = -s;
      else
        support_ += d_.at.b_to_a * s + d_.at.offset;
      if (d.dot(s - placed_[i].p) <= level_) continue;
      if (!widen(i, s)) return Verdict::refuted;
      revised = true;
    }
    return revised ? Verdict::revised : balance();
  }

  // Extends the feature by a support point beyond it.
  bool widen(int i, const V3<R>& s) {
    if (feature_[i].kind == FeatureKind::face) return false;
    const V3<R> p = feature_[i].kind == FeatureKind::edge ? s : placed_[i].p;
    suggest(i, {p, p, s}, s);
    return true;
  }

  // The point of the features' sum along m: locates it on each edge or face.
  Verdict balance() {
    upper_ = m_.dot(support_);
    rest_ = upper_ * m_ - w_;
    for (int i = 0; i < 2; ++i)
      if (feature_[i].kind == FeatureKind::face) return on_face(i);
    V3<R> e[2];
    R along[2] = {0, 0};
    int side[2], edges = 0;
    for (int i = 0; i < 2; ++i)
      if (feature_[i].kind == FeatureKind::edge) {
        e[edges] = out(i, feature_[i].e);
        side[edges++] = i;
      }
    if (edges == 1) {
      along[0] = rest_.dot(e[0]);
    } else if (edges == 2) {
      const R g = e[0].dot(e[1]), det = 1 - g * g, p = rest_.dot(e[0]), q = rest_.dot(e[1]);
      if (!(det > R(tolerance::parallel_sine_sq))) return Verdict::refuted;
      along[0] = (p - g * q) / det;
      along[1] = (q - g * p) / det;
    }
    for (int k = 0; k < edges; ++k) {
      const Feature& f = feature_[side[k]];
      if (along[k] < f.lo || along[k] > f.hi) {
        ask(side[k], [&](const auto& core) { core.shorten(feature_[side[k]], along[k] > f.hi); });
        return Verdict::revised;
      }
      reach_[side[k]] = std::min(along[k] - f.lo, f.hi - along[k]);
      along_[side[k]] = along[k];
      placed_[side[k]].p += along[k] * f.e;
      rest_ -= along[k] * e[k];
      w_ += along[k] * e[k];
    }
    return Verdict::confirmed;
  }

  Verdict on_face(int i) {
    V3<R>& p = placed_[i].p;
    p += i == 0 ? V3<R>(-rest_) : V3<R>(d_.at.b_to_a.transpose() * rest_);
    w_ += rest_;
    rest_.setZero();
    reach_[i] = ask(i, [&](const auto& core) { return core.face_margin(feature_[i], p); });
    return reach_[i] > 0 ? Verdict::confirmed : Verdict::refuted;
  }

  // Close to its axis, a rim's point turns with the direction so much that what Newton's last step leaves of
  // m moves it along the rim. Moves the points along their edges and rims until they differ along m only; not
  // by so much that the bend of a rim, the move's square over twice the radius, counts.
  void level_points(LocalDepth<R>& r) const {
    V3<R> t[2];
    for (int i = 0; i < 2; ++i)
      t[i] = out(i, feature_[i].kind == FeatureKind::edge ? feature_[i].e : placed_[i].t);
    const R g = t[0].dot(t[1]), det = t[0].squaredNorm() * t[1].squaredNorm() - g * g;
    const R p = rest_.dot(t[0]), q = rest_.dot(t[1]);
    const bool two = det > R(tolerance::parallel_sine_sq);
    if (!two && t[0].squaredNorm() > 0 && t[1].squaredNorm() > 0) return;
    const R along[2] = {two ? (p - g * q) / det : p, two ? (q - g * p) / det : q};
    for (int i = 0; i < 2; ++i)
      if (feature_[i].kind != FeatureKind::edge &&
          !(along[i] * along[i] <= level_ * convex::flat_length(placed_[i].p)))
        return;
    r.w += along[0] * t[0] + along[1] * t[1];
    r.a -= along[0] * t[0];  // t[0] is of −A
  }

  // ---- the proof

  // An edge that is not quite orthogonal to m extends that much less far.
  R unevenness() const {
    R sum = 0;
    for (int i = 0; i < 2; ++i)
      if (feature_[i].kind == FeatureKind::edge) sum += reach_[i] * std::abs(out(i, feature_[i].e).dot(m_));
    return sum;
  }

  /// `at`: m, x and y in the body's frame.
  void add_side(int i, const V3<R>& x, const V3<R>& y, const convex::Tangents<R>& at, const Cap& cap, R share,
                Form& ball, Form& reach) const {
    const Feature& f = feature_[i];
    R part = 1;
    if_curved(i, [&](const auto& core) {
      core.add_curvature(f, along_[i], at, cap, share, ball);
      part = core.edge_share(f, share);
    });
    if (f.kind == FeatureKind::face) reach.add_all(reach_[i]);
    if (f.kind == FeatureKind::edge) {
      const V3<R> e = out(i, f.e);
      reach.add(reach_[i] * part, e.dot(x), e.dot(y));
    }
  }

  const Difference<R>& d_;
  R level_, slight_;
  V3<R> m_, w_, support_, rest_;
  Feature feature_[2];
  convex::FeaturePoint<R> placed_[2];
  R reach_[2] = {0, 0}, along_[2] = {0, 0}, upper_ = 0;
};

}  // namespace touchstone::narrow::filtered
