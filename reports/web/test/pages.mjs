// Pages in a real browser: node pages.mjs CHROMIUM DIR [SCREENSHOTS], where DIR holds case.html (two bodies that touch or overlap),
// motion.html, report.html, chart.html, stability.html, many.html: a report of 1e5 kinds of
// findings, separate.html, touching.html, curved.html, mesh.html, script.html, crowd.html: cases of these kinds, certified.html, refuted.html: certificates of broad phases,
// index.html: the index of all these,
// plan.html: a plan that sweeps a body, broad.html, broad.json: a script's broad phases as a page and as `--json`. Prints one line a check; exit code 1 when one fails.
import { readFileSync, statSync } from "node:fs";
import { join } from "node:path";
import { address, barriers, check, data, dir, end, open, shoot, wide } from "./browser.mjs";

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

for (const name of ["case.html", "crowd.html", "motion.html", "report.html", "many.html", "chart.html", "stability.html", "certified.html", "refuted.html", "broad.html", "index.html", "plan.html"]) {
  check(`${name} is smaller than 5 MB`, statSync(join(dir, name)).size < 5e6);
  for (const size of [{ width: 1280, height: 720 }, { width: 390, height: 844, dark: true }]) {
    const { page, errors } = await open(name, size);
    check(`${name} at ${size.width} loads without an error`, errors.length === 0, errors.join("; "));
    check(`${name} at ${size.width} does not scroll sideways`, await wide(page));
    const found = await barriers(page);
    check(`${name} at ${size.width} has no barrier that axe-core finds`, found === "", found);
    const back = await page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
    check(`${name} is ${size.dark ? "dark" : "light"}`, (back === "rgb(255, 255, 255)") !== Boolean(size.dark), back);
    await shoot(page, `${name.replace(".html", "")}-${size.width}${size.dark ? "-dark" : ""}`, { fullPage: size.width < 500 });
    await page.click("#theme");
    const other = await page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
    check(`${name} changes its light`, other !== back);
    if (!size.dark) {
      await page.emulateMedia({ media: "print" });
      const paper = await page.evaluate(() => [getComputedStyle(document.documentElement).backgroundColor, getComputedStyle(document.querySelector("#theme").parentElement).display]);
      check(`${name} prints on white, without buttons`, paper.join() === "rgb(255, 255, 255),none", paper.join());
      // Charts are drawn again for paper a moment later.
      const paleLetters = () => [...document.querySelectorAll("svg text")].map((x) => getComputedStyle(x).fill.match(/\d+/g)?.map(Number) ?? [0]).filter((c) => c.length === 3 && Math.min(...c) > 200).length;
      await page.waitForFunction(`(${paleLetters})() === 0`, null, { timeout: 120_000 }).catch(() => {});
      const pale = await page.evaluate(paleLetters);
      check(`${name} prints no pale letters`, pale === 0, String(pale));
      await shoot(page, `${name.replace(".html", "")}-print`);
    }
    await page.close();
  }
}

{
  for (const dark of [false, true]) {
    const { page } = await open("broad.html", { dark });
    const d = await data(page), full = JSON.parse(readFileSync(join(dir, "broad.json"), "utf8"));
    const near = (x, y) => x === y || Math.abs(x - y) <= d.step;
    check("broad.html has the pairs of the JSON", full.frames.every((f, i) => JSON.stringify([f.kept, f.looks.map((l) => l.pruned)]) === JSON.stringify([d.frames[i].kept, d.frames[i].looks.map((l) => l.pruned)])));
    check("broad.html has the boxes of the JSON", full.frames.every((f, i) => f.boxes.every((b, k) => (b === null ? d.frames[i].boxes[k] === null : b.flat().every((x, m) => near(x, d.frames[i].boxes[k].flat()[m]))))));
    const drawn = () => page.evaluate(() => document.querySelector("#plan").toDataURL());
    const first = await drawn();
    await page.$eval("#frame", (e) => { e.value = e.max; e.dispatchEvent(new Event("input")); });
    check("broad.html's slider moves the boxes", full.frames.length > 1 && (await drawn()) !== first);
    await page.close();
  }
}

{
  const { page } = await open("plan.html");
  const { plan } = await data(page);
  const choices = await page.$$eval("tr[data-choice]", (r) => r.map((x) => [x.dataset.choice, x.className === "chosen", x.lastChild.textContent]));
  check("the plan stands beside the fixed choices", choices.length === plan.rows.length && plan.rows.every((r, i) => choices[i][0] === r.name && choices[i][1] === r.plan && choices[i][2].startsWith("unsound") === (r.outside + r.unanswered + r.unswept > 0)), JSON.stringify(choices));
  const bodies = () => page.$$eval("tr[data-body]", (r) => r.map((x) => Number(x.dataset.body)));
  check("the bodies to be swept are listed", plan.swept.length > 0 && (await bodies()).join() === plan.swept.map((s) => s.body).join());
  await page.fill("#filter", "no such body");
  check("and can be filtered", (await bodies()).length === 0 && (await address(page)).includes("body=no+such+body"));
  const terms = await page.$$eval("main li", (all) => all.map((x) => x.textContent));
  check("the plan is put in the terms of other libraries", plan.terms.length >= 2 && plan.terms.flatMap((t) => t.lines).join() === terms.join());
  await page.close();
}

{
  const { page } = await open("index.html");
  const d = await data(page);
  const rows = await page.$$("ul.results > li");
  check("the index has a line for each result", rows.length === d.results.length + d.unreadable.length && rows.length >= 10, String(rows.length));
  const links = await page.$$eval("ul.results a", (all) => all.map((a) => a.href));
  check("the links of the index lead to files", links.length >= d.results.length && links.every((x) => statSync(new URL(x)).isFile()));
  const said = await page.$$eval("li[data-mood=bad] .verdict", (all) => all.map((x) => x.textContent));
  check("the index says what is wrong", said.length > 0 && said.every((x) => x.startsWith("✗")), said.join("; "));
  await page.close();
}

{
  const { page } = await open("case.html");
  const d = await data(page);
  const claim = await page.textContent("#claim");
  const name = claim.match(/(\S+) says:/)?.[1];
  check("a case opens on a wrong answer, beside the truth", claim.startsWith("Truth:") && claim.includes("WRONG") && d.queries.some((x) => x.engines[name]?.faults.length > 0), claim);
  await page.close();
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
  check("the command replays", /^\S*touchstone replay /.test(await page.textContent(".command code")));
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
  const hash = await address(page);
  const was = await picture(page);
  check("the link names camera and engine", /camera=/.test(hash) && /engine=/.test(hash), hash);
  await page.close();
  const again = await open("case.html", { hash });
  check("a link shows the same picture again", (await picture(again.page)) === was);
  await again.page.close();
}

{
  const { page } = await open("case.html");
  const d = await data(page);
  const shown = await page.$$eval("tr[data-stages]", (r) => r.map((x) => [x.dataset.stages, [...x.children].slice(2).map((c) => c.textContent === "✗")]));
  const traced = Object.entries(d.engines).filter(([, e]) => e.stages);
  check("the stages of each wrong engine are those of the JSON", shown.length > 0 && shown.length === traced.length &&
    shown.every(([n, marks]) => JSON.stringify(marks) === JSON.stringify(d.engines[n].stages[0].stages.map((s) => s.faults.length > 0))), JSON.stringify(shown));
  const programs = Object.values(d.engines).flatMap((e) => e.programs ?? []);
  if (programs.length > 0) {
    const text = await page.textContent("#program pre");
    check("the stand-alone test is there as it is", programs.some((p) => p.program === text) && text.includes("int main"));
  }
  const all = await picture(page);
  await page.uncheck("#part-normals");
  const fewer = await picture(page);
  check("normals can be left out", fewer !== all);
  await page.keyboard.press("5");
  check("the certificate can be left out by its key", (await picture(page)) !== fewer && (await page.evaluate(() => document.body.dataset.drawn)) === "");
  const hash = await address(page);
  const left = await picture(page);
  await page.close();
  const again = await open("case.html", { hash });
  check("the link has what is left out", (await picture(again.page)) === left, hash);
  await again.page.close();
}

// A case of each kind: what of the referee's evidence is drawn, and what it says that it did.
for (const [name, question, drawn, words] of [
  ["separate.html", "distance", ["plane", "segment"], /a plane between A and B/],
  ["touching.html", "contact", ["point"], /a point in both/],
  ["curved.html", "contact", ["point", "polytope", "direction"], /a polytope of \d+ exact points of A − B, \d+ facets/],
  ["mesh.html", "contact", ["point"], /depth: not defined/],
  ["motion.html", "time_of_impact", ["point"], /moving planes, checked until t = /],
  ["script.html", "candidates", [], /every pair of bodies/],
]) {
  const first = await open(name);
  const q = (await data(first.page)).queries.findIndex((x) => x.question === question);
  await first.page.close();
  const { page, errors } = await open(name, { hash: `#q=${q}` });
  const kinds = await page.evaluate(() => document.body.dataset.drawn.split(" "));
  check(`${name} draws ${drawn.join(", ") || "no certificate"}`, drawn.every((k) => kinds.includes(k)) && (name !== "mesh.html" || !kinds.includes("direction")), kinds.join());
  const said = (await page.textContent("#referee-trace ul")) ?? "";
  check(`${name} says how the referee knows`, words.test(said), said);
  const c = await colours(page);
  await shoot(page, `${name.replace(".html", "")}-${question}`);
  check(`${name} draws bodies`, errors.length === 0 && c.kinds > 5 && c.share > 0.01, JSON.stringify(c) + errors.join());
  await page.close();
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
  const hash = await address(page);
  check("the time is in the link", /t=0\.2[23]/.test(hash), hash);
  await page.close();
}

{
  const { page } = await open("report.html");
  const d = await data(page);
  check("the report begins with its causes", d.causes.list.length > 0 && (await page.$$eval("main > *", (all) => all[0].id)) === "causes" &&
    (await page.$$(".cause-table tbody tr")).length === d.causes.list.length);
  await page.click(".cause-table tbody tr button");
  check("a cause has its command", (await page.textContent("#cause-command")).includes(`--cause ${d.causes.list[0].id}`));
  check("the report has a row an answered question", (await page.$$("#engines tbody tr")).length > 0);
  const f = d.findings;
  check("the report counts its findings", (await page.textContent("#found")).includes(`of ${f.count.toLocaleString("en-US")} kinds`) && f.count === f.answers.length && f.count > 0);
  await page.selectOption("#group", { label: "not grouped" });
  check("the most frequent finding comes first", (await page.textContent("#findings tbody tr td.answers")) === Math.max(...f.answers).toLocaleString("en-US"));
  await page.click("#findings tbody tr");
  await shoot(page, "report-finding");
  check("a finding opens with its replay", (await page.textContent("#detail")).includes("./touchstone replay "));
  await page.selectOption("#group", { label: "by engine" });
  const engine = f.coded.engine.values.find((e) => f.coded.engine.codes.some((c) => f.coded.engine.values[c] === e));
  await page.selectOption("#filter-engine", engine).catch(() => undefined);
  const kinds = f.coded.engine.codes.filter((c) => f.coded.engine.values[c] === engine).length;
  check("a filter leaves its own", (await page.textContent("#found")).startsWith(`${kinds.toLocaleString("en-US")} of `), await page.textContent("#found"));
  await page.close();
}

{
  const before = Date.now();
  const { page, errors } = await open("many.html", { settle: 0 });
  await page.evaluate(() => new Promise((r) => requestAnimationFrame(() => requestAnimationFrame(r))));
  const opened = Date.now() - before;
  const { findings: f } = await data(page);
  console.log(`     many.html: ${f.count} findings, ${(statSync(join(dir, "many.html")).size / 1e6).toFixed(2)} MB, drawn after ${opened} ms`);
  check("many findings load without an error", errors.length === 0 && f.count === 100000, errors.join("; "));
  const rows = () => page.$$eval("#findings tbody tr:not(.gap)", (r) => r.length);
  await page.selectOption("#group", { label: "not grouped" });
  check("only the lines in sight are in the document", (await rows()) > 5 && (await rows()) < 120, String(await rows()));
  await page.focus("#findings");
  await page.keyboard.press("End");
  // Where it is not reached, the check says so.
  await page.waitForFunction((count) => Number([...document.querySelectorAll("#findings tbody tr:not(.gap)")].at(-1)?.getAttribute("aria-rowindex")) === count, f.count).catch(() => {});
  const last = await page.$$eval("#findings tbody tr:not(.gap)", (r) => Number(r.at(-1).getAttribute("aria-rowindex")));
  check("the End key reaches the last of them", last === f.count, String(last));
  await page.keyboard.press("Enter");
  const fewest = Math.min(...f.answers);
  check("it is the least frequent", (await page.textContent("#findings tr.chosen td.answers")) === String(fewest));
  // What the page says of a finding is what was packed: 100 of them, words and all.
  const wrong = await page.evaluate(async () => {
    const packed = globalThis.touchstoneData.findings;
    const numbers = packed.words.numbers.split(" ");
    let next = 0, bad = 0;
    packed.words.codes.forEach((c, i) => {
      const t = packed.words.templates[c], n = t.split("\u0001").length - 1;
      if (i % 1000 === 0) bad += globalThis.touchstoneFindings.words(i) !== t.replaceAll("\u0001", () => numbers[next++]);
      else next += n;
    });
    return bad + (next !== numbers.length);
  });
  check("a finding has its own words", wrong === 0, String(wrong));
  await page.focus("#filter-shapes");
  check("a filter of many values has them once it is wanted", (await page.$$eval("#filter-shapes option", (o) => o.length)) === f.coded.shapes.values.length + 1);
  await page.close();
  const shapes = f.coded.shapes.values.at(-1);
  const linked = await open("many.html", { hash: `#shapes=${encodeURIComponent(shapes)}` });
  const own = f.coded.shapes.codes.filter((c) => c === f.coded.shapes.values.length - 1).length;
  check("a link filters by one of them", (await linked.page.textContent("#found")).startsWith(`${own} of `), await linked.page.textContent("#found"));
  await linked.page.close();
}

{
  const { page } = await open("chart.html", { hash: "#question=distance" });
  const saved = async (kind) => {
    const [file] = await Promise.all([page.waitForEvent("download"), page.click(`#save-${kind}`)]);
    return { name: file.suggestedFilename(), bytes: readFileSync(await file.path()) };
  };
  const svg = await saved("svg"), svgText = svg.bytes.toString();
  check("chart.html saves the plot as SVG, with its caption", svg.name === "touchstone-distance.svg" && svgText.startsWith("<svg") && svgText.includes("distance: speed against accuracy") && (svgText.match(/<path/g) ?? []).length > 5, svg.name);
  const png = await saved("png");
  check("chart.html saves the plot as PNG, at twice its size", png.name === "touchstone-distance.png" && png.bytes.readUInt32BE(16) === 2 * (await page.evaluate(() => document.getElementById("chart").clientWidth)), String(png.bytes.readUInt32BE(16)));
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
  const hash = await address(page);
  check("the choice is in the link", /question=overlap/.test(hash), hash);
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

for (const name of ["certified.html", "refuted.html"]) {
  const { page } = await open(name);
  const { certificate: c } = await data(page);
  const numbers = (text) => Number(text.replaceAll(",", ""));
  const rows = await page.$$eval("tr[data-evidence]", (r) => r.map((x) => [x.dataset.evidence, ...[3, 9, 10].map((i) => x.children[i - 1].textContent)]));
  const same = rows.every(([n, cases, truth, reported], i) => {
    const e = c.evidence[i];
    return e.name === n && e.cases === numbers(cases) && e.pairs_true === numbers(truth) && e.pairs_reported === numbers(reported);
  });
  check(`${name} has the evidence of the certificate`, same && rows.length === c.evidence.length && rows.length > 0, JSON.stringify(rows[0]));
  const verdicts = await page.$$eval(".tile b", (t) => t.map((x) => x.textContent.slice(2)));
  check(`${name} says so first`, verdicts.join() === Object.values(c.verdict).filter((v) => v !== "not_asked").join(), verdicts.join());
  check(`${name} says what is not proved`, (await page.$$("#not-proved li")).length === c.not_proved.length);
  const scripts = await page.$$eval(".refutation a[download]", (a) => a.map((x) => JSON.parse(decodeURIComponent(x.href.replace("data:application/json,", "")))));
  const faults = await page.$$eval("tr[data-fault]", (t) => t.map((x) => x.dataset.fault));
  check(`${name} lists every fault`, faults.join() === c.faults.map((f) => `${f.fault}/${f.kind}/${f.evidence}`).join() && (faults.length > 0) === name.startsWith("refuted"));
  check(`${name} offers no program where there is no writer`, !(await page.evaluate(() => document.body.innerText)).includes("touchstone reproduce"));
  check(`${name} hands out what refutes it`, JSON.stringify(scripts) === JSON.stringify(c.refutations.map((r) => r.script)) && (scripts.length > 0) === name.startsWith("refuted"));
  await page.close();
}

await end();
