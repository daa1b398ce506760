#!/usr/bin/env node
// Pictures of the ten walks through the lab (tests/viewer/lab_walks.mjs), at three widths, light and dark, to be looked at:
//
//   tools/lab-walks.mjs PROGRAM [--folder runs/walks] [--only first,luck] [--widths 360,800] [--schemes dark] [--scale 1]
//
// Writes FOLDER/WALK-WIDTH-SCHEME-N-MOMENT.png: the whole page at each moment. Once before: viewer/install-packages.
// Example: tools/lab-walks.mjs build/release/src/cli/amble --only first --widths 360
import { mkdirSync } from "node:fs";
import { join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { fail, programAt, readArguments, someOf } from "./tool_input.mjs";

const text = { type: "string" };
const { values: options, positionals: [program] } = readArguments(
  { folder: { ...text, default: "runs/walks" }, only: text, widths: text, schemes: text, scale: { ...text, default: "1" } }, 1);
if (!program) fail("expected a PROGRAM (tools/lab-walks.mjs --help)");
if (!(Number(options.scale) > 0)) fail(`--scale ${options.scale}: expected a number above 0`);
const folder = resolve(options.folder);
Object.assign(process.env, { AMBLE_PROGRAM: programAt(program), AMBLE_PAGES: folder, AMBLE_SOURCE: fileURLToPath(new URL("..", import.meta.url)) });
const { launch } = await import("../tests/viewer/browser.mjs").catch((error) => fail(`${error.message.split("\n")[0]}: run viewer/install-packages`));
const { SCHEMES, WALKS, WIDTHS, makePages, take } = await import("../tests/viewer/lab_walks.mjs");

const only = someOf("--only", options.only, WALKS.map(({ id }) => id));
const widths = someOf("--widths", options.widths, WIDTHS).map(Number), schemes = someOf("--schemes", options.schemes, SCHEMES);
/** Diagrams are painted when they come into sight. */
const scrollThrough = (page) => page.evaluate(async () => {
  const was = scrollY;
  for (let y = 0; y < document.documentElement.scrollHeight; y += innerHeight / 2) {
    scrollTo(0, y);
    await new Promise((done) => setTimeout(done, 60));
  }
  scrollTo(0, was);
});

mkdirSync(folder, { recursive: true });
const pages = makePages(), browser = await launch();
for (const walk of WALKS.filter(({ id }) => only.includes(id)))
  for (const width of WIDTHS.filter((one) => widths.includes(one)))
    for (const scheme of SCHEMES.filter((one) => schemes.includes(one))) {
      let count = 0;
      const problems = await take(browser, pages, walk, [width, scheme], async (page, name) => {
        const path = join(folder, `${walk.id}-${width}-${scheme}-${++count}-${name.replaceAll(/\W+/g, "-")}.png`);
        await scrollThrough(page);
        await page.screenshot({ path, fullPage: true });
      }, { deviceScaleFactor: Number(options.scale) });
      console.log(`${walk.id}, ${width} px, ${scheme}: ${count} pictures${problems.map((problem) => `; ${problem}`).join("")}`);
    }
await browser.close();
