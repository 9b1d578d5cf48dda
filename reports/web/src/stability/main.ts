// Ladders: a heat map of where each engine begins to fail, and the curves of one ladder.
import { LinkState, app, colourOf, el, grouped, numberOf, pageData, themeButton } from "../common/page";
import { axis, choice, css, plotIn } from "../common/plot";

interface Result {
  ladder: string; engine: string; question: string; rungs: unknown[][];
  fails_at: number | null; order_fails_at: number | null; frame_fails_at: number | null; unit_fails_at: number | null;
}
type Kind = "fails_at" | "order_fails_at" | "frame_fails_at" | "unit_fails_at";
interface StabilityPage {
  scope: string; seed: number; per_rung: number;
  ladders: { name: string; line: string; unit: string }[];
  columns: string[];
  results: Result[];
}

const data = pageData<StabilityPage>();
const link = new LinkState();
document.title = "Touchstone: where engines begin to fail";
const column = new Map(data.columns.map((c, i) => [c, i]));
const cell = (rung: unknown[], name: string): number => numberOf(rung[column.get(name)!]);
const engines = [...new Set(data.results.map((r) => r.engine))];
const questions = [...new Set(data.results.map((r) => r.question))];

const question = choice(link, "question", "question", questions.map((q) => [q, q.replaceAll("_", " ")]), () => draw());
if (link.get("question") === null && questions.includes("contact")) question.value = "contact";
const kind = choice(link, "kind", "how it fails", [
  ["fails_at", "wrong or no answer"], ["order_fails_at", "contradicts itself when A and B are exchanged"],
  ["frame_fails_at", "contradicts itself in another frame"], ["unit_fails_at", "contradicts itself in another unit of length"]], () => draw());
const metric = choice(link, "metric", "what is drawn", [
  ["wrong", "wrong or no answer, share"], ["missed", "missed, share"], ["ghost", "ghosts, share"], ["failed", "failed, share"],
  ["depth_error", "error of distance or depth / L"], ["normal_error", "error of the normal / L"], ["impact_error", "error of the impact / L"],
  ["jitter", "change when B moves by an ulp / L"], ["order", "change when A and B are exchanged / L"], ["frame", "change in other frames / L"], ["unit", "change in other units / L"],
  ["order_broken", "contradicts itself, A and B exchanged, share"], ["frame_broken", "contradicts itself, other frames, share"], ["unit_broken", "contradicts itself, other units, share"]], () => draw());
let ladder = link.get("ladder") ?? data.ladders[0]?.name ?? "";

const heat = el("div", { class: "chart", id: "heat" }), curves = el("div", { class: "chart", id: "curves" });
const title = el("h2", {}), table = el("div", { class: "scroll", id: "rows" });
app().append(
  el("header", {}, el("div", { class: "grow" }, el("h1", {}, "Where engines begin to fail"), el("p", { class: "soft" }, `${data.scope}: ${data.per_rung} cases per rung, seed ${data.seed}. Each cell shows the first rung with a wrong answer or none, or with two answers about the same pair that contradict each other by more than the engine's tolerances; –: never.`)),
    el("div", { class: "controls screen-only" }, themeButton(link, () => draw()))),
  el("main", {}, el("div", { class: "controls screen-only", style: "margin:0.6rem 0" }, question, kind), heat, title, el("div", { class: "controls screen-only" }, metric), curves, el("h2", {}, "Rungs of failure"), table),
);
const heatPlot = plotIn(heat), curvePlot = plotIn(curves);

export const rungText = (x: number): string => {
  const e = Math.log2(x);
  return Number.isInteger(e) && (x > 4096 || x < 1) ? `2^${e}` : String(Number(x.toPrecision(4)));
};
const failsAt = (r: Result): number | null => r[kind.value as Kind] ?? null;
const of = (engine: string, name: string): Result | undefined => data.results.find((r) => r.engine === engine && r.ladder === name && r.question === question.value);

function withUnit(name: string): string {
  const unit = data.ladders.find((l) => l.name === name)?.unit;
  return unit && unit !== name ? `${name}, ${unit}` : name;
}

function draw(): void {
  const names = data.ladders.map((l) => l.name).filter((n) => data.results.some((r) => r.ladder === n && r.question === question.value));
  const here = engines.filter((e) => names.some((n) => of(e, n)));
  if (!names.includes(ladder)) ladder = names[0] ?? "";
  const ink = css("--ink");
  heat.style.height = `${80 + 28 * here.length}px`;
  heatPlot.resize();
  // 0: fails at the first rung; 1: never fails.
  const cells = here.flatMap((e, y) => names.flatMap((n, x) => {
    const r = of(e, n);
    if (!r) return [];
    const at = failsAt(r), i = r.rungs.findIndex((k) => cell(k, "value") === at);
    return [{ value: [x, y, at === null ? 1 : i / r.rungs.length], label: { formatter: at === null ? "–" : rungText(at) }, ladder: n }];
  }));
  heatPlot.setOption({
    animation: false, tooltip: { formatter: (p: { data: { ladder: string; value: number[] } }) => `${here[p.data.value[1]!]}: ${data.ladders.find((l) => l.name === p.data.ladder)?.line}` },
    grid: { left: 170, right: 16, top: 30, bottom: 10 },
    xAxis: { type: "category", data: names, position: "top", axisLabel: { color: ink, interval: 0 } },
    yAxis: { type: "category", data: here, inverse: true, axisLabel: { color: ink } },
    visualMap: { show: false, min: 0, max: 1, dimension: 2, inRange: { color: ["#c2543e", "#e3a84f", "#e6d9a0", "#8fbf8f", "#3f8f63"] } },
    series: [{ type: "heatmap", data: cells, label: { show: true, color: "#111" }, itemStyle: { borderColor: css("--back"), borderWidth: 2 } }],
  }, { notMerge: true });
  const l = data.ladders.find((x) => x.name === ladder);
  title.textContent = `${ladder}: ${l?.line ?? ""}`;
  const share = ["wrong", "missed", "ghost", "failed", "order_broken", "frame_broken", "unit_broken"].includes(metric.value);
  const y = (k: unknown[]): number => {
    if (!share) return Math.max(cell(k, metric.value), 1e-18);
    const n = metric.value === "wrong" ? cell(k, "wrong") + cell(k, "failed") : cell(k, metric.value);
    return n / Math.max(1, cell(k, "asked"));
  };
  curvePlot.setOption({
    animation: false, tooltip: { trigger: "axis", confine: true },
    legend: { type: "scroll", textStyle: { color: ink }, top: 0 }, grid: { left: 76, right: 30, top: 40, bottom: 50 },
    xAxis: axis(l?.unit || ladder, true, { logBase: 2, axisLabel: { color: ink, formatter: rungText } }),
    yAxis: axis(metric.selectedOptions[0]!.text, !share, { nameGap: 58, axisLabel: { color: ink, formatter: (x: number) => (share ? String(Number(x.toFixed(3))) : x <= 1e-18 ? "0" : x.toExponential(0)) } }),
    series: here.flatMap((e) => {
      const r = of(e, ladder), c = colourOf(engines.indexOf(e));
      return r ? [{ name: e, type: "line", lineStyle: { color: c }, itemStyle: { color: c }, data: r.rungs.filter((k) => cell(k, "asked") > 0).map((k) => [cell(k, "value"), y(k)]) }] : [];
    }),
  }, { notMerge: true });
  table.replaceChildren(el("table", {}, el("thead", {}, el("tr", {}, el("th", {}, "engine"), ...names.map((n) => el("th", { class: "n", title: data.ladders.find((l) => l.name === n)?.line ?? "" }, withUnit(n))))),
    el("tbody", {}, ...here.map((e) => el("tr", { "data-engine": e }, el("td", {}, e), ...names.map((n) => {
      const r = of(e, n);
      const at = r ? failsAt(r) : null, asked = r?.rungs.reduce((s, k) => s + cell(k, "asked"), 0) ?? 0;
      return el("td", { class: "n", title: `${grouped(asked)} asked` }, !r ? "" : at === null ? "–" : rungText(at));
    }))))));
}
heatPlot.on("click", (p) => {
  ladder = (p.data as { ladder: string }).ladder;
  link.set("ladder", ladder);
  draw();
});
draw();
link.onChange(() => {
  ladder = link.get("ladder") ?? ladder;
  for (const s of [question, kind, metric]) {
    const v = link.get(s.id);
    if (v !== null) s.value = v;
  }
  draw();
});
