// A broad-phase certificate: is the subject conservative, what was tried, what is not proved; or what refutes it.
import { LinkState, app, commandLine, el, grouped, numberOf, pageData, themeButton } from "../common/page";
import { drawScript } from "./script";
import type { CertificatePage, Evidence, FaultClass, Level, Refutation, TooSlow } from "./types";
import "./certificate.css";

const data = pageData<CertificatePage>();
const c = data.certificate;
const link = new LinkState();
document.title = `Touchstone: ${data.title}`;
const spaced = (s: string): string => s.replaceAll("_", " ");
const levels = (["boxes", "bodies"] as const).filter((l) => c.verdict[l] !== undefined && c.verdict[l] !== "not_asked");
const about: Record<Level, string> = {
  boxes: "The candidates must contain every overlapping pair of the given boxes, touching included. The boxes are exact in the subject's arithmetic.",
  bodies: "The candidates must contain every truly overlapping pair of bodies, decided in exact arithmetic, whatever boxes the subject computes.",
};
const kinds: Record<string, string> = {
  exhaustive: "every case, up to symmetry", adversarial: "aimed at known weaknesses of broad phases", temporal: "long histories", random: "drawn from a stated distribution",
};
const badge = (verdict: string): HTMLElement => {
  const [sign, style] = verdict === "certified" ? ["✓", "good"] : verdict === "refuted" ? ["✗", "bad"] : ["–", "warn"];
  return el("b", { class: style }, `${sign} ${spaced(verdict)}`);
};

const price = (truth: number, reported: number): string => (truth === 0 ? "–" : String(Number((Math.max(0, reported - truth) / truth).toPrecision(3))));
const sum = (list: Evidence[], key: "cases" | "queries" | "pairs_true" | "pairs_reported" | "refused" | "steps" | "undecided"): number => list.reduce((s, e) => s + e[key], 0);

const kindWords: Record<string, string> = {
  solid: "solid pair", touching: "touching pair", moving: "pair that meets within the step", numbers: "", unbounded: "infinite box", invalid: "NaN, infinite or inverted box",
};
const inWords = (f: FaultClass): string => `${spaced(f.fault)}${kindWords[f.kind] ? `, ${kindWords[f.kind]}` : ""}`;

function tile(level: Level): HTMLElement {
  const list = c.evidence.filter((e) => e.level === level);
  const r = c.refutations.find((x) => x.level === level);
  const others = c.refutations.filter((x) => x.level === level).length - 1;
  const slow = c.too_slow.filter((x) => x.level === level);
  const cut = list.some((e) => e.cases < e.population);
  return el("a", { class: `tile ${c.verdict[level]!.replaceAll(" ", "_")}`, href: `#${level}` }, el("div", {}, `Level of ${level}: `, badge(c.verdict[level]!)),
    el("div", { class: "soft" }, r ? `${inWords(r)}, shown with ${r.bodies} bodies in ${r.steps} steps${others ? `; ${others} more ${others > 1 ? "kinds" : "kind"} of fault` : ""}` :
      slow.length ? `too slow for ${slow.map((x) => spaced(x.evidence)).join(", ")}: no fault was seen, but nothing is certified` : `${grouped(sum(list, "cases"))} cases${cut ? " (some are samples)" : ""}, ${grouped(sum(list, "pairs_true"))} true pairs, none lost; price ${price(sum(list, "pairs_true"), sum(list, "pairs_reported"))}`));
}

function facts(): HTMLElement {
  const list = el("dl", {});
  const fact = (name: string, value: string): void => {
    if (value) list.append(el("dt", {}, name), el("dd", {}, value));
  };
  const u = numberOf(c.card.unit_roundoff);
  fact("Subject", data.subject && data.subject !== c.subject ? `${c.subject} (${data.subject})` : c.subject);
  fact("Library", `${c.card.library} ${c.card.version}`);
  fact("Settings", c.card.settings);
  fact("Hash of the plug-in", c.plugin_hash);
  fact("Arithmetic", `${u > 2 ** -50 ? "float" : "double"}, unit roundoff ${u.toExponential(2)}`);
  fact("Source of its tolerances", c.card.source);
  if (c.margin !== undefined) fact("Margin", `${c.margin}: every pair no farther apart must be a candidate`);
  fact("Motion", c.sweeps ? "tested: candidates over the whole step" : "not tested: --sweeps was not given");
  fact("Scope", `${c.scope}, seed ${c.seed}${c.limit ? `, at most ${grouped(c.limit)} cases per suite` : ""}`);
  fact("Left out", c.without.map(spaced).join(", "));
  fact("Made by", c.program);
  fact("Digest", c.digest);
  return list;
}

function evidenceTable(level: Level): HTMLElement {
  const heads: [string, string][] = [["suite", ""], ["what was tried", ""], ["cases", "n"], ["share", "n"], ["refused", "n"], ["undecided", "n"], ["steps", "n"], ["queries", "n"], ["true pairs", "n"], ["reported", "n"], ["price", "n"]];
  const body = el("tbody");
  for (const e of c.evidence.filter((x) => x.level === level)) {
    const n = (x: string, style = ""): HTMLElement => el("td", { class: `n ${style}` }, x);
    const share = e.population ? (e.cases >= e.population ? "all" : `${Number(((100 * e.cases) / e.population).toPrecision(2))} %`) : e.cases < e.planned ? "stopped" : "";
    body.append(el("tr", { "data-evidence": e.name, title: `digest ${e.digest}` }, el("td", { class: "name" }, spaced(e.name), el("div", { class: "soft", title: kinds[e.kind] ?? "" }, e.kind)),
      el("td", { class: "tried" }, e.line), n(grouped(e.cases)), n(share, share === "all" ? "good" : ""), n(e.refused ? grouped(e.refused) : "–"), n(e.undecided ? grouped(e.undecided) : "–", e.undecided ? "warn" : ""),
      n(grouped(e.steps)), n(grouped(e.queries)), n(grouped(e.pairs_true)), n(grouped(e.pairs_reported)), n(price(e.pairs_true, e.pairs_reported))));
    if (e.refusal) body.append(el("tr", {}, el("td", {}), el("td", { class: "soft tried", colspan: "10" }, `refused: ${e.refusal}`)));
  }
  return el("div", { class: "scroll" }, el("table", { class: "evidence" }, el("thead", {}, el("tr", {}, ...heads.map(([h, s]) => el("th", { class: s }, h)))), body));
}

// Every class of fault and every suite that shows it.
function faultTable(level: Level): HTMLElement[] {
  const list = c.faults.filter((f) => f.level === level);
  if (list.length === 0) return [];
  const body = el("tbody");
  for (const f of list)
    body.append(el("tr", { "data-fault": `${f.fault}/${f.kind}/${f.evidence}` }, el("td", { class: "bad" }, inWords(f)), el("td", { class: "name" }, spaced(f.evidence)), el("td", { class: "n" }, grouped(f.cases)),
      el("td", { class: "n" }, f.kind === "solid" ? `${Number((100 * f.share).toPrecision(2))} %` : "–"), el("td", { class: "tried" }, f.words)));
  const heads: [string, string][] = [["fault", ""], ["suite", ""], ["cases", "n"], ["overlap lost", "n"], ["example", ""]];
  return [el("h3", {}, "Faults seen"), el("div", { class: "scroll" }, el("table", { class: "faults" }, el("thead", {}, el("tr", {}, ...heads.map(([h, s]) => el("th", { class: s }, h)))), body))];
}

function slowLine(t: TooSlow): HTMLElement {
  const enough = t.sufficient ? `it answers within ${t.sufficient}: use --case-seconds ${t.sufficient}` : t.tried > t.allowed ? `nor within ${t.tried}` : "raise --case-seconds";
  return el("p", { class: "slow" }, el("b", { class: "warn" }, "too slow"), ` for ${spaced(t.evidence)}: no answer within ${t.allowed} CPU seconds per question in case ${t.index}, ${t.bodies} bodies, ${grouped(t.steps)} steps; ${enough}.`);
}

function refutation(r: Refutation): HTMLElement {
  const out = el("div", { class: "refutation" }, el("p", {}, el("b", { class: "bad" }, inWords(r)), `: ${r.words}`),
    el("p", { class: "soft" }, `Found in ${spaced(r.evidence)}, case ${r.index}. Smallest script: ${r.bodies} bodies, ${r.steps} steps (${spaced(r.shrink)}).`));
  if (!r.script) return out;
  out.append(...drawScript(r));
  const written = data.scripts[c.refutations.indexOf(r)];
  const file = written || `${c.subject.replace(/[^\w.-]+/g, "_")}.${r.level}.${r.fault}-${r.kind}.case.json`;
  const text = JSON.stringify(r.script, null, 1);
  const download = el("a", { download: file.replace(/^.*\//, ""), href: `data:application/json,${encodeURIComponent(text)}` }, "save the script");
  out.append(el("p", { class: "soft" }, written ? `The script is in ${file}; or ` : "Save it first: ", download, "."),
    commandLine(`./touchstone replay ${file} --engines ${data.subject}`), commandLine(`./touchstone view ${file} --broad -o page.html`));
  if (data.has_writer) out.append(commandLine(`./touchstone reproduce ${file} --engine ${data.subject} -o reproduce.cpp`));
  out.append(el("details", {}, el("summary", {}, "the script as JSON"), el("pre", {}, text)));
  return out;
}

function levelSection(level: Level): HTMLElement {
  const out = el("section", { id: level }, el("h2", {}, `Level of ${level}: `, badge(c.verdict[level]!)), el("p", { class: "soft" }, about[level]));
  for (const r of c.refutations) if (r.level === level) out.append(refutation(r));
  for (const t of c.too_slow) if (t.level === level) out.append(slowLine(t));
  out.append(...faultTable(level), evidenceTable(level));
  // If N random cases show no miss, the miss rate is below 3/N with 95 % confidence (the rule of three).
  if (c.verdict[level] === "certified")
    for (const e of c.evidence)
      if (e.level === level && e.kind === "random" && e.answered > 0)
        out.append(el("p", { class: "bound" }, `${spaced(e.name)}: miss rate below ${Number((3 / e.answered).toPrecision(2))} per scene (95 % confidence).`));
  return out;
}

app().append(
  el("header", {}, el("div", { class: "grow" }, el("h1", {}, c.subject), el("p", { class: "soft" }, "Is this broad phase conservative: does it ever lose a pair?")),
    el("div", { class: "controls screen-only" }, themeButton(link, () => undefined))),
  el("main", {}, el("div", { id: "tiles" }, ...levels.map(tile)), facts(), ...levels.map(levelSection),
    el("h2", {}, "What this does not prove"), el("ul", { id: "not-proved" }, ...c.not_proved.map((x) => el("li", {}, x))),
    el("h2", {}, "Re-run it"), el("p", { class: "soft" }, "Price: superfluous pairs per true pair. The certificate can be re-run from its own data alone; exit code 1 means that it does not hold."),
    commandLine(`./touchstone certify --check ${data.file || "CERTIFICATE.json"}`),
    el("p", { class: "soft screen-only" }, "Key l: light or dark.")),
);
