// The page of runs that go on, served by the program.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdirSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { NO_INTRUDERS, amble, intruders, isOurs, launch, pictureOf, violationsAnywhere } from "./browser.mjs";

const { AMBLE_PAGES, AMBLE_PROGRAM, AMBLE_SOURCE } = process.env;
const CONFIG = join(AMBLE_SOURCE, "configs/quick/quadruped.toml");
const SMALL = ["--set", "population.size=40", "--set", "trial.duration_s=2", "--jobs", "1"];

let browser;
before(async () => {
  mkdirSync(AMBLE_PAGES, { recursive: true });
  browser = await launch();
});
after(() => browser.close());

const folder = (name) => {
  const path = join(AMBLE_PAGES, name);
  rmSync(path, { recursive: true, force: true });
  return path;
};
const evolve = (out, generations, ...more) => ["evolve", CONFIG, ...SMALL, "--generations", String(generations), "--out", out, ...more];

/** A process that serves pages: {url, ended, stop()}. */
function serve(...words) {
  const process_ = spawn(AMBLE_PROGRAM, words);
  const ended = new Promise((done) => process_.on("exit", done));
  let said = "";
  const url = new Promise((found, failed) => {
    process_.stderr.on("data", (text) => {
      said += text;
      const match = /watch it at (\S+)\n/.exec(said);
      if (match) found(match[1]);
    });
    process_.on("exit", () => failed(new Error(said)));
  });
  return { url, ended, kill: (signal) => process_.kill(signal), stop: () => (process_.kill("SIGINT"), ended) };
}

/** A page of the server, in which nothing may go wrong but what `expected` allows. */
async function inPage(server, steps, { hash = "", expected = /^$/, ...options } = {}) {
  const url = await server.url, page = await browser.newPage({ viewport: { width: 1280, height: 800 }, deviceScaleFactor: 0.5, ...options }), problems = [];
  page.setDefaultTimeout(60_000);
  page.on("console", (message) => isOurs(message) && problems.push(`console ${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => problems.push(`error: ${error.message}`));
  page.on("request", (request) => !request.url().startsWith(new URL(url).origin) && !/^(data|blob):/.test(request.url()) && problems.push(request.url()));
  try {
    await page.goto(url + hash);
    await page.waitForFunction(() => window.amble || !document.getElementById("trouble").hidden);
    await steps(page);
    assert.deepEqual(problems.filter((problem) => !expected.test(problem)), []);
    assert.ok(await page.locator("#trouble").isHidden(), await page.locator("#trouble").textContent());
  } finally {
    await page.close();
  }
}

const story = (page) => page.locator("#stage-text").textContent();
const says = (page, text) => page.waitForFunction((part) => document.getElementById("stage-text").textContent.includes(part), text);
const rows = (page) => page.evaluate(() => window.amble.rows.map(({ generation, best, best_so_far, median, typical }) => ({ generation, best, best_so_far, median, typical })));
const table = (run) => readFileSync(join(run, "generations.csv"), "utf8").trim().split("\n").slice(1).map((line) => line.split(",").map(Number));

test("a run's curve grows, its best walks, and when it ends the page says where its files are", async () => {
  // Ten seconds at least, so that a page sees it go on, also on a quick machine.
  const generations = 200, run = folder("ends"), server = serve(...evolve(run, generations, "--watch", "--set", "trial.duration_s=8"));
  await inPage(server, async (page) => {
    await page.waitForFunction(() => window.amble.rows.length > 3);
    assert.match(await story(page), /It runs: generation \d+ of 200/);
    const early = await pictureOf(page, ".lab-curve");
    await page.waitForFunction(() => window.amble.stage.walk);
    assert.ok((await pictureOf(page)).colours > 50);
    assert.match(await page.locator("#story").textContent(), /Best of generation \d+: /);
    const drawn = await page.locator("#cppn text").allTextContents();
    assert.ok(drawn.includes("bias") && drawn.includes("time"), `the network's nodes: ${drawn}`);
    assert.ok((await page.locator("#patterns .panel").count()) > 3);
    page.setDefaultTimeout(300_000);
    await says(page, "The run has ended; its files are in");
    assert.ok((await story(page)).includes(run));
    assert.notEqual((await pictureOf(page, ".lab-curve")).hash, early.hash);
    const shown = await rows(page);
    assert.equal(shown.length, generations);
    assert.deepEqual(shown.map(({ best }) => best), table(run).map((row) => row[1]));
    assert.ok(await page.evaluate(() => window.amble.rows.some(({ species }) => species.length > 0 && species.reduce((sum, [, size]) => sum + size, 0) === 40)), "sizes of species");
    assert.ok(await page.locator("#runs").isHidden());
    assert.deepEqual(await violationsAnywhere(page), {});
  });
  assert.equal(await server.ended, 0);
});

test("several runs are one view; one that is chosen is shown, the one before stays as a line", async () => {
  const study = folder("study");
  for (const [name, seed] of [["a", 1], ["b", 2]]) amble(...evolve(join(study, name), 5, "--seed", String(seed)));
  const server = serve("view", "--live", study), other = serve(...evolve(join(study, "c"), 100_000, "--seed", "3", "--watch"));
  await other.url;
  await inPage(server, async (page) => {
    await page.waitForFunction(() => document.querySelectorAll(".run-list tbody tr").length === 3);
    await page.getByRole("button", { name: "b", exact: true }).click();
    await says(page, "The run has ended");
    await page.waitForFunction(() => window.amble.rows.length === 5);
    assert.match(await page.locator("#name").textContent(), /, seed 2$/);
    await page.getByRole("button", { name: "c", exact: true }).click();
    await page.waitForFunction(() => window.amble.rows.length > 2);
    assert.match(await page.locator("#runs-note").textContent(), /^3 runs: 1 going on, 2 ended\. A run is chosen/);
    assert.equal(await page.evaluate(() => window.amble.curve.before[0].name), "b");
    assert.deepEqual(await violationsAnywhere(page), {}, "a page of several runs");
    assert.equal(await page.locator('.run-list [aria-pressed="true"]').textContent(), "c");
    await page.waitForFunction(() => window.amble.all.runs.size === 3);
    assert.deepEqual(await page.locator("#all-curves .line-key").allTextContents(), ["a", "b", "c"]);
    assert.match(await page.locator("#all-curves canvas").getAttribute("aria-label"), /a: \d\.\d\d m; b: \d\.\d\d m; c: /);
    assert.ok((await pictureOf(page, "#all-curves canvas")).colours > 5);
    await other.stop();
    await says(page, "Stopped at generation");
  });
  assert.equal(await server.stop(), 0);
});

test("a folder that vanishes, and comes back, is told", async () => {
  const run = folder("vanishes"), elsewhere = folder("elsewhere");
  amble(...evolve(run, 3));
  const server = serve("view", "--live", run);
  await inPage(server, async (page) => {
    await says(page, "The run has ended");
    await page.waitForFunction(() => window.amble.stage.walk && window.amble.rows.length === 3);
    renameSync(run, elsewhere);
    await says(page, "has vanished");
    assert.equal((await rows(page)).length, 3);
    renameSync(elsewhere, run);
    await says(page, "The run has ended");
  });
  await server.stop();
});

test("a program that was killed is told", async () => {
  const run = folder("killed");
  amble(...evolve(run, 3));
  const server = serve("view", "--live", run);
  await inPage(server, async (page) => {
    await says(page, "The run has ended");
    await page.waitForFunction(() => window.amble.stage.walk && window.amble.rows.length === 3);
    server.kill("SIGKILL");
    await says(page, "does not answer: it has ended, or was killed");
    assert.equal((await rows(page)).length, 3);
  }, { expected: /net::ERR_|Failed to fetch/ });
});

const MAP = [join(AMBLE_SOURCE, "configs/repertoire/quadruped.toml"), "--jobs", "1", "--set", "search.map_elites.batch=32", "--set", "search.map_elites.initial=64",
             "--set", "trial.duration_s=2", "--set", "search.map_elites.trials=1"];

test("a map is seen to fill", async () => {
  const run = folder("map");
  amble("evolve", ...MAP, "--generations", "3", "--out", run);
  const server = serve("view", "--live", run);
  await inPage(server, async (page) => {
    await page.waitForFunction(() => !document.getElementById("map").hidden);
    const note = await page.locator("#map-note").textContent(), filled = Number(/^(\d+) of \d+ cells are filled/.exec(note)[1]);
    assert.equal(filled, table(run).at(-1)[readFileSync(join(run, "generations.csv"), "utf8").split("\n")[0].split(",").indexOf("elites")]);
    assert.ok((await pictureOf(page, ".lab-cells")).colours > 2);
    assert.deepEqual(await violationsAnywhere(page), {}, "a page with a map");
  });
  await server.stop();
});

test("a cell of the map is chosen by a click or by keys, its elite walks until the best is asked for, and how its trial ends is said", async () => {
  const run = folder("cells");
  amble("evolve", ...MAP, "--generations", "3", "--out", run);
  const server = serve("view", "--live", run);
  await inPage(server, async (page) => {
    await page.waitForFunction(() => !document.getElementById("map").hidden && window.amble.stage.walk);
    const champion = JSON.parse(await page.evaluate(() => window.amble.stage.text));
    // The middle of the cell whose elite gets farthest.
    const { cell, at } = await page.evaluate(() => {
      const { map } = window.amble, place = map.bestPlace(), { axes } = map.map;
      const [wide, tall] = [0, 1].map((first) => axes.reduce((bins, axis, i) => (i % 2 === first ? bins * axis.bins : bins), 1));
      const { clientWidth, clientHeight } = map.canvas;
      return { cell: place.cell, at: { x: ((place.column + 0.5) / wide) * clientWidth, y: ((tall - place.row - 0.5) / tall) * clientHeight } };
    });
    const shown = (id) => page.waitForFunction((number) => document.getElementById("story").textContent.startsWith(`Cell ${number} of the map: `), id);
    await page.locator(".lab-cells").click({ position: at });
    await shown(cell);
    const file = join(AMBLE_PAGES, "elite.json");
    rmSync(file, { force: true });
    amble("repertoire", run, "--cell", String(cell), "-o", file);
    assert.equal(await page.evaluate(() => window.amble.stage.text), readFileSync(file, "utf8"));
    assert.match(await page.locator(".lab-cells").getAttribute("aria-label"), new RegExp(` Cell ${cell} is chosen: `));
    await page.waitForFunction(() => / (Its trial is over; it has not fallen|It fell after \d+\.\d s, at \d+\.\d+ m: its trial was over there)\.$/.test(document.getElementById("story").textContent));

    await page.locator(".lab-cells").focus();
    for (const key of ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"]) await page.keyboard.press(key);
    const other = await page.evaluate(() => window.amble.elite);
    await shown(other);
    assert.ok(await page.evaluate((id) => window.amble.map.map.filled.some(([filled]) => filled === id), other));
    await page.getByRole("button", { name: "The best again", exact: true }).click();
    await page.waitForFunction(() => /^Best of generation \d+: /.test(document.getElementById("story").textContent));
    assert.deepEqual(JSON.parse(await page.evaluate(() => window.amble.stage.text)).genome, champion.genome);
    assert.ok(await page.getByRole("button", { name: "The best again", exact: true }).isHidden());
  });
  await server.stop();
});

test("a study that goes on has a page of its runs", async () => {
  // The study in miniature with longer runs: it must not end before a browser has opened its page.
  const out = folder("studied"), file = `${out}.toml`;
  writeFileSync(file, readFileSync(join(AMBLE_SOURCE, "studies/smoke.toml"), "utf8").replace("generations = 5", "generations = 80")
    .replaceAll("../configs", join(AMBLE_SOURCE, "configs")));
  const server = serve("study", file, "--out", out, "--jobs", "1", "--watch");
  await inPage(server, async (page) => {
    await page.waitForFunction(() => window.amble.rows.length > 0 && window.amble.stage.walk);
    assert.match(await page.locator("#runs-note").textContent(), / \d of 6 are in the study’s ledger\./);
    await says(page, "The study has ended; for its report, run: amble report");
    assert.equal(await page.locator(".run-list tbody tr").count(), 6);
    assert.match(await page.locator("#runs-note").textContent(), /^6 runs: 6 ended\. 6 of 6 are in the study’s ledger\. A run is chosen by its line or its name\.$/);
  });
  assert.equal(await server.ended, 0);
});

test("a script that is put into the page does not run, and nothing runs in what else is served", async () => {
  const run = folder("policy");
  amble(...evolve(run, 2));
  const server = serve("view", "--live", run);
  await inPage(server, async (page) => assert.deepEqual(await intruders(page), NO_INTRUDERS), { expected: /^console error: .*Content Security Policy/ });
  const url = await server.url, policy = async (path) => (await fetch(url + path)).headers.get("content-security-policy");
  const html = await (await fetch(url)).text(), scripts = / script-src [^;]+;/.exec(html)[0];
  assert.ok((await policy("")).includes(scripts), "that of the header is that of the page");
  assert.match(await policy("runs"), / script-src 'none';/);
  await server.stop();
});

test("a narrow screen shows all of it", async () => {
  const run = folder("narrow");
  amble(...evolve(run, 3));
  const server = serve("view", "--live", run);
  await inPage(server, async (page) => {
    await page.waitForFunction(() => window.amble.rows.length === 3);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  }, { viewport: { width: 360, height: 740 } });
  await server.stop();
});
