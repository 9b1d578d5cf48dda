// ECharts with the chart types used by the pages, and colours that follow the theme.
import { HeatmapChart, LineChart, ScatterChart } from "echarts/charts";
import { GridComponent, LegendComponent, TooltipComponent, VisualMapComponent } from "echarts/components";
import { LabelLayout } from "echarts/features";
import { init, use, type EChartsType } from "echarts/core";
import { SVGRenderer } from "echarts/renderers";

use([ScatterChart, LineChart, HeatmapChart, GridComponent, LegendComponent, TooltipComponent, VisualMapComponent, LabelLayout, SVGRenderer]);

export const css = (name: string): string => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

export function plotIn(host: HTMLElement): EChartsType {
  const plot = init(host, null, { renderer: "svg" });
  new ResizeObserver(() => plot.resize()).observe(host);
  addEventListener("beforeprint", () => plot.getZr().flush());  // at once: printing does not wait for the next frame
  return plot;
}

export function axis(name: string, log: boolean, more: object = {}): object {
  const ink = css("--ink"), line = css("--line");
  return {
    type: log ? "log" : "value", name, nameLocation: "middle", nameGap: 32, nameTextStyle: { color: ink },
    axisLabel: { color: ink, hideOverlap: true }, axisLine: { lineStyle: { color: ink } }, splitLine: { lineStyle: { color: line } }, ...more,
  };
}

/** A select whose value is kept in the address. */
export function choice(link: { get(k: string): string | null; set(k: string, v: string | null): void }, key: string, label: string,
                       options: [string, string][], changed: () => void): HTMLSelectElement {
  const select = document.createElement("select");
  select.id = key;
  select.setAttribute("aria-label", label);
  for (const [value, text] of options) select.append(new Option(text, value));
  const wanted = link.get(key);
  if (wanted !== null && options.some(([v]) => v === wanted)) select.value = wanted;
  select.addEventListener("change", () => {
    link.set(key, select.value);
    changed();
  });
  return select;
}
