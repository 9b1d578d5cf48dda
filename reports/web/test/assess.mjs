// The page of `assess` in a real browser: node assess.mjs CHROMIUM DIR [SCREENSHOTS], where DIR holds assess.html (with wrong
// answers) and clean.html (without). Prints one line a check; exit code 1 when one fails.
import { address, check, data, end, open, shoot, wide } from "./browser.mjs";

const picture = (page) => page.evaluate(() => document.querySelector("#view canvas").toDataURL());

for (const name of ["assess.html", "clean.html"])
  for (const size of [{ width: 1400, height: 900 }, { width: 1400, height: 900, dark: true }, { width: 390, height: 844 }, { width: 390, height: 844, dark: true }]) {
    const { page, errors } = await open(name, { ...size, settle: 600 });
    const title = `${name} at ${size.width}${size.dark ? ", dark" : ""}`;
    check(`${title} loads without an error`, errors.length === 0, errors.join("; "));
    check(`${title} does not scroll sideways`, await wide(page));
    await shoot(page, `${name.replace(".html", "")}-${size.width}${size.dark ? "-dark" : ""}`, { fullPage: size.width < 500 });
    await page.close();
  }

const { page } = await open("assess.html", { settle: 600 });
const d = await data(page);
const rows = await page.$$eval("#engines tr[data-engine]", (r) => r.map((x) => [x.dataset.engine, ...[...x.children].slice(1).map((c) => c.textContent)]));
check("the table has every engine with its missed collisions", rows.length === d.assessment.engines.length && rows.length > 1 &&
  rows.every(([name, missed], i) => name === d.assessment.engines[i].engine && Number(missed) === d.assessment.engines[i].missed), JSON.stringify(rows));
check("the advice is on the page", (await page.evaluate(() => document.body.innerText)).includes(d.advice[0]));
check("every pair that an engine gets wrong is listed", (await page.$$("#pairs tr[data-pair]")).length === d.pairs.length && d.pairs.length > 1);
const before = await picture(page);
const last = d.pairs.length - 1;
await page.click(`#pairs tr[data-pair="${last}"] button`);
await page.waitForTimeout(200);
const p = d.pairs[last], body = (i) => d.scene.bodies[i].name;
check("a click shows the pair", (await page.textContent("#pair h2")) === `${body(p.a)} and ${body(p.b)}` && (await picture(page)) !== before);
check("and its configuration", (await page.textContent("#pair p")).startsWith(`Configuration ${p.configuration}.`));
const says = await page.$$eval("#pair tr[data-says]", (r) => r.map((x) => [x.dataset.says, x.children[1].textContent]));
const words = (s) => (s.outcome !== "answered" ? s.outcome.replaceAll("_", " ") : s.overlap === undefined ? "no verdict" : s.overlap ? "collide" : "apart");
check("what every engine says of the pair is shown", says.length === rows.length && says.every(([name, text]) => words(p.engines[name]) === text), JSON.stringify(says));
const some = d.pairs.flatMap((x) => x.of.map((o) => o.engine))[0];
await page.click(`#engines tr[data-engine="${some}"] button`);
check("an engine's pairs alone are listed", (await page.$$("#pairs tr[data-pair]")).length === d.pairs.filter((x) => x.of.some((o) => o.engine === some)).length);
const hash = await address(page);
check("the address keeps what is shown", hash.includes(`engine=${encodeURIComponent(some)}`) && hash.includes("pair="), hash);
await page.close();

await end();
