// The 3-D picture: bodies, the referee's certificate, the engines' normals and points. The GPU uses floats, so everything
// is drawn relative to the centre of the scene and divided by its size; both are computed in doubles.
import {
  AmbientLight, ArrowHelper, Color, DirectionalLight, DoubleSide, EdgesGeometry, GridHelper, Group, LineBasicMaterial,
  LineSegments, Mesh, MeshBasicMaterial, MeshStandardMaterial, Object3D, PerspectiveCamera, PlaneGeometry, Quaternion,
  Scene, SphereGeometry, Vector3, WebGLRenderer, BufferGeometry, Float32BufferAttribute,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Drawn } from "./certificate";
import { bodyColours, frameOf } from "./frame";
import type { Stand } from "./motion";
import { geometryOf, reachOf } from "./shapes";
import type { CasePage, V3 } from "./types";

export interface Mark {
  colour: string;
  strong: boolean;
  at: V3;
  normal?: V3 | undefined;
  /** The direction of the depth if the normal's arrow is not drawn. */
  along?: V3 | undefined;
  depth?: number | undefined;
  points: V3[];
  segment?: [V3, V3] | undefined;
  /** Pairs of a crowd, drawn as one set of thin lines. */
  lines?: [V3, V3][] | undefined;
}

const up = new Vector3(0, 0, 1);

export class Picture {
  readonly canvas: HTMLCanvasElement;
  readonly camera = new PerspectiveCamera(40, 1, 0.001, 400);
  private controls: OrbitControls;
  private renderer: WebGLRenderer;
  private scene = new Scene();
  private bodies: (Group | null)[] = [];
  private marks = new Group();
  private evidence = new Group();
  private grid: GridHelper | null = null;
  private paints = new Map<string, MeshStandardMaterial | LineBasicMaterial>();
  private centre: V3;
  private size: number;
  private focus: V3 | null = null;
  private drawnSize = "";
  private ready = false;  // nothing is drawn until the marks are set
  private smallest = 1;  // reach of the smallest body, in the picture's unit

  constructor(private data: { case: Pick<CasePage["case"], "scene">; hull_faces: CasePage["hull_faces"] }, stands: (Stand | null)[][], host: HTMLElement, moved: () => void) {
    [this.centre, this.size] = frameOf(data.case.scene, stands);
    this.renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", "the bodies in three dimensions");
    host.append(this.canvas);
    this.camera.up.copy(up);
    const sun = new DirectionalLight(0xffffff, 2.2);
    sun.position.set(0.4, -0.7, 1);
    this.camera.add(sun);
    this.scene.add(new AmbientLight(0xffffff, 1.3), this.camera, this.marks, this.evidence);
    this.makeBodies();
    this.makeTrails(stands);
    this.theme("#ffffff", "#888888");
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.zoomToCursor = true;
    this.controls.minDistance = 1e-5;
    this.controls.maxDistance = 100;
    this.controls.addEventListener("change", () => {
      this.draw();
      moved();
    });
    new ResizeObserver(() => this.resize(host)).observe(host);
    this.fit();
    this.resize(host);
  }

  private local(p: V3): Vector3 {
    return new Vector3(...(p.map((x, i) => (x - this.centre[i]!) / this.size) as V3));
  }

  private makeBodies(): void {
    const { shapes, bodies } = this.data.case.scene;
    const many = bodies.length > 2;
    // Bodies share the geometry of their shape. In a crowd each body is small, so its geometry is coarser.
    const made = new Map<number, BufferGeometry>(), materials = new Map<string, MeshStandardMaterial>();
    const fine = bodies.length > 60 ? 0.25 : 1;
    bodies.forEach((b, i) => {
      const shape = shapes[b.shape]!;
      const group = new Group();
      const colour = many && b.static ? "#8b949e" : bodyColours[i % 2]!;
      const flat = shape.type === "half_space" || shape.type === "mesh";
      const geometry = made.get(b.shape) ?? geometryOf(shape, this.data.hull_faces[String(b.shape)], 1 / this.size, 3, fine);
      made.set(b.shape, geometry);
      const opacity = flat ? 0.35 : 0.5;
      const material = materials.get(`${colour} ${opacity}`) ??
        new MeshStandardMaterial({ color: colour, transparent: true, opacity, roughness: 0.75, side: DoubleSide, depthWrite: false, forceSinglePass: fine < 1 });
      materials.set(`${colour} ${opacity}`, material);
      const mesh = new Mesh(geometry, material);
      group.add(mesh);
      const round = !["box", "hull", "mesh", "half_space", "cylinder", "cone"].includes(shape.type);
      if (!round && (geometry.attributes["position"]?.count ?? 0) < 60000)
        group.add(new LineSegments(new EdgesGeometry(geometry, 20), new LineBasicMaterial({ color: colour })));
      if (shape.type === "half_space") group.userData["plane"] = shape;
      this.bodies.push(group);
      this.scene.add(group);
    });
  }

  /** Gives every body its colour; the strong ones are drawn more opaque. */
  paint(colours: string[], strong: boolean[]): void {
    this.bodies.forEach((group, i) => group?.traverse((o) => {
      const mesh = o as Mesh, lines = o as LineSegments;
      if (!mesh.isMesh && !lines.isLineSegments) return;
      const key = `${mesh.isMesh ? "face" : "edge"} ${colours[i]} ${strong[i]}`;
      const made = this.paints.get(key) ?? (mesh.isMesh
        ? new MeshStandardMaterial({ color: colours[i]!, transparent: true, opacity: strong[i] ? 0.7 : 0.4, roughness: 0.75, side: DoubleSide, depthWrite: false })
        : new LineBasicMaterial({ color: colours[i]! }));
      this.paints.set(key, made);
      mesh.material = made;
    }));
  }

  // Draws the paths of the moving bodies' origins.
  private makeTrails(frames: (Stand | null)[][]): void {
    const { bodies, shapes } = this.data.case.scene;
    const reach = bodies.map((b) => reachOf(shapes[b.shape]!)).filter((r) => r > 0);
    if (reach.length > 0) this.smallest = Math.min(...reach) / this.size;
    if (frames.length < 2 || bodies.length > 200) return;
    bodies.forEach((_, i) => {
      const at: number[] = [];
      for (let f = 1; f < frames.length; ++f) {
        const from = frames[f - 1]![i], to = frames[f]![i];
        if (!from || !to || from.position.every((x, k) => x === to.position[k])) continue;
        at.push(...this.local(from.position).toArray(), ...this.local(to.position).toArray());
      }
      const g = new BufferGeometry();
      g.setAttribute("position", new Float32BufferAttribute(at, 3));
      if (at.length > 0) this.scene.add(new LineSegments(g, new LineBasicMaterial({ color: bodyColours[i % 2]! })));
    });
  }

  place(stands: (Stand | null)[]): void {
    stands.forEach((s, i) => {
      const g = this.bodies[i]!;
      g.visible = s !== null;
      if (!s) return;
      g.quaternion.copy(s.rotation);
      const shape = g.userData["plane"] as { normal: V3; offset: number } | undefined;
      if (!shape) return void g.position.copy(this.local(s.position));
      // The patch drawn for a half-space is the part of its plane nearest the centre of the picture.
      const length = Math.hypot(...shape.normal);
      const n = new Vector3(...shape.normal).normalize().applyQuaternion(s.rotation);
      const distance = this.local(s.position).dot(n) + shape.offset / length / this.size;
      g.position.copy(n.multiplyScalar(distance));
    });
  }

  private dispose(group: Group): void {
    group.traverse((o: Object3D) => {
      const m = o as Mesh;
      m.geometry?.dispose();
    });
    group.clear();
  }

  showEvidence(list: Drawn[], near: V3, colour: string): void {
    this.dispose(this.evidence);
    const p = this.local(near);
    for (const d of list) {
      if (d.kind === "plane") {
        const n = new Vector3(...d.normal);
        // offset − n·centre without losing digits far from the origin
        const c = d.normal[0] * this.centre[0] + d.normal[1] * this.centre[1] + d.normal[2] * this.centre[2];
        const distance = (d.offset - c) / this.size;
        const plane = new Mesh(
          new PlaneGeometry(1.5, 1.5),
          new MeshBasicMaterial({ color: colour, transparent: true, opacity: 0.28, side: DoubleSide, depthWrite: false }),
        );
        plane.quaternion.setFromUnitVectors(up, n);
        plane.position.copy(p.clone().addScaledVector(n, distance - p.dot(n)));
        plane.add(new LineSegments(new EdgesGeometry(plane.geometry), new LineBasicMaterial({ color: colour })));
        this.evidence.add(plane);
      } else if (d.kind === "polytope") {
        const g = new BufferGeometry();
        g.setAttribute("position", new Float32BufferAttribute(d.edges.flatMap((e) => e.flatMap((v) => this.local(v).toArray())), 3));
        this.evidence.add(new LineSegments(g, new LineBasicMaterial({ color: colour, transparent: true, opacity: 0.75 })));
      } else if (d.kind === "segment") {
        this.evidence.add(this.stick(this.local(d.from), this.local(d.to), colour, 0.007), this.ball(this.local(d.from), colour, 0.013), this.ball(this.local(d.to), colour, 0.013));
      } else if (d.kind === "point") {
        this.evidence.add(this.ball(this.local(d.at), colour, 0.02));
      } else {
        const n = new Vector3(...d.along).normalize();
        this.evidence.add(this.arrow(p, n, colour, 0.42, 0.011));
        this.evidence.add(this.stick(p, p.clone().addScaledVector(n, d.depth / this.size), colour, 0.012));
      }
    }
  }

  private ball(at: Vector3, colour: string, radius: number): Mesh {
    const m = new Mesh(new SphereGeometry(radius, 20, 12), new MeshBasicMaterial({ color: colour, depthTest: false, transparent: true }));
    m.position.copy(at);
    m.renderOrder = 3;
    m.userData["pixels"] = true;
    return m;
  }

  private arrow(at: Vector3, n: Vector3, colour: string, length: number, head: number): ArrowHelper {
    const a = new ArrowHelper(n, at, length, new Color(colour), head * 6, head * 3.5);
    for (const part of [a.line, a.cone]) {
      // Transparent objects are drawn last, over the bodies.
      Object.assign(part.material as MeshBasicMaterial, { depthTest: false, transparent: true });
      part.renderOrder = 2;
    }
    a.userData["pixels"] = true;
    return a;
  }

  // A cylinder: lines are one pixel wide in WebGL.
  private stick(from: Vector3, to: Vector3, colour: string, radius: number): Object3D {
    const along = to.clone().sub(from);
    const length = along.length();
    const g = new BufferGeometry();
    if (!(length > 1e-9)) {
      g.setAttribute("position", new Float32BufferAttribute([...from.toArray(), ...to.toArray()], 3));
      return new LineSegments(g, new LineBasicMaterial({ color: colour, depthTest: false }));
    }
    const m = new Mesh(
      geometryOf({ type: "cylinder", radius, half_height: length / 2 }, undefined, 1, 1, 0.2),
      new MeshBasicMaterial({ color: colour, depthTest: false, transparent: true, opacity: 0.85 }),
    );
    m.position.copy(from).addScaledVector(along, 0.5);
    m.quaternion.copy(new Quaternion().setFromUnitVectors(up, along.normalize()));
    m.renderOrder = 2;
    m.userData["stick"] = true;
    return m;
  }

  showMarks(marks: Mark[]): void {
    this.ready = true;
    this.dispose(this.marks);
    for (const m of marks) {
      const at = this.local(m.at);
      const size = m.strong ? 1 : 0.6;
      const along = m.normal ?? m.along;
      if (along && Math.hypot(...along) > 0 && along.every(Number.isFinite)) {
        const n = new Vector3(...along).normalize();
        if (m.normal) this.marks.add(this.arrow(at, n, m.colour, m.strong ? 0.36 : 0.26, 0.008 * size));
        if (m.depth !== undefined && Number.isFinite(m.depth))
          this.marks.add(this.stick(at, at.clone().addScaledVector(n, m.depth / this.size), m.colour, 0.006 * size));
      }
      if (m.lines?.length) {
        const g = new BufferGeometry();
        g.setAttribute("position", new Float32BufferAttribute(m.lines.flatMap((l) => l.flatMap((v) => this.local(v).toArray())), 3));
        const lines = new LineSegments(g, new LineBasicMaterial({ color: m.colour, depthTest: false, transparent: true }));
        lines.renderOrder = 2;
        this.marks.add(lines);
      }
      for (const p of m.points) if (p.every(Number.isFinite)) this.marks.add(this.ball(this.local(p), m.colour, 0.011 * size));
      if (m.segment && m.segment.flat().every(Number.isFinite))
        this.marks.add(this.stick(this.local(m.segment[0]), this.local(m.segment[1]), m.colour, 0.004 * size));
    }
  }

  /** Reach of the smallest body, where the scene has size 1. */
  get smallness(): number {
    return this.smallest;
  }

  setFocus(p: V3 | null): void {
    this.focus = p;
  }

  theme(back: string, line: string): void {
    this.scene.background = new Color(back);
    if (this.grid) this.scene.remove(this.grid);
    this.grid = new GridHelper(4, 20, line, line);
    this.grid.rotation.x = Math.PI / 2;
    this.grid.position.z = -0.75;
    (this.grid.material as LineBasicMaterial).transparent = true;
    (this.grid.material as LineBasicMaterial).opacity = 0.35;
    this.scene.add(this.grid);
  }

  /** Shows the whole scene. */
  fit(): void {
    this.controls?.target.set(0, 0, 0);
    this.look(new Vector3(1.35, -2.1, 1.15));
  }

  /** Moves close to the contact. */
  approach(): void {
    if (!this.focus) return;
    const target = this.local(this.focus);
    const from = this.camera.position.clone().sub(this.controls.target).normalize();
    this.controls.target.copy(target);
    this.look(target.clone().addScaledVector(from, Math.min(0.6, Math.max(this.smallest * 6, 1e-4))));
  }

  private look(position: Vector3): void {
    this.camera.position.copy(position);
    this.camera.lookAt(this.controls?.target ?? new Vector3());
    this.controls?.update();
    this.draw();
  }

  /** Radians about the vertical, radians up, and a factor of the distance. */
  orbit(sideways: number, upwards: number, zoom: number): void {
    const t = this.controls.target;
    const d = this.camera.position.clone().sub(t);
    const r = d.length() * zoom;
    const angle = Math.atan2(d.y, d.x) + sideways;
    const height = Math.max(-1.55, Math.min(1.55, Math.asin(d.z / d.length()) + upwards));
    this.look(new Vector3(Math.cos(angle) * Math.cos(height), Math.sin(angle) * Math.cos(height), Math.sin(height)).multiplyScalar(r).add(t));
    this.controls.dispatchEvent({ type: "change" });
  }

  cameraText(): string {
    return [...this.camera.position.toArray(), ...this.controls.target.toArray()].map((x) => Number(x.toPrecision(9))).join(",");
  }

  setCamera(text: string): void {
    const v = text.split(",").map(Number);
    if (v.length !== 6 || !v.every(Number.isFinite)) return;
    this.controls.target.set(v[3]!, v[4]!, v[5]!);
    this.look(new Vector3(v[0]!, v[1]!, v[2]!));
  }

  private resize(host: HTMLElement): void {
    const { clientWidth: w, clientHeight: h } = host;
    if (w === 0 || h === 0 || `${w} ${h}` === this.drawnSize) return;
    this.drawnSize = `${w} ${h}`;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(w, h, false);
    this.camera.aspect = w / h;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw(): void {
    if (!this.ready) return;
    const distance = this.controls ? this.camera.position.distanceTo(this.controls.target) : 3;
    this.camera.near = Math.max(1e-7, distance * 1e-3);
    this.camera.updateProjectionMatrix();
    // Up close, points and arrows keep their size on the screen; depths keep their length in the scene.
    const size = Math.min(1, distance / 2);
    this.scene.traverse((o) => {
      if (o.userData["pixels"]) o.scale.setScalar(size);
      if (o.userData["stick"]) o.scale.set(size, size, 1);
    });
    this.renderer.render(this.scene, this.camera);
  }
}
