// The pictures: boxes in a projection with the cells, tree or order of a method, and the intervals on each axis.
import { high, low, type BroadPage, type Box, type Frame, type Look, type Pair } from "./data";

export interface View {
  data: BroadPage; range: Pair[]; frame: Frame; look: Look;
  across: number; up: number;
  kept: boolean; pruned: boolean; structure: boolean;
  hovered: number;  // a body, or -1
}
/** From the scene to a canvas. */
export interface Projection { x(value: number): number; y(value: number): number }

const colour = (name: string): string => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
const alpha = (hex: string, opacity: number): string => hex + Math.max(3, Math.round(255 * Math.min(1, opacity))).toString(16).padStart(2, "0");

function fit(canvas: HTMLCanvasElement, ratio: number): { g: CanvasRenderingContext2D; w: number; h: number } {
  const scale = devicePixelRatio || 1, w = canvas.clientWidth, h = Math.round(w * ratio);
  canvas.style.height = `${h}px`;
  canvas.width = w * scale;
  canvas.height = h * scale;
  const g = canvas.getContext("2d")!;
  g.setTransform(scale, 0, 0, scale, 0, 0);
  g.clearRect(0, 0, w, h);
  return { g, w, h };
}

function line(g: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number): void {
  g.beginPath();
  g.moveTo(x0, y0);
  g.lineTo(x1, y1);
  g.stroke();
}

function drawCells(g: CanvasRenderingContext2D, v: View, p: Projection, w: number, h: number): void {
  v.look.grids.forEach((grid, level) => {
    for (const k of [v.across, v.up]) {
      const cell = (x: number): number => (x - grid.origin[k]!) / grid.cell[k]!;
      const first = Math.max(1, Math.floor(cell(v.range[k]![0]))), last = Math.min(grid.count[k]! - 1, Math.ceil(cell(v.range[k]![1])));
      if (last - first > 400) continue;
      g.strokeStyle = alpha(colour("part"), k === grid.along ? 0.16 : 0.53);
      g.lineWidth = 1 + level * 0.8;
      for (let c = first; c <= last; ++c) {
        const at = grid.origin[k]! + c * grid.cell[k]!;
        if (k === v.across) line(g, p.x(at), 0, p.x(at), h);
        else line(g, 0, p.y(at), w, p.y(at));
      }
    }
  });
}

/** Draws the projection and returns it, to find the box under the pointer. */
export function drawPlan(canvas: HTMLCanvasElement, v: View): Projection {
  const { g, w, h } = fit(canvas, 0.8);
  const { across, up, range, frame, hovered } = v;
  const s = Math.min(w / (range[across]![1] - range[across]![0]), h / (range[up]![1] - range[up]![0]));
  const centre = range.map(([from, to]) => (from + to) / 2);
  const clamp = (x: number, most: number): number => Math.max(-10, Math.min(most + 10, x));
  const p: Projection = { x: (x) => clamp(w / 2 + (x - centre[across]!) * s, w), y: (y) => clamp(h / 2 - (y - centre[up]!) * s, h) };
  const rectangle = (b: Box, fill: string | null, stroke: string, width: number): void => {
    const x = p.x(low(b, across)), y = p.y(high(b, up)), wide = Math.max(p.x(high(b, across)) - x, 1), tall = Math.max(p.y(low(b, up)) - y, 1);
    if (fill) {
      g.fillStyle = fill;
      g.fillRect(x, y, wide, tall);
    }
    g.strokeStyle = stroke;
    g.lineWidth = width;
    g.strokeRect(x, y, wide, tall);
  };
  if (v.structure) drawCells(g, v, p, w, h);
  const touched = new Set(frame.kept.filter((q) => q.includes(hovered)).flat());
  // The more boxes there are, the fainter each is drawn: otherwise many of them would form one dark area.
  const here = frame.boxes.filter((b) => b).length, faint = Math.min(1, 120 / Math.max(here, 1));
  const rim = here > 300 ? Math.max(0.25, faint * 2) : 1;
  frame.boxes.forEach((b, i) => {
    if (!b) return;
    const own = colour(v.data.fixed[i] ? "fixed" : "moving");
    const fill = i === hovered || touched.has(i) ? alpha(colour("kept"), 0.2) : alpha(own, 0.11 * faint);
    rectangle(b, fill, i === hovered ? colour("moving") : alpha(own, rim), i === hovered ? 2.2 : 1);
  });
  if (v.structure) v.look.nodes.forEach((level, l) => level.forEach((b) => rectangle(b, null, colour("part"), 1.2 + l)));
  const middle = (b: Box, k: number): number => {
    const from = low(b, k), to = high(b, k);
    return Number.isFinite(from) && Number.isFinite(to) ? (from + to) / 2 : Number.isFinite(from) ? from : Number.isFinite(to) ? to : centre[k]!;
  };
  // The line to a much larger box ends at its nearest point instead of its middle.
  const towards = (b: Box, from: Box, k: number): number =>
    high(b, k) - low(b, k) > 4 * (high(from, k) - low(from, k)) ? Math.max(low(b, k), Math.min(high(b, k), middle(from, k))) : middle(b, k);
  const link = (pairs: Pair[], style: string, width: number, dash: number[]): void => {
    g.strokeStyle = style;
    g.lineWidth = width;
    g.setLineDash(dash);
    g.beginPath();
    for (const [a, b] of pairs) {
      if (hovered >= 0 && a !== hovered && b !== hovered) continue;
      const from = frame.boxes[a]!, to = frame.boxes[b]!;
      g.moveTo(p.x(towards(from, to, across)), p.y(towards(from, to, up)));
      g.lineTo(p.x(towards(to, from, across)), p.y(towards(to, from, up)));
    }
    g.stroke();
    g.setLineDash([]);
  };
  const crowded = (pairs: Pair[]): boolean => pairs.length > 600 && hovered < 0;
  if (v.pruned) link(v.look.pruned, alpha(colour("pruned"), crowded(v.look.pruned) ? 0.16 : 0.67), 1, [3, 3]);
  if (v.kept) link(frame.kept, alpha(colour("kept"), crowded(frame.kept) ? 0.44 : 1), frame.kept.length > 600 ? 0.8 : 1.6, []);
  g.fillStyle = colour("soft");
  g.font = "12px sans-serif";
  g.fillText(`${"xyz"[across]!} →`, w - 28, h - 8);
  g.fillText(`${"xyz"[up]!} ↑`, 8, 16);
  return p;
}

/** The intervals of all boxes on axis k, in the order of their lower ends. */
export function drawIntervals(canvas: HTMLCanvasElement, v: View, k: number): void {
  const { g, w, h } = fit(canvas, 0.26);
  const [from, to] = v.range[k]!, span = to - from;
  const x = (value: number): number => Math.max(-5, Math.min(w + 5, ((value - from) / span) * w));
  const here = v.frame.boxes.flatMap((b, i) => (b ? [{ b, i }] : [])).sort((p, q) => low(p.b, k) - low(q.b, k));
  const grid = v.look.grids[0], step = (h - 14) / Math.max(here.length, 1);
  if (grid && v.structure && span / grid.cell[k]! < 400) {
    g.strokeStyle = alpha(colour("part"), 0.33);
    g.lineWidth = 1;
    for (let c = 1; c < grid.count[k]!; ++c) {
      const at = x(grid.origin[k]! + c * grid.cell[k]!);
      line(g, at, 0, at, h);
    }
  }
  here.forEach(({ b, i }, row) => {
    g.strokeStyle = colour(i === v.hovered ? "kept" : v.data.fixed[i] ? "fixed" : "moving");
    g.lineWidth = Math.max(0.7, Math.min(step * 0.7, 5)) * (i === v.hovered ? 1.5 : 1);
    const y = 7 + (row + 0.5) * step, start = x(low(b, k));
    line(g, start, y, Math.max(x(high(b, k)), start + 1), y);
  });
}
