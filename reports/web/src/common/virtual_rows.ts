// A table of any length: only visible lines are in the document; two empty rows take the height of the others.
import { el, grouped } from "./page";

const lineHeight = 27;
const spare = 12;  // lines kept above and below, so that scrolling shows no gap

export interface Lines {
  length: number;
  /** The cells of line i. */
  cells(i: number): HTMLElement[];
  /** Called on Enter or a click. */
  open(i: number): void;
  /** Handles other keys on line i; returns true if it used the key. */
  key?(i: number, key: string): boolean;
  /** Classes of line i. */
  style?(i: number): string;
}

export class VirtualRows {
  readonly table = el("table", { class: "virtual" });
  readonly host: HTMLElement;
  private head = el("thead");
  private body = el("tbody");
  private lines: Lines = { length: 0, cells: () => [], open: () => undefined };
  private focused = -1;
  private from = -1;
  private to = -1;

  constructor(label: string) {
    this.table.append(this.head, this.body);
    this.table.setAttribute("aria-label", label);
    this.host = el("div", { class: "rows", tabindex: "0", "aria-label": `${label}: arrows move, Enter opens` }, this.table);
    this.host.addEventListener("scroll", () => this.draw());
    this.host.addEventListener("keydown", (e) => this.onKey(e));
    new ResizeObserver(() => this.draw()).observe(this.host);
    // Paper cannot scroll: it gets the first lines and a note on how many more there are.
    addEventListener("beforeprint", () => this.draw(400));
    addEventListener("afterprint", () => this.draw());
  }

  heads(cells: HTMLElement[]): void {
    this.head.replaceChildren(el("tr", {}, ...cells));
  }

  show(lines: Lines): void {
    this.lines = lines;
    this.focused = Math.min(this.focused, lines.length - 1);
    this.table.setAttribute("aria-rowcount", String(lines.length));
    this.from = this.to = -1;
    this.draw();
  }

  /** Scrolls line i into view and gives it the keyboard focus. */
  goTo(i: number): void {
    this.focused = Math.max(0, Math.min(this.lines.length - 1, i));
    const top = this.focused * lineHeight, seen = this.host.clientHeight - this.head.offsetHeight;
    if (top < this.host.scrollTop) this.host.scrollTop = top;
    else if (top + lineHeight > this.host.scrollTop + seen) this.host.scrollTop = top + lineHeight - seen;
    this.from = -1;
    this.draw();
  }

  private onKey(e: KeyboardEvent): void {
    if (e.ctrlKey || e.metaKey || e.altKey) return;
    const page = Math.max(1, Math.floor(this.host.clientHeight / lineHeight) - 2);
    const step = { ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page, Home: -1e9, End: 1e9 }[e.key];
    if (step !== undefined) this.goTo(this.focused + step);
    else if (this.focused >= 0 && (e.key === "Enter" || e.key === " ")) this.lines.open(this.focused);
    else if (this.focused < 0 || !this.lines.key?.(this.focused, e.key)) return;
    e.preventDefault();
  }

  private draw(all = 0): void {
    const n = this.lines.length;
    const first = all ? 0 : Math.max(0, Math.floor(this.host.scrollTop / lineHeight) - spare);
    const last = all ? Math.min(n, all) : Math.min(n, Math.ceil((this.host.scrollTop + this.host.clientHeight) / lineHeight) + spare);
    if (!all && first === this.from && last === this.to) return;
    [this.from, this.to] = all ? [-1, -1] : [first, last];
    const rows: HTMLElement[] = [];
    for (let i = first; i < last; ++i) {
      const tr = el("tr", { class: `${this.lines.style?.(i) ?? ""}${i === this.focused ? " focused" : ""}`, "aria-rowindex": String(i + 1) }, ...this.lines.cells(i));
      tr.addEventListener("click", () => {
        this.focused = i;
        this.lines.open(i);
      });
      rows.push(tr);
    }
    const gap = (lines: number): HTMLElement => el("tr", { class: "gap", "aria-hidden": "true" }, el("td", { style: `height:${lines * lineHeight}px` }));
    const rest = el("tr", { class: "print-only" }, el("td", { colspan: "4" }, `and ${grouped(n - last)} more lines`));
    this.body.replaceChildren(...(first > 0 ? [gap(first)] : []), ...rows, ...(last < n ? [all ? rest : gap(n - last)] : []));
  }
}
