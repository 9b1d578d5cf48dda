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

// The plot on its background with a line of text below it, as a document of its own.
function documentOf(plot: EChartsType, caption: string): { text: string; width: number; height: number } {
  const space = 24, width = plot.getWidth(), height = plot.getHeight() + space;
  const svg = new DOMParser().parseFromString(plot.renderToSVGString(), "image/svg+xml").documentElement;
  svg.setAttribute("width", String(width));
  svg.setAttribute("height", String(height));
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  const own = (tag: string, attributes: Record<string, string>): Element => {
    const e = svg.ownerDocument.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v);
    return e;
  };
  svg.prepend(own("rect", { width: "100%", height: "100%", fill: css("--back") }));
  const line = own("text", { x: "8", y: String(height - 8), fill: css("--soft"), "font-size": "11", "font-family": "sans-serif" });
  line.textContent = caption;
  svg.append(line);
  return { text: new XMLSerializer().serializeToString(svg), width, height };
}

function save(file: string, content: Blob): void {
  const a = document.createElement("a");
  a.href = URL.createObjectURL(content);
  a.download = file;
  a.click();
  setTimeout(() => URL.revokeObjectURL(a.href), 1000);
}

async function asPng(drawing: { text: string; width: number; height: number }): Promise<Blob> {
  const sharpness = 2;
  const image = new Image();
  image.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(drawing.text);
  await image.decode();
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [sharpness * drawing.width, sharpness * drawing.height];
  canvas.getContext("2d")!.drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((done, failed) => canvas.toBlob((b) => (b ? done(b) : failed(new Error("the picture is too large"))), "image/png"));
}

/** Buttons that save the plot as it is drawn, with a caption, as NAME.svg and NAME.png. */
export function saveButtons(plot: () => EChartsType, name: () => string, caption: () => string): HTMLButtonElement[] {
  const button = (kind: string, action: () => void): HTMLButtonElement => {
    const b = document.createElement("button");
    b.id = `save-${kind}`;
    b.textContent = `save ${kind.toUpperCase()}`;
    b.addEventListener("click", action);
    return b;
  };
  return [
    button("svg", () => save(`${name()}.svg`, new Blob([documentOf(plot(), caption()).text], { type: "image/svg+xml" }))),
    button("png", () => void asPng(documentOf(plot(), caption())).then((b) => save(`${name()}.png`, b))),
  ];
}
