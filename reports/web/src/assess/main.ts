// Which engine can be trusted on a robot: the table of the engines, the advice, and the pairs that some engine gets
// wrong, each shown on the robot in its configuration.
import { LinkState, app, colourOf, commandLine, el, isDark, isTyping, nanoseconds, numberOf, pageData, short, themeButton } from "../common/page";
import "../case/case.css";
import { Look } from "../common/look";
import "./assess.css";
import { standAt, standsOfScript, type Stand } from "../case/motion";
import { Picture } from "../case/scene3d";
import { shapeLine } from "../case/shape_line";
import type { V3 } from "../case/types";
import type { AssessPage, EngineJson, PairJson } from "./types";

const data = pageData<AssessPage>();
const link = new LinkState();
const { bodies, shapes, script } = data.scene;
const scripted = (script ?? []).some((s) => s.op === "query");
const frames: (Stand | null)[][] = scripted ? standsOfScript(bodies, script!) : [bodies.map((b) => standAt(b, 0))];
const engines = data.assessment.engines;

// State: the engine whose pairs are listed (none: all), and the pair.
let engine = link.get("engine") ?? "";
let pair = Math.min(data.pairs.length - 1, Math.max(0, link.number("pair") ?? 0));

document.title = `Touchstone: ${data.title}`;
const view = el("div", { id: "view" }), look = el("div", { class: "controls screen-only", id: "parts" });
const table = el("div", { class: "scroll", id: "engines" }), list = el("div", { id: "pairs" }), detail = el("div", { id: "pair" });
const paragraphs = (lines: string[], kind = ""): HTMLElement[] => lines.map((t) => el("p", kind ? { class: kind } : {}, t));

app().append(
  el("header", {}, el("div", { class: "grow" }, el("h1", {}, data.title), el("p", { class: "soft" }, data.heading)),
    el("div", { class: "controls screen-only" }, themeButton(link, () => refresh()))),
  el("div", { id: "layout" },
    el("section", { id: "left" }, look, view, detail),
    el("section", { id: "right" }, el("h2", {}, "Advice"), ...paragraphs(data.advice), el("h2", {}, "Engines"), table,
      ...paragraphs(data.notes), ...paragraphs(data.legend, "soft"), el("h2", {}, "Pairs that an engine gets wrong"), list,
      el("h2", {}, "Ask again"), commandLine(data.command))),
);

let picture: Picture | null = null;
const camera = new Look(() => picture, link);
try {
  picture = new Picture({ case: { scene: data.scene }, hull_faces: data.hull_faces }, frames.slice(0, 1), view, () => {
    if (picture) link.set("camera", picture.cameraText());
  });
  look.append(...camera.buttons("go to the pair"));
} catch (e) {
  view.append(el("p", { class: "soft", style: "padding:1rem" }, `No picture: this browser does not support WebGL (${String(e)}). The tables have the same results in numbers.`));
}
const millimetres = (metres: number): string => (metres === 0 ? "0" : metres < 1e-9 ? "< 1e-6" : short(metres * 1e3, 3));
const nameOf = (body: number): string => bodies[body]?.name || `body ${body}`;

function cells(e: EngineJson): string[] {
  const o = e.questions["overlap"], d = e.questions["distance"];
  const none = (q: typeof o): string => String((q?.failed ?? 0) + (q?.unsupported ?? 0));
  const time = (q: typeof o): string => (q && q.answered > 0 ? nanoseconds(q.median_ns) : "–");
  const padding = !o || o.answered === 0 ? "–" : e.padding === null ? "unknown" : e.denied_collisions > 0 && e.padding === 0 ? "distance" : millimetres(e.padding);
  return [String(e.missed), String(e.false_alarms), none(o), time(o), e.distances_apart > 0 ? millimetres(e.worst_distance_error) : "–", none(d), time(d), padding];
}

function drawEngines(): void {
  const group = (name: string, columns: number): HTMLElement => el("th", { colspan: String(columns), class: "group" }, name);
  const head = el("thead", {}, el("tr", {}, el("th"), group("collision test", 4), group("distance", 3), el("th", { class: "n" }, "padding")),
    el("tr", {}, el("th", {}, "engine"), ...["missed", "false", "none", "time", "worst, mm", "none", "time", "mm"].map((h) => el("th", { class: "n" }, h))));
  const rows = engines.map((e) => {
    const pick = el("button", { type: "button", "aria-pressed": String(e.engine === engine), title: `${e.library} ${e.version}: ${e.settings}` }, e.engine);
    pick.addEventListener("click", () => {
      engine = engine === e.engine ? "" : e.engine;
      link.set("engine", engine || null);
      const first = data.pairs.findIndex(isListed);
      if (first >= 0 && !isListed(data.pairs[pair]!)) choose(first);
      else refresh();
    });
    return el("tr", { "data-engine": e.engine }, el("td", {}, pick), ...cells(e).map((c, i) => el("td", { class: i < 2 && c !== "0" ? "n bad" : "n" }, c)));
  });
  table.replaceChildren(el("table", {}, head, el("tbody", {}, ...rows)));
}

const isListed = (p: PairJson): boolean => !engine || p.of.some((o) => o.engine === engine);

const reason = (o: PairJson["of"][number]): string => {
  const size = `${millimetres(o.size)} mm`;
  if (o.kind === "missed") return `${o.engine} misses it${o.size > 0 ? `, ${size} deep` : ""}`;
  return o.kind === "false" ? `${o.engine} reports it, ${size} apart` : `${o.engine} is off by ${size}`;
};

function choose(i: number): void {
  pair = i;
  link.set("pair", String(i));
  refresh();
  camera.near();
}

function drawList(): void {
  const shown = data.pairs.map((p, i) => [p, i] as const).filter(([p]) => isListed(p));
  if (shown.length === 0)
    return list.replaceChildren(el("p", { class: "soft" }, data.pairs.length ? `${engine}: none.` : "None. The picture shows the first configuration."));
  const rows = shown.map(([p, i]) => {
    const pick = el("button", { type: "button", "aria-pressed": String(i === pair) }, `${nameOf(p.a)} and ${nameOf(p.b)}`);
    pick.addEventListener("click", () => choose(i));
    const of = p.of.filter((o) => !engine || o.engine === engine);
    return el("tr", { "data-pair": String(i) }, el("td", {}, pick), el("td", {}, reason(of[0]!) + (of.length > 1 ? `, and ${of.length - 1} more` : "")));
  });
  list.replaceChildren(el("table", {}, el("tbody", {}, ...rows)));
}

function truthOf(p: PairJson): string {
  const lo = numberOf(p.gap[0]), hi = numberOf(p.gap[1]), middle = (lo + hi) / 2;
  if (p.verdict === "disjoint") return `apart by ${millimetres(middle)} mm`;
  if (p.verdict !== "overlap") return "undecided";
  return Number.isFinite(middle) ? `collide, ${millimetres(-middle)} mm deep` : "collide (a mesh has no inside, and so no depth)";
}

function drawDetail(): void {
  const p = data.pairs[pair];
  if (!p) return detail.replaceChildren();
  const says = (name: string): HTMLElement[] => {
    const s = p.engines[name];
    if (!s || s.outcome !== "answered") return [el("td", { class: "soft" }, s?.outcome.replaceAll("_", " ") ?? "–"), el("td"), el("td")];
    const wrong = s.overlap !== undefined && p.verdict !== "undecided" && s.overlap !== (p.verdict === "overlap");
    const d = numberOf(s.distance);
    return [el("td", { class: s.overlap === undefined ? "soft" : wrong ? "bad" : "good" }, s.overlap === undefined ? "no verdict" : s.overlap ? "collide" : "apart"),
      el("td", { class: "n" }, Number.isFinite(d) ? short(d * 1e3, 7) : "–"),
      el("td", { class: "n" }, s.error === undefined ? "–" : millimetres(s.error))];
  };
  const rows = engines.map((e) => el("tr", { "data-says": e.engine }, el("td", {}, e.engine), ...says(e.engine)));
  detail.replaceChildren(
    el("h2", {}, el("span", { class: "swatch", style: `background:${pairColours()[0]}` }), nameOf(p.a), " and ",
      el("span", { class: "swatch", style: `background:${pairColours()[1]}` }), nameOf(p.b)),
    el("p", {}, `Configuration ${p.configuration}. In truth they ${p.verdict === "disjoint" ? "are " : ""}${truthOf(p)}.`),
    el("p", { class: "soft mono" }, `${shapeLine(shapes[bodies[p.a]!.shape]!)}; ${shapeLine(shapes[bodies[p.b]!.shape]!)}`),
    el("div", { class: "scroll" }, el("table", {}, el("thead", {}, el("tr", {}, el("th", {}, "engine"), el("th", {}, "says"), el("th", { class: "n" }, "distance, mm"), el("th", { class: "n" }, "error, mm"))), el("tbody", {}, ...rows))));
}

const pairColours = (): [string, string] => [colourOf(4), colourOf(1)];
const middle = (p: PairJson, now: (Stand | null)[]): V3 => {
  const w = p.witness;
  if (w?.flat().every(Number.isFinite)) return w[0].map((x, k) => (x + w[1][k]!) / 2) as V3;
  const a = now[p.a]?.position ?? [0, 0, 0], b = now[p.b]?.position ?? a;
  return a.map((x, k) => (x + b[k]!) / 2) as V3;
};

function refresh(): void {
  drawEngines();
  drawList();
  drawDetail();
  if (!picture) return;
  const p = data.pairs[pair];
  const now = frames[Math.min(frames.length - 1, p?.frame ?? 0)]!;
  const style = getComputedStyle(document.documentElement);
  picture.theme(style.getPropertyValue("--back").trim(), style.getPropertyValue("--soft").trim());
  picture.place(now);
  const [first, second] = pairColours();
  picture.paint(bodies.map((b, i) => (i === p?.a ? first : i === p?.b ? second : b.static ? "#8b949e" : "#7f93ad")), bodies.map((_, i) => i === p?.a || i === p?.b));
  picture.setFocus(p ? middle(p, now) : null);
  const truth = isDark() ? "#4ade80" : "#0a7a3f";
  picture.showMarks(p?.witness ? [{ colour: truth, strong: true, at: middle(p, now), points: p.witness, segment: p.witness }] : []);
  picture.draw();
}

addEventListener("keydown", (e) => {
  if (isTyping(e)) return;
  const turn = 0.08, listed = data.pairs.flatMap((p, i) => (isListed(p) ? [i] : []));
  const step = (by: number): void => {
    if (listed.length) choose(listed[(listed.indexOf(pair) + by + listed.length) % listed.length]!);
  };
  const keys: Record<string, () => void> = {
    ArrowLeft: () => picture?.orbit(-turn, 0, 1), ArrowRight: () => picture?.orbit(turn, 0, 1), ArrowUp: () => picture?.orbit(0, turn, 1), ArrowDown: () => picture?.orbit(0, -turn, 1),
    "+": () => picture?.orbit(0, 0, 0.85), "=": () => picture?.orbit(0, 0, 0.85), "-": () => picture?.orbit(0, 0, 1 / 0.85), f: camera.atAll, c: camera.near, n: () => step(1), p: () => step(-1),
  };
  const f = keys[e.key];
  if (!f) return;
  e.preventDefault();
  f();
});
link.onChange(() => {
  engine = link.get("engine") ?? "";
  pair = Math.min(data.pairs.length - 1, Math.max(0, link.number("pair") ?? pair));
  const kept = link.get("camera");
  if (kept) picture?.setCamera(kept);
  refresh();
});
const kept = link.get("camera");
refresh();
if (kept) picture?.setCamera(kept);
