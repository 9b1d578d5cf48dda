// Speed against accuracy: one point per engine, the Pareto front, and unsound methods (hollow) with the reason.
import { LinkState, app, colourOf, el, grouped, nanoseconds, numberOf, pageData, themeButton } from "../common/page";
import { axis, choice, css, plotIn, saveButtons } from "../common/plot";

interface Row {
  engine: string; question: string; regime: string; pair: string; scale: string; bodies: number;
  asked: number; answers: number; failed: number; missed: number; ghost: number; no_number: number; wrong: number; rounding: number; undecided: number;
  ns_min: number; ns_median: number; ns_p99: number; ns_spread: number;
  error_p50: unknown; error_p99: unknown; error_max: unknown; pairs_true: number; pairs_reported: number; front: number; tie: number; unsound: string;
}
interface ChartPage {
  scope: string; seed: number; rounds: number; measure_ns: number;
  machine: { processor: string; cores: number; load: number; system: string; compiler: string; date: string };
  engines: { name: string; library: string; version: string; settings: string }[];
  columns: string[];
  text_columns: string[];
  strings: string[];
  rows: unknown[][];
}

const data = pageData<ChartPage>();
const link = new LinkState();
const isText = data.columns.map((c) => data.text_columns.includes(c));
const rows: Row[] = data.rows.map((r) => Object.fromEntries(data.columns.map((c, i) => [c, isText[i] ? data.strings[r[i] as number] : r[i]])) as unknown as Row);
document.title = "Touchstone: speed against accuracy";
const values = (key: "question" | "regime" | "pair" | "scale"): string[] => [...new Set(rows.map((r) => r[key]))].filter(Boolean).sort();
// Settings of one method share a colour and form a curve.
const method = (name: string): string => name.replace(/-tuned$|@.*$/, "");
const methods = [...new Set(data.engines.map((e) => method(e.name)))];
const colour = (engine: string): string => colourOf(Math.max(0, methods.indexOf(method(engine))));

// Errors of 0 are drawn at this floor, below the unit roundoff of a double.
const floor = 1e-18;

const questions = ["overlap", "distance", "contact", "within", "bounded_distance", "contact_within", "ray", "time_of_impact", "candidates"].filter((q) => rows.some((r) => r.question === q));
const any = (key: "regime" | "pair" | "scale", what: string): [string, string][] => [["", what], ...values(key).map((v): [string, string] => [v, v])];
const question = choice(link, "question", "question", questions.map((q) => [q, q.replaceAll("_", " ")]), draw);
const regime = choice(link, "regime", "regime", any("regime", "all regimes"), draw);
const pair = choice(link, "pair", "pair of shapes", any("pair", "all pairs"), draw);
const scale = choice(link, "scale", "scale", any("scale", "all scales"), draw);
const time = choice(link, "time", "time", [["ns_median", "median time"], ["ns_p99", "99 % time"], ["ns_min", "least time"]], draw);
const measure = choice(link, "error", "error", [["error_p99", "99 % error"], ["error_p50", "median error"], ["error_max", "largest error"], ["missed", "missed, share"], ["ghost", "ghosts, share"]], draw);
if (link.get("question") === null) question.value = questions.includes("contact") ? "contact" : questions[0]!;

const host = el("div", { class: "chart", id: "chart" });
const growthTitle = el("h2", {}, "Time by number of bodies"), growth = el("div", { class: "chart", id: "growth" });
const table = el("div", { class: "scroll", id: "rows" });
const note = el("p", { class: "soft", id: "note" });
app().append(
  el("header", {}, el("div", { class: "grow" }, el("h1", {}, "Speed against accuracy"),
    el("p", { class: "soft" }, `${data.machine.processor}, ${data.machine.cores} cores, load ${data.machine.load.toFixed(1)}, ${data.machine.system}, ${data.machine.compiler}, ${data.machine.date}. ` +
      `${data.scope} chart, seed ${data.seed}, ${data.rounds} interleaved rounds.`)), el("div", { class: "controls screen-only" }, themeButton(link, draw))),
  el("main", {}, el("div", { class: "controls screen-only", style: "margin:0.6rem 0" }, question, regime, pair, scale, time, measure,
    ...saveButtons(() => plot, () => `touchstone-${question.value}`, caption)), host, note, growthTitle, growth,
    el("h2", {}, "The numbers"), table, el("h2", {}, "Engines"),
    el("div", { class: "scroll" }, el("table", {}, el("tbody", {}, ...data.engines.map((e) => el("tr", {}, el("td", {}, e.name), el("td", {}, `${e.library} ${e.version}`), el("td", { class: "soft" }, e.settings))))))),
);
function caption(): string {
  const { processor, cores, date, compiler } = data.machine;
  return `${question.value.replaceAll("_", " ")}: speed against accuracy. ${processor}, ${cores} cores, ${compiler}, ${date}; seed ${data.seed}. Diamonds: the Pareto front; hollow: unsound.`;
}
const plot = plotIn(host), growthPlot = plotIn(growth);

const precision = (r: Row): number => (r.pairs_reported ? r.pairs_true / r.pairs_reported : 1);
function inaccuracy(r: Row): number {
  const key = measure.value as "error_p99" | "missed" | "ghost";
  if (key === "missed" || key === "ghost") return r[key] / Math.max(1, r.answers);
  return r.question === "candidates" ? 1 - precision(r) : numberOf(r[key]);
}
const shown = (): Row[] => {
  const crowd = question.value === "candidates";
  const most = Math.max(...rows.filter((r) => r.question === "candidates").map((r) => r.bodies));
  return rows.filter((r) => r.question === question.value && r.answers > 0 &&
    (crowd ? r.bodies === most : r.regime === regime.value && r.pair === pair.value && r.scale === scale.value));
};
const words = (r: Row): string =>
  `<b>${r.engine}</b><br>median ${nanoseconds(r.ns_median)}, 99 % ${nanoseconds(r.ns_p99)}, a typical round ${Math.round(100 * r.ns_spread)} % slower than the fastest<br>` +
  (r.question === "candidates" ? `precision ${(100 * precision(r)).toFixed(1)} %<br>` : `error/L ${numberOf(r.error_p50).toExponential(1)}, 99 % ${numberOf(r.error_p99).toExponential(1)}, most ${numberOf(r.error_max).toExponential(1)}<br>`) +
  `${grouped(r.answers)} answers, ${r.wrong} wrong` + (r.unsound ? `<br>not on the front: ${r.unsound}` : r.front ? `<br>on the Pareto front${r.tie ? ", tied within noise" : ""}` : "");

// False if the row's times would be those of a pipe.
const isTimed = (r: Row): boolean => r.ns_median > 0;

function draw(): void {
  const all = shown();
  const list = all.filter(isTimed);
  const crowd = question.value === "candidates";
  for (const s of [regime, pair, scale]) s.disabled = crowd;
  const point = (r: Row): [number, number] => [Math.max(r[time.value as "ns_median"], 0.5), crowd ? inaccuracy(r) : Math.max(inaccuracy(r), floor)];
  const ink = css("--ink");
  const narrow = innerWidth < 600;  // no room for names beside the points
  const curves = [...new Set(list.map((r) => method(r.engine)))].map((m) => list.filter((r) => method(r.engine) === m).sort((a, b) => a.ns_median - b.ns_median)).filter((c) => c.length > 1);
  // A curve's first point is labelled with its name, the last with its setting; the table and tooltips name the others.
  const between = (r: Row): boolean => !r.front && curves.some((c) => c.slice(1, -1).includes(r));
  const label = (r: Row): string => (curves.some((c) => c.slice(1).includes(r)) && r.engine.includes("@") ? r.engine.slice(r.engine.indexOf("@")) : r.engine);
  const one = (r: Row): object => {
    const c = colour(r.engine);
    return {
      name: r.engine, value: point(r), row: r, symbol: r.front ? "diamond" : "circle", symbolSize: r.tie ? 14 : r.front ? 17 : 12,
      itemStyle: r.unsound ? { color: "transparent", borderColor: c, borderWidth: 2 } : { color: c, borderColor: ink, borderWidth: r.front ? 1.5 : 0 },
      label: { show: !between(r), formatter: label(r), position: narrow ? "top" : "right", color: r.unsound ? css("--soft") : ink, fontSize: 11 },
    };
  };
  const front = list.filter((r) => r.front).sort((a, b) => a.ns_median - b.ns_median);
  plot.setOption({
    animation: false,
    tooltip: { trigger: "item", confine: true, formatter: (p: { data?: { row?: Row } }) => (p.data?.row ? words(p.data.row) : "") },
    grid: { left: 76, right: narrow ? 36 : 130, top: narrow ? 24 : 16, bottom: 50 },
    xAxis: axis(`${time.selectedOptions[0]!.text} of a query, ns`, true),
    yAxis: crowd ? axis("share of superfluous pairs", false, { nameGap: 48, min: 0, max: 1 }) : axis(`${measure.selectedOptions[0]!.text}${measure.value.startsWith("error") ? " / L" : ""} (0 is drawn at ${floor})`, true,
      { nameGap: 58, splitNumber: 9, min: floor, max: 10 ** Math.ceil(Math.log10(Math.max(1e-9, ...list.map(inaccuracy))) + 0.5), axisLabel: { color: ink, formatter: (x: number) => (x === floor ? "0" : x.toExponential(0)) } }),
    series: [
      { type: "line", data: front.map(point), lineStyle: { color: css("--good"), width: 2 }, symbol: "none", silent: true, z: 1 },
      ...curves.map((c) => ({ type: "line", data: c.map(point), lineStyle: { color: colour(c[0]!.engine), type: "dashed", width: 1 }, symbol: "none", silent: true, z: 1 })),
      { type: "scatter", id: "engines", data: list.map(one), labelLayout: { hideOverlap: true, moveOverlap: "shiftY" }, z: 3 },
    ],
  }, { notMerge: true });
  note.textContent = (crowd ? `Crowds of ${grouped(shown()[0]?.bodies ?? 0)} bodies, inserted and queried once. ` : "") +
    "Diamonds and line: the Pareto front; small diamonds are tied with another engine within noise. Hollow: unsound or incomplete, so not on the front; the table gives the reason. Dashed: settings of one method.";
  drawTable(all);
  drawGrowth();
}

function drawTable(list: Row[]): void {
  const accuracy = question.value === "candidates" ? ["", "precision", ""] : ["error p50 / L", "p99 / L", "most / L"];
  const head = ["engine", "", "answers", "median", "99 %", "± rounds", ...accuracy, "missed", "ghost", "failed", "wrong", "reason it is not on the front"];
  const e = (x: unknown): string => (numberOf(x) === 0 ? "0" : numberOf(x).toExponential(1));
  const body = el("tbody", {}, ...[...list].sort((a, b) => Number(!isTimed(a)) - Number(!isTimed(b)) || a.ns_median - b.ns_median).map((r) => {
    const n = (text: string, bad = false): HTMLElement => el("td", { class: bad ? "n bad" : "n" }, text);
    return el("tr", { "data-engine": r.engine }, el("td", { style: "white-space:nowrap" }, el("span", { class: "swatch", style: `background:${colour(r.engine)}` }), r.engine), el("td", { class: "good" }, r.tie ? "front, tie" : r.front ? "front" : ""),
      n(grouped(r.answers)), ...(isTimed(r) ? [n(nanoseconds(r.ns_median)), n(nanoseconds(r.ns_p99)), n(`${Math.round(100 * r.ns_spread)} %`)] : [n("pipe"), n("pipe"), n("")]),
      ...(r.question === "candidates" ? [n(""), n(`${(100 * precision(r)).toFixed(1)} %`), n("")] : [n(e(r.error_p50)), n(e(r.error_p99)), n(e(r.error_max))]),
      n(grouped(r.missed), r.missed > 0), n(grouped(r.ghost), r.ghost > 0), n(grouped(r.failed), r.failed > 0), n(grouped(r.wrong), r.wrong > 0), el("td", { class: "soft", style: "min-width:10rem" }, r.unsound));
  }));
  table.replaceChildren(el("table", {}, el("thead", {}, el("tr", {}, ...head.map((h, i) => el("th", i > 1 && i < 13 ? { class: "n" } : {}, h)))), body));
}

function drawGrowth(): void {
  const crowds = rows.filter((r) => r.question === "candidates" && r.answers > 0);
  const visible = question.value === "candidates" && crowds.length > 0;
  growth.style.display = growthTitle.style.display = visible ? "" : "none";
  if (!visible) return;
  const names = [...new Set(crowds.map((r) => r.engine))];
  growthPlot.resize();
  growthPlot.setOption({
    animation: false,
    tooltip: { trigger: "item", confine: true, formatter: (p: { data: { row: Row } }) => words(p.data.row) },
    legend: { type: "scroll", textStyle: { color: css("--ink") }, top: 0 },
    grid: { left: 76, right: 30, top: 40, bottom: 50 },
    xAxis: axis("bodies", true), yAxis: axis("time to insert all and query, ns", true, { nameGap: 58, axisLabel: { color: css("--ink"), formatter: (x: number) => x.toExponential(0) } }),
    series: names.map((n) => {
      const c = colour(n);
      return { name: n, type: "line", lineStyle: { color: c }, itemStyle: { color: c }, data: crowds.filter((r) => r.engine === n && isTimed(r)).sort((a, b) => a.bodies - b.bodies).map((r) => ({ value: [r.bodies, r.ns_median], row: r })) };
    }),
  }, { notMerge: true });
}

draw();
link.onChange(() => {
  for (const s of [question, regime, pair, scale, time, measure]) {
    const v = link.get(s.id);
    if (v !== null) s.value = v;
  }
  draw();
});
// For tests.
(globalThis as unknown as { touchstonePlot: unknown }).touchstonePlot = plot;
