// Makes dist/page.html, the page that amble fills with recordings: skeleton, style sheet, program and the
// licences of what is in it, in one file. `--check` compares with what is there instead of writing.
//
// The result depends on the sources and on package-lock.json only: no time, no path, no host.
import { build, transform } from "esbuild";
import { readFile, writeFile, mkdir } from "node:fs/promises";
import { fileURLToPath } from "node:url";

const here = fileURLToPath(new URL(".", import.meta.url));
const read = (name) => readFile(here + name, "utf8");

/** One script of a source and all that it needs. */
async function bundle(source, define = {}) {
  const { outputFiles } = await build({
    absWorkingDir: here,
    entryPoints: [source],
    define,
    bundle: true,
    minify: true,
    write: false,
    format: "iife",
    target: "es2022",
    charset: "ascii",
    legalComments: "none", // the whole licence stands at the top of the page
  });
  return outputFiles[0].text.trim();
}

/** The page's, which holds that of its worker as a text. */
async function program() {
  return bundle("src/main.js", { AMBLE_EVOLVE_WORKER: JSON.stringify(await bundle("src/evolve_worker.js")) });
}

async function page() {
  const style = (await transform(await read("src/style.css"), { loader: "css", minify: true })).code.trim();
  const script = await program();
  for (const [what, text] of [["program", script], ["style sheet", style]])
    if (/<\/(script|style)|<!--/i.test(text)) throw new Error(`the ${what} would end its element`);
  const licence = (await read("node_modules/three/LICENSE")).trim();
  const version = JSON.parse(await read("package.json")).dependencies.three;
  const parts = { style, script, licence: `three.js ${version}, https://threejs.org\n\n${licence}` };
  return (await read("src/page.html")).replace(/<!--viewer:(\w+)-->/g, (_, name) => parts[name]);
}

const made = await page();
if (process.argv.includes("--check")) {
  const committed = await read("dist/page.html").catch(() => "");
  if (made !== committed) {
    console.error("viewer/dist/page.html is not what its sources give: run `npm ci && npm run build` in viewer/");
    process.exit(1);
  }
  console.log("viewer/dist/page.html is what its sources give");
} else {
  await mkdir(here + "dist", { recursive: true });
  await writeFile(here + "dist/page.html", made);
  console.log(`dist/page.html: ${(made.length / 1024).toFixed(0)} KiB`);
}
