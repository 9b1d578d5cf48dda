// A script's broad phases: boxes in a projection, their intervals on each axis, the cells, tree or order of a method, the
// pairs kept and pruned, and a slider over the queries.
import { app, el, grouped, LinkState, themeButton } from "../common/page";
import "./broad.css";
import { broadPage, high, low, rangeOf } from "./data";
import { drawIntervals, drawPlan, type Projection, type View } from "./draw";

const data = broadPage(), range = rangeOf(data), link = new LinkState();
document.title = `Broad phase: ${data.name || "scene"}`;
let hovered = -1, projection: Projection;

function select(id: string, options: [string, string][], initial: string): HTMLSelectElement {
  const s = el("select", { id });
  for (const [value, text] of options) s.append(new Option(text, value));
  const read = (): void => {
    const wanted = link.get(id);
    s.value = options.some(([v]) => v === wanted) ? wanted! : initial;
  };
  read();
  link.onChange(read);
  s.addEventListener("input", () => link.set(id, s.value));
  s.addEventListener("input", () => draw());
  return s;
}
function toggle(id: string, text: string): { input: HTMLInputElement; label: HTMLElement } {
  const input = el("input", { id, type: "checkbox" });
  const read = (): void => {
    input.checked = link.get(id) !== "0";
  };
  read();
  link.onChange(read);
  input.addEventListener("input", () => link.set(id, input.checked ? null : "0"));
  input.addEventListener("input", () => draw());
  return { input, label: el("label", {}, input, text) };
}

const axes: [string, string][] = [["0", "x"], ["1", "y"], ["2", "z"]];
const method = select("method", data.methods.map((m, i) => [String(i), m.replaceAll("_", " ")]), "0");
const across = select("across", axes, "0"), up = select("up", axes, "2");
const kept = toggle("show_kept", "kept"), pruned = toggle("show_pruned", "pruned"), structure = toggle("show_structure", "structure");
const frame = el("input", { id: "frame", type: "range", min: "0", max: String(data.frames.length - 1) });
const readFrame = (): void => {
  frame.value = String(link.number("frame") ?? 0);
};
readFrame();
link.onChange(readFrame);
frame.addEventListener("input", () => link.set("frame", frame.value));
frame.addEventListener("input", () => draw());

const plan = el("canvas", { id: "plan" }), frameName = el("span", { id: "frame_name" }), hover = el("p", { id: "hover" });
const counts = el("table", { id: "counts" }), explanation = el("p", { id: "explanation", class: "soft" });
const strips = axes.map(([k]) => ({ title: el("h2", {}), canvas: el("canvas", { id: `strip${k}` }) }));
app().append(
  el("header", {}, el("div", { class: "grow" }, el("h1", {}, `Broad phase: ${data.name || "scene"}, ${grouped(data.bodies.length)} bodies`),
    el("p", { class: "soft" }, "A broad phase finds the pairs whose axis-aligned bounding boxes overlap without testing all pairs. Two boxes overlap if their intervals overlap on x, y and z.")),
    el("div", { class: "controls screen-only" }, themeButton(link, () => draw()))),
  el("main", {},
    el("div", { class: "controls bar" }, el("label", {}, "Method ", method), el("label", {}, "Query ", frame, frameName),
      el("label", {}, "Across ", across), el("label", {}, "Up ", up), kept.label, pruned.label, structure.label),
    el("div", { id: "pictures" }, el("div", {}, plan, hover), el("div", {}, counts, ...strips.flatMap((s) => [s.title, s.canvas]))),
    explanation),
);

const view = (): View => {
  const f = data.frames[Number(frame.value)]!;
  return { data, range, frame: f, look: f.looks[Number(method.value)]!, across: Number(across.value), up: Number(up.value),
    kept: kept.input.checked, pruned: pruned.input.checked, structure: structure.input.checked, hovered };
};

function countRow(colour: string, text: string, n: number): HTMLElement {
  return el("tr", {}, el("td", {}, colour ? el("span", { class: "swatch", style: `background:var(--${colour})` }) : null, text), el("td", { class: "n" }, grouped(n)));
}

function draw(): void {
  const v = view(), { frame: f, look } = v;
  projection = drawPlan(plan, v);
  strips.forEach((s, k) => {
    drawIntervals(s.canvas, v, k);
    const order = look.sweep_axis === k && look.grids.length === 0 ? " — swept in this order"
      : look.grids[0]?.along === k ? " — the grid's columns run along this axis" : "";
    s.title.textContent = `Intervals on ${"xyz"[k]!}: ${grouped(f.overlap_on_axis[k]!)} pairs overlap here${order}`;
  });
  const fewer = f.kept.length > 0 ? ` (${grouped(Math.round(f.all_pairs / f.kept.length))}× fewer)` : "";
  counts.replaceChildren(el("tbody", {},
    countRow("", "all pairs (exact tests without a broad phase)", f.all_pairs),
    countRow("part", "considered by the method", look.considered),
    countRow("pruned", "… of these, pruned because the boxes do not overlap", look.considered - Math.min(look.considered, f.kept.length)),
    countRow("kept", `kept (exact tests with the broad phase)${fewer}`, f.kept.length)));
  frameName.textContent = `${Number(frame.value) + 1} of ${data.frames.length}`;
  explanation.textContent = `The method's own account: ${look.explanation}`;
  hover.textContent = hovered < 0 ? "Point at a box to see only its pairs."
    : `${data.bodies[hovered]!}${data.fixed[hovered] ? " (fixed)" : ""}: ${f.kept.filter((p) => p.includes(hovered)).length} pairs kept`;
}

// The smallest box under the pointer.
function bodyAt(x: number, y: number): number {
  const v = view();
  let best = -1, least = Infinity;
  v.frame.boxes.forEach((b, i) => {
    if (!b) return;
    const x0 = projection.x(low(b, v.across)), x1 = projection.x(high(b, v.across)), y0 = projection.y(high(b, v.up)), y1 = projection.y(low(b, v.up));
    const area = (x1 - x0) * (y1 - y0);
    if (x >= x0 - 2 && x <= x1 + 2 && y >= y0 - 2 && y <= y1 + 2 && area < least) {
      least = area;
      best = i;
    }
  });
  return best;
}
function pointAt(body: number): void {
  if (body === hovered) return;
  hovered = body;
  draw();
}
plan.addEventListener("mousemove", (e) => pointAt(bodyAt(e.offsetX, e.offsetY)));
plan.addEventListener("mouseleave", () => pointAt(-1));
addEventListener("resize", draw);
link.onChange(draw);
draw();
