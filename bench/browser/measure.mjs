// node --experimental-wasm-relaxed-simd measure.mjs NATIVE_BUILD MODULES [--quick] [--live] [--seeds N] [CHAMPION…]: the tables of docs/BROWSER.md (tools/measure-browser).
import { execFileSync } from "node:child_process";
import { copyFileSync, existsSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { availableParallelism, cpus, tmpdir } from "node:os";
import { basename, dirname, join, resolve } from "node:path";
import { parseArgs } from "node:util";
import { gzipSync } from "node:zlib";
import { Browser, findBrowser } from "../../tests/browser/harness.mjs";
import { stepsIn } from "./in_page.mjs";

const { values: options, positionals: [build, modules, ...named] } = parseArgs({
  allowPositionals: true, options: { quick: { type: "boolean", default: false }, live: { type: "boolean", default: false }, seeds: { type: "string" } },
});
const paths = named.length ? named : ["servo", "octopod"].map((name) => `robots/${name}/champion.json`);
const COUNT = options.quick ? 100 : 1000, LONG_S = options.quick ? 30 : 300, LIVE_S = options.quick ? 3 : 20, METRES = options.quick ? 1 : 3, GENERATIONS = options.quick ? 10 : 300;
const SEEDS = Array.from({ length: Number(options.seeds ?? (options.quick ? 1 : 3)) }, (_, i) => i + 1);
const MODULES = { exact: "exact, without relaxed SIMD", relaxed: "relaxed SIMD, the same bits", rounding: "products rounded: other bits" };
const program = resolve(build, "src/cli/amble");

const line = (...cells) => console.log(`| ${cells.join(" | ")} |`);
const head = (...cells) => (console.log(), line(...cells), line(...cells.map(() => "---")));
const say = (text) => console.error(`# ${text}`);
const one = (value) => value.toFixed(1), percent = (share) => `${(100 * share).toFixed(0)} %`;
const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
const nameOf = (agent) => ({ Firefox: "Firefox", Chrome: "Chromium" })[/(Firefox|Chrome)\/\d+/.exec(agent)[1]] + " " + /(?:Firefox|Chrome)\/(\d+)/.exec(agent)[1];

const folder = mkdtempSync(join(tmpdir(), "amble-measure-"));
const champions = paths.map((path) => readFileSync(path, "utf8"));
const robots = paths.map((path) => basename(dirname(path)));

/** A row for a module somewhere. */
function stepsRow(where, name, told) {
  if (!told) return line(where, MODULES[name], ...robots.flatMap(() => ["not taken", ""]));
  line(where, MODULES[name] + (told.exact || name === "rounding" ? "" : " (OTHER BITS)"), ...told.us.flat().map(one));
}

async function stepsEverywhere(browsers) {
  head("µs per robot-step", "module", ...robots.flatMap((robot) => [`${robot}, 1 robot`, "16 robots"]));
  say("natively");
  const told = execFileSync(join(build, "bench/lane_steps"), paths, { encoding: "utf8" });
  line("native", "always sixteen at once", ...[...told.matchAll(/1 robot ([\d.]+), 16 robots ([\d.]+)/g)].flatMap(([, a, b]) => [one(Number(a)), one(Number(b))]));
  for (const name of Object.keys(MODULES)) {
    const file = `measure-${name}.wasm`, bytes = readFileSync(join(modules, file));
    copyFileSync(join(modules, file), join(folder, file));
    say(`Node.js, ${name}`);
    stepsRow(`Node.js ${process.versions.node.split(".")[0]}`, name, WebAssembly.validate(bytes) ? await stepsIn(await WebAssembly.compile(bytes), champions, COUNT) : null);
    for (const { browser, called } of browsers) {
      say(`${called}, ${name}`);
      stepsRow(called, name, await browser.run("steps", { name: file, champions, count: COUNT }));
    }
  }
}

/** A row: what, and what each browser gives. */
async function pageRow(browsers, what, of) {
  const cells = [];
  for (const one_ of browsers) {
    say(`${one_.called}: ${what}`);
    cells.push(await of(one_));
  }
  line(what, ...cells);
}

async function livePages(browsers) {
  for (const [i, path] of paths.entries()) {
    const page = join(folder, `${robots[i]}.html`);
    execFileSync(program, ["view", path, "--undisturbed", "-o", page]);
    await pageRow(browsers, `${robots[i]}, live: pictures/s; of a core, the page's script; its thread; all of the browser`, async ({ browser }) => {
      const told = await browser.run("live", { url: `/pages/${robots[i]}.html#live`, seconds: LIVE_S });
      const { page_s, all_s } = used(...browser.clock.splice(0));
      return `${one(told.frames_s)}; ${percent(told.busy_share)}; ${percent(page_s / LIVE_S)}; ${percent(all_s / LIVE_S)}`;
    });
  }
}

/** Waits that a reader would feel: a slider over five minutes, and seconds simulated at once. */
async function waits(browsers) {
  const record = join(folder, "long.rec"), page = join(folder, "long.html");
  execFileSync(program, ["trial", paths[0], "--undisturbed", "--seconds", String(LONG_S), "--record", record]);
  execFileSync(program, ["view", record, "-o", page]);
  await pageRow(browsers, `${robots[0]}, a page of ${LONG_S} s (${(statSync(page).size / 1e6).toFixed(2)} MB) under its slider: ms of script a frame (median; 95 %; worst)`, async ({ browser }) => {
    const { frames_ms } = await browser.run("scrub", { url: "/pages/long.html", inputs: 60 });
    frames_ms.sort((a, b) => a - b);
    return [0.5, 0.95, 1].map((share) => one(frames_ms[Math.floor(share * (frames_ms.length - 1))])).join("; ");
  });
  for (const robot of robots)
    await pageRow(browsers, `${robot}, 10 s simulated at once, diagrams and all: ms`, async ({ browser }) =>
      (await browser.run("ahead", { url: `/pages/${robot}.html#live`, seconds: 10 })).took_ms.toFixed(0));
}

/** What the browser takes around any page whose picture changes. */
async function blankPage(browsers) {
  writeFileSync(join(folder, "blank.html"), `<!DOCTYPE html><html lang="en"><head><title>blank</title></head><body><p id="trouble" hidden></p><canvas width="668" height="476"></canvas><script>
    const paint = document.querySelector("canvas").getContext("webgl2"), amble = { pictures: 0 };
    const draw = () => {
      paint.clearColor((++amble.pictures % 100) / 100, 0, 0, 1);
      paint.clear(paint.COLOR_BUFFER_BIT);
      requestAnimationFrame(draw);
    };
    window.amble = amble;
    draw();
  </script></body></html>`);
  await pageRow(browsers, "a page that only clears a WebGL canvas: pictures/s; of a core, its thread; all of the browser", async ({ browser }) => {
    const told = await browser.run("blank", { url: "/pages/blank.html", seconds: LIVE_S });
    const { page_s, all_s } = used(...browser.clock.splice(0));
    return told.frames_s ? `${one(told.frames_s)}; ${percent(page_s / LIVE_S)}; ${percent(all_s / LIVE_S)}` : "no WebGL";
  });
}

/** Between two readings of the threads: the page's own (its script, style, layout, paint), and all but those that stand for a graphics card. */
function used(before, after) {
  const earlier = new Map(before.map(({ id, used_s }) => [id, used_s]));
  const threads = after.map((thread) => ({ ...thread, used_s: thread.used_s - (earlier.get(thread.id) ?? 0) }));
  return { page_s: Math.max(...threads.filter(({ main, content }) => main && content).map(({ used_s }) => used_s)),
           all_s: threads.filter(({ name }) => name !== "skip_drawing").reduce((sum, { used_s }) => sum + used_s, 0) };
}

/** Chromium with a graphics device that does not draw, if that was compiled and Chromium has SwiftShader. */
async function openWithDevice() {
  const driver = resolve(build, "bench/libskip_drawing.so"), swiftshader = "/usr/lib/chromium/libvk_swiftshader.so", path = join(folder, "driver.json");
  if (![driver, swiftshader].every(existsSync) || !findBrowser("chromium")) return say("no graphics device that does not draw (./setup --wasm)");
  writeFileSync(path, JSON.stringify({ file_format_version: "1.0.0", ICD: { library_path: driver, api_version: "1.3.0" } }));
  return open("chromium", ", a card drawing", { VK_ICD_FILENAMES: path, VK_DRIVER_FILES: path, AMBLE_SWIFTSHADER: swiftshader });
}

async function labRuns(browsers) {
  execFileSync(program, ["lab", "-o", join(folder, "lab.html")]);
  for (const threads of [...new Set([1, Math.min(availableParallelism(), 4)])])
    for (const seed of SEEDS)
      await pageRow(browsers, `lab, its first settings (hexapod), ${threads} worker${threads > 1 ? "s" : ""}, seed ${seed}: thousand robot-steps/s for each worker; s to a walker of ${METRES} m`, async (it) => {
        const told = await it.browser.run("lab", { url: `/pages/lab.html#threads=${threads}`, seed, metres: METRES, generations: GENERATIONS });
        if (told.robot !== "hexapod") throw new Error(`the lab's first robot is ${told.robot}`);
        const rate = told.steps / told.seconds / threads, reached = told.best_m >= METRES;
        if (reached) it.runs.push({ steps: told.steps, rate });
        return `${one(rate / 1000)}; ${reached ? one(told.seconds) : `none (best ${one(told.best_m)} m) in ${one(told.seconds)}`}`;
      });
  await pageRow(browsers, `the same on four processors, by the median of steps (${SEEDS.length} seeds) and of steps/s, s`, ({ runs }) =>
    runs.length ? one(median(runs.map(({ steps }) => steps)) / median(runs.map(({ rate }) => rate)) / 4) : "–");
}

function sizes(browsers) {
  const watch = readFileSync("viewer/dist/watch.html"), wasm = readFileSync("viewer/dist/amble.wasm");
  const files = [...robots.map((robot) => [`a walk of ${robot} with what drives it live`, join(folder, `${robot}.html`)]), ["the lab", join(folder, "lab.html")]];
  const mb = (bytes) => `${(bytes / 1e6).toFixed(2)} MB`;
  for (const [what, path] of files) line(`size of the page: ${what}`, mb(statSync(path).size), ...browsers.slice(1).map(() => ""));
  line("size of the page: runs that go on, served; its module; the module packed, as pages carry it", `${mb(watch.length)}; ${mb(wasm.length)}; ${mb((gzipSync(wasm, { level: 9 }).length * 4) / 3)}`, ...browsers.slice(1).map(() => ""));
}

async function open(kind, with_ = "", device = null) {
  const browser = await Browser.open(kind, { jobs: "bench/browser/in_page.mjs", pages: folder, longest_s: 900, device });
  browsers.push({ browser, runs: [], called: nameOf(await browser.run("who")) + with_ });
}

const browsers = [];
try {
  for (const kind of ["chromium", "firefox"])
    if (findBrowser(kind)) await open(kind);
    else say(`${kind} is not installed`);
  if (options.live) await openWithDevice();
  console.log(`${cpus()[0].model}, ${availableParallelism()} processors; ${new Date().toISOString().slice(0, 10)}${options.quick ? "; --quick: no figures to keep" : ""}`);
  if (!options.live) await stepsEverywhere(browsers);
  if (browsers.length) {
    head("page", ...browsers.map(({ called }) => called));
    await livePages(browsers);
    await waits(browsers);
    await blankPage(browsers);
  }
  if (browsers.length && !options.live) {
    await labRuns(browsers);
    sizes(browsers);
  }
} finally {
  await Promise.all(browsers.map(({ browser }) => browser.close()));
  rmSync(folder, { recursive: true });
}
