// A campaign: the run, engine by engine, and its findings by key.
import { BarChart } from "echarts/charts";
import { GridComponent, LegendComponent, TooltipComponent } from "echarts/components";
import { init, use } from "echarts/core";
import { SVGRenderer } from "echarts/renderers";
import { LinkState, app, colourOf, commandLine, el, grouped, nanoseconds, numberOf, pageData, themeButton } from "../common/page";

use([BarChart, GridComponent, LegendComponent, TooltipComponent, SVGRenderer]);

interface Tally {
  outcomes: Record<string, number>;
  right: number; wrong: number; missed: number; ghost: number; undecided: number; representation: number;
  worst_in_l: unknown; ns_median?: number; ns_p99?: number;
}
interface Finding {
  engine: string; question: string; fault: string; shapes: string; blame: string; degeneracy: string; magnitude: string;
  count: number; worst_in_l: unknown; words: string;
}
interface ReportPage {
  page: "report"; version: number; title: string; directory: string;
  settings: { subject?: string; seed?: number; family?: string } | null;
  summary: {
    cases: number; pair_cases: number; overlapping: number; undecided: number; digest?: string;
    engines: Record<string, Record<string, Tally>>;
    families?: Record<string, number>;
  };
  columns: (keyof Finding)[];
  findings: unknown[][];
}

const data = pageData<ReportPage>();
const link = new LinkState();
const findings = data.findings.map((row) => {
  const f = Object.fromEntries(data.columns.map((c, i) => [c, row[i]])) as unknown as Finding;
  return [[f.engine, f.question, f.fault, f.shapes, f.blame, f.degeneracy, f.magnitude].join("."), f] as const;
});
document.title = `Touchstone: ${data.title}`;
const style = (name: string): string => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

const engines = Object.keys(data.summary.engines);
const filters = ["engine", "question", "fault", "shapes", "blame", "degeneracy", "magnitude"] as const;
type Filter = (typeof filters)[number];
const columns: { key: Filter | "count" | "worst_in_l"; head: string; number?: boolean }[] = [
  { key: "engine", head: "engine" }, { key: "question", head: "question" }, { key: "fault", head: "fault" },
  { key: "shapes", head: "shapes" }, { key: "blame", head: "blame" }, { key: "magnitude", head: "size" },
  { key: "count", head: "count", number: true }, { key: "worst_in_l", head: "worst / L", number: true },
];

const chart = el("div", { class: "chart", id: "chart", style: `height:${Math.max(180, 60 + 26 * engines.length)}px` });
const engineTable = el("div", { class: "scroll", id: "engines" });
const controls = el("div", { class: "controls screen-only", id: "filters" });
const found = el("p", { class: "soft", id: "found" });
const table = el("table", { id: "findings" });
const detail = el("div", { id: "detail" });

app().append(
  el("header", {}, el("div", { class: "grow" }, el("h1", {}, data.title), el("p", { class: "soft" }, summaryLine())), el("div", { class: "controls screen-only" }, themeButton(link, draw))),
  el("main", {}, el("h2", {}, "Wrong and failed answers by engine"), chart, el("h2", {}, "Answers"), engineTable,
    el("h2", {}, "Findings by key"), controls, found, detail, el("div", { class: "scroll" }, table)),
);

function summaryLine(): string {
  const s = data.summary;
  const rate = s.pair_cases ? ` ${Math.round((100 * s.overlapping) / s.pair_cases)} % of the pairs overlap.` : "";
  const set = data.settings ? ` Seed ${data.settings.seed}, subject ${data.settings.subject}.` : "";
  return `${grouped(s.cases)} cases, ${grouped(findings.length)} kinds of findings.${rate}${set} ${s.digest ? "Digest " + s.digest + "." : ""}`;
}

const failed = (t: Tally): number => Object.entries(t.outcomes).reduce((n, [k, v]) => (k === "answered" || k === "unsupported" ? n : n + v), 0);

function drawEngines(): void {
  const head = ["engine", "question", "answered", "right", "wrong", "missed", "ghost", "failed", "undecided", "worst / L", "median", "p99"];
  const body = el("tbody");
  for (const [engine, questions] of Object.entries(data.summary.engines))
    for (const [question, t] of Object.entries(questions)) {
      const answered = t.outcomes["answered"] ?? 0;
      if (answered + failed(t) === 0) continue;
      const n = (x: number, bad = false): HTMLElement => el("td", { class: bad && x > 0 ? "n bad" : "n" }, grouped(x));
      body.append(el("tr", {}, el("td", {}, engine), el("td", {}, question.replaceAll("_", " ")), n(answered), n(t.right), n(t.wrong, true), n(t.missed, true), n(t.ghost, true), n(failed(t), true),
        n(t.undecided), el("td", { class: "n" }, numberOf(t.worst_in_l) > 0 ? numberOf(t.worst_in_l).toExponential(1) : "0"),
        el("td", { class: "n" }, t.ns_median ? nanoseconds(t.ns_median) : "–"), el("td", { class: "n" }, t.ns_p99 ? nanoseconds(t.ns_p99) : "–")));
    }
  engineTable.replaceChildren(el("table", {}, el("thead", {}, el("tr", {}, ...head.map((h, i) => el("th", i > 1 ? { class: "n" } : {}, h)))), body));
}

const plot = init(chart, null, { renderer: "svg" });
new ResizeObserver(() => plot.resize()).observe(chart);
function drawChart(): void {
  const questions = [...new Set(Object.values(data.summary.engines).flatMap((q) => Object.keys(q)))];
  const ink = style("--ink"), line = style("--line");
  plot.setOption({
    animation: false,
    textStyle: { color: ink },
    tooltip: { trigger: "axis", axisPointer: { type: "shadow" } },
    legend: { textStyle: { color: ink }, top: 0, type: "scroll" },
    grid: { left: 8, right: 24, top: 34, bottom: 8, containLabel: true },
    xAxis: { type: "value", axisLabel: { color: ink }, splitLine: { lineStyle: { color: line } } },
    yAxis: { type: "category", inverse: true, data: engines, axisLabel: { color: ink } },
    series: questions.map((q, i) => ({
      name: q.replaceAll("_", " "), type: "bar", stack: "all", itemStyle: { color: colourOf(i) },
      data: engines.map((e) => {
        const t = data.summary.engines[e]![q];
        return t ? t.wrong + failed(t) : 0;
      }),
    })),
  });
}

// A selection a filter; the rows shown are cut, so that 1e5 findings cost nothing.
let shown = 200;
let sort: { key: (typeof columns)[number]["key"]; down: boolean } = { key: (link.get("sort") as Filter) ?? "count", down: link.get("down") !== "0" };
const selects = new Map<Filter, HTMLSelectElement>();
for (const f of filters) {
  const counts = new Map<string, number>();
  for (const [, x] of findings) counts.set(x[f], (counts.get(x[f]) ?? 0) + 1);
  if (counts.size < 2) continue;
  const select = el("select", { "aria-label": f, id: `filter-${f}` }, el("option", { value: "" }, `any ${f}`),
    ...[...counts].sort((a, b) => b[1] - a[1]).map(([v, n]) => el("option", { value: v }, `${v} (${n})`)));
  select.value = link.get(f) ?? "";
  select.addEventListener("change", () => {
    link.set(f, select.value || null);
    shown = 200;
    drawFindings();
  });
  selects.set(f, select);
  controls.append(select);
}
const search = el("input", { type: "search", placeholder: "words", "aria-label": "words in the finding" });
search.value = link.get("words") ?? "";
search.addEventListener("input", () => {
  link.set("words", search.value || null);
  drawFindings();
});
controls.append(search);

function drawFindings(): void {
  const wanted = [...selects].filter(([, s]) => s.value);
  const words = search.value.toLowerCase();
  const rows = findings.filter(([, f]) => wanted.every(([k, s]) => f[k] === s.value) && (!words || f.words.toLowerCase().includes(words)));
  const value = (f: Finding): string | number => (sort.key === "worst_in_l" ? numberOf(f.worst_in_l) || 0 : f[sort.key]);
  rows.sort(([ka, a], [kb, b]) => {
    const x = value(a), y = value(b);
    const order = x < y ? -1 : x > y ? 1 : ka < kb ? -1 : 1;
    return sort.down ? -order : order;
  });
  found.textContent = `${grouped(rows.length)} of ${grouped(findings.length)} kinds, ${grouped(rows.reduce((s, [, f]) => s + f.count, 0))} answers. Press a row for its replay.`;
  const head = el("tr", {}, ...columns.map((c) => {
    const th = el("th", { "data-key": c.key, class: c.number ? "n" : "" }, c.head + (sort.key === c.key ? (sort.down ? " ↓" : " ↑") : ""));
    th.addEventListener("click", () => {
      sort = { key: c.key, down: sort.key === c.key ? !sort.down : Boolean(c.number) };
      link.set("sort", c.key);
      link.set("down", sort.down ? "1" : "0");
      drawFindings();
    });
    return th;
  }));
  const body = el("tbody");
  for (const [key, f] of rows.slice(0, shown)) {
    const tr = el("tr", { tabindex: "0" }, ...columns.map((c) => el("td", { class: c.number ? "n" : "" },
      c.key === "count" ? grouped(f.count) : c.key === "worst_in_l" ? numberOf(f.worst_in_l).toExponential(1) : f[c.key].replaceAll("_", " "))));
    const open = (): void => {
      link.set("finding", key);
      drawDetail(key);
      detail.scrollIntoView({ block: "nearest" });
    };
    tr.addEventListener("click", open);
    tr.addEventListener("keydown", (e) => e.key === "Enter" && open());
    body.append(tr);
  }
  const more = el("button", { type: "button" }, `show ${grouped(Math.min(500, rows.length - shown))} more`);
  more.addEventListener("click", () => {
    shown += 500;
    drawFindings();
  });
  table.replaceChildren(el("thead", {}, head), body);
  if (rows.length > shown) table.append(el("tfoot", { class: "screen-only" }, el("tr", {}, el("td", { colspan: String(columns.length) }, more))));
}

function drawDetail(key: string): void {
  const f = findings.find(([k]) => k === key)?.[1];
  if (!f) return detail.replaceChildren();
  const path = `${data.directory}/findings/${key}`;
  detail.replaceChildren(el("h2", {}, key), el("p", {}, f.words),
    commandLine(`./touchstone replay ${path}`), commandLine(`./touchstone view ${path} -o page.html`),
    commandLine(`./touchstone shrink ${path} --engine ${f.engine}`));
}

function draw(): void {
  drawChart();
  drawEngines();
  drawFindings();
}
draw();
const opened = link.get("finding");
if (opened) drawDetail(opened);
link.onChange(() => {
  for (const [f, s] of selects) s.value = link.get(f) ?? "";
  drawFindings();
  drawDetail(link.get("finding") ?? "");
});
