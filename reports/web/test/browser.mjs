// What tests of pages share: node TEST.mjs CHROMIUM DIR [SCREENSHOTS].
import { mkdirSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { chromium } from "playwright-core";

const [, , executablePath, dir, pictures] = process.argv;
if (pictures) mkdirSync(pictures, { recursive: true });
const browser = await chromium.launch({
  executablePath,
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
});
let failed = 0;

export { dir };

export function check(what, ok, more = "") {
  console.log(`${ok ? "ok  " : "FAIL"} ${what} ${ok ? "" : more}`);
  if (!ok) ++failed;
}

export async function open(name, { settle = 150, hash = "", width = 1280, height = 720, dark = false } = {}) {
  const page = await browser.newPage({ viewport: { width, height }, colorScheme: dark ? "dark" : "light" });
  const errors = [];
  page.on("console", (m) => m.type() === "error" && errors.push(m.text()));
  page.on("pageerror", (e) => errors.push(String(e)));
  page.on("request", (r) => /^https?:/.test(r.url()) && errors.push(`asks the network for ${r.url()}`));
  await page.goto(`file://${join(dir, name)}${hash}`);
  await page.waitForTimeout(settle);
  return { page, errors };
}

export const shoot = (page, name, more = {}) => (pictures ? page.screenshot({ path: join(pictures, `${name}.png`), ...more }) : undefined);
export const data = (page) => page.evaluate(() => globalThis.touchstoneData);
export const wide = (page) => page.evaluate(() => document.documentElement.scrollWidth <= innerWidth + 1);

const twoFrames = (page) => page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));

/** The address after '#', once the page has written there what it shows. */
export async function address(page) {
  await twoFrames(page);
  await page.waitForFunction(() => !("linkPending" in document.documentElement.dataset));
  return page.evaluate(() => location.hash);
}

/** What axe-core finds against WCAG 2.1, levels A and AA: rule, place and reason, in one line. A page that may still be
 * drawing is asked again; what stays is a barrier. */
export async function barriers(page) {
  await page.addScriptTag({ path: createRequire(import.meta.url).resolve("axe-core/axe.min.js") });
  for (let asked = 1; ; ++asked) {
    const found = await page.evaluate(() => globalThis.axe.run(document, { runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"] }));
    if (found.violations.length === 0 || asked === 20)
      return found.violations.map((v) => `${v.id} at ${v.nodes.map((n) => n.target.join(" ")).join(", ")}: ${v.help}`).join("; ");
    await twoFrames(page);
    await page.waitForTimeout(250);
  }
}

export async function end() {
  await browser.close();
  console.log(failed ? `${failed} checks failed` : "all checks hold");
  process.exit(failed ? 1 : 0);
}
