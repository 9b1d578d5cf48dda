// The page of causes in a real browser: node causes.mjs CHROMIUM DIR [SCREENSHOTS], where DIR holds causes.html (every kind of
// cause once), causes-many.html (60 causes) and causes-hostile.html (markup in every text).
import { statSync } from "node:fs";
import { join } from "node:path";
import { address, check, data, dir, end, open, shoot, wide } from "./browser.mjs";

for (const name of ["causes.html", "causes-many.html", "causes-hostile.html"])
  for (const size of [{ width: 1280, height: 800 }, { width: 390, height: 844, dark: true }]) {
    const { page, errors } = await open(name, size);
    check(`${name} at ${size.width} loads without an error`, errors.length === 0, errors.join("; "));
    check(`${name} at ${size.width} does not scroll sideways`, await wide(page));
    await page.$$eval("details", (list) => list.forEach((d) => (d.open = true)));
    await page.waitForTimeout(200);
    check(`${name} at ${size.width} does not scroll sideways with everything opened`, await wide(page));
    const back = await page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
    check(`${name} is ${size.dark ? "dark" : "light"}`, (back === "rgb(255, 255, 255)") !== Boolean(size.dark), back);
    await page.click("#theme");
    check(`${name} changes its light`, (await page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor)) !== back);
    await page.close();
    if (name !== "causes.html") continue;
    const { page: shown } = await open(name, { ...size, height: 4000, settle: 400 });
    await shoot(shown, `${name.replace(".html", "")}-${size.width}${size.dark ? "-dark" : ""}`, { fullPage: true });
    await shown.close();
  }

{
  const { page } = await open("causes.html");
  const { record } = await data(page);
  const blocks = await page.$$eval("article.cause", (list) => list.map((b) => [b.dataset.cause, b.innerText]));
  check("the page has a block a cause, in the order of the record", blocks.map(([id]) => id).join() === record.causes.map((c) => c.id).join());
  check("a block says what is wrong and how often", record.causes.every((c, i) => [c.title, c.severity, c.path, c.rate_text, c.expected].every((x) => blocks[i][1].includes(x))));
  check("a block has its response", record.causes.every((c, i) => c.response.filter((r) => r.response !== "not applicable").every((r) => blocks[i][1].includes(r.change))));
  const gone = await page.$$eval("tr[data-response=gone] li", (t) => t.map((x) => x.textContent));
  check("what makes a fault vanish is said apart", gone.join() === record.causes.flatMap((c) => c.response.filter((r) => r.response === "gone").map((r) => r.change)).join(), gone.join());
  check("a documented cause is marked", (await page.$$eval("article .badge", (b) => b.filter((x) => x.textContent.startsWith("documented")).length)) === record.causes.filter((c) => c.documented).length);
  check("the head has the unseen chance and the notes", await page.evaluate((r) => [r.unseen_text, ...r.notes].every((x) => document.querySelector("header").innerText.includes(x)), record));

  const i = record.causes.findIndex((c) => c.program);
  const block = `article[data-cause="${record.causes[i].id}"]`;
  for (const [summary, text] of [["Markdown", record.causes[i].markdown], ["program", record.causes[i].program]]) {
    await page.click(`${block} summary:text("${summary}")`);
    const there = ([b, t]) => [...document.querySelectorAll(`${b} pre`)].some((x) => x.textContent === t);
    check(`the ${summary} opens as it is`, await page.waitForFunction(there, [block, text], { timeout: 120_000 }).then(() => true, () => false));
  }
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await page.click(`${block} button:text("copy as Markdown")`);
  check("the Markdown is copied", (await page.evaluate(() => navigator.clipboard.readText())) === record.causes[i].markdown);
  check("the command is there to copy", (await page.textContent(`${block} .command code`)) === record.causes[i].command);
  await page.close();
}

// Colours of a picture: bodies, not an empty canvas.
const pictureOf = (page, at = 0) => page.$$eval(".drawing canvas", (list, i) => list[i].toDataURL(), at);
const kindsIn = (page) =>
  page.$$eval(".drawing canvas", (list) => list.map((c) => {
    const bytes = c.getContext("2d").getImageData(0, 0, c.width, c.height).data, seen = new Set();
    for (let k = 0; k < bytes.length; k += 4 * 97) seen.add(bytes.slice(k, k + 4).map((x) => x >> 3).join());
    return seen.size;
  }));

{
  const { page } = await open("causes.html", { height: 9000, settle: 400 });
  const { record } = await data(page);
  const kinds = await kindsIn(page);
  check("every cause has a picture", kinds.length === record.causes.length && kinds.every((n) => n > 3), kinds.join());
  const before = await pictureOf(page);
  await page.focus(".drawing canvas");
  await page.keyboard.press("ArrowRight");
  const turned = await pictureOf(page);
  check("the arrow key turns a picture", turned !== before);
  await page.setViewportSize({ width: 1280, height: 800 });
  await page.focus(`article[data-cause="${record.causes[2].id}"]`);
  await page.evaluate(() => document.activeElement.scrollIntoView());
  await shoot(page, "causes-block");
  await page.setViewportSize({ width: 1280, height: 9000 });
  await page.focus(".drawing canvas");
  const resized = await pictureOf(page);
  await page.keyboard.press("+");
  check("the plus key enlarges it", (await pictureOf(page)) !== resized);
  const moving = await page.$$eval("article.cause", (list) => list.filter((a) => a.querySelector("canvas")).findIndex((a) => a.querySelector("input[type=range]")));
  const still = await pictureOf(page, moving);
  await page.focus(".drawing input[type=range]");
  for (let k = 0; k < 16; ++k) await page.keyboard.press("ArrowRight");
  check("the slider moves the bodies of a motion", moving >= 0 && (await pictureOf(page, moving)) !== still && (await page.textContent(".drawing output")) === "t = 0.50");
  await page.close();
}

{
  const { page } = await open("causes-many.html");
  const { record } = await data(page);
  const made = (await page.$$(".drawing canvas")).length;
  check("pictures are made when they come into sight", made > 0 && made < record.causes.length / 2, String(made));
  const visible = () => page.$$eval("article.cause", (list) => list.filter((a) => a.offsetParent !== null).map((a) => a.dataset.cause));
  const { path, severity } = record.causes[1];
  await page.selectOption("#filter-path", path);
  check("a filter leaves the causes of its engine path", (await visible()).join() === record.causes.filter((c) => c.path === path).map((c) => c.id).join());
  await page.selectOption("#filter-severity", severity);
  const both = record.causes.filter((c) => c.path === path && c.severity === severity);
  check("two filters leave those of both", (await visible()).join() === both.map((c) => c.id).join() && both.length > 0);
  check("the page says how many", (await page.textContent("#found")) === `${both.length} of ${record.causes.length} causes`);
  await page.focus("#theme");
  await page.keyboard.press("n");
  await page.keyboard.press("n");
  const focused = () => page.evaluate(() => document.activeElement.dataset.cause);
  check("the key n goes to the next cause that is shown", (await focused()) === both[1].id, await focused());
  const hash = await address(page);
  await page.close();
  const again = await open("causes-many.html", { hash });
  check("the link has the filters and the cause", (await again.page.textContent("#found")).startsWith(`${both.length} of `) && (await again.page.evaluate(() => document.activeElement.dataset.cause)) === both[1].id, hash);
  await again.page.close();
  const bytes = statSync(join(dir, "causes-many.html")).size;
  console.log(`     causes-many.html: ${record.causes.length} causes, ${(bytes / 1e3).toFixed(0)} kB`);
  check("60 causes fit in 600 kB", record.causes.length === 60 && bytes < 600e3, String(bytes));
}

{
  const { page, errors } = await open("causes-hostile.html", { height: 9000, settle: 400 });
  await page.$$eval("details", (list) => list.forEach((d) => (d.open = true)));
  await page.waitForTimeout(200);
  check("hostile text is text", errors.length === 0 && (await page.$$("img, article script, iframe")).length === 0, errors.join("; "));
  const links = await page.$$eval("a[href]", (a) => a.map((x) => x.getAttribute("href")).filter((h) => !/^(#|data:text\/plain;)/.test(h)));
  check("its only links are the page's own", links.length === 0, links.join());
  await page.close();
}

await end();
