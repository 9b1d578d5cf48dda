// One cause: what is wrong, how often, what makes it vanish, and what to hand to the maintainers.
import { shapeLine } from "../case/shape_line";
import type { SceneJson } from "../case/types";
import { severityBadge } from "../common/cause_table";
import { commandLine, el, grouped, numberOf, short } from "../common/page";
import { Drawing, canDraw } from "./drawing";
import type { Cause, CauseCase, Response } from "./types";

export const spaced = (s: string): string => s.replaceAll("_", " ");

const counted = (n: number, one: string, many: string): string => `${grouped(n)} ${n === 1 ? one : many}`;

export const shownCase = (c: Cause): CauseCase => (c.defensible.case ? c.defensible : c.smallest);

const answers: [Response, string, string][] = [["gone", "✓", "right when"], ["differs", "≠", "wrong in another way when"], ["stays", "✗", "still wrong when"], ["open", "?", "not decided when"]];

// Changes by the answer they led to: what makes the fault vanish comes first.
function responseTable(c: Cause): HTMLElement | null {
  const rows = answers.flatMap(([response, sign, words]) => {
    const changes = c.response.filter((r) => r.response === response);
    if (changes.length === 0) return [];
    return [el("tr", { class: response, "data-response": response }, el("th", { scope: "row" }, el("span", { "aria-hidden": "true" }, `${sign} `), words),
      el("td", {}, el("ul", {}, ...changes.map((r) => el("li", { title: r.intervention }, r.change)))))];
  });
  if (rows.length === 0) return null;
  const left = c.response.filter((r) => r.response === "not applicable").length;
  return el("div", {}, el("table", { class: "response" }, el("caption", {}, "One thing changed at a time"), el("tbody", {}, ...rows)),
    left > 0 ? el("p", { class: "soft" }, `${left} more ${left > 1 ? "changes do" : "change does"} not apply.`) : null);
}

function facts(c: Cause): HTMLElement {
  const list = el("dl");
  const fact = (name: string, value: string): void => {
    if (value) list.append(el("div", {}, el("dt", {}, name), el("dd", {}, value)));
  };
  const worst = numberOf(c.worst_in_l);
  fact("Library", c.library);
  fact("Routine", c.route);
  fact("Engines", c.engines.join(", "));
  fact("Questions", c.questions.map(spaced).join(", "));
  fact("Shapes", c.shapes.join(", "));
  fact("Faults", c.faults.map(spaced).join(", "));
  fact("Worst error", worst > 0 ? `${worst.toExponential(1)} L` : "");
  fact("Worst case", c.worst.words && c.worst.words !== shownCase(c).words ? `${c.worst.engine}: ${c.worst.words}` : "");
  if (c.defensible.case && c.smallest.words !== c.defensible.words) fact("Smallest case", `${counted(c.smallest.bodies, "body", "bodies")}, ${counted(c.smallest.bits, "bit", "bits")}: ${c.smallest.words}`);
  fact("Consequences", c.consequences.map(spaced).join(", "));
  fact("Families", c.families.join(", "));
  fact("Filed under", `${counted(c.key_count, "key", "keys")}; first seen in case ${grouped(c.first_index)}`);
  return list;
}

function copyButton(text: string, label: string): HTMLButtonElement {
  const button = el("button", { type: "button" }, label);
  button.addEventListener("click", () => void navigator.clipboard?.writeText(text).then(() => (button.textContent = "copied")));
  return button;
}

// A long text that is put into the document only when it is opened.
function folded(summary: string, text: () => string, file?: string): HTMLElement {
  const out = el("details", {}, el("summary", {}, summary));
  out.addEventListener("toggle", () => {
    if (!out.open || out.querySelector("pre")) return;
    const whole = text();
    const save = file ? el("a", { download: file, href: `data:text/plain;charset=utf-8,${encodeURIComponent(whole)}` }, "save") : null;
    out.append(el("div", { class: "controls screen-only" }, copyButton(whole, "copy"), save), el("pre", { tabindex: "0" }, whole));
  });
  return out;
}

function sceneList(scene: SceneJson): HTMLElement {
  const lines = scene.bodies.slice(0, 4).map((b, i) => {
    const at = b.pose?.translation ?? [0, 0, 0], v = b.motion?.linear;
    return el("div", {}, `${"AB"[i] ?? i}: ${shapeLine(scene.shapes[b.shape]!)}, at (${at.map((x) => short(x, 6)).join(" ")})` +
      (b.pose?.rotation ? ", turned" : "") + (v ? `, moves (${v.map((x) => short(x)).join(" ")})` : ""));
  });
  const left = scene.bodies.length - lines.length;
  return el("div", { class: "soft mono bodies" }, ...lines, left > 0 ? el("div", {}, `and ${left} more`) : null);
}

// A case comes from a file: one that is no valid scene must not take the other causes with it.
function orNothing<T>(make: () => T): T | null {
  try {
    return make();
  } catch {
    return null;
  }
}

/** The picture is made when the block comes near the window. */
export class Block {
  readonly element: HTMLElement;
  private drawing: Drawing | null = null;
  private place = el("div", { class: "picture" });

  constructor(readonly cause: Cause, readonly number: number, seen: IntersectionObserver) {
    const c = cause, shown = shownCase(c);
    const scene = shown.case?.scene ?? null;
    const drawn = scene !== null && canDraw(scene);
    const list = scene ? orNothing(() => sceneList(scene)) : null;
    this.element = el("article", { class: "cause", id: `cause-${c.id}`, "data-cause": c.id, tabindex: "-1", "aria-label": `cause ${number}` },
      el("div", { class: "line" }, el("span", { class: "soft number" }, String(number)), severityBadge(c), el("b", {}, c.path), el("span", { class: "soft" }, c.rate_text)),
      el("h2", {}, c.title),
      c.documented ? el("p", { class: "soft" }, `The engine's documentation states it: ${c.documented}`) : null,
      el("div", { class: "sides" },
        el("div", {}, el("p", {}, el("b", {}, "Expected: "), c.expected), el("p", { class: "actual" }, el("b", {}, `Actual, ${shown.engine}: `), shown.words),
          responseTable(c), facts(c)),
        el("div", {}, drawn ? this.place : null, list)),
      commandLine(c.command),
      el("div", { class: "controls screen-only" }, copyButton(c.markdown, "copy as Markdown for an issue tracker")),
      folded("Markdown", () => c.markdown, `${c.id}.md`),
      shown.case ? folded(`the case as JSON (${counted(shown.bodies, "body", "bodies")}, ${counted(shown.bits, "bit", "bits")})`, () => JSON.stringify(shown.case, null, 1), `${c.id}.case.json`) : null,
      c.program ? folded(`program in the engine's own API (${c.program.split("\n").length} lines)`, () => c.program, `${c.id}.cpp`) : null,
      c.no_program ? el("p", { class: "soft" }, `No program in the engine's own API: ${c.no_program}.`) : null,
      c.certificate ? folded("certificate of the right answer", () => JSON.stringify(c.certificate, null, 1), `${c.id}.certificate.json`) : null);
    if (drawn) seen.observe(this.place);
  }

  owns(place: Element): boolean {
    return place === this.place;
  }

  show(): void {
    const scene = shownCase(this.cause).case?.scene;
    if (this.drawing || !scene) return;
    this.drawing = orNothing(() => new Drawing(scene, `the bodies of cause ${this.number}`));
    this.place.replaceChildren(this.drawing?.element ?? el("p", { class: "soft" }, "This case cannot be drawn."));
  }

  redraw(): void {
    this.drawing?.draw();
  }
}
