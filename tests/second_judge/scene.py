"""Scenes as exact sets: shapes, poses, motions, the scale L, and the gap of two bodies (docs/truth.md, sections 1 and 2)."""
import math
from decimal import Decimal, getcontext
from fractions import Fraction as F

from exact import Curved, Poly, add, cross, dot, exact, floats, gap, mul, nearest, quotient, sqrt_hi, sqrt_lo, sub, times, width

getcontext().prec = 60
FAR = F(10) ** 400


class HalfSpace:
    def __init__(self, n, d):
        self.n, self.d = n, d


class Mesh:
    def __init__(self, triangles, points):
        self.triangles, self.points = triangles, points


def rotation(q):
    x, y, z, w = q
    k = 2 / (x * x + y * y + z * z + w * w)
    return ((1 - k * (y * y + z * z), k * (x * y - z * w), k * (x * z + y * w)),
            (k * (x * y + z * w), 1 - k * (x * x + z * z), k * (y * z - x * w)),
            (k * (x * z - y * w), k * (y * z + x * w), 1 - k * (x * x + y * y)))


def sine_cosine(x):
    """Sine and cosine of a rational by their series, to 40 digits."""
    s, c, term, k = F(0), F(0), F(1), 0
    while abs(term) > F(1, 10 ** 45):
        c, s = (c + term * (-1) ** (k // 2), s) if k % 2 == 0 else (c, s + term * (-1) ** (k // 2))
        k += 1
        term = F(int(term * x / k * 10 ** 60), 10 ** 60)
    return s, c


def turned(q, w, t):
    """exp(t w) q; the error, below 1e-38 of a turn, is far below every tolerance."""
    angle = sqrt_lo(dot(w, w))
    if angle == 0 or t == 0:
        return q
    s, c = sine_cosine(F(int(angle * t / 2 * 10 ** 50), 10 ** 50))
    a, (bx, by, bz, bw) = mul(s / angle, w), q
    v = add(add(mul(c, (bx, by, bz)), mul(bw, a)), cross(a, (bx, by, bz)))
    return (v[0], v[1], v[2], c * bw - dot(a, (bx, by, bz)))


class CannotTell(Exception):
    pass


def pose_of(body, t=F(0), pose=None):
    """Matrix and translation at the time t of the step."""
    p = body.get("pose", {}) if pose is None else pose
    x, q = exact(p.get("translation", (0, 0, 0))), exact(p.get("rotation", (0, 0, 0, 1)))
    m = body.get("motion", {})
    return rotation(turned(q, exact(m.get("angular", (0, 0, 0))), t)), add(x, mul(t, exact(m.get("linear", (0, 0, 0)))))


def place(shape, m, c):
    kind = shape["type"]
    at = lambda y: add(times(m, y), c)
    if kind == "sphere":
        return Poly([c], F(shape["radius"]))
    if kind == "capsule":
        h = F(shape["half_height"])
        return Poly([at((F(0), F(0), h)), at((F(0), F(0), -h))], F(shape["radius"]))
    if kind in ("box", "rounded_box"):
        x, y, z = exact(shape["half_extents"])
        signs = [(1, 1, 1), (-1, 1, 1), (1, -1, 1), (1, 1, -1), (-1, -1, 1), (-1, 1, -1), (1, -1, -1), (-1, -1, -1)]
        return Poly([at((i * x, j * y, k * z)) for i, j, k in signs], F(shape.get("radius", 0)))
    if kind in ("hull", "padded_hull"):
        return Poly([at(v) for v in sorted({exact(v) for v in shape["vertices"]})], F(shape.get("padding", 0)))
    if kind == "solid_mesh":
        raise CannotTell("solid meshes are not judged here")
    if kind == "half_space":
        n = times(m, exact(shape["normal"]))
        return HalfSpace(n, F(shape["offset"]) + dot(n, c))
    if kind == "mesh":
        p = [at(exact(v)) for v in shape["vertices"]]
        return Mesh([Poly([p[i] for i in t]) for t in shape["triangles"]], p)
    kind = kind.removeprefix("padded_")
    size = [F(s) for s in shape["semi_axes"]] if kind == "ellipsoid" else [F(shape["radius"]), F(shape["half_height"])]
    return Curved(kind, size, m, c, F(shape.get("padding", 0)))


def extent(shape):
    """Full length along the body's axes; for hull and mesh also the farthest vertex; for a half-space its plane."""
    kind = shape["type"]
    if kind.startswith("padded_"):
        return extent({**shape, "type": kind[len("padded_"):]}) + 2 * F(shape["padding"])
    if kind == "half_space":
        n = exact(shape["normal"])
        return abs(F(shape["offset"])) / sqrt_lo(dot(n, n))
    if kind in ("hull", "mesh", "solid_mesh"):
        v = [exact(p) for p in shape["vertices"]]
        longest = max(max(p[i] for p in v) - min(p[i] for p in v) for i in range(3))
        return max(longest, sqrt_hi(max(dot(p, p) for p in v)))
    if kind == "capsule":
        return 2 * (F(shape["radius"]) + F(shape["half_height"]))
    if kind == "rounded_box":
        return 2 * (F(shape["radius"]) + max(F(s) for s in shape["half_extents"]))
    sizes = shape.get("half_extents") or shape.get("semi_axes") or [shape["radius"], shape.get("half_height", 0)]
    return 2 * max(F(s) for s in sizes)


def scale(scene, a, b, poses=(None, None)):
    bodies = [scene["bodies"][a], scene["bodies"][b]]
    lengths = [extent(scene["shapes"][x["shape"]]) for x in bodies] + [abs(F(scene.get("margin", 0)))]
    for t in (F(0), F(1)):
        x, y = [pose_of(body, t, p)[1] for body, p in zip(bodies, poses)]
        lengths += [abs(c) for c in x + y] + [sqrt_hi(dot(sub(x, y), sub(x, y)))]
    return max(lengths)


def world(scene, i, t=F(0), pose=None):
    body = scene["bodies"][i]
    return place(scene["shapes"][body["shape"]], *pose_of(body, t, pose))


def plane_gap(h, b):
    """Bracket of the gap of a half-space and a bounded convex set, or the points of a mesh."""
    if isinstance(b, Mesh):
        b = Poly(b.points)
    lo, hi = b.support(mul(-1, h.n))
    lo, hi = quotient(-hi - h.d, -lo - h.d, dot(h.n, h.n))
    return lo - b.radius, hi - b.radius


def pieces(s):
    return s.triangles if isinstance(s, Mesh) else [s]


def ball_around(s):
    """Centre and radius, in floats, of a bounding ball of a convex set."""
    if isinstance(s, Curved):
        k = [float(x) for x in s.size]
        return floats(s.c), (max(k) if s.kind == "ellipsoid" else math.hypot(k[0], k[1])) + float(s.radius)
    c = floats(mul(F(1, len(s.points)), (sum(p[0] for p in s.points), sum(p[1] for p in s.points), sum(p[2] for p in s.points))))
    return c, max(math.dist(c, floats(p)) for p in s.points) + float(s.radius)


def signed_gap(a, b, hints=(), deep=True):
    """Bracket of the gap of any two shapes. Where a mesh overlaps, the depth is that of its deepest triangle, an upper
    bound on the gap of a surface."""
    if isinstance(a, HalfSpace) and isinstance(b, HalfSpace):
        return -FAR, FAR
    if isinstance(a, HalfSpace):
        return plane_gap(a, b)
    if isinstance(b, HalfSpace):
        return plane_gap(b, a)
    pairs = [(x, y) for x in pieces(a) for y in pieces(b)]
    if len(pairs) == 1:
        return gap(*pairs[0], hints, deep)
    around = {id(x): ball_around(x) for x in pieces(a) + pieces(b)}
    bound = lambda x, y: math.dist(around[id(x)][0], around[id(y)][0]) - around[id(x)][1] - around[id(y)][1]
    pairs = sorted(((bound(x, y), i) for i, (x, y) in enumerate(pairs)))
    every = [(x, y) for x in pieces(a) for y in pieces(b)]
    lo, hi = FAR, FAR
    for near, i in pairs:
        if near - 1e-9 * (1 + abs(near)) > min(hi, FAR):
            break
        l, h = gap(*every[i], hints, deep)
        lo, hi = min(lo, l), min(hi, h)
    return lo, hi


def needed(a, b, n):
    """Bracket of how far B must move along n / |n| to leave A; None where that is undefined (a plane along n)."""
    plane, other, s = (a, b, 1) if isinstance(a, HalfSpace) else (b, a, -1)
    if isinstance(plane, HalfSpace):
        along = s * dot(plane.n, n)
        if along <= 0:
            return None
        lo, hi = plane_gap(plane, other)
        k = along * along / (dot(plane.n, plane.n) * dot(n, n))
        return tuple(sorted((-hi / sqrt_lo(k), -lo / sqrt_hi(k))))
    solid = lambda s: Poly(s.points) if isinstance(s, Mesh) else s
    return width(solid(a), solid(b), n)


def distance_to(p, s):
    """Bracket of the distance of a point from a shape."""
    lo, hi = signed_gap(Poly([p]), s, deep=False)
    return max(lo, F(0)), max(hi, F(0))
