// How the answers came about: the referee's stages, the first wrong stage of each wrong engine, and the program that
// shows the fault against the engine's own API.
import { commandLine, el, numberOf, short } from "../common/page";
import type { CasePage, QueryJson } from "./types";

const arithmetic = ["doubles with proven error bounds", "extended precision with error bounds", "exact integers"];
const spaced = (s: string): string => s.replaceAll("_", " ");

/** What the referee did for this question, one line per stage. */
export function refereeTrace(q: QueryJson): string[] {
  const r = q.referee;
  if (r.overlapping_pairs || r.pairs_within) return ["every pair of bodies is decided separately"];
  if (q.question === "time_of_impact" || q.question === "ray") {
    const c = r.certificate;
    if (!c) return ["no certificate in a form that `touchstone check` accepts"];
    const lines = [];
    if (c.planes?.length) lines.push(`apart from the start: ${c.planes.length} track${c.planes.length > 1 ? "s" : ""} of moving planes, checked until t = ${c.clear_until}`);
    if (c.contact) lines.push(`together: a point in both bodies at t = ${short(numberOf(r.t_hi), 15)}, with rational coordinates`);
    return lines;
  }
  const lines: string[] = [];
  if (r.filter_level !== undefined) lines.push(`verdict: decided in ${arithmetic[r.filter_level] ?? "exact arithmetic"}`);
  const v = r.verdict_certificate;
  if (v?.kind === "separating_plane") lines.push(`certificate: ${v.rationals && v.rationals.length > 4 ? `${Math.floor(v.rationals.length / 4)} planes` : "a plane"} between A and B${v.rationals?.length ? ", with rational coefficients" : ""}`);
  if (v?.kind === "common_point") lines.push(`certificate: a point in both${v.rationals?.length ? ", with rational coordinates" : ""}`);
  if (v?.note) lines.push(v.note);
  const lo = numberOf(r.gap?.[0]), hi = numberOf(r.gap?.[1]);
  if (Number.isFinite(lo)) lines.push(`signed distance: between ${lo} and ${hi}`);
  else if (r.verdict === "overlap") lines.push("depth: not defined, because a mesh is a surface without an inside");
  const d = r.depth_certificate;
  if (d?.kind === "inner_polytope")
    lines.push(`depth at least ${short(numberOf(d.offset), 12)}: ` + (d.facets?.length ? `a polytope of ${d.support_pairs!.length} exact points of A − B, ${d.facets.length} facets, around the origin` : (d.note ?? "")));
  return lines;
}

const heads: Record<string, string> = {
  representation: "rounding", failure: "failure", "broad phase": "broad", overlap: "overlap", "simplex (distance)": "distance", "contact verdict": "verdict",
  normal: "normal", depth: "depth", manifold: "points", cast: "impact",
};

/** The engines that are wrong about this pair, by stage; null if none was traced. */
export function stageTable(data: CasePage, q: QueryJson, colour: (engine: string) => string): HTMLElement | null {
  const rows = Object.entries(data.engines).flatMap(([name, e]) => {
    const pair = e.stages?.find((s) => s.a === q.a && s.b === q.b);
    return pair ? [{ name, stages: pair.stages }] : [];
  });
  if (rows.length === 0) return null;
  const names = rows[0]!.stages.map((s) => s.name);
  const body = el("tbody", {}, ...rows.map(({ name, stages }) => {
    const first = stages.findIndex((s) => s.faults.length > 0);
    return el("tr", { "data-stages": name }, el("td", {}, el("span", { class: "swatch", style: `background:${colour(name)}` }), name),
      el("td", { class: "bad" }, first < 0 ? "right for the pair alone" : stages[first]!.faults.map((f) => spaced(f.replace(/^\S+ /, ""))).join(", ")), ...stages.map((s, i) =>
      el("td", { class: s.faults.length ? (i === first ? "bad first" : "bad") : "soft", title: s.faults.length ? s.faults.map(spaced).join(", ") : "right, or no such answer" }, s.faults.length ? "✗" : "·")));
  }));
  return el("div", {}, el("p", { class: "soft" }, "The two bodies alone, in the order an engine works. Framed: the first wrong stage. ·: right, or no such answer."),
    el("div", { class: "scroll" }, el("table", { class: "stages" }, el("thead", {}, el("tr", {}, el("th", {}, "engine"), el("th", {}, "wrong first"), ...names.map((n) => el("th", { title: n }, heads[n] ?? n)))), body)));
}

/** The program against the engine's own API, or the command that writes it. */
export function standAlone(data: CasePage, engine: string, question: string, asked: string): HTMLElement[] {
  const e = data.engines[engine];
  if (!e?.has_reproducer) return [];
  const p = e.programs?.find((x) => x.question === question);
  const is_module = p?.program.includes("node reproduce.mjs") ?? false, file = is_module ? "reproduce.mjs" : "reproduce.cpp";
  const command = commandLine(`./touchstone reproduce ${asked} --engine ${engine}${p ? ` --key ${p.key}` : ""} -o ${file}`);
  if (!p) return [el("p", { class: "soft" }, `The stand-alone test against ${e.library}'s own API, if it supports the question:`), command];
  const copy = el("button", { type: "button" }, "copy");
  copy.addEventListener("click", () => void navigator.clipboard?.writeText(p.program).then(() => (copy.textContent = "copied")));
  const save = el("a", { download: file, href: `data:text/plain,${encodeURIComponent(p.program)}` }, "save");
  return [el("p", { class: "soft" }, `The stand-alone test: one ${is_module ? "JavaScript" : "C++"} file against ${e.library}'s own API, which exits with 1 while the answer is wrong.`), command,
    el("details", { id: "program" }, el("summary", {}, `show it (${p.program.split("\n").length} lines)`), el("div", { class: "controls screen-only" }, copy, save), el("pre", {}, p.program))];
}
