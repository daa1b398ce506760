// Whether pages can be used by everybody, as far as a program can tell: axe-core (viewer/package.json) finds nothing in the lab, in pages of
// walkers, recorded and simulated, and in one of figures, light and dark, at two widths. map.test.mjs, report.test.mjs, site.test.mjs and
// watch.test.mjs ask it of their pages. Without the packages of viewer/package-lock.json the test is skipped (with-packages).
import assert from "node:assert/strict";
import { mkdirSync, rmSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { amble, launch, makePage, open, settled, violations, violationsAnywhere } from "./browser.mjs";

const { AMBLE_PAGES, AMBLE_SOURCE } = process.env;

let browser, lab, walker, steered;
before(async () => {
  mkdirSync(AMBLE_PAGES, { recursive: true });
  lab = join(AMBLE_PAGES, "lab.html");
  rmSync(lab, { force: true });
  amble("lab", "-o", lab);
  walker = makePage("walker.html", join(AMBLE_SOURCE, "robots/servo/champion.json"));
  steered = makePage("steered.html", join(AMBLE_SOURCE, "robots/hexapod/steered.json"));
  browser = await launch();
});
after(() => browser?.close());

async function showRun(page) {
  await page.waitForFunction(() => window.amble.stage.walk);
  await page.evaluate(() => { window.amble.form.set({ robot: "servo", population: 20, seconds: 2, generations: 3, search: "map-elites" }); window.amble.chosen("robot"); });
  await page.getByRole("button", { name: "Start", exact: true }).click();
  await page.waitForFunction(() => window.amble.evolution?.state === "ended", null, { timeout: 120_000 });
  await page.locator("summary").evaluateAll((all) => all.slice(-2).forEach((one) => one.click()));
}

test("axe-core finds nothing wrong in the lab before and after a run", async () => {
  const { page } = await open(browser, lab, { at_s: null, hash: "threads=2" });
  assert.deepEqual(await violationsAnywhere(page), {});
  await showRun(page);
  assert.deepEqual(await violationsAnywhere(page), {});
  await page.close();
});

for (const [what, path, hash] of [["recorded", () => walker, null], ["recorded, one that obeys", () => steered, null],
                                  ["simulated", () => walker, "live"], ["simulated, one that obeys", () => steered, "live"]])
  test(`axe-core finds nothing wrong in the page of a walker: ${what}`, async () => {
    const { page } = await open(browser, path(), { hash });
    await settled(page);
    await page.locator("summary").evaluateAll((all) => all.forEach((one) => one.click()));
    assert.deepEqual(await violationsAnywhere(page), {});
    await page.close();
  });

test("axe-core finds nothing wrong in a page of figures", async () => {
  const run = join(AMBLE_PAGES, "run");
  rmSync(run, { recursive: true, force: true });
  amble("evolve", join(AMBLE_SOURCE, "configs/quick/quadruped.toml"), "--generations", "3", "--set", "population.size=20", "--set", "trial.duration_s=2", "--jobs", "1", "--out", run);
  const path = makePage("figures.html", "--static", run);
  const page = await browser.newPage();
  await page.goto(pathToFileURL(path).href);
  assert.deepEqual(await violationsAnywhere(page), {});
  await page.close();
});

test("axe-core would find a button without a name", async () => {
  const { page } = await open(browser, walker, {});
  await page.evaluate(() => document.querySelector("main").append(document.createElement("button")));
  assert.deepEqual((await violations(page)).map(([id]) => id), ["button-name"]);
  await page.close();
});
