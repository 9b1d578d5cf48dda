// The page of one case: the bodies with the answers of every engine and the referee, and which engine is wrong.
import { LinkState, app, colourOf, commandLine, el, isDark, isTyping, nanoseconds, numberOf, pageData, short, themeButton } from "../common/page";
import { Look } from "../common/look";
import "./case.css";
import { drawn, rational, type Drawn } from "./certificate";
import { Parts } from "./parts";
import { refereeTrace, stageTable, standAlone } from "./trace";
import { standAt, standsOfScript, type Stand } from "./motion";
import { bodyColours } from "./frame";
import { Picture, type Mark } from "./scene3d";
import { shapeLine } from "./shape_line";
import { isCurved } from "./shapes";
import type { CasePage, EngineAnswer, QueryJson, V3 } from "./types";

const data = pageData<CasePage>();
const link = new LinkState();
const { bodies, shapes, script } = data.case.scene;
const engineNames = [...new Set(data.queries.flatMap((q) => Object.keys(q.engines ?? {})))];
const scripted = (script ?? []).some((s) => s.op === "query");
const frames: (Stand | null)[][] = scripted
  ? standsOfScript(bodies, script!)
  : bodies.some((b) => b.motion)
    ? Array.from({ length: 33 }, (_, i) => bodies.map((b) => standAt(b, i / 32)))
    : [bodies.map((b) => standAt(b, 0))];
const moves = !scripted && frames.length > 1;

// State: the query, the selected engine, the hidden engines, the time.
let query = Math.min(data.queries.length - 1, Math.max(0, link.number("q") ?? firstInteresting()));
let chosen = link.get("engine") ?? firstWrong(query);
const hidden = new Set((link.get("hide") ?? "").split(",").filter(Boolean));
let time = link.number("t") ?? momentOf(query);

// For a time of impact, the time of the impact: nothing shows before it.
function momentOf(i: number): number {
  const q = data.queries[i];
  const t = q && isOfMotion(q.question) && q.referee.verdict === "impact" ? numberOf(q.referee.t_hi) : 0;
  return Number.isFinite(t) ? t : 0;
}

// The question with the most wrong answers, else the one about contact.
function firstInteresting(): number {
  const wrong = data.queries.map((q) => Object.values(q.engines ?? {}).filter((e) => e.faults.length > 0).length);
  const most = Math.max(0, ...wrong);
  return Math.max(0, most > 0 ? wrong.lastIndexOf(most) : data.queries.findIndex((q) => q.question === "contact"));
}

function isWrong(e?: EngineAnswer): boolean { return e !== undefined && e.faults.length > 0; }

// The engine whose wrong answer a reader sees first: one whose answer can be drawn, the largest error of these. "": all
// engines are drawn, because none is wrong.
function firstWrong(i: number): string {
  const rank = (e: EngineAnswer): number[] => {
    const error = e.faults.reduce((most, f) => Math.max(most, Math.min(numberOf(f.error_in_l), 1e300) || 0), 0);
    return [Number(e.answer.outcome === "answered"), Number(Boolean(e.answer.normal?.every(Number.isFinite) || e.answer.witness)), error];
  };
  const wrong = Object.entries(data.queries[i]?.engines ?? {}).filter(([, e]) => isWrong(e)).map(([name, e]) => ({ name, rank: rank(e) }));
  wrong.sort((x, y) => x.rank.map((v, k) => y.rank[k]! - v).find((d) => d !== 0) ?? 0);
  return wrong[0]?.name ?? "";
}

const stands = (): (Stand | null)[] =>
  scripted ? frames[Math.min(frames.length - 1, Math.round(time))]! : bodies.map((b) => standAt(b, moves ? time : 0));
// The selected engine, where it is wrong, is red: what it says stands beside the truth, which is green.
const colour = (engine: string): string =>
  engine === chosen && isWrong(data.queries[query]?.engines?.[engine]) ? (isDark() ? "#ff8b81" : "#d00000") : colourOf(engineNames.indexOf(engine));
const refereeColour = (): string => (isDark() ? "#4ade80" : "#0a7a3f");

const units = "Lengths are in the scene's unit, times t in steps. L is the scale of the pair, by which errors are divided.";
document.title = `Touchstone: ${data.title}`;
// Polyhedral shapes are their own polytopes: the wireframe would only hide their edges.
const curved = shapes.some(isCurved);
const parts = new Parts(link, curved ? [] : ["polytope"], () => refresh());
const view = el("div", { id: "view" });
const claim = el("div", { id: "claim" });
const table = el("div", { id: "answers", class: "scroll" });
const tabs = el("div", { class: "controls", id: "questions" });
const words = el("div", { id: "referee" });
const commands = el("div", { id: "commands" });
const trace = el("div", { id: "trace" });
const how = el("details", { id: "referee-trace" });
const timeline = el("div", { id: "timeline" });
const tick = el("datalist", { id: "marks" });

app().append(
  el("header", {}, el("div", { class: "grow" }, el("h1", {}, data.title), data.case.description ? el("p", { class: "soft" }, data.case.description) : null),
    el("div", { class: "controls screen-only" }, themeButton(link, () => refresh()))),
  el("div", { id: "layout" },
    el("section", { id: "left" }, claim, parts.element, view, timeline,
      el("p", { class: "soft screen-only", id: "keys" },
        "Drag to rotate, wheel to zoom, right button to pan. Keys: arrows rotate, + and − zoom, f whole scene, c contact, n and p next and previous engine, q next question, 1 to 6 choose what is drawn, " +
        (frames.length > 1 ? "[ and ] step back and forward in time, space plays, " : "") + "l light or dark.")),
    el("section", { id: "right" }, tabs, words, table, trace, el("h2", {}, "Ask again"), commands,
      el("h2", {}, "Bodies"), bodyList(), data.case.source ? el("p", { class: "soft" }, `Source: ${data.case.source}`) : null)),
);

function bodyList(): HTMLElement {
  const list = el("div", { class: "soft mono", id: "bodies" });
  bodies.slice(0, 12).forEach((b, i) => {
    const p = b.pose?.translation ?? [0, 0, 0];
    list.append(el("div", {}, el("span", { class: "swatch", style: `background:${bodyColours[i % 2]}` }),
      `${i}${b.name ? " " + b.name : ""}: ${shapeLine(shapes[b.shape]!)}, at (${p.map((x) => short(x, 6)).join(" ")})` +
      (b.motion ? `, moves (${(b.motion.linear ?? [0, 0, 0]).map((x) => short(x)).join(" ")}) turns (${(b.motion.angular ?? [0, 0, 0]).map((x) => short(x)).join(" ")})` : "")));
  });
  if (bodies.length > 12) list.append(el("div", {}, `and ${bodies.length - 12} more`));
  return list;
}

let picture: Picture | null = null;
const camera = new Look(() => picture, link);
try {
  picture = new Picture(data, frames, view, () => {
    if (picture) link.set("camera", picture.cameraText());
  });
  const tiny = picture.smallness < 0.03 ? el("span", { class: "soft" }, "a body is tiny beside the scene") : null;
  parts.element.append(el("span", { class: "grow" }), ...camera.buttons("go to the contact"), ...(tiny ? [tiny] : []));
} catch (e) {
  view.append(el("p", { class: "soft", style: "padding:1rem" }, `No picture: this browser does not support WebGL (${String(e)}). The table has the same results in numbers.`));
}

/** Where arrows begin: the contact or witness points of the engine or the referee, else between the bodies. */
function anchorOf(q: QueryJson, e?: EngineAnswer): V3 {
  const points = e?.answer.manifold?.map((m) => m.position).filter((p) => p.every(Number.isFinite)) ?? [];
  if (points.length > 0) return [0, 1, 2].map((k) => points.reduce((s, p) => s + p[k]! / points.length, 0)) as V3;
  const w = e?.answer.witness ?? q.referee.witness;
  if (w && w.flat().every(Number.isFinite)) return w[0].map((x, k) => (x + w[1][k]!) / 2) as V3;
  if (q.referee.witness && !isOfMotion(q.question)) return anchorOf(q);
  const now = stands();
  const a = now[q.a]?.position, b = now[q.b]?.position;
  const contact = isOfMotion(q.question) ? q.referee.certificate?.contact : undefined;
  if (contact && b) return contact.point.map((x, k) => rational(x) + b[k]!) as V3;
  const bounded = [a, b].filter((p, i) => p && shapes[bodies[[q.a, q.b][i]!]!.shape]!.type !== "half_space") as V3[];
  if (bounded.length === 0) return [0, 0, 0];
  return [0, 1, 2].map((k) => bounded.reduce((s, p) => s + p[k]! / bounded.length, 0)) as V3;
}

function marksOf(q: QueryJson): Mark[] {
  const out: Mark[] = [];
  const now = stands();
  for (const name of engineNames) {
    const e = q.engines?.[name];
    if (!e || hidden.has(name) || e.answer.outcome !== "answered" || (chosen && name !== chosen)) continue;
    const a = e.answer;
    const base = { colour: colour(name), strong: name === chosen || !chosen };
    const contacts = a.contacts ?? [];
    for (const c of contacts.slice(0, 200)) {
      const p = now[c.a]?.position, r = now[c.b]?.position;
      if (p && r) out.push({ ...base, at: p.map((x, k) => (x + r[k]!) / 2) as V3, normal: c.normal, depth: numberOf(c.depth), points: [] });
    }
    const sets = scripted ? a.candidate_pairs?.[Math.round(time)] : a.candidate_pairs?.[0];
    const between = ([i, j]: [number, number]): [V3, V3][] => {
      const p = now[i]?.position, r = now[j]?.position;
      return p && r ? [[p, r]] : [];
    };
    if (sets && (name === chosen || (!chosen && name === engineNames[0])))
      out.push({ ...base, at: [0, 0, 0], points: [], lines: sets.slice(0, 20000).flatMap(between) });
    const truth = q.question === "candidates" ? (scripted ? q.referee.overlapping_pairs?.[Math.round(time)] : q.referee.overlapping_pairs?.[0]) : undefined;
    if (truth && sets && (name === chosen || (!chosen && e.faults.length > 0))) {
      const has = new Set(sets.flatMap(([i, j]) => [`${i},${j}`, `${j},${i}`]));
      const lost = truth.filter(([i, j]) => !has.has(`${i},${j}`)).slice(0, 200);
      for (const [p, r] of lost.flatMap(between))
        out.push({ colour: isDark() ? "#ff5c4d" : "#d00000", strong: true, at: p, points: [p, r], segment: [p, r] });
    }
    if (!a.normal && !a.witness && !a.manifold?.length) continue;
    const mark: Mark = { ...base, at: anchorOf(q, e), points: [...(a.manifold?.map((m) => m.position) ?? []), ...(a.witness ?? [])] };
    if (a.normal) mark.normal = a.normal;
    if (a.depth !== undefined) mark.depth = numberOf(a.depth);
    if (a.witness) mark.segment = a.witness;
    out.push(mark);
  }
  return out;
}

function isOfContact(question: string): boolean { return question === "contact" || question === "contact_within"; }

function isOfMotion(question: string): boolean { return question === "time_of_impact" || question === "ray"; }

function stated(q: QueryJson, e: EngineAnswer): string {
  const a = e.answer;
  if (a.outcome !== "answered") return a.outcome.replace("_", " ");
  switch (q.question) {
    case "overlap": return a.overlap === undefined ? "–" : a.overlap ? "overlap" : "apart";
    case "distance": return a.distance !== undefined ? short(numberOf(a.distance), 10) : a.overlap ? "overlap, no distance" : "apart, no distance";
    case "contact":
    case "contact_within": {
      if (!a.overlap) return q.question === "contact" ? "apart" : "beyond";
      const n = a.normal ? ` along (${a.normal.map((x) => short(numberOf(x), 3)).join(" ")})` : "";
      const points = a.manifold?.length ?? 0;
      const depth = a.depth === undefined ? NaN : numberOf(a.depth);
      const far = q.question === "contact_within" && depth < 0 ? `${short(-depth, 9)} apart` : `depth ${a.depth === undefined ? "–" : short(depth, 9)}`;
      return `${far}${n}, ${points} ${points === 1 ? "point" : "points"}`;
    }
    case "within": return a.overlap === undefined ? "–" : a.overlap ? "within" : "beyond";
    case "bounded_distance":
      if (a.distance !== undefined) return short(numberOf(a.distance), 10);
      return a.lower_bound === undefined ? "–" : `at least ${short(numberOf(a.lower_bound), 10)}`;
    case "ray": return a.toi === undefined ? "no hit" : `t = ${short(numberOf(a.toi), 10)}`;
    case "time_of_impact": return a.toi === undefined ? "no impact" : `t = ${short(numberOf(a.toi), 10)}`;
    case "candidates_within":
    case "candidates": return `${(a.candidate_pairs ?? []).reduce((s, p) => s + p.length, 0)} pairs in ${(a.candidate_pairs ?? []).length} queries`;
    default: return `${a.contacts?.length ?? 0} contacts`;
  }
}

function refereeLine(q: QueryJson): string {
  const r = q.referee;
  if (r.overlapping_pairs) return `${r.overlapping_pairs.reduce((s, p) => s + p.length, 0)} pairs overlap in ${r.overlapping_pairs.length} queries`;
  if (r.pairs_within) return `${r.pairs_within.reduce((s, p) => s + p.length, 0)} pairs are within the margin in ${r.pairs_within.length} queries`;
  if (isOfMotion(q.question))
    return r.verdict === "impact" ? `impact, t in [${r.t_lo}, ${r.t_hi}]` : `${r.verdict}${r.note ? "; " + r.note : ""}`;
  const lo = numberOf(r.gap?.[0]), hi = numberOf(r.gap?.[1]);
  const gap = Number.isFinite(lo) ? `, signed distance ${short((lo + hi) / 2, 14)}${hi > lo ? `, known to ${(hi - lo).toExponential(1)}` : " exactly"}` : "";
  return `${r.within ? `${r.within} the margin, ` : ""}${r.verdict}${gap}` + (isOfContact(q.question) && r.verdict === "overlap" && r.normal ? `, least along (${r.normal.map((x) => short(x)).join(" ")})` : "");
}

function drawTable(q: QueryJson): void {
  const rows = engineNames.filter((n) => q.engines?.[n] && q.engines[n]!.answer.outcome !== "unsupported");
  const cannot = engineNames.filter((n) => !rows.includes(n));
  const t = el("table", {}, el("thead", {}, el("tr", {}, ...["", "engine", "", "says", "error / L", "time"].map((h, i) => el("th", i > 3 ? { class: "n" } : i === 0 ? { class: "screen-only" } : {}, h)))));
  const body = el("tbody");
  for (const name of rows) {
    const e = q.engines[name]!;
    const wrong = e.faults.length > 0;
    const claimed = numberOf(e.claimed_in_l) || 0;
    const verdict = wrong ? e.ruling.toUpperCase() : e.right && claimed > 0 ? `right within its claimed ${claimed.toPrecision(2)} L` : e.ruling;
    const left = (e.not_judged ?? []).map((u) => u.claim).join("; ");
    const see = el("input", { type: "checkbox", title: `draw ${name}` });
    see.checked = !hidden.has(name);
    see.addEventListener("change", () => {
      see.checked ? hidden.delete(name) : hidden.add(name);
      link.set("hide", hidden.size ? [...hidden].join(",") : null);
      refresh();
    });
    const pick = el("button", { type: "button", "aria-pressed": String(name === chosen), title: data.engines[name]?.settings ?? "" }, name);
    pick.addEventListener("click", () => choose(name === chosen ? "" : name));
    const worst = e.faults.reduce((m, f) => Math.max(m, numberOf(f.error_in_l) || 0), 0);
    const row = el("tr", { "data-engine": name }, el("td", { class: "screen-only" }, see),
      el("td", {}, el("span", { class: "swatch", style: `background:${colour(name)}` }), pick),
      el("td", { class: wrong ? "bad" : e.right && !claimed ? "good" : "warn", title: left ? `not judged: ${left}` : "" }, verdict),
      el("td", {}, stated(q, e)), el("td", { class: "n" }, worst > 0 ? worst.toExponential(1) : "–"),
      el("td", { class: "n" }, nanoseconds(e.elapsed_ns)));
    if (wrong || e.blame !== "none") row.className = "open";
    body.append(row);
    if (row.className === "open") body.append(el("tr", {}, el("td", { class: "screen-only" }), el("td", { colspan: "5", class: "soft faults" }, ...faultLines(e))));
  }
  t.append(body);
  const every = el("button", { type: "button", id: "every" }, hidden.size ? "draw all" : "draw none");
  every.addEventListener("click", () => {
    if (hidden.size) hidden.clear();
    else for (const n of rows) hidden.add(n);
    link.set("hide", hidden.size ? [...hidden].join(",") : null);
    refresh();
  });
  table.replaceChildren(t, rows.length > 1 ? el("div", { class: "controls screen-only" }, every) : "", cannot.length ? el("p", { class: "soft" }, `cannot: ${cannot.join(", ")}`) : "");
}

function faultLines(e: EngineAnswer): HTMLElement[] {
  const lines = e.faults.slice(0, 4).map((f) => el("div", {}, el("b", {}, f.fault.replaceAll("_", " ")), `: ${f.words}`));
  if (e.faults.length > 4) lines.push(el("div", {}, `and ${e.faults.length - 4} more`));
  if (e.blame === "representation") lines.push(el("div", {}, "blame: rounding of the scene; right for the scene as received"));
  if (e.blame === "algorithm") lines.push(el("div", {}, "blame: the algorithm; also wrong for the scene as received"));
  return lines;
}

function drawTabs(): void {
  tabs.replaceChildren(...data.queries.map((q, i) => {
    const wrong = Object.values(q.engines ?? {}).filter((e) => e.faults.length > 0).length;
    const b = el("button", { type: "button", "aria-pressed": String(i === query) }, `${q.question.replaceAll("_", " ")}${data.queries.length > 4 ? ` ${q.a}–${q.b}` : ""}${wrong ? ` · ${wrong} wrong` : ""}`);
    b.addEventListener("click", () => {
      ask(i);
    });
    return b;
  }));
}

// Shows another question: unless the reader has chosen an engine, with the first wrong answer to it.
function ask(i: number): void {
  query = i;
  link.set("q", String(i));
  if (link.get("engine") === null) chosen = firstWrong(i);
  refresh();
}

// "": all engines. The address then has an empty name, because without one the first wrong engine is chosen.
function choose(name: string): void {
  chosen = name;
  link.set("engine", name);
  const t = q().engines?.[name]?.answer.toi;
  if (moves && t !== undefined) setTime(numberOf(t));
  refresh();
}
const q = (): QueryJson => data.queries[query]!;

// The slider sets the time t in the step, or the query of a script.
let slider: HTMLInputElement | null = null;
const clock = el("output", { id: "clock", class: "mono" });
let playing = 0;
if (frames.length > 1) {
  slider = el("input", scripted ? { type: "range", id: "time", min: "0", max: String(frames.length - 1), step: "1" } : { type: "range", id: "time", min: "0", max: "1", step: "0.0005", list: "marks" });
  slider.setAttribute("aria-label", scripted ? "query of the script" : "time");
  slider.addEventListener("input", () => setTime(Number(slider!.value)));
  const play = el("button", { type: "button", id: "play", title: "play (space)" }, "▶");
  play.addEventListener("click", togglePlay);
  timeline.append(play, slider, clock, tick);
}
function setTime(t: number): void {
  const last = scripted ? frames.length - 1 : 1;
  time = Math.max(0, Math.min(last, Number.isFinite(t) ? t : 0));
  link.set("t", String(time));
  refresh();
}
function togglePlay(): void {
  if (playing) {
    clearInterval(playing);
    playing = 0;
    return;
  }
  const last = scripted ? frames.length - 1 : 1;
  playing = window.setInterval(() => setTime(time >= last ? 0 : time + (scripted ? 1 : 0.005)), scripted ? 500 : 33);
}

function drawTimeline(): void {
  if (!slider) return;
  slider.value = String(time);
  clock.value = scripted ? `query ${Math.round(time) + 1} of ${frames.length}` : `t = ${time.toFixed(4)}`;
  // Marks at the impact reported by each engine and by the referee.
  const impacts = data.queries.filter((x) => isOfMotion(x.question));
  tick.replaceChildren(...impacts.flatMap((x) => [x.referee.t_hi, ...Object.values(x.engines ?? {}).map((e) => e.answer.toi)])
    .map(numberOf).filter(Number.isFinite).map((t) => el("option", { value: String(t) })));
}

// The truth in few words; how precisely it is known stands below.
function shortTruth(q: QueryJson): string {
  const lo = numberOf(q.referee.gap?.[0]), hi = numberOf(q.referee.gap?.[1]), middle = (lo + hi) / 2;
  if (isOfMotion(q.question) || !Number.isFinite(middle)) return refereeLine(q);
  if (q.referee.verdict === "disjoint") return `apart by ${short(middle, 6)}`;
  if (q.referee.verdict !== "overlap" || middle > 0) return refereeLine(q);
  const normal = isOfContact(q.question) && q.referee.normal ? ` along (${q.referee.normal.map((x) => short(x, 3)).join(" ")})` : "";
  return middle === 0 ? "the bodies touch" : `the bodies overlap; the least depth is ${short(-middle, 6)}${normal}`;
}

// Over the picture: what is true, and what the selected engine says, in the colours of what is drawn.
function drawClaim(now: QueryJson): void {
  const line = (css: string, who: string, says: string, verdict: HTMLElement | null): HTMLElement =>
    el("p", {}, el("span", { class: "swatch", style: `background:${css}` }), el("b", {}, who), ` ${says} `, verdict);
  const e = now.engines?.[chosen];
  const others = engineNames.filter((n) => n !== chosen && isWrong(now.engines?.[n])).length;
  claim.replaceChildren(line(refereeColour(), "Truth:", shortTruth(now), null));
  if (!e) return;
  claim.append(line(colour(chosen), `${chosen} says:`, stated(now, e), el("b", { class: isWrong(e) ? "bad" : e.right ? "good" : "warn" }, isWrong(e) ? e.ruling.toUpperCase() : e.ruling)));
  if (e.faults[0]) claim.append(el("p", { class: "bad" }, `${e.faults[0].fault.replaceAll("_", " ")}: ${e.faults[0].words}`));
  if (isWrong(e) && others > 0) claim.append(el("p", { class: "soft" }, `${others} more ${others > 1 ? "engines are" : "engine is"} wrong: see the table, or press n.`));
}

const allDrawn = (q: QueryJson): Drawn[] => drawn(q.referee, q.question, moves ? time : 0, stands()[q.b]?.position ?? [0, 0, 0]);

function refresh(): void {
  const now = q();
  drawTabs();
  drawClaim(now);
  drawTable(now);
  drawTimeline();
  const evidence = allDrawn(now).filter((d) => parts.has(d.kind === "polytope" ? "polytope" : "certificate"));
  const stages = stageTable(data, now, colour);
  trace.replaceChildren(...(stages ? [el("h2", {}, "Stages of the wrong engines"), stages] : []));
  words.replaceChildren(
    el("p", {}, el("span", { class: "swatch", style: `background:${refereeColour()}` }), el("b", {}, "referee: "), refereeLine(now)),
    ...[...new Set(evidence.map((d) => d.words))].map((w) => el("p", { class: "soft" }, `drawn: ${w}`)),
    el("p", { class: "soft", id: "units" }, units),
    how);
  how.replaceChildren(el("summary", { class: "soft" }, "how the referee knows"), el("ul", { class: "soft" }, ...refereeTrace(now).map((x) => el("li", {}, x))));
  // Commands for the selected engine, or the only wrong one: the smaller case and the program against its own API.
  const wrong = engineNames.filter((n) => (now.engines?.[n]?.faults.length ?? 0) > 0);
  const of = wrong.includes(chosen) ? chosen : wrong.length === 1 ? wrong[0]! : (wrong.find((n) => data.engines[n]?.programs?.some((p) => p.question === now.question)) ?? "");
  const asked = data.command.replace(/^\S+ replay /, "");
  const open = document.querySelector<HTMLDetailsElement>("#program")?.open ?? false;
  commands.replaceChildren(commandLine(data.command), ...(of
    ? [el("p", { class: "soft" }, `The smallest case that ${of} gets wrong:`), commandLine(`./touchstone shrink ${asked} --engine ${of}`), ...standAlone(data, of, now.question, asked)]
    : []));
  const program = document.querySelector<HTMLDetailsElement>("#program");
  if (program) program.open = open;
  document.body.dataset["drawn"] = evidence.map((d) => d.kind).join(" ");
  if (!picture) return;
  const style = getComputedStyle(document.documentElement);
  picture.theme(style.getPropertyValue("--back").trim(), style.getPropertyValue("--soft").trim());
  picture.place(stands());
  const anchor = anchorOf(now);
  picture.setFocus(anchor);
  picture.showEvidence(evidence, anchor, refereeColour());
  picture.showMarks(marksOf(now).map((m) => ({
    ...m, normal: parts.has("normals") ? m.normal : undefined, along: m.normal, depth: parts.has("depths") ? m.depth : undefined,
    points: parts.has("points") ? m.points : [], segment: parts.has("lines") ? m.segment : undefined, lines: parts.has("lines") ? m.lines : undefined,
  })));
  picture.draw();
}

addEventListener("keydown", (e) => {
  if (isTyping(e)) return;
  const turn = 0.08;
  const step = scripted ? 1 : 0.01;
  const overSlider = e.target === slider && e.key.startsWith("Arrow");
  const keys: Record<string, () => void> = {
    ArrowLeft: () => picture?.orbit(-turn, 0, 1), ArrowRight: () => picture?.orbit(turn, 0, 1),
    ArrowUp: () => picture?.orbit(0, turn, 1), ArrowDown: () => picture?.orbit(0, -turn, 1),
    "+": () => picture?.orbit(0, 0, 0.85), "=": () => picture?.orbit(0, 0, 0.85), "-": () => picture?.orbit(0, 0, 1 / 0.85),
    f: camera.atAll, c: camera.near,
    q: () => ask((query + 1) % data.queries.length),
    n: () => nextEngine(1), p: () => nextEngine(-1),
    "]": () => setTime(time + step), "[": () => setTime(time - step),
  };
  if (frames.length > 1 && !(e.target instanceof HTMLButtonElement)) keys[" "] = togglePlay;
  const f = keys[e.key];
  if (!f || overSlider) return;
  e.preventDefault();
  f();
});
function nextEngine(by: number): void {
  const shown = ["", ...engineNames.filter((n) => q().engines?.[n]?.answer.outcome === "answered")];
  choose(shown[(shown.indexOf(chosen) + by + shown.length) % shown.length]!);
}

addEventListener("beforeprint", () => {
  picture?.theme("#ffffff", "#888888");
  picture?.draw();
});
addEventListener("afterprint", () => refresh());
link.onChange(() => {
  query = Math.min(data.queries.length - 1, Math.max(0, link.number("q") ?? query));
  chosen = link.get("engine") ?? firstWrong(query);
  time = link.number("t") ?? 0;
  parts.follow();
  const kept = link.get("camera");
  if (kept) picture?.setCamera(kept);
  refresh();
});
const kept = link.get("camera");
refresh();
if (kept) picture?.setCamera(kept);
