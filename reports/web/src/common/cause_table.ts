// The table of causes in the order in which to read them: a row each.
import { el, grouped } from "./page";
import "./cause_table.css";

export interface CauseRow {
  id: string;
  path: string;
  severity: string;
  documented: string;
  wrong: number;
  title: string;
}

const grave = ["crash", "hang", "missed", "ghost", "infeasible"];

export const severityBadge = (c: CauseRow): HTMLElement =>
  el("b", { class: `badge ${c.documented ? "soft" : grave.includes(c.severity) ? "bad" : "warn"}` }, c.documented ? `documented: ${c.severity}` : c.severity);

/** `titleOf`: what stands in the last column. */
export function causeTable<C extends CauseRow>(causes: C[], titleOf: (c: C) => Node | string): HTMLElement {
  const rows = causes.map((c, i) =>
    el("tr", { "data-index": c.id }, el("td", { class: "n" }, String(i + 1)), el("td", { class: "severity" }, severityBadge(c)), el("td", { class: "path" }, c.path), el("td", { class: "n" }, grouped(c.wrong)), el("td", { class: "title" }, titleOf(c))));
  const head = el("tr", {}, el("th", { class: "n" }, "#"), el("th", { class: "severity" }, "severity"), el("th", { class: "path" }, "engine path"), el("th", { class: "n" }, "wrong"), el("th", {}, "cause"));
  return el("div", { class: "cause-table", tabindex: "0", "aria-label": "all causes" }, el("table", {}, el("thead", {}, head), el("tbody", {}, ...rows)));
}
