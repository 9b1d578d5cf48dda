// The refuting script for a reader: its steps, and the intervals of the boxes at the query that fails.
import { el, short } from "../common/page";
import { shapeLine } from "../case/shape_line";
import type { ShapeJson, StepJson, V3 } from "../case/types";
import type { Refutation } from "./types";

type Box = [V3, V3];

// The axis-aligned box of an unrotated shape; null for shapes whose box takes more than simple arithmetic.
function boxOf(s: ShapeJson, at: V3): Box | null {
  const h: V3 | null = s.type === "box" ? s.half_extents! : s.type === "sphere" ? [s.radius!, s.radius!, s.radius!] : s.type === "ellipsoid" ? s.semi_axes!
    : s.type === "capsule" ? [s.radius!, s.radius!, s.radius! + s.half_height!] : s.type === "cylinder" || s.type === "cone" ? [s.radius!, s.radius!, s.half_height!] : null;
  if (!h) return null;
  return [at.map((x, k) => x - h[k]!) as V3, at.map((x, k) => x + h[k]!) as V3];
}

const stepLine = (s: StepJson, name: (i: number) => string): string =>
  s.op === "query" ? "query candidate pairs" : `${s.op} ${name(s.body!)}` + (s.op === "move" ? ` to (${(s.pose?.translation ?? [0, 0, 0]).map((x) => short(x, 9)).join(" ")})` : "");

// Three strips, one per axis. Ends are drawn to scale, or by rank if some are too close to tell apart.
function strips(boxes: [number, Box][], lost: number[]): HTMLElement {
  const host = el("div", { class: "strips" });
  for (let k = 0; k < 3; ++k) {
    const ends = [...new Set(boxes.flatMap(([, b]) => [b[0][k]!, b[1][k]!]))].sort((a, b) => a - b);
    const span = ends.at(-1)! - ends[0]!;
    const least = Math.min(...ends.slice(1).map((x, i) => x - ends[i]!));
    const ranked = ends.length > 1 && !(least > span / 60);
    const place = (x: number): number => (ends.length < 2 ? 50 : ranked ? (90 * ends.indexOf(x)) / (ends.length - 1) + 5 : (90 * (x - ends[0]!)) / span + 5);
    const rows = boxes.map(([i, b]) => {
      const from = place(b[0][k]!), to = place(b[1][k]!);
      const bar = el("div", { class: lost.includes(i) ? "bar lost" : "bar", style: `left:${from}%;width:max(3px,${to - from}%)`, title: `body ${i}: [${b[0][k]}, ${b[1][k]}]` });
      return el("div", { class: "strip" }, el("span", { class: "soft mono" }, String(i)), el("div", { class: "line" }, bar));
    });
    host.append(el("figure", {}, el("figcaption", { class: "soft" }, `${"xyz"[k]!}: ${short(ends[0]!, 6)} to ${short(ends.at(-1)!, 6)}${ranked ? ", ends in order, not to scale" : ""}`), ...rows));
  }
  return host;
}

export function drawScript(r: Refutation): HTMLElement[] {
  const { shapes, bodies, script } = r.script!.scene;
  const name = (i: number): string => `body ${i}${bodies[i]?.name ? ` (${bodies[i]!.name})` : ""}`;
  const steps = script ?? [];
  const lost = /bodies (\d+) and (\d+)/.exec(r.words)?.slice(1).map(Number) ?? [];
  const asked = Number(/query (\d+)/.exec(r.words)?.[1] ?? 0);
  const at = new Map<number, V3>(), turned = new Set<number>();
  let query = 0;
  for (const s of steps) {
    if (s.op === "query" && query++ === asked) break;
    if (s.op === "remove") at.delete(s.body!);
    if (s.op !== "insert" && s.op !== "move") continue;
    const pose = s.pose ?? bodies[s.body!]!.pose;
    at.set(s.body!, pose?.translation ?? [0, 0, 0]);
    if (pose?.rotation && Math.abs(pose.rotation[3]) < 1) turned.add(s.body!);
  }
  const boxes = [...at].map(([i, p]) => [i, boxOf(shapes[bodies[i]!.shape]!, p)] as [number, Box | null]);
  const drawable = boxes.length > 0 && boxes.length <= 24 && turned.size === 0 && boxes.every(([, b]) => b && b.flat().every(Number.isFinite));
  const list = el("ol", { class: "steps mono" }, ...steps.slice(0, 40).map((s) => el("li", {}, stepLine(s, name))));
  if (steps.length > 40) list.append(el("li", {}, `and ${steps.length - 40} more`));
  return [...(drawable ? [el("p", { class: "soft" }, `The boxes on each axis at the query${lost.length === 2 ? `; bodies ${lost.join(" and ")}, in red, overlap on all three axes but are not reported` : ""}.`), strips(boxes as [number, Box][], lost)] : []),
    el("div", { class: "columns" }, el("div", {}, el("h3", {}, "Bodies"), el("div", { class: "mono soft" }, ...bodies.slice(0, 24).map((b, i) => el("div", {}, `${i}: ${shapeLine(shapes[b.shape]!)}`)))),
      el("div", {}, el("h3", {}, "Steps"), list))];
}
