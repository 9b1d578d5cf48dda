"""Brackets of distance and depth of convex sets, from certificates in exact arithmetic.

A convex set is a core and a radius: all points within the radius of the core. Floats find a guess (GJK for the distance, an
expanding polytope for the depth); the result follows from the guess in rational arithmetic:
  a direction n            gap >= -(h_A(n) + h_B(-n)) / |n|
  a point of A and of B    gap <= their distance
  a closed surface of triangles between points of the core of A - B, each with the origin at a distance >= l on the inner
  side of its plane        gap <= -l   (its winding number about the origin is not zero, so the ball is inside)
Square roots are bracketed to 2^-200 with integers.
"""
import math
import random
from fractions import Fraction as F

BITS = 200


def sqrt_floor(x):
    """The integer part of 2^k sqrt(x), and k: at least BITS bits, however small x is."""
    k = BITS + max(0, (x.denominator.bit_length() - x.numerator.bit_length()) // 2)
    return math.isqrt((x.numerator << (2 * k)) // x.denominator), k


def sqrt_lo(x):
    if x <= 0:
        return F(0)
    root, k = sqrt_floor(x)
    return F(root, 1 << k)


def sqrt_hi(x):
    if x <= 0:
        return F(0)
    root, k = sqrt_floor(x)
    return F(root + 1, 1 << k)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def mul(s, a):
    return (s * a[0], s * a[1], s * a[2])


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def exact(v):
    return tuple(F(x) for x in v)


def times(m, v):
    return tuple(dot(row, v) for row in m)


def floats(v):
    return (float(v[0]), float(v[1]), float(v[2]))


def quotient(lo, hi, n2):
    """[lo, hi] / sqrt(n2), outwards."""
    a, b = sqrt_lo(n2), sqrt_hi(n2)
    return (lo / b if lo >= 0 else lo / a), (hi / a if hi >= 0 else hi / b)


class Poly:
    """Convex hull of exact points, thickened by a radius."""

    def __init__(self, points, radius=F(0)):
        self.points, self.radius = points, radius

    def centre(self, origin):
        self.rough = [floats(sub(p, origin)) for p in self.points]

    def guess(self, d):
        best = max(range(len(self.rough)), key=lambda i: dot(self.rough[i], d))
        return self.rough[best], best

    def point(self, key):
        return self.points[key]

    def support(self, n):
        """Bracket of the support function of the core."""
        h = max(dot(p, n) for p in self.points)
        return h, h

    def extreme(self, n):
        return max(range(len(self.points)), key=lambda i: dot(self.points[i], n))


class Curved:
    """Cylinder, cone or ellipsoid, thickened by a radius: x = m y + c, y in the body's frame. Points of the core are exact:
    circles and spheres have rational parametrisations."""

    def __init__(self, kind, size, m, c, radius=F(0)):
        self.kind, self.size, self.m, self.c, self.radius = kind, size, m, c, radius
        self.transposed = tuple(zip(*m))

    def centre(self, origin):
        self.rough_m = [floats(r) for r in self.m]
        self.rough_t = list(zip(*self.rough_m))
        self.rough_c = floats(sub(self.c, origin))
        self.rough_size = [float(s) for s in self.size]

    def rough_local(self, d):
        s = self.rough_size
        if self.kind == "ellipsoid":
            u = (s[0] * d[0], s[1] * d[1], s[2] * d[2])
            k = math.sqrt(dot(u, u)) or 1.0
            u = (u[0] / k, u[1] / k, u[2] / k)
            return (s[0] * u[0], s[1] * u[1], s[2] * u[2]), u
        k = math.hypot(d[0], d[1])
        c = (d[0] / k, d[1] / k) if k else (1.0, 0.0)
        rim = (s[0] * c[0], s[0] * c[1])
        if self.kind == "cylinder":
            z = 1 if d[2] >= 0 else -1
            return (rim[0], rim[1], z * s[1]), (c[0], c[1], z)
        if dot((rim[0], rim[1], -s[1]), d) > s[1] * d[2]:
            return (rim[0], rim[1], -s[1]), (c[0], c[1], -1)
        return (0.0, 0.0, s[1]), None

    def guess(self, d):
        y, key = self.rough_local(times(self.rough_t, d))
        return add(times(self.rough_m, y), self.rough_c), key

    def point(self, key):
        s = self.size
        if key is None:
            y = (F(0), F(0), s[1])
        elif self.kind == "ellipsoid":
            y = tuple(a * b for a, b in zip(s, sphere_point(key)))
        else:
            c = circle_point(key[0], key[1])
            y = (s[0] * c[0], s[0] * c[1], key[2] * s[1])
        return add(times(self.m, y), self.c)

    def support(self, n):
        d, s = times(self.transposed, n), self.size
        if self.kind == "ellipsoid":
            q = sum((a * b) ** 2 for a, b in zip(s, d))
            lo, hi = sqrt_lo(q), sqrt_hi(q)
        else:
            q = d[0] * d[0] + d[1] * d[1]
            lo, hi = s[0] * sqrt_lo(q), s[0] * sqrt_hi(q)
            if self.kind == "cylinder":
                lo, hi = lo + s[1] * abs(d[2]), hi + s[1] * abs(d[2])
            else:
                lo, hi = max(lo - s[1] * d[2], s[1] * d[2]), max(hi - s[1] * d[2], s[1] * d[2])
        at = dot(self.c, n)
        return lo + at, hi + at

    def extreme(self, n):
        k = max(abs(x) for x in n) or F(1)
        return self.rough_local(times(self.rough_t, floats(mul(1 / k, n))))[1]


def circle_point(c, s):
    """A rational point of the unit circle close to (c, s)."""
    if c < 0:
        x, y = circle_point(-c, s)
        return -x, y
    t = F(s / (1 + c))
    return (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)


def sphere_point(u):
    if u[2] < 0:
        x, y, z = sphere_point((u[0], u[1], -u[2]))
        return x, y, -z
    p, q = F(u[0] / (1 + u[2])), F(u[1] / (1 + u[2]))
    k = 1 + p * p + q * q
    return 2 * p / k, 2 * q / k, (2 - k) / k


def width(a, b, n):
    """Bracket of w(n) = h_A(n) + h_B(-n) for the direction n / |n|, radii included."""
    la, ha = a.support(n)
    lb, hb = b.support(mul(-1, n))
    lo, hi = quotient(la + lb, ha + hb, dot(n, n))
    return lo + a.radius + b.radius, hi + a.radius + b.radius


def solve(m, r):
    """Solves a small linear system; None if it is singular. Works on floats and on rationals."""
    m, k = [list(row) + [x] for row, x in zip(m, r)], len(r)
    for i in range(k):
        p = max(range(i, k), key=lambda j: abs(m[j][i]))
        if m[p][i] == 0:
            return None
        m[i], m[p] = m[p], m[i]
        for j in range(k):
            if j != i:
                f = m[j][i] / m[i][i]
                m[j] = [x - f * y for x, y in zip(m[j], m[i])]
    return [m[i][k] / m[i][i] for i in range(k)]


def nearest(points):
    """The point of least norm of a hull of at most four points: (its square, the point, the indices that span it)."""
    best = None
    for mask in range(1, 1 << len(points)):
        s = [i for i in range(len(points)) if mask >> i & 1]
        p0, e = points[s[0]], [sub(points[i], points[s[0]]) for i in s[1:]]
        x = solve([[dot(a, b) for b in e] for a in e], [-dot(a, p0) for a in e]) if e else []
        if x is None or any(c < 0 for c in x) or sum(x) > 1:
            continue
        v = p0
        for c, a in zip(x, e):
            v = add(v, mul(c, a))
        if best is None or dot(v, v) < best[0]:
            best = (dot(v, v), v, s)
    return best


def gjk(a, b):
    """Keys (of a, of b) of the supports that span the nearest point of the core of A - B, in floats."""
    p, ka = a.guess((1.0, 0.0, 0.0))
    q, kb = b.guess((-1.0, 0.0, 0.0))
    simplex = [(sub(p, q), ka, kb)]
    for _ in range(60):
        found = nearest([s[0] for s in simplex])
        if found is None:
            break
        v2, v, used = found
        simplex = [simplex[i] for i in used]
        if len(simplex) == 4 or v2 < 1e-30:
            break
        p, ka = a.guess(mul(-1.0, v))
        q, kb = b.guess(v)
        w = sub(p, q)
        if v2 - dot(v, w) <= 1e-15 * v2 or any(s[1:] == (ka, kb) for s in simplex):
            break
        simplex.append((w, ka, kb))
    return [s[1:] for s in simplex]


def separation(a, b, rounds=8):
    """Bracket of the distance of the cores: (lower, upper, direction); lower is negative when nothing was proved."""
    keys = gjk(a, b)
    upper, lower, n = None, None, None
    for _ in range(rounds):
        v2, v, used = nearest([sub(a.point(i), b.point(j)) for i, j in keys])
        keys = [keys[i] for i in used]
        upper = v2 if upper is None else min(upper, v2)
        if v2 == 0:
            return (F(-1) if lower is None else lower), F(0), n
        d = mul(-1, v)
        if isinstance(a, Curved) or isinstance(b, Curved):
            k = max(abs(x) for x in d)
            d = exact(floats(mul(1 / k, d)))
        lo = -width(a, b, d)[1] + a.radius + b.radius
        if lower is None or lo > lower:
            lower, n = lo, d
        new = (a.extreme(d), b.extreme(mul(-1, d)))
        if new in keys or len(keys) == 4:
            break
        keys.append(new)
    return lower, sqrt_hi(upper), n


class Hull:
    """A growing polytope of points of the core of A - B, rounded to a fine grid and perturbed by a few of its units, so
    that no four points are coplanar. In integers its facets are exact; it is within `slack` of points of the core."""

    def __init__(self, a, b):
        self.a, self.b, self.points, self.keys, self.facets, self.shake = a, b, [], set(), {}, random.Random(1)
        grid = [(x, y, z) for x in (-1.0, 0.0, 1.0) for y in (-1.0, 0.0, 1.0) for z in (-1.0, 0.0, 1.0) if x or y or z]
        keys = list(dict.fromkeys(self.probe((x + 0.0137 * y, y + 0.0211 * z, z - 0.0173 * x)) for x, y, z in grid))
        seeds = [sub(a.point(i), b.point(j)) for i, j in keys]
        size = max(max(map(abs, p)) for p in seeds) or F(1)
        self.unit = F(2) ** (math.frexp(float(size))[1] - 72)
        self.slack = 2 ** 10 * self.unit
        self.solid = self.start([(self.snap(p), k) for p, k in zip(seeds, keys)])

    def snap(self, p):
        return tuple(int(x / self.unit) + self.shake.randrange(-255, 256) for x in p)

    def probe(self, d):
        return self.a.guess(d)[1], self.b.guess(mul(-1.0, d))[1]

    def start(self, seeds):
        p = seeds[0][0]
        q = max(seeds, key=lambda s: dot(sub(s[0], p), sub(s[0], p)))[0]
        area = lambda s: cross(sub(q, p), sub(s[0], p))
        r = max(seeds, key=lambda s: dot(area(s), area(s)))
        n = area(r)
        t = max(seeds, key=lambda s: abs(dot(n, sub(s[0], p))))[0]
        if dot(n, sub(t, p)) ** 2 <= 2 ** 80 * dot(n, n):
            return False
        self.points = [p, q, r[0], t]
        i, j, k = (0, 1, 2) if dot(n, sub(t, p)) < 0 else (0, 2, 1)
        for f in ((i, j, k), (3, j, i), (3, k, j), (3, i, k)):
            self.facet(*f)
        for s in seeds:
            self.insert(*s)
        return True

    def facet(self, i, j, k):
        p = self.points
        n = cross(sub(p[j], p[i]), sub(p[k], p[i]))
        off = dot(n, p[i])
        self.facets[(i, j, k)] = (n, off, off / math.sqrt(dot(n, n)) if any(n) else -math.inf)

    def insert(self, p, key):
        if key in self.keys:
            return False
        self.keys.add(key)
        seen = [f for f, (n, off, _) in self.facets.items() if dot(n, p) > off]
        edges = {e for i, j, k in seen for e in ((i, j), (j, k), (k, i))}
        for f in seen:
            del self.facets[f]
        self.points.append(p)
        for i, j in edges:
            if (j, i) not in edges:
                self.facet(i, j, len(self.points) - 1)
        return bool(seen)

    def grow(self, steps):
        """Pushes out the facet nearest to the origin until no facet moves; returns the best normals."""
        best = []
        for _ in range(steps):
            n = min(self.facets.values(), key=lambda f: f[2])[0]
            k = max(map(abs, n))
            best = [tuple(x / k for x in n)] + best[:3]
            i, j = self.probe(best[0])
            if not self.insert(self.snap(sub(self.a.point(i), self.b.point(j))), (i, j)):
                break
        return best

    def inner_ball(self):
        """The radius of a ball around the origin that the core of A - B certainly contains."""
        directed = [e for i, j, k in self.facets for e in ((i, j), (j, k), (k, i))]
        known = set(directed)
        if len(known) != len(directed) or any((j, i) not in known for i, j in known):
            return F(0)
        if any(off <= 0 for _, off, _ in self.facets.values()):
            return F(0)
        least = min(F(off * off, dot(n, n)) for n, off, _ in self.facets.values())
        return max(F(0), sqrt_lo(least) * self.unit - self.slack)


def gap(a, b, hints=(), deep=True):
    """Bracket [lo, hi] of the signed gap of two convex sets (minus the depth where they overlap)."""
    origin = a.c if isinstance(a, Curved) else a.points[0]
    a.centre(origin)
    b.centre(origin)
    r = a.radius + b.radius
    lower, upper, n = separation(a, b)
    lo, hi = lower - r, upper - r
    if lower > 0 or not deep:
        return (lo, hi) if lower > 0 else (-max(r, F(0)) - F(10) ** 400, hi)
    directions = [exact(h) for h in hints if h and any(h)]
    hull = Hull(a, b)
    if hull.solid:
        directions += [exact(x) for x in hull.grow(150)]
        hi = min(hi, -hull.inner_ball() - r)
    directions += flat_directions(a, b)
    return max([lo if n else -F(10) ** 400] + [-width(a, b, d)[1] for d in directions if any(d)]), hi


def flat_directions(a, b):
    """Cross products of edges of small polytopes: candidates for the least depth of parallel faces and flat sets."""
    if not (isinstance(a, Poly) and isinstance(b, Poly)) or len(a.points) > 8 or len(b.points) > 8:
        return []
    edges = [sub(p, s.points[0]) for s in (a, b) for p in s.points[1:4]]
    axes = [(F(1), F(0), F(0)), (F(0), F(1), F(0)), (F(0), F(0), F(1))]
    found = axes + [cross(x, y) for i, x in enumerate(edges) for y in edges[:i] + axes]
    return [m for n in found if any(n) for m in (n, mul(-1, n))]
