// Makes dist/page.html, dist/lab.html and dist/watch.html, the pages that amble fills with recordings, with robots, and serves: skeleton, style
// sheet, program and the licences of what is in it, in one file. amble packs the program when it fills a page (src/page). `--check` compares with
// what is there instead of writing.
//
// The result depends on the sources and on package-lock.json only: no time, no path, no host.
import { build, transform } from "esbuild";
import { createHash } from "node:crypto";
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

/** What a page's Content-Security-Policy names a script by, which may run as it stands here alone; src/unpack.js and src/page leave it as it is. */
const hashOf = (script) => `'sha256-${createHash("sha256").update(script).digest("base64")}'`;

/** A page: skeleton, style sheets, and a program that holds its worker's, if it has one, as a text. */
const PAGES = [
  { name: "page.html", skeleton: "src/page.html", styles: ["src/style.css"], program: "src/main.js", worker: ["AMBLE_EVOLVE_WORKER", "src/evolve_worker.js"] },
  { name: "lab.html", skeleton: "src/lab/lab.html", styles: ["src/style.css", "src/lab/lab.css"], program: "src/lab/main.js", worker: ["AMBLE_LAB_WORKER", "src/lab/worker.js"] },
  { name: "watch.html", skeleton: "src/watch/watch.html", styles: ["src/style.css", "src/lab/lab.css", "src/watch/watch.css"], program: "src/watch/main.js" },
];

async function make({ skeleton, styles, program, worker }) {
  const sheets = (await Promise.all(styles.map(read))).join("\n");
  const style = (await transform(sheets, { loader: "css", minify: true })).code.trim();
  const script = await bundle(program, worker && { [worker[0]]: JSON.stringify(await bundle(worker[1])) });
  const unpack = await bundle("src/unpack.js");
  for (const [what, text] of [["program", script], ["style sheet", style], ["unpacking", unpack]])
    if (/<\/(script|style)|<!--/i.test(text)) throw new Error(`the ${what} would end its element`);
  const licence = (await read("node_modules/three/LICENSE")).trim();
  const version = JSON.parse(await read("package.json")).dependencies.three;
  const parts = { style, script, unpack, hashes: [script, unpack].map(hashOf).join(" "), licence: `three.js ${version}, https://threejs.org\n\n${licence}` };
  return (await read(skeleton)).replace(/<!--viewer:(\w+)-->/g, (_, part) => parts[part]);
}

await mkdir(here + "dist", { recursive: true });
for (const page of PAGES) {
  const made = await make(page), file = `dist/${page.name}`;
  if (process.argv.includes("--check")) {
    const committed = await read(file).catch(() => "");
    if (made !== committed) {
      console.error(`viewer/${file} is not what its sources give: run \`npm ci && npm run build\` in viewer/`);
      process.exit(1);
    }
    console.log(`viewer/${file} is what its sources give`);
  } else {
    await writeFile(here + file, made);
    console.log(`${file}: ${(made.length / 1024).toFixed(0)} KiB`);
  }
}
