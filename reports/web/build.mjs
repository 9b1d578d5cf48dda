// Builds one self-contained HTML file per page kind, in dist/ or the directory given: page.html with the page's script
// and styles in it. The placeholder __TOUCHSTONE_DATA__ remains; the program replaces it with the JSON.
import { mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "vite";

const here = dirname(fileURLToPath(import.meta.url));
const out = resolve(process.argv[2] ?? join(here, "dist"));
const skeleton = readFileSync(join(here, "page.html"), "utf8");
const pages = readdirSync(join(here, "src")).filter((name) => name !== "common").sort();
const placeholder = "__TOUCHSTONE_DATA__";

mkdirSync(out, { recursive: true });
for (const page of pages) {
  const { output } = (
    await build({
      root: here,
      configFile: false,
      logLevel: "warn",
      build: {
        write: false,
        target: "es2022",
        chunkSizeWarningLimit: 4000,
        lib: { entry: join(here, "src", page, "main.ts"), formats: ["iife"], name: "page" },
      },
      define: { "process.env.NODE_ENV": JSON.stringify("production") },
    })
  )[0];
  const script = output.find((o) => o.type === "chunk").code.replaceAll("</script", "<\\/script");
  const style = output.filter((o) => o.type === "asset" && o.fileName.endsWith(".css")).map((o) => o.source).join("\n");
  // Replacement functions, because String.replace interprets "$&" in a replacement string.
  const html = skeleton.replace("/*style*/", () => style).replace("/*script*/", () => script);
  if (html.split(placeholder).length !== 2) throw new Error(`${page}: the placeholder must occur exactly once`);
  writeFileSync(join(out, `${page}.html`), html);
  console.log(`${page}.html ${(html.length / 1e3).toFixed(0)} kB`);
}
