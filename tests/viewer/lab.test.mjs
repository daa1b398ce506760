// The lab: a page in which walkers evolve.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { amble, launch, open, pictureOf } from "./browser.mjs";

const { AMBLE_PAGES, AMBLE_SOURCE } = process.env;
const MB = 1e6;

let browser, lab;
before(async () => {
  mkdirSync(AMBLE_PAGES, { recursive: true });
  lab = join(AMBLE_PAGES, "lab.html");
  rmSync(lab, { force: true });
  amble("lab", "-o", lab);
  browser = await launch();
});
after(() => browser.close());

/** Runs `steps` in the lab, in which nothing may go wrong. */
async function inLab(options, steps) {
  const { page, problems } = await open(browser, lab, { at_s: null, hash: "threads=2", ...options });
  try {
    await page.waitForFunction(() => window.amble.stage.walk || document.querySelector("#trouble:not([hidden])"));
    await steps(page);
    assert.deepEqual(problems, []);
  } finally {
    await page.close();
  }
}

const button = (page, name) => page.getByRole("button", { name, exact: true });
const field = (page, key) => page.locator(`#settings [name=${key}]`);
const set = (page, values) => page.evaluate((v) => { window.amble.form.set(v); window.amble.chosen("robot"); }, values);
const generation = (page) => page.evaluate(() => window.amble.evolution?.generation ?? 0);
const until = (page, count) => page.waitForFunction((n) => window.amble.evolution.generation >= n, count, { timeout: 120_000 });
const trouble = (page) => page.locator("#trouble").textContent();
const history = (page) => page.evaluate(() => window.amble.curve.history);

/** What a click saves; gives its path. */
async function saved(page, click, name) {
  const [download] = await Promise.all([page.waitForEvent("download"), click()]);
  const path = join(AMBLE_PAGES, name);
  await download.saveAs(path);
  return path;
}

/** The walker stands: painting it takes more of a processor than what is tested. */
const STILL = { reducedMotion: "reduce" };
const SMALL = { robot: "servo", population: 20, seconds: 2, generations: 20 };

test("it opens from a file, asks no network for anything, and is at most 1.25 MB", () =>
  inLab({}, async (page) => {
    assert.ok(readFileSync(lab).length <= 1.25 * MB, `${readFileSync(lab).length} bytes`);
    assert.match(await page.locator("meta[http-equiv]").getAttribute("content"), /^default-src 'none'; script-src 'sha256-\S{44}' 'sha256-\S{44}' 'wasm-unsafe-eval'; /);
    assert.ok((await pictureOf(page)).colours > 50);
    assert.match(await page.locator("#story").textContent(), /random network/);
    await page.locator("#footfalls").scrollIntoViewIfNeeded();
    const drawn = () => pictureOf(page, "#footfalls canvas");
    await page.waitForFunction(() => window.amble.stage.clock.duration_s > 0.5);
    const early = await drawn();
    await page.waitForFunction(() => window.amble.stage.clock.duration_s > 1.5);
    assert.notEqual((await drawn()).hash, early.hash, "footfalls as it walks");
    assert.equal(await page.locator("#settings select[name=robot] option").count(), 5);
  }));

test("twenty generations in the page: curve and species grow, it pauses and goes on, and the same run natively has the same table", () =>
  inLab({}, async (page) => {
    await set(page, SMALL);
    await button(page, "Start").click();
    await until(page, 4);
    await button(page, "Pause").click();
    await page.waitForTimeout(600);
    const at = await generation(page), early = await pictureOf(page, ".lab-curve");
    await page.waitForTimeout(400);
    assert.equal(await generation(page), at);
    await button(page, "Go on").click();
    await page.waitForFunction(() => window.amble.evolution.state === "ended", null, { timeout: 120_000 });
    assert.notEqual((await pictureOf(page, ".lab-curve")).hash, early.hash);
    const told = await history(page);
    assert.equal(told.length, 20);
    assert.ok(told.every(({ species }) => species.reduce((sum, [, size]) => sum + size, 0) === 20));
    assert.ok(await page.locator("#cppn svg .neuron").count() > 1);
    assert.ok(await page.locator("#patterns .pattern").count() > 3);

    const champion = await saved(page, () => button(page, "Save the walker").click(), "champion.json");
    assert.match(amble("info", champion), /experiment +servo in the lab/);
    assert.match(amble("trial", champion, "--undisturbed"), /completed|fell/);
    const tar = await saved(page, () => button(page, "Save the run").click(), "run.tar");
    for (const folder of ["amble-run", "native"]) rmSync(join(AMBLE_PAGES, folder), { recursive: true, force: true });
    execFileSync("tar", ["xf", tar], { cwd: AMBLE_PAGES });
    const run = join(AMBLE_PAGES, "amble-run");
    amble("evolve", join(run, "config.toml"), "--jobs", "2", "--out", join(AMBLE_PAGES, "native"));
    const table = (folder) => readFileSync(join(folder, "generations.csv"), "utf8").trim().split("\n").slice(1).map((line) => line.split(",").slice(0, 5).map(Number));
    assert.deepEqual(table(run), table(join(AMBLE_PAGES, "native")));
    assert.deepEqual(told.map(({ best }) => best), table(run).map((row) => row[1]));
    amble("resume", run, "--generations", "22", "--jobs", "1");
    assert.ok(existsSync(join(run, "checkpoint.bin")));
  }));

test("the best of runs before walk once more, in the world that was chosen, and are called by what was run", () =>
  inLab(STILL, async (page) => {
    const step = (experiment, name) => page.locator(`#experiment-${experiment}`).getByRole("button", { name, exact: true });
    const evolve = async (settings = {}) => {
      await page.evaluate((v) => window.amble.form.set(v), { population: 20, seconds: 2, generations: 2, ...settings });
      await button(page, "Start").click();
      await ended(page);
    };
    const set = async (experiment, name) => {
      await page.evaluate((id) => (document.getElementById(`experiment-${id}`).open = true), experiment);
      await step(experiment, name).click();
    };
    await field(page, "seed").fill("7");
    await set("rough", "Flat");
    assert.equal(await field(page, "seed").inputValue(), "7", "a seed stays");
    await evolve();
    assert.equal(await page.locator(".earlier").isHidden(), true);
    const flat = await page.evaluate(() => window.amble.newest.text);
    await set("rough", "Hurdles");
    assert.equal(await field(page, "seed").inputValue(), "7");
    await evolve({ slope: 0.1 });
    const earlier = page.locator(".earlier button"), name = await earlier.textContent();
    assert.match(name, /^Flat, population 20, generations 2, …, seed 7$/);
    assert.match(await page.locator(".keys").first().textContent(), /before: Flat, population 20/);
    await page.evaluate(() => { window.amble.form.set({ ground: "stairs", slope: 0 }); window.amble.chosen("ground"); });
    await page.waitForFunction(() => /is there now/.test(document.getElementById("said").textContent));
    await earlier.click();
    await page.waitForFunction((title) => window.amble.stage.title === title, name);
    assert.equal(await page.evaluate(() => window.amble.stage.text), flat);
    assert.equal(await page.evaluate(() => window.amble.stage.walk.description.ground.kind), "stairs");
    assert.equal(JSON.parse(flat).seed, 7);
    await button(page, "The best again").click();
    await page.waitForFunction(() => /^Best of generation/.test(window.amble.stage.title));
    assert.equal(await page.evaluate(() => window.amble.stage.walk.description.ground.kind), "stairs", "also where the newest is put");
    assert.match(await page.locator("#typically").textContent(), /^Typically: the middle of 16 new trials of the best, .* \d+ of these end in a fall\.$/);

    await set("luck", "Seed 3");
    assert.equal(await page.locator(".earlier").isHidden(), true, "another experiment has other runs before");
    assert.equal(await field(page, "seed").inputValue(), "3");
  }));

test("any number of threads gives the same generations", async () => {
  const all = [];
  for (const threads of [1, 3])
    await inLab({ ...STILL, hash: `threads=${threads}` }, async (page) => {
      await set(page, { ...SMALL, generations: 5, noise: "strong" });
      await button(page, "Start").click();
      await page.waitForFunction(() => window.amble.evolution?.state === "ended", null, { timeout: 120_000 });
      all.push((await history(page)).map(({ best, median, steps, species }) => ({ best, median, steps, species })));
    });
  assert.deepEqual(all[0], all[1]);
});

test("a pause in the midst of a generation of many genomes ends in the same generations", async () => {
  const all = [];
  for (const pauses of [0, 6])
    await inLab(STILL, async (page) => {
      await set(page, { ...SMALL, population: 100, generations: 4 });
      await button(page, "Start").click();
      for (let i = 0; i < pauses; ++i) {
        await page.waitForTimeout(150);
        await page.evaluate(() => { const { evolution } = window.amble; if (evolution.state === "running") { evolution.pause(); setTimeout(() => evolution.goOn(), 400); } });
        await page.waitForTimeout(500);
      }
      await page.waitForFunction(() => window.amble.evolution?.state === "ended", null, { timeout: 120_000 });
      all.push((await history(page)).map(({ best, median }) => [best, median]));
    });
  assert.deepEqual(all[0], all[1]);
});

test("a run that was saved is opened and goes on to the same generations", () =>
  inLab(STILL, async (page) => {
    await set(page, { ...SMALL, generations: 60, search: "novelty" });
    await button(page, "Start").click();
    await until(page, 4);
    await button(page, "Pause").click();
    await page.waitForTimeout(500);
    const tar = await saved(page, () => button(page, "Save the run").click(), "part.tar");
    await button(page, "Go on").click();
    await page.waitForFunction(() => window.amble.evolution.state === "ended", null, { timeout: 120_000 });
    const whole = (await history(page)).map(({ best }) => best);
    assert.match(await page.locator(".lab-ends").getAttribute("aria-label"), /; rings: the \d+ of the archive$/);
    await page.setInputFiles("#file", tar);
    await page.waitForFunction(() => window.amble.evolution?.state === "paused");
    assert.ok((await generation(page)) >= 4);
    await button(page, "Go on").click();
    await page.waitForFunction(() => window.amble.evolution.state === "ended", null, { timeout: 120_000 });
    assert.deepEqual((await history(page)).map(({ best }) => best), whole);
  }));

test("a leg is lost while it evolves: the best begins anew, and what walks has a leg less", () =>
  inLab(STILL, async (page) => {
    await set(page, { ...SMALL, generations: 6, lost: "first", lostAt: 3 });
    await button(page, "Start").click();
    await page.waitForFunction(() => window.amble.evolution?.state === "ended", null, { timeout: 120_000 });
    assert.deepEqual(await page.evaluate(() => window.amble.curve.marks), [3]);
    const champion = JSON.parse(await page.evaluate(() => window.amble.best.text));
    assert.deepEqual(champion.damage.parts.map(({ kind }) => kind), ["missing"]);
    assert.ok(champion.generation >= 3);
    assert.equal(await field(page, "missing").inputValue(), "front_left");
  }));

/** A folder as the lab's tar of it. */
function packed(folder, name) {
  const path = join(AMBLE_PAGES, name);
  execFileSync("tar", ["cf", path, "amble-run"], { cwd: folder });
  return path;
}
function unpacked(tar, into) {
  const folder = join(AMBLE_PAGES, into);
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder);
  execFileSync("tar", ["xf", tar], { cwd: folder });
  return folder;
}
const bests = (run) => readFileSync(join(run, "generations.csv"), "utf8").trim().split("\n").slice(1).map((line) => Number(line.split(",")[1]));
const ended = (page) => page.waitForFunction(() => window.amble.evolution?.state === "ended", null, { timeout: 120_000 });

test("a run that amble resume made longer opens with its whole curve and its own best; a leg that is still to be lost is lost", () =>
  inLab(STILL, async (page) => {
    await set(page, { ...SMALL, generations: 4, lost: "first", lostAt: 8 });
    await button(page, "Start").click();
    await ended(page);
    const species = (await history(page)).map((row) => row.species);
    const folder = unpacked(await saved(page, () => button(page, "Save the run").click(), "short.tar"), "longer"), run = join(folder, "amble-run");
    amble("resume", run, "--generations", "7", "--jobs", "1");
    await button(page, "Stop and begin anew").click();
    await page.setInputFiles("#file", packed(folder, "longer.tar"));
    await page.waitForFunction(() => window.amble.evolution?.state === "ended" && /7 generations are over/.test(document.getElementById("said").textContent));
    const shown = await history(page), all = bests(run);
    assert.deepEqual(shown.map(({ best }) => best), all);
    assert.deepEqual(shown.slice(0, 4).map((row) => row.species), species);
    const best = all.indexOf(Math.max(...all));
    assert.equal(await page.evaluate(() => window.amble.stage.title), `Best of generation ${best}`);
    assert.equal(await page.locator("#now dd").first().textContent(), "7 of 7");
    assert.match(await page.locator("#said").textContent(), /A leg is lost at generation 8/);

    await button(page, "100 more generations").click();
    await until(page, 9);
    await button(page, "Pause").click();
    assert.deepEqual(await page.evaluate(() => window.amble.curve.marks), [8]);
    assert.equal(await field(page, "missing").inputValue(), "front_left");
    assert.deepEqual((await history(page)).slice(0, 7).map(({ best }) => best), all);
  }));

test("100 more generations are those of a longer run natively", () =>
  inLab(STILL, async (page) => {
    await set(page, { ...SMALL, generations: 3 });
    await button(page, "Start").click();
    await ended(page);
    await button(page, "100 more generations").click();
    await until(page, 6);
    await button(page, "Pause").click();
    await page.waitForTimeout(600);
    const run = join(unpacked(await saved(page, () => button(page, "Save the run").click(), "more.tar"), "more"), "amble-run"), native = join(AMBLE_PAGES, "more-native");
    rmSync(native, { recursive: true, force: true });
    assert.match(readFileSync(join(run, "config.toml"), "utf8"), /^generations = 103$/m);
    amble("evolve", join(run, "config.toml"), "--generations", String(bests(run).length), "--jobs", "1", "--out", native);
    assert.deepEqual(bests(run), bests(native));
    assert.deepEqual((await history(page)).map(({ best }) => best), bests(run));
  }));

test("after the end the walker goes where the world's settings put it, and more generations are born there", () =>
  inLab(STILL, async (page) => {
    const put = async (key, value) => {
      await field(page, key).selectOption(value);
      await page.waitForFunction(() => /The walker is there now/.test(document.getElementById("said").textContent));
      await page.evaluate(() => { document.getElementById("said").textContent = ""; });
    };
    const walks = () => page.evaluate(() => { const { ground, damage } = window.amble.stage.walk.live.describe(); return [ground.kind, damage.parts.length]; });
    await set(page, { ...SMALL, generations: 2 });
    await button(page, "Start").click();
    await ended(page);
    assert.match(await page.locator(".world-when").textContent(), /^The run is over/);
    await put("ground", "rough");
    assert.deepEqual(await walks(), ["rough", 0]);
    await put("missing", "front_right");
    assert.deepEqual(await walks(), ["rough", 1]);
    await put("missing", "");
    await put("ground", "plane");
    assert.deepEqual(await walks(), ["plane", 0]);
    assert.deepEqual(await page.evaluate(() => window.amble.evolution.changes), [], "it is the world of before");
    await put("ground", "rough");
    await button(page, "100 more generations").click();
    await until(page, 3);
    assert.deepEqual(await page.evaluate(() => window.amble.curve.marks), [2]);
    assert.equal(JSON.parse(await page.evaluate(() => window.amble.best.text)).ground.kind, "rough");
  }));

test("a map fills, and the walker of a cell walks", () =>
  inLab(STILL, async (page) => {
    await set(page, { ...SMALL, generations: 4, search: "map-elites" });
    await button(page, "Start").click();
    await page.waitForFunction(() => window.amble.evolution?.state === "ended", null, { timeout: 120_000 });
    const filled = page.locator(".lab-map button:enabled");
    assert.ok((await filled.count()) > 3);
    assert.match(await page.locator("#now").textContent(), new RegExp(`Cells filled${await filled.count()} of 100`));
    assert.match(await page.locator(".lab-curve").getAttribute("aria-label"), /; \d+ cells of the map$/);
    await filled.first().click();
    await page.waitForFunction(() => /Of the map/.test(document.getElementById("story").textContent));
    await filled.first().press("ArrowRight");
    assert.match(await filled.first().getAttribute("aria-label"), /^column \d+, row \d+ from below: \d+\.\d\d m$/);
    assert.equal(await filled.first().getAttribute("aria-pressed"), "true");
    await button(page, "100 more generations").click();
    await until(page, 6);
    await button(page, "Pause").click();
    assert.match(await page.locator("#story").textContent(), /Of the map/, "what was chosen walks on");
    await button(page, "The best again").click();
    await page.waitForFunction(() => /Best of generation/.test(document.getElementById("story").textContent));
    assert.equal(await page.locator(".lab-map button[aria-pressed=true]").count(), 0);
    assert.equal(await button(page, "The best again").isHidden(), true);
  }));

test("each experiment sets up the lab, and its runs stay in the diagram to compare with", () =>
  inLab(STILL, async (page) => {
    const experiments = page.locator(".experiment");
    assert.ok((await experiments.count()) >= 12);
    for (let i = 0; i < (await experiments.count()); ++i) {
      const one = experiments.nth(i);
      await one.locator("summary").click();
      for (const step of await one.locator(".lab-buttons button").all()) {
        await page.evaluate(() => (window.amble.stage.random = false));
        await step.click();
        await page.waitForFunction(() => window.amble.stage.random || !document.getElementById("trouble").hidden);
        assert.equal(await page.locator("#trouble").isHidden(), true, await trouble(page));
      }
    }
    await page.locator("#experiment-trigger summary").click();
    for (const step of ["With touch", "Without touch"]) {
      await button(page, step).click();
      await set(page, { ...SMALL, generations: 3, feels: step === "With touch" });
      await button(page, "Start").click();
      await page.waitForFunction(() => window.amble.evolution?.state === "ended", null, { timeout: 120_000 });
    }
    assert.match(await page.locator("#curves .keys").textContent(), /With touch/);
  }));

/** Whether the browser would ask before the page is left. */
const asks = (page) => page.evaluate(() => !dispatchEvent(new Event("beforeunload", { cancelable: true })));

test("a page with generations that were not saved is left only if that is confirmed", () =>
  inLab(STILL, async (page) => {
    assert.ok(!(await asks(page)));
    await set(page, { ...SMALL, generations: 500 });
    await button(page, "Start").click();
    await until(page, 2);
    await button(page, "Pause").click();
    await page.waitForFunction(() => window.amble.evolution.state === "paused");
    assert.ok(await asks(page));
    await Promise.all([page.waitForEvent("download"), button(page, "Save the run").click()]);
    await page.waitForFunction(() => !window.amble.unsaved);
    assert.ok(!(await asks(page)));
    await button(page, "Stop and begin anew").click();
    await set(page, { ...SMALL, generations: 5 });
    await button(page, "Start").click();
    await page.waitForFunction(() => window.amble.evolution.state === "ended");
    assert.ok(!(await asks(page)), "it is over soon, and made again as soon");
    await page.evaluate(() => (window.amble.opened_ms -= 61_000));
    assert.ok(await asks(page));
    const asked = [];
    page.removeAllListeners("dialog");
    page.once("dialog", (dialog) => (asked.push(dialog.message()), dialog.dismiss()));
    await button(page, "Stop and begin anew").click();
    assert.match(asked[0], /^5 generations are over, and were not saved\. Leave it\?/);
    assert.equal(await page.evaluate(() => window.amble.evolution.state), "ended");
  }));

test("a run that goes on is left for an experiment only if that is confirmed", () =>
  inLab(STILL, async (page) => {
    await set(page, { ...SMALL, generations: 500 });
    await button(page, "Start").click();
    await until(page, 2);
    await button(page, "Pause").click();
    const asked = [];
    const choose = async (answer) => {
      page.removeAllListeners("dialog");
      page.once("dialog", (dialog) => (asked.push(dialog.message()), answer ? dialog.accept() : dialog.dismiss()));
      await page.locator("#experiment-trigger .lab-buttons button").first().click();
    };
    await page.locator("#experiment-trigger summary").click();
    await choose(false);
    assert.equal(await page.evaluate(() => window.amble.evolution.state), "paused");
    page.once("dialog", (dialog) => (asked.push(dialog.message()), dialog.dismiss()));
    await page.setInputFiles("#file", join(AMBLE_SOURCE, "robots/biped/champion.json"));
    while (asked.length < 2) await page.waitForTimeout(50);
    assert.notEqual(await field(page, "robot").inputValue(), "own");
    page.once("dialog", (dialog) => (asked.push(dialog.message()), dialog.dismiss()));
    await button(page, "Stop and begin anew").click();
    assert.equal(await page.evaluate(() => window.amble.evolution.state), "paused");
    await choose(true);
    await page.waitForFunction(() => window.amble.evolution === null);
    assert.equal(asked.length, 4);
    await page.waitForFunction(() => [...document.querySelectorAll("#cppn text")].some((name) => name.textContent === "time")); // of the file's network
    assert.ok(await page.evaluate(() => {
      const { left, right } = document.querySelector("#cppn svg").getBoundingClientRect();
      return [...document.querySelectorAll("#cppn text")].every((name) => name.getBoundingClientRect().left >= left && name.getBoundingClientRect().right <= right);
    }), "a name of the network is cut off");
    assert.match(asked[0], /^\d+ generations are over, and the run is not\. Leave it\?/);
  }));

test("files that cannot be opened are told in the page, and one's own robot evolves", () =>
  inLab(STILL, async (page) => {
    const file = (name, text) => {
      writeFileSync(join(AMBLE_PAGES, name), text);
      return join(AMBLE_PAGES, name);
    };
    const champion = readFileSync(join(AMBLE_SOURCE, "robots/biped/champion.json"), "utf8");
    const refused = async (name, text, message) => {
      await page.setInputFiles("#file", file(name, text));
      await page.waitForFunction((n) => document.getElementById("trouble").textContent.startsWith(n), name);
      assert.match(await trouble(page), message);
    };
    await refused("broken.json", champion.slice(0, 2000), /was not opened: it is neither/);
    await refused("altered.json", champion.replace('"generation": ', '"generation": 1'), /altered: its checksum does not fit/);
    await refused("other.json", '{"format": "amble-repertoire"}', /no robot, champion or run of amble/);
    await page.setInputFiles("#file", join(AMBLE_SOURCE, "robots/biped/champion.json"));
    await page.waitForFunction(() => /From the file/.test(document.getElementById("story").textContent));
    assert.equal(await page.locator("#trouble").isHidden(), true);
    assert.equal(await field(page, "robot").inputValue(), "own");
    await set(page, { population: 10, seconds: 2, generations: 2 });
    await button(page, "Start").click();
    await page.waitForFunction(() => window.amble.evolution?.state === "ended", null, { timeout: 120_000 });
  }));

test("a thread that dies has a successor; a run that cannot go on is told", () =>
  inLab(STILL, async (page) => {
    await set(page, { ...SMALL, generations: 6 });
    await button(page, "Start").click();
    await until(page, 2);
    await page.evaluate(() => window.amble.evolution.trials[0].die(new Error("killed")));
    await page.waitForFunction(() => window.amble.evolution.state === "ended", null, { timeout: 120_000 });
    await button(page, "Stop and begin anew").click();
    await page.waitForFunction(() => window.amble.stage.random);
    await button(page, "Start").click();
    await until(page, 1);
    await page.evaluate(() => window.amble.evolution.search.die(new Error("killed")));
    await page.waitForFunction(() => /The run ended: killed/.test(document.getElementById("trouble").textContent));
    assert.equal(await button(page, "Save the walker").isVisible(), true);
  }));

test("a browser without SIMD is told so", async () => {
  const page = await browser.newPage();
  await page.addInitScript(() => { WebAssembly.validate = () => false; });
  await page.goto(`file://${lab}`);
  await page.locator("#trouble").waitFor();
  assert.match(await trouble(page), /needs WebAssembly with SIMD/);
  await page.close();
});

test("without WebGL it draws its walker in outlines, and evolves", async () => {
  const flat = await launch({ gl: false });
  const { page } = await open(flat, lab, { at_s: null });
  await page.waitForFunction(() => window.amble.stage.walk);
  assert.ok((await pictureOf(page)).colours > 100);
  await set(page, { ...SMALL, generations: 2 });
  await button(page, "Start").click();
  await page.waitForFunction(() => window.amble.evolution?.state === "ended", null, { timeout: 120_000 });
  await flat.close();
});

test("it is used by keyboard alone, and where motion is unwanted nothing moves by itself", () =>
  inLab({ reducedMotion: "reduce" }, async (page) => {
    assert.equal(await page.evaluate(() => window.amble.stage.clock.playing), false);
    await page.keyboard.press("Tab");
    assert.equal(await page.evaluate(() => document.activeElement.className), "skip");
    await page.keyboard.press("Enter");
    for (let i = 0; i < 3 && (await page.evaluate(() => document.activeElement.textContent)) !== "Start"; ++i) await page.keyboard.press("Tab");
    await set(page, { ...SMALL, generations: 3 });
    await page.keyboard.press("Enter");
    await page.waitForFunction(() => window.amble.evolution?.state === "ended", null, { timeout: 120_000 });
    assert.match(await page.locator("#said").textContent(), /The run is over\. Generation 2: best/);
    assert.equal(await page.evaluate(() => window.amble.stage.clock.playing), false);
  }));

for (const [width, scheme] of [[360, "light"], [800, "dark"], [1400, "light"]])
  test(`${width} px wide, ${scheme}: nothing runs over, all controls have names and can be hit`, () =>
    inLab({ viewport: { width, height: 800 }, colorScheme: scheme, ...(width < 500 ? { hasTouch: true, isMobile: true } : {}) }, async (page) => {
      await set(page, { ...SMALL, generations: 3 });
      await button(page, "Start").click();
      await page.waitForFunction(() => window.amble.evolution?.state === "ended", null, { timeout: 120_000 });
      assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= width);
      const nameless = await page.locator(":is(input, select, button, summary):visible").evaluateAll((controls) =>
        controls.filter((control) => !(control.labels?.[0]?.textContent.trim() || control.textContent.trim() || control.ariaLabel)).length);
      assert.equal(nameless, 0);
    }));
