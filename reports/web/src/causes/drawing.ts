// A small picture of a case in three dimensions on a plain canvas. A page has dozens of them, and a browser gives a page
// only about sixteen WebGL contexts.
import { Box3, BufferGeometry, EdgesGeometry, Quaternion, Vector3 } from "three";
import { ConvexHull } from "three/examples/jsm/math/ConvexHull.js";
import { bodyColours, frameOf } from "../case/frame";
import { standAt, standsOfScript, type Stand } from "../case/motion";
import { geometryOf } from "../case/shapes";
import type { SceneJson, ShapeJson, V3 } from "../case/types";
import { el } from "../common/page";

const mostBodies = 60, mostTriangles = 20000;
const motionFrames = 32;
const sun = new Vector3(0.35, 0.55, 0.76).normalize();  // towards the light, in the camera's axes

interface Body {
  shape: ShapeJson;
  rgb: [number, number, number];
  corners: Float32Array;  // nine numbers a triangle, in the body's axes and the picture's unit
  edges: Float32Array;  // six numbers an edge
}

const round = (s: ShapeJson): boolean => !["box", "hull", "mesh", "half_space", "cylinder", "cone"].includes(s.type);

// Triangles of a hull; undefined for a flat one.
function hullFaces(vertices: V3[]): V3[] | undefined {
  const points = vertices.map((v) => new Vector3(...v));
  if (points.length < 4) return undefined;
  const index = new Map(points.map((p, i) => [p, i]));
  const faces = new ConvexHull().setFromPoints(points).faces.map((f) => {
    const corners = [f.edge, f.edge.next, f.edge.prev].map((e) => index.get(e.head().point)!);
    return corners as V3;
  });
  return faces.length > 0 ? faces : undefined;
}

const flatPositions = (g: BufferGeometry): Float32Array => new Float32Array((g.index ? g.toNonIndexed() : g).getAttribute("position")!.array);

function framesOf(scene: SceneJson): (Stand | null)[][] {
  const { bodies, script } = scene;
  if (script?.some((s) => s.op === "query")) return standsOfScript(bodies, script);
  if (!bodies.some((b) => b.motion)) return [bodies.map((b) => standAt(b, 0))];
  return Array.from({ length: motionFrames + 1 }, (_, i) => bodies.map((b) => standAt(b, i / motionFrames)));
}

/** Whether the case can be drawn here; a crowd would only be a blot. */
export function canDraw(scene: SceneJson): boolean {
  if (!Array.isArray(scene.shapes) || !Array.isArray(scene.bodies)) return false;
  const triangles = scene.shapes.reduce((n, s) => n + (s.triangles?.length ?? 0), 0);
  return scene.bodies.length > 0 && scene.bodies.length <= mostBodies && triangles <= mostTriangles;
}

export class Drawing {
  readonly element: HTMLElement;
  private canvas = el("canvas", { tabindex: "0", role: "img" });
  private frames: (Stand | null)[][];
  private bodies: Body[];
  private centre: V3;
  private size: number;
  private middle = new Vector3();  // of all that is drawn, in the picture's unit
  private radius = 0.5;
  private frame = 0;
  private turn = -0.95;
  private tilt = 0.45;
  private zoom = 1;

  constructor(scene: SceneJson, label: string) {
    this.frames = framesOf(scene);
    [this.centre, this.size] = frameOf(scene, this.frames);
    this.bodies = scene.bodies.map((b, i) => this.bodyOf(scene.shapes[b.shape]!, i));
    this.fit();
    this.canvas.setAttribute("aria-label", `${label}; arrows rotate, + and − zoom`);
    this.canvas.title = "drag or arrow keys: rotate; + and −: zoom";
    this.element = el("figure", { class: "drawing" }, this.canvas, this.slider());
    this.listen();
    new ResizeObserver(() => this.draw()).observe(this.canvas);
  }

  private bodyOf(shape: ShapeJson, i: number): Body {
    const faces = shape.type === "hull" ? hullFaces(shape.vertices!) : undefined;
    const geometry = geometryOf(shape, faces, 1 / this.size, 0.9, 0.375);
    const edges = round(shape) ? new Float32Array(0) : flatPositions(new EdgesGeometry(geometry, 20));
    const hex = parseInt(bodyColours[i % 2]!.slice(1), 16);
    return { shape, rgb: [hex >> 16, (hex >> 8) & 255, hex & 255], corners: flatPositions(geometry), edges };
  }

  // The vertices of a hull or mesh may be far from its body's origin, so what counts is what is drawn. A body that is
  // large beside all others, such as a floor, does not count.
  private fit(): void {
    const boxes = this.bodies.map((body, i) => {
      const box = new Box3();
      if (body.shape.type !== "half_space")
        for (const stands of this.frames)
          if (stands[i])
            for (let t = 0; t < body.corners.length; t += 3)
              box.expandByPoint(new Vector3().fromArray(body.corners, t).applyQuaternion(stands[i].rotation).add(this.placeOf(body, stands[i])));
      return box;
    }).filter((b) => !b.isEmpty());
    const sizes = boxes.map((b) => b.getSize(new Vector3()).length());
    const largest = 30 * Math.min(...sizes);
    const all = new Box3();
    boxes.forEach((b, i) => sizes[i]! <= largest && all.union(b));
    if (all.isEmpty()) return;
    all.getCenter(this.middle);
    this.radius = Math.max(1e-9, all.getSize(new Vector3()).length() / 2);
  }

  private slider(): HTMLElement | null {
    if (this.frames.length < 2) return null;
    const moving = this.frames.length === motionFrames + 1;
    const range = el("input", { type: "range", min: "0", max: String(this.frames.length - 1), value: "0", "aria-label": moving ? "time" : "query of the script" });
    const clock = el("output", {}, moving ? "t = 0" : "query 1");
    range.addEventListener("input", () => {
      this.frame = Number(range.value);
      clock.value = moving ? `t = ${(this.frame / motionFrames).toFixed(2)}` : `query ${this.frame + 1}`;
      this.draw();
    });
    return el("figcaption", { class: "controls screen-only" }, range, clock);
  }

  private listen(): void {
    const rotate = (sideways: number, upwards: number): void => {
      this.turn += sideways;
      this.tilt = Math.max(-1.5, Math.min(1.5, this.tilt + upwards));
      this.draw();
    };
    this.canvas.addEventListener("pointerdown", (e) => this.canvas.setPointerCapture(e.pointerId));
    this.canvas.addEventListener("pointermove", (e) => {
      if (this.canvas.hasPointerCapture(e.pointerId)) rotate(-e.movementX * 0.012, e.movementY * 0.012);
    });
    const keys: Record<string, () => void> = {
      ArrowLeft: () => rotate(-0.1, 0), ArrowRight: () => rotate(0.1, 0), ArrowUp: () => rotate(0, 0.1), ArrowDown: () => rotate(0, -0.1),
      "+": () => this.scale(1.2), "=": () => this.scale(1.2), "-": () => this.scale(1 / 1.2),
    };
    this.canvas.addEventListener("keydown", (e) => {
      const f = keys[e.key];
      if (!f || e.ctrlKey || e.metaKey || e.altKey) return;
      e.preventDefault();
      f();
    });
  }

  private scale(by: number): void {
    this.zoom = Math.max(0.2, Math.min(1e4, this.zoom * by));
    this.draw();
  }

  // Where a body's origin is in the picture. The patch drawn for a half-space is the part nearest the centre.
  private placeOf(b: Body, s: Stand): Vector3 {
    const at = new Vector3(...(s.position.map((x, k) => (x - this.centre[k]!) / this.size) as V3));
    if (b.shape.type !== "half_space") return at;
    const length = Math.hypot(...b.shape.normal!);
    const n = new Vector3(...b.shape.normal!).normalize().applyQuaternion(s.rotation);
    return n.clone().multiplyScalar(at.dot(n) + b.shape.offset! / length / this.size);
  }

  draw(): void {
    const { clientWidth: w, clientHeight: h } = this.canvas;
    const g = this.canvas.getContext("2d");
    if (!g || w === 0 || h === 0) return;
    const dense = Math.min(devicePixelRatio, 2);
    this.canvas.width = w * dense;
    this.canvas.height = h * dense;
    g.scale(dense, dense);
    g.translate(w / 2, h / 2);
    g.lineJoin = "round";
    const unit = (0.47 * Math.min(w, h) * this.zoom) / this.radius;
    // The camera's axes: x to the right, y up, z towards the viewer.
    const view = new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0), this.tilt - Math.PI / 2)
      .multiply(new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), -this.turn - Math.PI / 2));
    const parts: { depth: number; paint: () => void }[] = [];
    this.frames[this.frame]!.forEach((stand, i) => {
      if (!stand) return;
      const body = this.bodies[i]!;
      const turn = view.clone().multiply(stand.rotation), shift = this.placeOf(body, stand).sub(this.middle).applyQuaternion(view);
      const point = (from: Float32Array, at: number): Vector3 =>
        new Vector3(from[at]!, from[at + 1]!, from[at + 2]!).applyQuaternion(turn).add(shift);
      for (let t = 0; t < body.corners.length; t += 9) {
        const [a, b, c] = [point(body.corners, t), point(body.corners, t + 3), point(body.corners, t + 6)] as const;
        parts.push({ depth: a.z + b.z + c.z, paint: () => this.triangle(g, unit, a, b, c, body) });
      }
      for (let t = 0; t < body.edges.length; t += 6) {
        const [a, b] = [point(body.edges, t), point(body.edges, t + 3)] as const;
        parts.push({ depth: 1.5 * (a.z + b.z), paint: () => this.edge(g, unit, a, b, body) });
      }
    });
    for (const part of parts.sort((p, q) => p.depth - q.depth)) part.paint();
  }

  private triangle(g: CanvasRenderingContext2D, unit: number, a: Vector3, b: Vector3, c: Vector3, body: Body): void {
    const n = b.clone().sub(a).cross(c.clone().sub(a)).normalize();
    const light = 0.5 + 0.5 * Math.abs(n.dot(sun));
    const alpha = body.shape.type === "half_space" || body.shape.type === "mesh" ? 0.3 : 0.5;
    g.fillStyle = `rgba(${body.rgb.map((x) => Math.round(Math.min(255, x * light * 1.15))).join(",")},${alpha})`;
    g.beginPath();
    g.moveTo(a.x * unit, -a.y * unit);
    g.lineTo(b.x * unit, -b.y * unit);
    g.lineTo(c.x * unit, -c.y * unit);
    g.fill();
  }

  private edge(g: CanvasRenderingContext2D, unit: number, a: Vector3, b: Vector3, body: Body): void {
    g.strokeStyle = `rgb(${body.rgb.map((x) => Math.round(x * 0.8)).join(",")})`;
    g.lineWidth = 1.1;
    g.beginPath();
    g.moveTo(a.x * unit, -a.y * unit);
    g.lineTo(b.x * unit, -b.y * unit);
    g.stroke();
  }
}
