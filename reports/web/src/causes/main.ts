// The page of a campaign's causes, in the order in which to read them.
import { causeTable } from "../common/cause_table";
import { LinkState, app, el, grouped, isTyping, pageData, themeButton } from "../common/page";
import { Block } from "./block";
import type { CausesPage } from "./types";
import "./causes.css";

const data = pageData<CausesPage>();
const { causes, notes, answers, keys, unseen_text, cases, seed } = data.record;
const link = new LinkState();
document.title = `Touchstone: ${data.title}`;

const seen = new IntersectionObserver((entries) => {
  for (const e of entries) if (e.isIntersecting) blocks.find((b) => b.owns(e.target))?.show();
}, { rootMargin: "600px" });
const blocks = causes.map((c, i) => new Block(c, i + 1, seen));

// Filters: a value of each, or all.
const filters = { path: select("path", "engine path", causes.map((c) => c.path)), severity: select("severity", "severity", causes.map((c) => c.severity), true) };
function select(key: string, label: string, values: string[], ordered = false): HTMLSelectElement {
  const distinct = [...new Set(values)];
  if (!ordered) distinct.sort();
  const s = el("select", { id: `filter-${key}`, "aria-label": label }, new Option(`every ${label}`, ""), ...distinct.map((v) => new Option(`${v} (${values.filter((x) => x === v).length})`, v)));
  s.addEventListener("change", () => {
    link.set(key, s.value || null);
    filter();
  });
  return s;
}

const found = el("span", { id: "found", class: "soft", role: "status" });
const index = causeTable(causes, (c) => {
  const open = el("a", { href: `#cause=${encodeURIComponent(c.id)}` }, c.title);
  open.addEventListener("click", (e) => {
    e.preventDefault();
    goTo(blocks[causes.indexOf(c)]!);
  });
  return open;
});

app().append(
  el("header", {}, el("div", { class: "grow" }, el("h1", {}, data.title),
    el("p", {}, el("b", {}, `${grouped(causes.length)} ${causes.length === 1 ? "cause" : "causes"}`), ` behind ${grouped(answers)} wrong answers (${grouped(keys)} keys) of ${grouped(cases)} cases, seed ${seed}. Chance that the next wrong answer is of a cause not listed: ${unseen_text}.`),
    ...notes.map((n) => el("p", { class: "warn" }, n))),
    el("div", { class: "controls screen-only" }, themeButton(link, () => blocks.forEach((b) => b.redraw())))),
  el("main", {},
    el("div", { class: "controls screen-only", id: "filters" }, filters.path, filters.severity, found),
    index,
    ...blocks.map((b) => b.element),
    el("p", { class: "soft screen-only" }, "Keys: n and p next and previous cause, l light or dark; in a picture, arrows rotate, + and − zoom.")),
);

const visible = (): Block[] => blocks.filter((b) => !b.element.hidden);

function goTo(b: Block): void {
  link.set("cause", b.cause.id);
  b.element.focus({ preventScroll: true });
  b.element.scrollIntoView({ block: "start" });
}

function filter(): void {
  for (const b of blocks) {
    const shown = (!filters.path.value || b.cause.path === filters.path.value) && (!filters.severity.value || b.cause.severity === filters.severity.value);
    b.element.hidden = !shown;
    index.querySelectorAll<HTMLElement>("tbody tr")[b.number - 1]!.hidden = !shown;
  }
  const n = visible().length;
  found.textContent = n === blocks.length ? `${grouped(n)} causes` : `${grouped(n)} of ${grouped(blocks.length)} causes`;
}

addEventListener("keydown", (e) => {
  if (isTyping(e) || (e.key !== "n" && e.key !== "p")) return;
  const list = visible(), at = list.findIndex((b) => b.element.contains(document.activeElement));
  const next = list[at < 0 ? 0 : at + (e.key === "n" ? 1 : -1)];
  if (next) goTo(next);
});

// Paper: every picture must be there.
addEventListener("beforeprint", () => visible().forEach((b) => b.show()));

function follow(): void {
  filters.path.value = link.get("path") ?? "";
  filters.severity.value = link.get("severity") ?? "";
  if (filters.path.selectedIndex < 0) filters.path.value = "";
  if (filters.severity.selectedIndex < 0) filters.severity.value = "";
  filter();
  const wanted = blocks.find((b) => b.cause.id === link.get("cause"));
  if (wanted && !wanted.element.hidden) goTo(wanted);
}
follow();
link.onChange(follow);
