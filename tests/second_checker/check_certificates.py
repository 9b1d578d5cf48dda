#!/usr/bin/env python3
"""Checks certificates about pairs of bodies in exact rational arithmetic, with Python's standard library alone.

Usage: check_certificates.py [FILE...]   (standard input without a file)

Reads JSON lines: the output of `touchstone answer --json`, or {"scene": SCENE, "certificate": CERTIFICATE};
A and B are bodies 0 and 1 of the scene. Prints `valid`, `not valid` or `refused: REASON` for each certificate.
Exit code: 0 all valid, 1 some not, 2 bad input.

What a certificate proves is defined in docs/truth.md (section 4) and in oracles/checker/checker.h; this program
shares no code with that one. A bounded convex set is the hull of round pieces {c + sum u_k a_k, |u| <= 1} (the
core) plus a ball; its support value in direction n is max(c.n + sqrt(sum (a_k.n)^2)) + ball |n|.
"""
import json
import re
import sys
from fractions import Fraction as Q
from math import hypot, isqrt

sys.set_int_max_str_digits(0)
POINT_FACTOR = Q(1, 2**50)  # how far support points may be outside a core, in units of their largest coordinate
MOST_DIGITS = 50_000
RATIONAL = re.compile(r"-?(0|[1-9][0-9]*)(/[1-9][0-9]*)?")


class Refused(Exception):
    """The certificate is malformed."""


def rational(s):
    if not isinstance(s, str) or not RATIONAL.fullmatch(s) or max(map(len, s.lstrip("-").split("/"))) > MOST_DIGITS:
        raise Refused("is not a rational number")
    return Q(s)


def vec(v):
    return tuple(Q(float(x)) for x in v)


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def mul(s, a):
    return tuple(s * x for x in a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def root(square, factor=1):
    """An upper bound of factor * sqrt(square): exact if the root is rational, else within 2^-600 of it."""
    n = square.numerator * square.denominator << 1200 if isinstance(square, Q) else square << 1200
    r = isqrt(n)
    r += r * r != n and factor > 0
    return factor * Q(r, Q(square).denominator << 600)


def rotated(v, w, x):
    """x turned by the quaternion (v, w), which need not have unit length."""
    return mul(1 / (dot(v, v) + w * w),
               add(add(mul(2 * dot(v, x), v), mul(w * w - dot(v, v), x)), mul(2 * w, cross(v, x))))


class Body:
    """A convex part of a placed body. `move`: a rotation (v, w) about the body's origin, and a shift."""

    def __init__(self, shape, pose, pieces, move):
        (v, w), shift = move
        q = vec(pose.get("rotation", (0, 0, 0, 1)))
        unit = ((Q(1), Q(0), Q(0)), (Q(0), Q(1), Q(0)), (Q(0), Q(0), Q(1)))
        self.axes = [rotated(v, w, rotated(q[:3], q[3], e)) for e in unit]
        self.origin = add(vec(pose.get("translation", (0, 0, 0))), shift)
        self.kind, self.plane, self.pieces = shape["type"], None, []
        self.ball = Q(float(shape["radius"])) if self.kind in ("sphere", "capsule", "rounded_box") else Q(0)
        if self.kind.startswith("padded_"):
            self.ball, self.kind = Q(float(shape["padding"])), self.kind[len("padded_"):]
        if self.kind == "half_space":
            normal = self.turned(vec(shape["normal"]))
            self.plane = (normal, Q(float(shape["offset"])) + dot(normal, self.origin))
        self.local = pieces
        for centre, radii in pieces:
            axes = [mul(r, a) for r, a in zip(radii, self.axes)] if any(radii) else []
            self.pieces.append((add(self.turned(centre), self.origin), axes))

    def turned(self, x):
        return tuple(dot(x, [a[i] for a in self.axes]) for i in range(3))

    def core_support(self, n):
        """max n.x over the core, rounded up; None where it is infinite."""
        if self.plane:
            m, offset = self.plane
            along = dot(m, n)
            return offset * along / dot(m, m) if not any(cross(m, n)) and along > 0 else None
        return max(dot(c, n) + root(sum((dot(a, n)**2 for a in axes), Q(0))) for c, axes in self.pieces)

    def holds(self, x, r):
        """Whether x is in the core plus a ball of radius r. Curved cores: true only if so; exact for r = 0."""
        if self.plane:
            return dot(self.plane[0], x) <= self.plane[1]
        if not any(axes for _, axes in self.pieces):
            v = nearest([sub(c, x) for c, _ in self.pieces])
            return dot(v, v) <= r * r
        u = tuple(dot(a, sub(x, self.origin)) for a in self.axes)
        if self.core_holds(u, r / 4):
            return True
        near = self.near_point([float(c) for c in u]) if r else []
        for share in (1 - 2.0**-49, 1 - 2.0**-40) if near else ():
            y = vec([share * c for c in near])
            if self.core_holds(y, Q(0)) and dot(sub(y, u), sub(y, u)) <= r * r:
                return True
        return False

    def near_point(self, u):
        """In floats, a point of a curved core near u, which is outside; local coordinates."""
        if self.kind == "ellipsoid":
            semi = [float(s) for s in self.local[0][1]]
            low, high = 0.0, max(semi) * hypot(*u)
            for _ in range(128):
                t = low + (high - low) / 2
                if sum((c * s / (s * s + t))**2 for c, s in zip(u, semi)) > 1:
                    low = t
                else:
                    high = t
            return [c * s * s / (s * s + high) for c, s in zip(u, semi)]
        low, high, h = float(self.local[0][1][0]), float(self.local[1][1][0]), float(self.local[1][0][2])
        across, best = hypot(u[0], u[1]), (0.0, -h)
        corners = [(0.0, -h), (low, -h), (high, h), (0.0, h)]
        for p, q in zip(corners, corners[1:]):
            side = (q[0] - p[0], q[1] - p[1])
            square = side[0]**2 + side[1]**2
            t = min(1, max(0, ((across - p[0]) * side[0] + (u[2] - p[1]) * side[1]) / square)) if square else 0
            best = min(best, (p[0] + t * side[0], p[1] + t * side[1]), key=lambda z: hypot(z[0] - across, z[1] - u[2]))
        k = best[0] / across if across else 0
        return [k * u[0], k * u[1], best[1]]

    def core_holds(self, u, g):
        """Whether the curved core, at least g larger along each axis of its own, has the point u."""
        if self.kind == "ellipsoid":
            return sum((u[i] / (s + g))**2 for i, s in enumerate(self.local[0][1])) <= 1
        low, high, h = self.local[0][1][0], self.local[1][1][0], self.local[1][0][2]
        z = max(-h, u[2] - g)
        room = (low + (high - low) * (z + h) / (2 * h) if h else low) + g
        return abs(u[2]) <= h + g and u[0]**2 + u[1]**2 <= room * room


def parts(shape, pose, move=(((Q(0),) * 3, Q(1)), (Q(0),) * 3)):
    """The convex parts of a placed shape: the triangles of a mesh, else one."""
    zero, kind = (Q(0),) * 3, shape["type"]
    if kind in ("mesh", "solid_mesh"):
        points = [vec(p) for p in shape["vertices"]]
        return [Body(shape, pose, [(points[i], zero) for i in t], move) for t in shape["triangles"]]
    if kind.startswith("padded_"):
        kind = kind[len("padded_"):]
    h, r = Q(float(shape.get("half_height", 0))), Q(float(shape.get("radius", 0)))
    e = vec(shape.get("half_extents", (0, 0, 0)))
    pieces = {
        "sphere": lambda: [(zero, zero)],
        "box": lambda: [((x, y, z), zero) for x in (-e[0], e[0]) for y in (-e[1], e[1]) for z in (-e[2], e[2])],
        "capsule": lambda: [((Q(0), Q(0), -h), zero), ((Q(0), Q(0), h), zero)],
        "cylinder": lambda: [((Q(0), Q(0), -h), (r, r, Q(0))), ((Q(0), Q(0), h), (r, r, Q(0)))],
        "cone": lambda: [((Q(0), Q(0), -h), (r, r, Q(0))), ((Q(0), Q(0), h), zero)],
        "ellipsoid": lambda: [(zero, vec(shape["semi_axes"]))],
        "hull": lambda: [(vec(p), zero) for p in shape["vertices"]],
        "half_space": lambda: [],
    }
    pieces["rounded_box"] = pieces["box"]
    return [Body(shape, pose, pieces[kind](), move)]


def nearest(points):
    """The point of the hull nearest to the origin: Wolfe's method, whose end is a proof of itself."""
    face, weight = [points[0]], [Q(1)]
    while True:
        v = tuple(sum(w * p[i] for w, p in zip(weight, face)) for i in range(3))
        far = min(points, key=lambda p: dot(v, p))
        if dot(v, far) >= dot(v, v):
            return v
        face.append(far)
        weight.append(Q(0))
        while True:
            goal = affine_weights(face)
            step = min([Q(1)] + [w / (w - g) for w, g in zip(weight, goal) if g < 0])
            kept = [(p, w + step * (g - w)) for p, w, g in zip(face, weight, goal)]
            face, weight = [p for p, w in kept if w], [w for _, w in kept if w]
            if step == 1:
                break


def affine_weights(p):
    """Weights, sum 1, of the point of the affine hull that is nearest to the origin: (Gram + 1) w = 1, scaled."""
    rows = [[dot(a, b) + 1 for b in p] + [Q(1)] for a in p]
    for k, row in enumerate(rows):
        row[:] = [x / row[k] for x in row]
        for other in rows:
            if other is not row and other[k]:
                f = other[k]
                other[:] = [x - f * y for x, y in zip(other, row)]
    total = sum(row[-1] for row in rows)
    return [row[-1] / total for row in rows]


def check_planes(c, a, b):
    text = c.get("rationals")
    if text is not None and (len(text) == 0 or len(text) % 4):
        if not text:
            raise Refused("rationals is empty")
        return False

    def plane(i):
        if text is None:
            return vec(c["direction"]), Q(float(c["offset"]))
        r = [rational(s) for s in text[4 * i:4 * i + 4]]
        return tuple(r[:3]), r[3]

    def separates(n, at, s, t):
        top, bottom, nn = s.core_support(n), t.core_support(mul(-1, n)), dot(n, n)
        return (top is not None and bottom is not None and top + root(nn, s.ball) <= at
                and bottom + root(nn, t.ball) < -at)

    count = 1 if text is None else len(text) // 4
    return all(any(separates(*plane(i), s, t) for i in range(count)) for s in a for t in b) and not_nested(a, b)


def winds_around(triangles, x):
    """How often the closed surface winds around x, counted along a ray; None if every ray tried meets an edge."""
    for ray in ((Q(1), Q(503, 509), Q(-251, 257)), (Q(-127, 131), Q(1), Q(601, 607)), (Q(11, 13), Q(-17, 19), Q(1))):
        winding = 0
        for t in triangles:
            a, b, c = (sub(p, x) for p, _ in t.pieces)
            side = dot(a, cross(b, c))
            split = [dot(ray, cross(p, q)) * side for p, q in ((b, c), (c, a), (a, b))]
            if side == 0 or min(split) < 0:
                continue
            if min(split) == 0:
                break
            winding += 1 if side > 0 else -1
        else:
            return winding
    return None


def not_nested(a, b):
    """Whether no part of either begins inside the other, where that is a solid mesh. The parts do not meet."""
    def outside(solid, other):
        return solid[0].kind != "solid_mesh" or all(s.plane or winds_around(solid, s.pieces[0][0]) == 0 for s in other)
    return outside(a, b) and outside(b, a)


def check_point(c, a, b):
    text = c.get("rationals")
    if text is not None and len(text) != 3:
        if not text:
            raise Refused("rationals is empty")
        return False
    x = vec(c["point"]) if text is None else tuple(rational(s) for s in text)
    def held(body):
        return any(s.holds(x, s.ball) for s in body) or (body[0].kind == "solid_mesh" and bool(winds_around(body, x)))
    return held(a) and held(b)


def check_direction(c, a, b):
    """B moved by d n/|n| can be separated from A across k: h_A(k) + h_B(-k) <= d (k.n)/|n|; k is n, or the normal
    of a half-space."""
    n, d = vec(c["direction"]), Q(float(c["offset"]))
    k = a.plane[0] if a.plane else mul(-1, b.plane[0]) if b.plane else n
    top, bottom, nn = a.core_support(k), b.core_support(mul(-1, k)), dot(n, n)
    if nn == 0 or top is None or bottom is None:
        return False
    if a.plane or b.plane:
        rest = root(dot(k, k), a.ball + b.ball) + root(nn, -d * dot(k, n) / nn)
    else:
        rest = root(nn, a.ball + b.ball - d)
    return top + bottom + rest <= 0


def holds_ball(points, facets, r):
    """The facets form a closed surface that stays out of the ball of radius r about the origin and winds around it:
    it crosses a ray more often outward than inward."""
    edges, ray, crossings = {}, (Q(1), Q(1009, 1013), Q(-499, 997)), 0
    for f in facets:
        if min(f) < 0 or max(f) >= len(points):
            return False
        for i in range(3):
            edge, sign = (f[i], f[(i + 1) % 3]), 1
            if edge[0] > edge[1]:
                edge, sign = edge[::-1], -1
            edges[edge] = edges.get(edge, 0) + (sign if edge[0] != edge[1] else 0)
        a, b, c = (points[i] for i in f)
        v = nearest([a, b, c])
        if dot(v, v) == 0 or dot(v, v) < r * r:
            return False
        side = dot(a, cross(b, c))
        split = [dot(ray, cross(p, q)) * side for p, q in ((b, c), (c, a), (a, b))]
        if side == 0 or min(split) < 0:
            continue
        if min(split) == 0:
            return False  # the ray meets an edge: crossings cannot be counted
        crossings += 1 if side > 0 else -1
    return crossings != 0 and not any(edges.values())


def check_inner(c, a, b, loose=Q(0)):
    """depth >= offset. `loose`: a point at distance d from its body's origin may be loose * d from its place."""
    pairs = [(vec(p), vec(q)) for p, q in c["support_pairs"]]
    if not pairs or (a.plane and b.plane):
        return False
    offset, largest = Q(float(c["offset"])), max(abs(x) for p in pairs for v in p for x in v)
    near = POINT_FACTOR * largest
    e = near
    if loose > 0:
        e += loose * max(root(dot(s.origin, s.origin)) + 2 * largest + near for s in (a, b))
    if not all((a.plane or a.holds(p, near)) and (b.plane or b.holds(q, near)) for p, q in pairs):
        return False
    if a.plane or b.plane:
        (m, o), other, x = (a.plane, b, pairs[0][1]) if a.plane else (b.plane, a, pairs[0][0])
        return dot(m, x) - o + root(dot(m, m), offset - other.ball + e) <= 0
    depth, points = offset - a.ball - b.ball + 2 * e, [sub(p, q) for p, q in pairs]
    if c["facets"]:
        return holds_ball(points, c["facets"], max(depth, Q(0)))
    return depth <= 0 and dot(points[0], points[0]) <= depth * depth


def check_pair(c, bodies):
    a, b = (parts(shape, body.get("pose", {})) for shape, body in bodies)
    if c["kind"] == "separating_plane":
        return check_planes(c, a, b)
    if c["kind"] == "common_point":
        return check_point(c, a, b)
    if any(shape["type"] in ("mesh", "solid_mesh") for shape, _ in bodies):
        return False
    if c["kind"] == "depth_direction":
        return check_direction(c, a[0], b[0])
    return c["kind"] == "inner_polytope" and check_inner(c, a[0], b[0])


def on_grid(x):
    return Q(x * 2**256 // 1, 2**256)


class Mover:
    """A body in motion, in the frame whose origin moves with that of B."""

    def __init__(self, shape, body, seen_from, velocity):
        self.shape, self.pose, self.start, self.velocity = shape, body.get("pose", {}), seen_from, velocity
        self.angular = vec(body.get("motion", {}).get("angular", (0, 0, 0)))

    def at(self, t):
        """The parts at time t, and a bound `loose`: points at distance d from the origin are within loose * d.
        exp(t w) is summed for 2^-m of the half turn to 40 terms on a grid of 2^-256, and squared m times."""
        shift, v, m = add(self.start, mul(t, self.velocity)), mul(t / 2, self.angular), 0
        if not any(v):
            return parts(self.shape, self.pose, ((v, Q(1)), shift)), Q(0)
        while dot(v, v) > 1:
            v, m = mul(Q(1, 2), v), m + 1
        v = tuple(map(on_grid, v))
        square, cosine, sine, term = on_grid(dot(v, v)), Q(0), Q(0), Q(1)
        for k in range(1, 41):
            cosine, sine = cosine + term, sine + on_grid(term / (2 * k - 1))
            term = on_grid(-term * square / (2 * k * (2 * k - 1)))
        v, w = tuple(on_grid(sine * x) for x in v), cosine
        for _ in range(m):
            v, w = tuple(on_grid(2 * w * x) for x in v), on_grid(w * w - dot(v, v))
        return parts(self.shape, self.pose, ((v, w), shift)), Q(2**m, 2**238)


def reach(s, seen):
    """Upper bound over the core of |seen(r)|, r from the body's origin, seen linear."""
    return max((root(dot(seen(sub(c, s.origin)), seen(sub(c, s.origin))))
                + root(sum((dot(seen(a), seen(a)) for a in axes), Q(0))) for c, axes in s.pieces), default=Q(0))


def stays(track, mover, side):
    """For each part, whether it stays on its side of the plane n.x = o that changes linearly between the keys. It
    does if it has a margin at the keys and the bend of its height in between is within what the margins leave."""
    good, margin, spin, before = None, None, None, None
    for key in track:
        t, n, o = Q(float(key["t"])), tuple(map(rational, key["direction"])), rational(key["offset"])
        now, loose = mover.at(t)
        if good is None:
            good, margin = [True] * len(now), [Q(0)] * len(now)
            spin = [reach(s, lambda r: cross(mover.angular, r)) for s in now]
        for i, s in enumerate(now):
            top = s.core_support(mul(side, n)) if good[i] and not (s.plane and any(mover.angular)) else None
            good[i] = top is not None
            if not good[i]:
                continue
            was, wide = margin[i], s.ball + (loose * reach(s, lambda r: r) if loose > 0 else 0)
            margin[i] = side * o - top - root(dot(n, n), wide)
            good[i] = margin[i] >= 0 if side > 0 else margin[i] > 0
            if before and good[i]:
                dt, change = t - before[0], sub(n, before[1])
                longest = max(root(dot(n, n)), root(dot(before[1], before[1])))
                bend = (dt * root(dot(change, change)) * (root(dot(mover.velocity, mover.velocity)) + spin[i])
                        + dt * dt / 2 * longest * root(dot(mover.angular, mover.angular)) * spin[i])
                room = was + margin[i] + 2 * min(was, margin[i])
                good[i] = bend <= room if side > 0 else bend < room
        before = (t, n)
    return good


def check_apart(c, a, b):
    n, m = len(a.at(Q(0))[0]), len(b.at(Q(0))[0])
    until, apart = float(c["clear_until"]), set()
    for track in c["planes"]:
        times = [float(key["t"]) for key in track]
        if not times or times[0] != 0 or times[-1] != until or until > 1 or times != sorted(times):
            return False
        below, above = stays(track, a, 1), stays(track, b, -1)
        apart |= {(i, j) for i in range(n) if below[i] for j in range(m) if above[j]}
    return len(apart) == n * m > 0 and not_nested(a.at(Q(0))[0], b.at(Q(0))[0])


def holds_loosely(moment, x):
    """A set turned by at most `loose` holds x if it holds the corners of an octahedron about x here."""
    def inside(s):
        w = 2 * moment[1] * root(dot(sub(x, s.origin), sub(x, s.origin)))
        corners = [tuple(w * f if i == k else Q(0) for i in range(3)) for k in range(3) for f in (1, -1)]
        return all(s.holds(add(x, corner), s.ball) for corner in corners)
    return any(map(inside, moment[0]))


def check_overlap(o, a, b):
    t, inner = Q(float(o["t"])), o["depth"]
    if not 0 <= t <= 1 or inner["kind"] != "inner_polytope":
        return False
    (x, loose_x), (y, loose_y), (i, j) = a.at(t), b.at(t), o["parts"]
    return (i < len(x) and j < len(y) and not x[i].plane and not y[j].plane
            and check_inner(inner, x[i], y[j], max(loose_x, loose_y)))


def check_impact(c, bodies):
    (shape_a, body_a), (shape_b, body_b) = bodies
    linear = [vec(body.get("motion", {}).get("linear", (0, 0, 0))) for body in (body_a, body_b)]
    seen_from = mul(-1, vec(body_b.get("pose", {}).get("translation", (0, 0, 0))))
    a = Mover(shape_a, body_a, seen_from, sub(*linear))
    b = Mover(shape_b, body_b, seen_from, (Q(0),) * 3)
    if not any(name in c for name in ("planes", "contact", "overlap")):
        return False
    if "planes" in c and not check_apart(c, a, b):
        return False
    if "contact" in c:
        t, x = rational(c["contact"]["t"]), tuple(map(rational, c["contact"]["point"]))
        if not (0 <= t <= 1 and holds_loosely(a.at(t), x) and holds_loosely(b.at(t), x)):
            return False
    return "overlap" not in c or check_overlap(c["overlap"], a, b)


def certificates_of(j):
    found = [j["certificate"]] if "certificate" in j else []
    found += j.get("certificates", {}).values()
    impact = j.get("time_of_impact") or {}
    return found + ([impact["certificate"]] if "certificate" in impact else [])


def main():
    code = 0
    for line in (text for name in sys.argv[1:] or [0] for text in open(name, encoding="utf-8")):
        try:
            j = json.loads(line)
            bodies = [(j["scene"]["shapes"][body["shape"]], body) for body in j["scene"]["bodies"][:2]]
            found = certificates_of(j)
        except (ValueError, KeyError, TypeError, IndexError) as e:
            print(f"check_certificates: bad input: {type(e).__name__}: {e}", file=sys.stderr)
            return 2
        for c in found:
            try:
                words = "valid" if (check_impact if c["kind"] == "impact" else check_pair)(c, bodies) else "not valid"
            except (Refused, ValueError, KeyError, TypeError, IndexError, OverflowError) as e:
                words = f"refused: {type(e).__name__}: {e}"
            print(words)
            code = code if words == "valid" else 1
    return code


if __name__ == "__main__":
    sys.exit(main())
