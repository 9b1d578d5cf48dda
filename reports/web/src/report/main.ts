// A campaign: its causes, results by engine, and findings by key.
import { BarChart } from "echarts/charts";
import { GridComponent, LegendComponent, TooltipComponent } from "echarts/components";
import { init, use } from "echarts/core";
import { SVGRenderer } from "echarts/renderers";
import { causeTable, type CauseRow } from "../common/cause_table";
import { LinkState, app, colourOf, commandLine, el, grouped, nanoseconds, numberOf, pageData, themeButton } from "../common/page";
import { FindingsBrowser } from "./browser";
import { Findings, type FindingsJson } from "./findings";
import "./report.css";

use([BarChart, GridComponent, LegendComponent, TooltipComponent, SVGRenderer]);

interface Tally {
  outcomes: Record<string, number>;
  right: number; wrong: number; missed: number; ghost: number; undecided: number; not_judged?: number; representation: number;
  worst_in_l: unknown; ns_median?: number; ns_p99?: number; times_include_pipe?: boolean;
}
interface ReportPage {
  page: "report"; version: number; title: string; directory: string;
  settings: { subject?: string; seed?: number; family?: string } | null;
  summary: {
    cases: number; pair_cases: number; overlapping: number; undecided: number; digest?: string;
    engines: Record<string, Record<string, Tally>>;
    families?: Record<string, number>;
  };
  findings: FindingsJson;
  causes: { command: string; list: (CauseRow & { command: string })[] };
}

const data = pageData<ReportPage>();
const link = new LinkState();
const findings = new Findings(data.findings);
// Questions in their usual order, not alphabetically.
const order = ["overlap", "distance", "contact", "time_of_impact", "candidates", "swept_candidates", "scene_contacts", "within",
               "bounded_distance", "contact_within", "candidates_within", "ray"];
for (const [engine, tallies] of Object.entries(data.summary.engines))
  data.summary.engines[engine] = Object.fromEntries(Object.entries(tallies).sort(([a], [b]) => order.indexOf(a) - order.indexOf(b)));
document.title = `Touchstone: ${data.title}`;
const style = (name: string): string => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

const engines = Object.keys(data.summary.engines);
const chart = el("div", { class: "chart", id: "chart", style: `height:${Math.max(180, 80 + 24 * engines.length)}px` });
const browser = new FindingsBrowser(findings, link, data.directory);
const causes = data.causes.list;
const engineTable = el("div", { class: "scroll", id: "engines" });

app().append(
  el("header", {}, el("div", { class: "grow" }, el("h1", {}, data.title), subjectLine(), el("p", { class: "soft" }, summaryLine())), el("div", { class: "controls screen-only" }, themeButton(link, draw))),
  el("main", {}, ...causesFirst(), el("h2", { id: "wrong" }, "Wrong and failed answers by engine"), chart, el("h2", { id: "by-key" }, "Findings by key"), browser.element,
    el("h2", { id: "answers" }, "All answers"), engineTable, familiesLine()),
);

// The causes before all else: what to read, and the command that shows it.
function causesFirst(): HTMLElement[] {
  if (!causes.length) return [];
  const command = el("div", { id: "cause-command" }, commandLine(data.causes.command));
  const table = causeTable(causes, (c) => {
    const open = el("button", { type: "button" }, c.title);
    open.addEventListener("click", () => command.replaceChildren(commandLine(c.command)));
    return open;
  });
  return [el("h2", { id: "causes" }, `${grouped(causes.length)} ${causes.length === 1 ? "cause" : "causes"} of wrong answers`), table,
    el("p", { class: "soft screen-only" }, "Click a cause for the command that shows it in full; this one shows all of them on a page:"), command];
}

function summaryLine(): string {
  const s = data.summary;
  const rate = s.pair_cases ? ` ${Math.round((100 * s.overlapping) / s.pair_cases)} % of the pairs overlap.` : "";
  const set = data.settings ? ` Seed ${data.settings.seed}, subject ${data.settings.subject}.` : "";
  return `${grouped(s.cases)} cases, ${grouped(findings.count)} kinds of findings.${rate}${set} ${s.digest ? "Digest " + s.digest + "." : ""}`;
}

// The subject, which decides the exit code, comes first.
function subjectLine(): HTMLElement | null {
  const subject = data.settings?.subject ?? "";
  const tallies = Object.values(data.summary.engines[subject] ?? {});
  if (!tallies.length) return null;
  const wrong = tallies.reduce((n, t) => n + t.wrong, 0), lost = tallies.reduce((n, t) => n + failed(t), 0);
  const all = tallies.reduce((n, t) => n + (t.outcomes["answered"] ?? 0), 0) + lost;
  return el("p", { id: "subject", class: wrong + lost ? "bad" : "good" }, `${subject}: ${grouped(wrong)} wrong, ${grouped(lost)} failed of ${grouped(all)} answers`);
}

function familiesLine(): HTMLElement | null {
  const families = Object.entries(data.summary.families ?? {});
  return families.length ? el("p", { class: "soft" }, "Cases by family: " + families.map(([f, n]) => `${f} ${grouped(n)}`).join(", ") + ".") : null;
}

function failed(t: Tally): number {
  return Object.entries(t.outcomes).reduce((n, [k, v]) => (k === "answered" || k === "unsupported" ? n : n + v), 0);
}

function drawEngines(): void {
  const head = ["engine", "question", "answered", "right", "wrong", "missed", "ghost", "failed", "undecided", "not judged", "worst / L", "median", "p99"];
  const body = el("tbody");
  for (const [engine, questions] of Object.entries(data.summary.engines))
    for (const [question, t] of Object.entries(questions)) {
      const answered = t.outcomes["answered"] ?? 0;
      if (answered + failed(t) === 0) continue;
      const n = (x: number, bad = false): HTMLElement => el("td", { class: bad && x > 0 ? "n bad" : "n" }, grouped(x));
      const time = (t: Tally, ns?: number): string => (ns ? nanoseconds(ns) + (t.times_include_pipe ? " (with pipe)" : "") : "–");
      const same = body.lastElementChild?.getAttribute("data-engine") === engine;
      body.append(el("tr", { "data-engine": engine, class: same ? "same" : "" }, el("td", {}, engine), el("td", {}, question.replaceAll("_", " ")), n(answered), n(t.right), n(t.wrong, true), n(t.missed, true), n(t.ghost, true), n(failed(t), true),
        n(t.undecided), n(t.not_judged ?? 0), el("td", { class: "n" }, numberOf(t.worst_in_l) > 0 ? numberOf(t.worst_in_l).toExponential(1) : "0"),
        el("td", { class: "n" }, time(t, t.ns_median)), el("td", { class: "n" }, time(t, t.ns_p99))));
    }
  engineTable.replaceChildren(el("table", {}, el("thead", {}, el("tr", {}, ...head.map((h, i) => el("th", i > 1 ? { class: "n" } : {}, h)))), body));
}

const plot = init(chart, null, { renderer: "svg" });
new ResizeObserver(() => plot.resize()).observe(chart);
addEventListener("beforeprint", () => plot.getZr().flush());
function drawChart(): void {
  const questions = [...new Set(Object.values(data.summary.engines).flatMap((q) => Object.keys(q)))];
  const ink = style("--ink"), line = style("--line");
  plot.setOption({
    animation: false,
    textStyle: { color: ink },
    tooltip: { trigger: "axis", axisPointer: { type: "shadow" } },
    legend: { textStyle: { color: ink }, top: 0, type: "scroll" },
    grid: { left: 8, right: 24, top: 34, bottom: 24, containLabel: true },
    xAxis: { type: "value", name: "answers", nameLocation: "middle", nameGap: 26, axisLabel: { color: ink, hideOverlap: true }, splitLine: { lineStyle: { color: line } } },
    yAxis: { type: "category", inverse: true, data: engines, axisLabel: { color: ink, interval: 0 } },
    series: questions.map((q, i) => ({
      name: q.replaceAll("_", " "), type: "bar", stack: "all", itemStyle: { color: colourOf(i) },
      data: engines.map((e) => {
        const t = data.summary.engines[e]![q];
        return t ? t.wrong + failed(t) : 0;
      }),
    })),
  });
}

function draw(): void {
  drawChart();
  drawEngines();
  browser.draw();
}
draw();
link.onChange(() => {
  browser.follow();
  draw();
});
// For tests.
(globalThis as unknown as { touchstoneFindings: unknown }).touchstoneFindings = findings;
