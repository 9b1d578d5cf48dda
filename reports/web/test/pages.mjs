// Pages in a real browser: node pages.mjs CHROMIUM DIR, where DIR holds case.html (two bodies that touch or overlap),
// motion.html, report.html, chart.html, stability.html. Prints one line a check; exit code 1 when one fails.
import { statSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";

const [, , executablePath, dir] = process.argv;
const browser = await chromium.launch({
  executablePath,
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
});
let failed = 0;
function check(what, ok, more = "") {
  console.log(`${ok ? "ok  " : "FAIL"} ${what} ${ok ? "" : more}`);
  if (!ok) ++failed;
}

async function open(name, { hash = "", width = 1280, height = 720, dark = false } = {}) {
  const page = await browser.newPage({ viewport: { width, height }, colorScheme: dark ? "dark" : "light" });
  const errors = [];
  page.on("console", (m) => m.type() === "error" && errors.push(m.text()));
  page.on("pageerror", (e) => errors.push(String(e)));
  page.on("request", (r) => /^https?:/.test(r.url()) && errors.push(`asks the network for ${r.url()}`));
  await page.goto(`file://${join(dir, name)}${hash}`);
  await page.waitForTimeout(150);
  return { page, errors };
}
const data = (page) => page.evaluate(() => JSON.parse(document.getElementById("data").textContent));

// Different colours in the middle of the canvas: a picture, not a background.
const colours = (page) =>
  page.evaluate(() => {
    const c = document.querySelector("#view canvas");
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [160, 120];
    const g = copy.getContext("2d");
    g.drawImage(c, 0, 0, 160, 120);
    const bytes = g.getImageData(0, 0, 160, 120).data;
    const seen = new Map();
    for (let i = 0; i < bytes.length; i += 4) {
      const key = `${bytes[i] >> 4},${bytes[i + 1] >> 4},${bytes[i + 2] >> 4}`;
      seen.set(key, (seen.get(key) ?? 0) + 1);
    }
    return { kinds: seen.size, share: 1 - Math.max(...seen.values()) / (160 * 120) };
  });
const picture = (page) => page.evaluate(() => document.querySelector("#view canvas").toDataURL());
const wide = (page) => page.evaluate(() => document.documentElement.scrollWidth <= innerWidth + 1);

for (const name of ["case.html", "motion.html", "report.html", "chart.html", "stability.html"]) {
  check(`${name} is smaller than 5 MB`, statSync(join(dir, name)).size < 5e6);
  for (const size of [{ width: 1280, height: 720 }, { width: 390, height: 844, dark: true }]) {
    const { page, errors } = await open(name, size);
    check(`${name} at ${size.width} loads without an error`, errors.length === 0, errors.join("; "));
    check(`${name} at ${size.width} does not scroll sideways`, await wide(page));
    const back = await page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
    check(`${name} is ${size.dark ? "dark" : "light"}`, (back === "rgb(255, 255, 255)") !== Boolean(size.dark), back);
    await page.click("#theme");
    const other = await page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
    check(`${name} changes its light`, other !== back);
    await page.close();
  }
}

{
  const { page } = await open("case.html");
  const d = await data(page);
  const c = await colours(page);
  check("the viewer draws bodies", c.kinds > 5 && c.share > 0.05, JSON.stringify(c));
  const q = d.queries.findIndex((x) => x.question === "contact");
  await page.click(`#questions button:nth-child(${q + 1})`);
  const shown = await page.$$eval("#answers tr[data-engine]", (rows) => rows.map((r) => [r.dataset.engine, r.textContent]));
  const expected = Object.entries(d.queries[q].engines).filter(([, e]) => e.answer.outcome !== "unsupported");
  check("the table has every engine that answers", shown.length === expected.length && shown.length > 0);
  check("the table says who is wrong", expected.every(([n, e]) => shown.find(([m]) => m === n)[1].includes("WRONG") === (e.faults.length > 0 && e.answer.outcome === "answered")));
  check("the command replays", (await page.textContent(".command code")).startsWith("./touchstone replay "));
  check("the certificate is drawn", /point|plane/.test(await page.evaluate(() => document.body.dataset.drawn)));
  const before = await picture(page);
  await page.focus("#view canvas");
  await page.keyboard.press("ArrowRight");
  check("the arrow key turns the picture", (await picture(page)) !== before);
  await page.mouse.move(300, 300);
  const turned = await picture(page);
  await page.mouse.down();
  await page.mouse.move(380, 330, { steps: 4 });
  await page.mouse.up();
  check("the mouse turns the picture", (await picture(page)) !== turned);
  await page.keyboard.press("n");
  await page.waitForTimeout(300);
  const hash = await page.evaluate(() => location.hash);
  const was = await picture(page);
  check("the link names camera and engine", /camera=/.test(hash) && /engine=/.test(hash), hash);
  await page.close();
  const again = await open("case.html", { hash });
  check("a link shows the same picture again", (await picture(again.page)) === was);
  await again.page.close();
}

{
  const { page } = await open("motion.html", { hash: "#t=0.2" });
  const at = (await page.inputValue("#time")) * 1;
  check("the link sets the time", Math.abs(at - 0.2) < 1e-3, String(at));
  const before = await picture(page);
  await page.focus("#time");
  for (let i = 0; i < 60; ++i) await page.keyboard.press("ArrowRight");
  check("the slider moves the time", (await page.inputValue("#time")) > 0.21);
  check("the slider moves the bodies", (await picture(page)) !== before);
  await page.waitForTimeout(250);
  check("the time is in the link", /t=0\.2[23]/.test(await page.evaluate(() => location.hash)), await page.evaluate(() => location.hash));
  await page.close();
}

{
  const { page } = await open("report.html");
  const d = await data(page);
  check("the report has a row an answered question", (await page.$$("#engines tbody tr")).length > 0);
  check("the report counts its findings", (await page.textContent("#found")).includes(`of ${d.findings.length.toLocaleString("en-US")} kinds`));
  const most = Math.max(...d.findings.map((f) => f[d.columns.indexOf("count")]));
  check("the most frequent finding comes first", (await page.textContent("#findings tbody tr td:nth-child(7)")) === most.toLocaleString("en-US"));
  await page.click("#findings tbody tr");
  check("a finding opens with its replay", (await page.textContent("#detail")).includes("./touchstone replay "));
  await page.close();
}

{
  const { page } = await open("chart.html", { hash: "#question=distance" });
  const d = await data(page);
  const column = (name) => d.columns.indexOf(name);
  for (const r of d.rows) for (const name of d.text_columns) r[column(name)] = d.strings[r[column(name)]];
  const rows = d.rows.filter((r) => r[column("question")] === "distance" && ["regime", "pair", "scale"].every((k) => r[column(k)] === "") && r[column("answers")] > 0);
  const points = await page.evaluate(() => touchstonePlot.getOption().series.find((s) => s.id === "engines").data.map((p) => [p.name, ...p.value]));
  const same = rows.every((r) => {
    const p = points.find(([n]) => n === r[column("engine")]);
    return p && p[1] === r[column("ns_median")] && p[2] === Math.max(Number(r[column("error_p99")]), 1e-18);
  });
  check("the chart's points are the numbers of the JSON", same && points.length === rows.length && rows.length > 0, JSON.stringify(points));
  const drawn = await page.$$eval("#chart svg path", (p) => p.length);
  check("the chart is drawn", drawn > rows.length);
  const table = await page.$$eval("#rows tr[data-engine]", (r) => r.map((x) => x.dataset.engine));
  check("the table has the same engines", table.length === rows.length);
  await page.selectOption("#question", "overlap");
  await page.waitForTimeout(250);
  check("the choice is in the link", /question=overlap/.test(await page.evaluate(() => location.hash)));
  await page.close();
}

{
  const { page } = await open("stability.html");
  const d = await data(page);
  const question = await page.inputValue("#question");
  const failing = d.results.filter((r) => r.question === question);
  const cells = await page.$$eval("#rows tbody td:not(:first-child)", (t) => t.map((x) => x.textContent).filter(Boolean));
  check("the table has a rung a ladder and engine", cells.length === failing.length && failing.length > 0);
  check("who never fails has a dash", cells.filter((x) => x === "–").length === failing.filter((r) => r.fails_at === null).length);
  await page.close();
}

await browser.close();
console.log(failed ? `${failed} checks failed` : "all checks hold");
process.exit(failed ? 1 : 0);
