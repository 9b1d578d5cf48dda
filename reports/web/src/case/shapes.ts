// Every shape in the body's frame, as the scene defines it: capsules, cylinders and cones along z. The one table of shapes
// of the pages: a type of shape that is not in it is not known to the compiler.
import {
  BoxGeometry, BufferGeometry, CapsuleGeometry, ConeGeometry, CylinderGeometry, Float32BufferAttribute, Matrix4,
  PlaneGeometry, Quaternion, SphereGeometry, Vector3,
} from "three";
import { RoundedBoxGeometry } from "three/examples/jsm/geometries/RoundedBoxGeometry.js";
import type { ShapeJson, V3 } from "./types";

interface Picture {
  faces: V3[] | undefined;
  scale: number;
  ground: number;
  fine: number;
}

interface Row {
  /** Radius of a ball about the body's origin that contains the shape. */
  reach(s: ShapeJson): number;
  /** Its core is neither a polytope nor a point: a certificate's polytope adds to the picture. */
  curved?: true;
  geometry(s: ShapeJson, p: Picture): BufferGeometry;
}

const length = (v: V3): number => Math.hypot(...v);
const farthest = (s: ShapeJson): number => s.vertices!.reduce((most, v) => Math.max(most, length(v)), 0);
const alongZ = (g: BufferGeometry): BufferGeometry => g.applyMatrix4(new Matrix4().makeRotationX(Math.PI / 2));

const support: Record<"cylinder" | "cone" | "ellipsoid" | "hull", (s: ShapeJson, d: Vector3) => Vector3> = {
  cylinder: (s, d) => {
    const k = s.radius! / (Math.hypot(d.x, d.y) || 1);
    return new Vector3(k * d.x, k * d.y, d.z < 0 ? -s.half_height! : s.half_height!);
  },
  cone: (s, d) => {
    const across = Math.hypot(d.x, d.y), k = s.radius! / (across || 1);
    const isApex = 2 * s.half_height! * d.z > s.radius! * across;
    return isApex ? new Vector3(0, 0, s.half_height!) : new Vector3(k * d.x, k * d.y, -s.half_height!);
  },
  ellipsoid: (s, d) => {
    const [x, y, z] = s.semi_axes!;
    const n = Math.hypot(x * d.x, y * d.y, z * d.z) || 1;
    return new Vector3((x * x * d.x) / n, (y * y * d.y) / n, (z * z * d.z) / n);
  },
  hull: (s, d) =>
    s.vertices!.map((v) => new Vector3(...v)).reduce((best, v) => (v.dot(d) > best.dot(d) ? v : best)),
};

/** The points of the surface with the normals of a sphere's grid. */
function padded(core: keyof typeof support, s: ShapeJson, { scale, fine }: Picture): BufferGeometry {
  const g = alongZ(new SphereGeometry(1, 96 * fine, 64 * fine)), at = g.getAttribute("position");
  for (let i = 0; i < at.count; ++i) {
    const d = new Vector3().fromBufferAttribute(at, i).normalize();
    const p = support[core](s, d).addScaledVector(d, s.padding!).multiplyScalar(scale);
    at.setXYZ(i, p.x, p.y, p.z);
  }
  g.computeVertexNormals();
  return g;
}

const table = {
  sphere: {
    reach: (s) => s.radius!,
    geometry: (s, { scale, fine }) => new SphereGeometry(s.radius! * scale, 64 * fine, 40 * fine),
  },
  box: {
    reach: (s) => length(s.half_extents!),
    geometry: (s, { scale }) => new BoxGeometry(...(s.half_extents!.map((x) => 2 * x * scale) as V3)),
  },
  rounded_box: {
    reach: (s) => length(s.half_extents!) + s.radius!,
    geometry: (s, { scale, fine }) =>
      new RoundedBoxGeometry(...(s.half_extents!.map((x) => 2 * (x + s.radius!) * scale) as V3), Math.ceil(8 * fine), s.radius! * scale),
  },
  capsule: {
    reach: (s) => s.radius! + s.half_height!,
    geometry: (s, { scale, fine }) =>
      alongZ(new CapsuleGeometry(s.radius! * scale, 2 * s.half_height! * scale, Math.ceil(16 * fine), 48 * fine)),
  },
  cylinder: {
    reach: (s) => Math.hypot(s.radius!, s.half_height!),
    curved: true,
    geometry: (s, { scale, fine }) =>
      alongZ(new CylinderGeometry(s.radius! * scale, s.radius! * scale, 2 * s.half_height! * scale, 64 * fine)),
  },
  cone: {
    reach: (s) => Math.hypot(s.radius!, s.half_height!),
    curved: true,
    geometry: (s, { scale, fine }) => alongZ(new ConeGeometry(s.radius! * scale, 2 * s.half_height! * scale, 64 * fine)),
  },
  ellipsoid: {
    reach: (s) => Math.max(...s.semi_axes!),
    curved: true,
    geometry: (s, { scale, fine }) =>
      new SphereGeometry(1, 64 * fine, 40 * fine).applyMatrix4(new Matrix4().makeScale(...(s.semi_axes!.map((x) => x * scale) as V3))),
  },
  hull: {
    reach: farthest,
    geometry: (s, { faces, scale }) => triangles(s.vertices!, faces && faces.length > 0 ? faces : flat(s.vertices!), scale),
  },
  half_space: {
    reach: () => 0,
    geometry: (s, { ground }) => {
      const n = new Vector3(...s.normal!);
      const g = new PlaneGeometry(2 * ground, 2 * ground, 20, 20);
      g.applyQuaternion(new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), n.clone().normalize()));
      return g;
    },
  },
  mesh: {
    reach: farthest,
    geometry: (s, { scale }) => triangles(s.vertices!, s.triangles!, scale),
  },
  solid_mesh: {
    reach: farthest,
    geometry: (s, { scale }) => triangles(s.vertices!, s.triangles!, scale),
  },
  padded_cylinder: {
    reach: (s) => Math.hypot(s.radius!, s.half_height!) + s.padding!,
    curved: true,
    geometry: (s, p) => padded("cylinder", s, p),
  },
  padded_cone: {
    reach: (s) => Math.hypot(s.radius!, s.half_height!) + s.padding!,
    curved: true,
    geometry: (s, p) => padded("cone", s, p),
  },
  padded_ellipsoid: {
    reach: (s) => Math.max(...s.semi_axes!) + s.padding!,
    curved: true,
    geometry: (s, p) => padded("ellipsoid", s, p),
  },
  padded_hull: {
    reach: (s) => farthest(s) + s.padding!,
    geometry: (s, p) => padded("hull", s, p),
  },
} satisfies Record<string, Row>;

export type ShapeType = keyof typeof table;

const rowOf = (s: ShapeJson): Row => table[s.type];

/** Radius of a ball about the body's origin that contains the shape; 0 for a half-space. */
export const reachOf = (s: ShapeJson): number => rowOf(s).reach(s);
export const isCurved = (s: ShapeJson): boolean => rowOf(s).curved ?? false;

function triangles(vertices: V3[], faces: V3[], scale: number): BufferGeometry {
  const positions = new Float32Array(faces.length * 9);
  faces.forEach((f, i) => f.forEach((v, k) => vertices[v]!.forEach((x, c) => (positions[9 * i + 3 * k + c] = x * scale))));
  const g = new BufferGeometry();
  g.setAttribute("position", new Float32BufferAttribute(positions, 3));
  g.computeVertexNormals();
  return g;
}

// A hull without faces is flat and has few vertices: the triangles of all vertex triples cover it.
function flat(vertices: V3[]): V3[] {
  const faces: V3[] = [];
  const n = Math.min(vertices.length, 24);
  for (let i = 0; i < n; ++i) for (let j = i + 1; j < n; ++j) for (let k = j + 1; k < n; ++k) faces.push([i, j, k]);
  return faces;
}

/** `scale`: from the scene's unit to the picture's. `ground`: half the side of the patch drawn for a half-space.
 * `fine`: the resolution of curved shapes, 1 for close-ups. */
export const geometryOf = (s: ShapeJson, faces: V3[] | undefined, scale: number, ground: number, fine = 1): BufferGeometry =>
  rowOf(s).geometry(s, { faces, scale, ground, fine });
