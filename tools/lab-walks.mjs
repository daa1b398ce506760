#!/usr/bin/env node
// Pictures of the ten walks through the lab (tests/viewer/lab_walks.mjs), at three widths, light and dark, to be looked at:
//
//   tools/lab-walks.mjs PROGRAM [--folder runs/walks] [--only first,luck] [--widths 360,800] [--schemes dark] [--scale 1]
//
// Writes FOLDER/WALK-WIDTH-SCHEME-N-MOMENT.png: the whole page at each moment. Once before: viewer/install-packages.
import { mkdirSync } from "node:fs";
import { join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";

const text = { type: "string" };
const { values: options, positionals: [program] } = parseArgs({
  allowPositionals: true,
  options: { folder: { ...text, default: "runs/walks" }, only: text, widths: text, schemes: text, scale: { ...text, default: "1" } },
});
if (!program) {
  console.error("tools/lab-walks.mjs PROGRAM [--folder DIR] [--only ID,…] [--widths PX,…] [--schemes light,dark] [--scale 1]");
  process.exit(2);
}
const folder = resolve(options.folder);
mkdirSync(folder, { recursive: true });
Object.assign(process.env, { AMBLE_PROGRAM: resolve(program), AMBLE_PAGES: folder, AMBLE_SOURCE: fileURLToPath(new URL("..", import.meta.url)) });
const { launch } = await import("../tests/viewer/browser.mjs");
const { SCHEMES, WALKS, WIDTHS, makePages, take } = await import("../tests/viewer/lab_walks.mjs");

const chosen = (words, all) => (words ? all.filter((one) => words.split(",").includes(String(one.id ?? one))) : all);
/** Diagrams are painted when they come into sight. */
const scrollThrough = (page) => page.evaluate(async () => {
  const was = scrollY;
  for (let y = 0; y < document.documentElement.scrollHeight; y += innerHeight / 2) {
    scrollTo(0, y);
    await new Promise((done) => setTimeout(done, 60));
  }
  scrollTo(0, was);
});

const pages = makePages(), browser = await launch();
for (const walk of chosen(options.only, WALKS))
  for (const width of chosen(options.widths, WIDTHS))
    for (const scheme of chosen(options.schemes, SCHEMES)) {
      let count = 0;
      const problems = await take(browser, pages, walk, [width, scheme], async (page, name) => {
        const path = join(folder, `${walk.id}-${width}-${scheme}-${++count}-${name.replaceAll(/\W+/g, "-")}.png`);
        await scrollThrough(page);
        await page.screenshot({ path, fullPage: true });
      }, { deviceScaleFactor: Number(options.scale) });
      console.log(`${walk.id}, ${width} px, ${scheme}: ${count} pictures${problems.map((problem) => `; ${problem}`).join("")}`);
    }
await browser.close();
