// Batches of pairs (pipe_protocol.md, Batches): many pairs arrive as arrays, and are answered as they would be one by
// one, a line each.

// By the numbers of ts_shape_kind: the fields of a shape, and how many numbers each has.
const kinds = [
  ["sphere", { radius: 1 }], ["box", { half_extents: 3 }], ["capsule", { radius: 1, half_height: 1 }],
  ["cylinder", { radius: 1, half_height: 1 }], ["cone", { radius: 1, half_height: 1 }], ["ellipsoid", { semi_axes: 3 }],
  ["hull", {}], ["half_space", { normal: 3, offset: 1 }], ["mesh", {}], ["rounded_box", { half_extents: 3, radius: 1 }],
  ["solid_mesh", {}],
];
const sizes = 4, of_pose = 7, of_motion = 6, of_double = 8; // numbers of a shape, a pose and a motion; bytes

/** Hands out the numbers of an array one after the other. */
function taker(array) {
  let at = 0;
  return (n) => Array.from(array.subarray(at, (at += n)));
}
const triples = (list) => Array.from({ length: list.length / 3 }, (_, k) => list.slice(3 * k, 3 * k + 3));

function shape_of(kind, size, vertices, triangles) {
  const [type, fields] = kinds[kind], shape = { type };
  let at = 0;
  for (const [name, n] of Object.entries(fields)) {
    shape[name] = n === 1 ? size[at] : size.slice(at, at + n);
    at += n;
  }
  return vertices.length > 0 ? { ...shape, vertices: triples(vertices), triangles: triples(triangles) } : shape;
}

/** The pairs of a batch, each as a scene of two bodies, a and b. */
export function scenes_of({ count, shapes: m, triangles: t, moving }, bytes) {
  const data = new Uint8Array(bytes).buffer, integers = 3 * m + 2 * count + 3 * t;
  const int = taker(new Int32Array(data, 0, integers));
  const double = taker(new Float64Array(data, Math.ceil((4 * integers) / of_double) * of_double));
  const [kind, vertices, triangles] = [int(m), int(m), int(m)], numbers = [int(count), int(count)];
  const lists = triangles.map((n) => int(3 * n)), size = kind.map(() => double(sizes));
  const shapes = kind.map((k, s) => shape_of(k, size[s], double(3 * vertices[s]), lists[s]));
  const each = (n) => [0, 1].map(() => Array.from({ length: count }, () => double(n)));
  const poses = each(of_pose), motions = moving ? each(of_motion) : null;
  const body = (which, i) => ({
    shape: which, static: false, group: -1,
    pose: { translation: poses[which][i].slice(0, 3), rotation: poses[which][i].slice(3) },
    ...(motions && { motion: { linear: motions[which][i].slice(0, 3), angular: motions[which][i].slice(3) } }),
  });
  return Array.from({ length: count }, (_, i) => ({
    shapes: numbers.map((list) => shapes[list[i]]), bodies: [body(0, i), body(1, i)], steps: [{ op: "query" }], ignored: [],
  }));
}
