// Findings in expandable groups, filtered and sorted, with the selected one and its commands beside them.
import { LinkState, commandLine, el, grouped, isTyping } from "../common/page";
import { VirtualRows } from "../common/virtual_rows";
import { Findings, groupsOf, parts, type Group, type Part } from "./findings";

type Line = { group: Group; row: number };  // row < 0: the group's own line
type SortKey = "name" | "answers" | "worst";

const groupings: [string, Part[]][] = [
  ["engine, question, fault", ["engine", "question", "fault"]], ["engine", ["engine"]], ["shapes", ["shapes"]], ["fault", ["fault"]],
  ["degeneracy", ["degeneracy"]], ["nothing", []],
];
const blameWords: Record<string, string> = {
  representation: "Blame: rounding of the scene. The answer is right for the scene as the engine received it.",
  algorithm: "Blame: the algorithm. The answer is also wrong for the scene as the engine received it.",
};
const spaced = (s: string): string => s.replaceAll("_", " ");

export class FindingsBrowser {
  readonly element = el("div", { id: "browser" });
  private controls = el("div", { class: "controls screen-only", id: "filters" });
  private found = el("p", { class: "soft", id: "found" });
  private detail = el("div", { id: "detail" });
  private rows = new VirtualRows("findings");
  private selects = new Map<Part, HTMLSelectElement>();
  private fills = new Map<Part, () => void>();
  private group = el("select", { id: "group", "aria-label": "grouped by" });
  private search = el("input", { type: "search", placeholder: "search text (key /)", "aria-label": "text in the finding" });
  private all = el("button", { type: "button", id: "open-all" });
  private open: Set<string>;
  private sort: { key: SortKey; down: boolean };
  private chosen = -1;
  private groups: Group[] = [];
  private lines: Line[] = [];

  constructor(private f: Findings, private link: LinkState, private directory: string) {
    this.rows.host.id = "findings";
    groupings.forEach(([name], i) => this.group.append(new Option(i < groupings.length - 1 ? `by ${name}` : "not grouped", String(i))));
    this.group.addEventListener("change", () => this.changed("group", this.group.value === "0" ? null : this.group.value, true));
    this.controls.append(this.group);
    for (const p of parts) this.addFilter(p);
    this.search.addEventListener("input", () => this.changed("words", this.search.value || null, false));
    this.all.addEventListener("click", () => this.toggleAll());
    this.controls.append(this.search, this.all);
    addEventListener("keydown", (e) => {
      if (e.key !== "/" || isTyping(e)) return;
      e.preventDefault();
      this.search.focus();
    });
    this.element.append(this.controls, this.found, el("div", { id: "work" }, this.rows.host, this.detail),
      el("p", { class: "soft screen-only", id: "keys" }, "Keys in the list: arrows move, Enter opens, ← closes a group, / searches, l switches between light and dark."));
    this.open = new Set();
    this.sort = { key: "answers", down: true };
    this.follow();
  }

  private addFilter(p: Part): void {
    const counts = new Int32Array(this.f.values(p).length);
    for (let i = 0; i < this.f.count; ++i) counts[this.f.code(i, p)]! += 1;
    if (counts.length < 2) return;
    const select = el("select", { "aria-label": p, id: `filter-${p}` }, el("option", { value: "" }, p === "magnitude" ? "any size" : `any ${p}`));
    const fill = (): void => {
      if (select.length > 1) return;
      const options = this.f.values(p).map((v, i) => [v, counts[i]!] as const).sort((a, b) => b[1] - a[1]);
      select.append(...options.map(([v, n]) => el("option", { value: v }, `${spaced(v)} (${grouped(n)})`)));
    };
    // Thousands of options cost more than the rest of the page, so they are added on first use.
    this.fills.set(p, fill);
    if (counts.length <= 500) fill();
    else for (const event of ["pointerdown", "focus"]) select.addEventListener(event, fill);
    select.addEventListener("change", () => this.changed(p, select.value || null, true));
    this.selects.set(p, select);
    this.controls.append(select);
  }

  private changed(key: string, value: string | null, top: boolean): void {
    this.link.set(key, value);
    if (top) this.rows.host.scrollTop = 0;
    this.draw();
  }

  /** Restores the state from the address. */
  follow(): void {
    for (const [p, s] of this.selects) {
      const value = this.link.get(p) ?? "";
      if (value) this.fills.get(p)!();
      s.value = value;
    }
    this.search.value = this.link.get("words") ?? "";
    this.group.value = String(Math.min(groupings.length - 1, Math.max(0, this.link.number("group") ?? 0)));
    this.open = new Set((this.link.get("open") ?? "").split(",").filter(Boolean));
    const key = this.link.get("sort");
    this.sort = { key: key === "name" || key === "worst" ? key : "answers", down: this.link.get("down") !== "0" };
    const wanted = this.link.get("finding");
    this.chosen = wanted ? this.f.find(wanted) : -1;
    this.drawDetail();
  }

  private wantedRows(): number[] {
    const wanted = [...this.selects].filter(([, s]) => s.value).map(([p, s]) => [p, this.f.values(p).indexOf(s.value)] as const);
    const words = this.search.value.toLowerCase();
    const rows: number[] = [];
    for (let i = 0; i < this.f.count; ++i)
      if (wanted.every(([p, c]) => this.f.code(i, p) === c) && (!words || this.f.says(i, words))) rows.push(i);
    return rows;
  }

  draw(): void {
    const rows = this.wantedRows();
    const sign = this.sort.down ? -1 : 1;
    const { key } = this.sort;
    const measure = key === "worst" ? this.f.worst : this.f.answers;
    // Rows arrive in the order of their keys; sorting is stable.
    if (key !== "name") rows.sort((a, b) => sign * ((measure[a]! || 0) - (measure[b]! || 0)) || a - b);
    else if (sign < 0) rows.reverse();
    const by = groupings[Number(this.group.value)]![1];
    this.groups = by.length ? groupsOf(this.f, rows, by) : [];
    if (key === "name") this.groups.sort((a, b) => sign * (a.id < b.id ? -1 : 1));
    else this.groups.sort((a, b) => sign * (a[key] - b[key]) || (a.id < b.id ? -1 : 1));
    const only = this.groups.length === 1;
    const none: Group = { id: "", rows, answers: 0, worst: 0 };
    this.lines = by.length
      ? this.groups.flatMap((g) => [{ group: g, row: -1 }, ...(only || this.open.has(g.id) ? g.rows.map((row) => ({ group: g, row })) : [])])
      : rows.map((row) => ({ group: none, row }));
    this.found.textContent = `${grouped(rows.length)} of ${grouped(this.f.count)} kinds` + (by.length ? ` in ${grouped(this.groups.length)} groups` : "") +
      `, ${grouped(rows.reduce((s, i) => s + this.f.answers[i]!, 0))} answers. ` + (by.length ? "Click a group to open it, a finding to see how to replay it." : "Click a finding to see how to replay it.");
    this.all.style.display = by.length && !only ? "" : "none";
    this.all.textContent = this.groups.every((g) => this.open.has(g.id)) ? "close all" : "open all";
    this.drawHead(by.length > 0);
    this.rows.show({
      length: this.lines.length, cells: (i) => this.cells(this.lines[i]!), open: (i) => this.press(i), key: (i, k) => this.key(i, k),
      style: (i) => (this.lines[i]!.row < 0 ? "group" : this.lines[i]!.row === this.chosen ? "chosen" : ""),
    });
  }

  private drawHead(groupedRows: boolean): void {
    const heads: [string, SortKey | null, string][] = [[groupedRows ? "what the first case shows" : "finding", "name", "what"], ["shapes", null, "shapes"],
      ["degeneracy", null, "degeneracy"], ["blame", null, "blame"], ["size", null, "size"], ["answers", "answers", "n answers"], ["worst / L", "worst", "n worst"]];
    this.rows.heads(heads.map(([text, key, style]) => {
      const th = el("th", { class: style }, key ? "" : text);
      if (!key) return th;
      const active = this.sort.key === key;
      const button = el("button", { type: "button", class: "head" }, text + (active ? (this.sort.down ? " ↓" : " ↑") : ""));
      button.addEventListener("click", () => {
        this.sort = { key, down: active ? !this.sort.down : key !== "name" };
        this.link.set("sort", key);
        this.changed("down", this.sort.down ? "1" : "0", true);
      });
      if (active) th.setAttribute("aria-sort", this.sort.down ? "descending" : "ascending");
      th.append(button);
      return th;
    }));
  }

  private cells({ group, row }: Line): HTMLElement[] {
    const td = (style: string, text: string): HTMLElement => el("td", { class: style, title: text }, text);
    const worst = (x: number): string => (x > 0 ? x.toExponential(1) : x === 0 ? "0" : String(x));
    if (row < 0) {
      const sign = this.groups.length === 1 || this.open.has(group.id) ? "▾" : "▸";
      const names = group.id.split(".").map(spaced).join(" · ");
      const name = td("what", `${sign} ${names}: ${grouped(group.rows.length)} ${group.rows.length === 1 ? "kind" : "kinds"}`);
      name.setAttribute("colspan", "2");
      return [name, td("degeneracy", ""), td("blame", ""), td("size", ""),
        td("n answers", grouped(group.answers)), td("n worst", worst(group.worst))];
    }
    const f = this.f;
    const what = group.id ? f.words(row) : `${f.value(row, "engine")} · ${spaced(f.value(row, "question"))} · ${spaced(f.value(row, "fault"))}`;
    return [td(group.id ? "what in" : "what", what), td("shapes", f.value(row, "shapes")), td("degeneracy", spaced(f.value(row, "degeneracy"))), td("blame", f.value(row, "blame")),
      td("size", spaced(f.value(row, "magnitude"))), td("n answers", grouped(f.answers[row]!)), td("n worst", worst(f.worst[row]!))];
  }

  private press(i: number): void {
    const { group, row } = this.lines[i]!;
    if (row < 0) return this.toggle(group, !this.open.has(group.id));
    this.chosen = row;
    this.link.set("finding", this.f.key(row));
    this.draw();
    this.drawDetail();
    this.detail.scrollIntoView({ block: "nearest" });
  }

  private toggle(group: Group, open: boolean): void {
    if (open) this.open.add(group.id);
    else this.open.delete(group.id);
    this.link.set("open", this.open.size && this.open.size <= 12 ? [...this.open].join(",") : null);
    this.draw();
  }

  private toggleAll(): void {
    const open = !this.groups.every((g) => this.open.has(g.id));
    for (const g of this.groups) open ? this.open.add(g.id) : this.open.delete(g.id);
    this.link.set("open", null);
    this.draw();
  }

  private key(i: number, key: string): boolean {
    const { group, row } = this.lines[i]!;
    if (key === "ArrowRight" && row < 0) this.toggle(group, true);
    else if (key === "ArrowLeft") {
      this.toggle(group, false);
      this.rows.goTo(this.lines.findIndex((l) => l.group.id === group.id));
    } else return false;
    return true;
  }

  private drawDetail(): void {
    if (this.chosen < 0) return this.detail.replaceChildren();
    const f = this.f, i = this.chosen, key = f.key(i), engine = f.value(i, "engine");
    const path = `${this.directory}/findings/${key}`;
    const close = el("button", { type: "button", class: "screen-only", title: "close" }, "×");
    close.addEventListener("click", () => {
      this.chosen = -1;
      this.link.set("finding", null);
      this.drawDetail();
      this.draw();
    });
    const say = (words: string, command: string): HTMLElement[] => [el("p", { class: "soft" }, words), commandLine(command)];
    this.detail.replaceChildren(el("div", { class: "title" }, el("h2", {}, parts.slice(0, 4).map((p) => spaced(f.value(i, p))).join(" · ")), close),
      el("p", {}, f.words(i)), el("p", { class: "soft" }, `${grouped(f.answers[i]!)} ${f.answers[i] === 1 ? "answer" : "answers"} like this${f.worst[i]! > 0 ? `; the worst is off by ${f.worst[i]!.toExponential(1)} of the scene's scale L` : ""}. ${blameWords[f.value(i, "blame")] ?? ""}`),
      ...say("Every engine's answer beside the referee's:", `./touchstone replay ${path}`), ...say("The case as a picture:", `./touchstone view ${path} -o page.html`),
      ...say("The smallest case that shows it:", `./touchstone shrink ${path} --engine ${engine}`),
      ...say("As one file against the engine alone:", `./touchstone reproduce ${path} --engine ${engine} -o reproduce.cpp`));
  }
}
