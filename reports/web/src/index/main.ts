// The index of a directory: one line a result, with links to its page and its record.
import { LinkState, app, commandLine, el, grouped, pageData, themeButton } from "../common/page";
import "./index.css";

type Mood = "none" | "good" | "bad" | "open";
interface Place { name: string; address: string }
interface Result {
  kind: string; subject: string; content: string; verdict: string; mood: Mood;
  page: Place | null; record: Place | null;
  /** Makes the page, if there is none. */
  command: string;
}
interface IndexPage { page: "index"; version: number; title: string; command: string; results: Result[]; unreadable: { file: Place; reason: string }[] }

const data = pageData<IndexPage>();
const link = new LinkState();

// In the order of the page.
const headings: [string, string][] = [
  ["campaign", "Campaigns"], ["causes", "Causes"], ["certificate", "Broad phases"], ["robot", "Robots"], ["plan", "Plans"], ["cover", "Convex pieces"],
  ["chart", "Speed and accuracy"], ["stability", "Stability"], ["releases", "Releases"], ["fingerprint", "Fingerprints"], ["case", "Cases"],
];
// The signs repeat what the colours say.
const marks: Record<Mood, [string, string]> = { none: ["", "soft"], good: ["✓", "good"], bad: ["✗", "bad"], open: ["?", "warn"] };

const linkTo = (place: Place | null, words: string): HTMLElement | null => (place ? el("a", { href: place.address }, words) : null);
const nameOf = (r: Result): string => r.subject || (r.page ?? r.record)!.name;

function line(r: Result): HTMLElement {
  const [mark, style] = marks[r.mood];
  const main = r.page ?? r.record;
  const record = r.page && r.record ? linkTo(r.record, r.record.name) : null;
  return el("li", { "data-kind": r.kind, "data-mood": r.mood },
    el("div", {}, el("a", { href: main!.address }, el("b", {}, nameOf(r))), el("div", {}, r.content)),
    el("div", { class: `verdict ${style}` }, mark ? el("span", { class: "mark", "aria-hidden": "true" }, mark) : null, r.verdict),
    el("div", { class: "more soft links" }, el("span", { class: "mono" }, main!.name), record ? el("span", { class: "mono" }, record) : null),
    r.command ? el("div", { class: "more screen-only" }, commandLine(r.command)) : null);
}

function section([kind, heading]: [string, string]): HTMLElement | null {
  const list = data.results.filter((r) => r.kind === kind);
  if (list.length === 0) return null;
  return el("section", { id: kind }, el("h2", {}, list.length > 1 ? `${heading} (${grouped(list.length)})` : heading), el("ul", { class: "results" }, ...list.map(line)));
}

function unreadable(): HTMLElement | null {
  if (data.unreadable.length === 0) return null;
  return el("section", { id: "unreadable" }, el("h2", {}, "Not readable"),
    el("ul", { class: "results" }, ...data.unreadable.map((u) => el("li", {}, el("div", {}, linkTo(u.file, u.file.name)), el("div", { class: "verdict bad" }, "not read"), el("div", { class: "more soft" }, u.reason)))));
}

const count = data.results.length;
const bad = data.results.filter((r) => r.mood === "bad").length;
document.title = `Touchstone: ${data.title}`;
app().append(
  el("header", {}, el("div", { class: "grow" }, el("h1", {}, data.title),
    el("p", { class: "soft" }, `${grouped(count)} ${count === 1 ? "result" : "results"}${bad > 0 ? `, ${grouped(bad)} with something wrong` : ""}. A name opens the page, or the record where there is no page.`)),
    el("div", { class: "controls screen-only" }, themeButton(link, () => undefined))),
  el("main", {}, ...headings.map(section), unreadable(),
    el("h2", { class: "screen-only" }, "List again"), el("div", { class: "screen-only" }, commandLine(data.command))),
);
