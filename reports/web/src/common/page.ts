// Shared by all pages: data, elements, the state kept in the address, light and dark themes.
import { unzlibSync } from "fflate";
import "./style.css";

/** The data the program wrote into the page: JSON, or if it is long, {"deflate": base64 of its zlib stream}. */
export function pageData<T>(): T {
  const holder = document.getElementById("data")!;
  let value = JSON.parse(holder.textContent!) as { deflate?: string };
  if (typeof value.deflate === "string") {
    const bytes = atob(value.deflate);
    const packed = new Uint8Array(bytes.length);
    for (let i = 0; i < bytes.length; ++i) packed[i] = bytes.charCodeAt(i);
    holder.textContent = "";
    value = JSON.parse(new TextDecoder().decode(unzlibSync(packed))) as object;
  }
  // For tests and the console.
  (globalThis as unknown as { touchstoneData: unknown }).touchstoneData = value;
  return value as T;
}

type Child = Node | string | null | undefined;

export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const e = document.createElement(tag);
  for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v);
  for (const c of children) if (c !== null && c !== undefined) e.append(c);
  return e;
}

export const app = (): HTMLElement => document.getElementById("app")!;

/** Key-value pairs in the address after '#', so that a link shows what its sender saw. */
export class LinkState {
  private values = new URLSearchParams(location.hash.slice(1));
  private timer = 0;
  get(key: string): string | null {
    return this.values.get(key);
  }
  number(key: string): number | null {
    const v = this.values.get(key);
    return v === null || v === "" || !Number.isFinite(Number(v)) ? null : Number(v);
  }
  set(key: string, value: string | null): void {
    if (value === null) this.values.delete(key);
    else this.values.set(key, value);
    clearTimeout(this.timer);
    // Browsers limit address changes to about a hundred in half a minute.
    this.timer = window.setTimeout(() => {
      history.replaceState(null, "", "#" + this.values.toString());
      delete document.documentElement.dataset["linkPending"];
    }, 150);
    document.documentElement.dataset["linkPending"] = "";
  }
  /** Calls `f` when the user edits the address or follows a link within the page. */
  onChange(f: () => void): void {
    addEventListener("hashchange", () => {
      this.values = new URLSearchParams(location.hash.slice(1));
      f();
    });
  }
}

export const isDark = (): boolean => {
  const chosen = document.documentElement.dataset["theme"];
  return chosen ? chosen === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
};

/** The button that switches between light and dark; `changed` redraws what CSS cannot restyle. */
export function themeButton(link: LinkState, changed: () => void): HTMLButtonElement {
  const apply = (theme: string | null): void => {
    if (theme === "dark" || theme === "light") document.documentElement.dataset["theme"] = theme;
  };
  apply(link.get("theme"));
  const button = el("button", { type: "button", id: "theme", title: "light or dark (key l)" }, "◐");
  const toggle = (): void => {
    const next = isDark() ? "light" : "dark";
    apply(next);
    link.set("theme", next);
    changed();
  };
  button.addEventListener("click", toggle);
  addEventListener("keydown", (e) => {
    if (e.key === "l" && !isTyping(e)) toggle();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", changed);
  // Paper is white, and scripted drawings take their colours when drawn, so they are redrawn for print.
  matchMedia("print").addEventListener("change", changed);
  let chosen: string | undefined;
  addEventListener("beforeprint", () => {
    chosen = document.documentElement.dataset["theme"];
    apply("light");
    changed();
  });
  addEventListener("afterprint", () => {
    if (chosen) apply(chosen);
    else delete document.documentElement.dataset["theme"];
    changed();
  });
  return button;
}

export const isTyping = (e: KeyboardEvent): boolean =>
  e.ctrlKey || e.metaKey || e.altKey || (e.target instanceof HTMLElement && /^(INPUT|SELECT|TEXTAREA)$/.test(e.target.tagName) &&
    (e.target as HTMLInputElement).type !== "range" && (e.target as HTMLInputElement).type !== "checkbox");

/** A shell command with a button that copies it. */
export function commandLine(command: string): HTMLElement {
  const copy = el("button", { type: "button", title: "copy" }, "copy");
  copy.addEventListener("click", () => {
    void navigator.clipboard?.writeText(command).then(() => (copy.textContent = "copied"));
  });
  return el("div", { class: "command" }, el("code", {}, command), copy);
}

/** A number from JSON, where NaN and infinities are strings. */
export const numberOf = (x: unknown): number =>
  typeof x === "number" ? x : x === "inf" ? Infinity : x === "-inf" ? -Infinity : NaN;

/** Short form, like C's %.{digits}g. */
export function short(x: number, digits = 4): string {
  if (!Number.isFinite(x)) return String(x);
  if (x === 0) return "0";
  const a = Math.abs(x);
  if (a >= 1e6 || a < 1e-3) return x.toExponential(Math.max(0, digits - 3)).replace("e+", "e");
  return String(Number(x.toPrecision(digits)));
}

const english = new Intl.NumberFormat("en-US");  // shared, because creating one is expensive
export const grouped = (n: number): string => english.format(n);

export function nanoseconds(ns: number): string {
  if (ns < 1e3) return `${Number(ns.toPrecision(3))} ns`;
  if (ns < 1e6) return `${Number((ns / 1e3).toPrecision(3))} µs`;
  return `${Number((ns / 1e6).toPrecision(3))} ms`;
}

/** Colours distinguishable with red-green colour blindness (Okabe and Ito 2008), then rotated hues. */
const palette = ["#0072b2", "#e69f00", "#cc79a7", "#56b4e9", "#d55e00", "#8c6bb1", "#b59f00", "#7f7f7f"];
export function colourOf(index: number): string {
  return palette[index] ?? hex((index * 137.5) % 360, 0.6, index % 2 ? 0.42 : 0.6);
}

// "#rrggbb", because three.js cannot parse hsl() without commas.
function hex(hue: number, saturation: number, lightness: number): string {
  const channel = (n: number): string => {
    const k = (n + hue / 30) % 12;
    const x = lightness - saturation * Math.min(lightness, 1 - lightness) * Math.max(-1, Math.min(k - 3, 9 - k, 1));
    return Math.round(255 * x).toString(16).padStart(2, "0");
  };
  return `#${channel(0)}${channel(8)}${channel(4)}`;
}

/** Regions that scroll sideways take the focus, so that the arrow keys can scroll them; others do not. */
function makeScrollable(): void {
  for (const e of document.querySelectorAll<HTMLElement>(".scroll, .command > code, pre")) {
    if (e.scrollWidth > e.clientWidth + 1) e.tabIndex = 0;
    else e.removeAttribute("tabindex");
  }
}

let planned = 0;
function planScrollable(): void {
  cancelAnimationFrame(planned);
  planned = requestAnimationFrame(makeScrollable);
}
new MutationObserver(planScrollable).observe(document.documentElement, { childList: true, subtree: true });
addEventListener("resize", planScrollable);
