// The cheapest sufficient model of a scene: what it takes beside the fixed choices, and every choice in it.
import { LinkState, app, commandLine, el, grouped, nanoseconds, numberOf, pageData, short, themeButton } from "../common/page";
import type { PlanPage } from "./types";
import "./plan.css";

const data = pageData<PlanPage>();
const { plan } = data;
const link = new LinkState();
document.title = `Touchstone: ${data.title}`;

const percent = (share: number): string => `${Math.round(100 * share)} %`;
const length = (x: unknown): string => short(numberOf(x), 4);
const time = (x: unknown): string => (numberOf(x) > 0 ? nanoseconds(numberOf(x)) : "–");
const n = (text: string, style = ""): HTMLElement => el("td", { class: `n ${style}` }, text);

function table(label: string, heads: [string, string?][], rows: HTMLElement[]): HTMLElement {
  return el("div", { class: "scroll" }, el("table", { "aria-label": label },
    el("thead", {}, el("tr", {}, ...heads.map(([text, style]) => el("th", { class: style ?? "" }, text)))), el("tbody", {}, ...rows)));
}

function choices(): HTMLElement {
  const longest = Math.max(...plan.rows.map((r) => numberOf(r.ns_min)));
  return table("time and error of a whole step", [["choice"], ["fastest round", "n"], [""], ["median", "n"], ["worst error", "n"], ["verdict"]], plan.rows.map((r, i) => {
    const why = data.reasons[i]!;
    const bar = el("div", { class: r.plan ? "time plan" : "time", style: `width:${(100 * numberOf(r.ns_min)) / longest}%` });
    return el("tr", { "data-choice": r.name, class: r.plan ? "chosen" : "" }, el("td", {}, r.name), n(time(r.ns_min)), el("td", { class: "bars", "aria-hidden": "true" }, bar), n(time(r.ns_median)), n(length(r.error)),
      el("td", { class: why ? "bad" : r.front ? "good" : "" }, why ? `unsound: ${why}` : r.front ? "on the front" : "sound"));
  }));
}

function pairs(): HTMLElement {
  return table("pairs of shapes", [["shapes, as run"], ["candidates", "n"], ["method"], ["time of a pair", "n"], ["in double", "n"], ["balls decide", "n"], ["cheap suffices", "n"], ["proven error", "n"]], plan.pairs.map((p) =>
    el("tr", { "data-pair": p.pair }, el("td", {}, p.pair.replaceAll("_", " ")), n(grouped(p.candidates)), el("td", {}, `${p.balls_first ? "bounding balls, then " : ""}${p.arithmetic}`), n(time(p.ns)), n(time(p.ns_double)),
      n(p.balls_first ? percent(p.balls_share) : "–"), n(p.arithmetic === "double" ? "–" : percent(p.cheap_share)), n(p.sampled ? length(p.certified_error) : "–"))));
}

function shapes(): HTMLElement {
  return table("simpler shapes", [["shape", "n"], ["is a"], ["run as"], ["vertices", "n"], ["bodies", "n"], ["error", "n"]], plan.shapes.map((s) =>
    el("tr", {}, n(String(s.shape)), el("td", {}, s.was), el("td", {}, s.becomes), n(s.vertices ? (s.left ? `${grouped(s.left)} of ${grouped(s.vertices)}` : grouped(s.vertices)) : "–"), n(grouped(s.bodies)), n(length(s.error)))));
}

// Bodies that must be swept. A page of 1e5 rows would open slowly; the filter reaches those beyond the first.
const most = 1000;
const filter = el("input", { id: "filter", type: "search", placeholder: "name or number of a body", "aria-label": "only bodies whose name or number has" });
const found = el("p", { class: "soft", role: "status" }), bodies = el("div", { id: "bodies" });

function drawBodies(): void {
  const wanted = filter.value.trim().toLowerCase();
  const all = plan.swept.filter((s) => !wanted || String(s.body) === wanted || s.name.toLowerCase().includes(wanted));
  found.textContent = all.length > most ? `${grouped(all.length)} bodies; the first ${grouped(most)} are listed, farthest beyond the criterion first.` : `${grouped(all.length)} ${all.length === 1 ? "body" : "bodies"}, farthest beyond the criterion first.`;
  bodies.replaceChildren(table("bodies to be swept", [["body", "n"], ["name"], ["because of"], ["may pass", "n"], ["inner radius", "n"], ["steps", "n"]], all.slice(0, most).map((s) =>
    el("tr", { "data-body": String(s.body) }, n(String(s.body)), el("td", {}, s.name || "–"), el("td", {}, s.reason === "turning" ? "rotation" : s.reason), n(length(s.pass_bound)), n(length(s.inner)), n(`${grouped(s.steps)} of ${grouped(plan.steps)}`)))));
}

const paragraphs = (lines: string[], kind = ""): HTMLElement[] => lines.map((t) => el("p", kind ? { class: kind } : {}, t));
const { processor, cores, load, compiler, date } = plan.machine;
app().append(
  el("header", {}, el("div", { class: "grow" }, el("h1", {}, data.heading), ...paragraphs(data.summary)),
    el("div", { class: "controls screen-only" }, themeButton(link, () => undefined))),
  el("main", {},
    el("h2", {}, "Time of a whole step"), choices(),
    el("p", { class: "soft" }, "Worst error: largest in the referee's sample. Unsound: errors outside the limit, pairs without an answer, or bodies not swept that the criterion sweeps. Front: nothing sound is both faster and as accurate."),
    el("h2", {}, "Broad phase"), el("p", {}, data.broad_phase),
    el("h2", {}, "Pairs of shapes"), pairs(),
    el("p", { class: "soft" }, "Double: doubles backed by extended precision. Balls decide: share decided by bounding balls. Cheap suffices: share of the rest that float or double alone answers within the error. Proven error: largest bound that the core states on the pairs sampled."),
    el("h2", {}, "Shapes"), el("p", {}, data.shapes), ...(plan.shapes.length ? [shapes()] : []),
    el("h2", {}, "Bodies to be swept"), el("p", {}, data.sweeping),
    ...(plan.swept.length ? [el("div", { class: "controls screen-only" }, filter), found, bodies, el("p", { class: "soft" }, "May pass: how deep another body may be passed unseen between two steps. Inner radius: of a ball inside the body. Both in the scene's unit.")] : []),
    el("h2", {}, "With other libraries"), ...plan.terms.flatMap((t) => [el("h3", {}, t.library), el("ul", {}, ...t.lines.map((line) => el("li", {}, line)))]),
    el("h2", {}, "Measure again"), commandLine(data.command),
    el("p", { class: "soft" }, `Measured on ${processor}, ${cores} ${cores === 1 ? "core" : "cores"}, load ${short(load, 2)}, ${compiler}, ${date}; up to ${grouped(plan.rounds)} rounds, seed ${plan.seed}.`)),
);
filter.value = link.get("body") ?? "";
filter.addEventListener("input", () => {
  link.set("body", filter.value || null);
  drawBodies();
});
drawBodies();
link.onChange(() => {
  filter.value = link.get("body") ?? "";
  drawBodies();
});
