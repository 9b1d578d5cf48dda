// Geometry of every shape in the body's frame, as the scene defines it: capsules, cylinders and cones along z.
import {
  BoxGeometry, BufferGeometry, CapsuleGeometry, ConeGeometry, CylinderGeometry, Float32BufferAttribute, Matrix4,
  PlaneGeometry, Quaternion, SphereGeometry, Vector3,
} from "three";
import type { ShapeJson, V3 } from "./types";

/** Radius of a ball about the body's origin that contains the shape; 0 for a half-space. */
export function reachOf(s: ShapeJson): number {
  switch (s.type) {
    case "sphere": return s.radius!;
    case "box": return Math.hypot(...s.half_extents!);
    case "capsule": return s.radius! + s.half_height!;
    case "cylinder":
    case "cone": return Math.hypot(s.radius!, s.half_height!);
    case "ellipsoid": return Math.max(...s.semi_axes!);
    case "hull":
    case "mesh": return s.vertices!.reduce((most, v) => Math.max(most, Math.hypot(...v)), 0);
    case "half_space": return 0;
  }
}

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
export function geometryOf(s: ShapeJson, faces: V3[] | undefined, scale: number, ground: number, fine = 1): BufferGeometry {
  const alongZ = new Matrix4().makeRotationX(Math.PI / 2);
  switch (s.type) {
    case "sphere": return new SphereGeometry(s.radius! * scale, 64 * fine, 40 * fine);
    case "box": return new BoxGeometry(...(s.half_extents!.map((x) => 2 * x * scale) as V3));
    case "capsule":
      return new CapsuleGeometry(s.radius! * scale, 2 * s.half_height! * scale, Math.ceil(16 * fine), 48 * fine).applyMatrix4(alongZ);
    case "cylinder":
      return new CylinderGeometry(s.radius! * scale, s.radius! * scale, 2 * s.half_height! * scale, 64 * fine).applyMatrix4(alongZ);
    case "cone": return new ConeGeometry(s.radius! * scale, 2 * s.half_height! * scale, 64 * fine).applyMatrix4(alongZ);
    case "ellipsoid":
      return new SphereGeometry(1, 64 * fine, 40 * fine).applyMatrix4(new Matrix4().makeScale(...(s.semi_axes!.map((x) => x * scale) as V3)));
    case "hull": return triangles(s.vertices!, faces && faces.length > 0 ? faces : flat(s.vertices!), scale);
    case "mesh": return triangles(s.vertices!, s.triangles!, scale);
    case "half_space": {
      const n = new Vector3(...s.normal!);
      const g = new PlaneGeometry(2 * ground, 2 * ground, 20, 20);
      g.applyQuaternion(new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), n.clone().normalize()));
      return g;
    }
  }
}
