// Whether pages can be used by everybody, as far as a program can tell: axe-core (viewer/package.json) finds nothing in the lab and in the
// page of a walker. Without the packages of viewer/package-lock.json the test is skipped (with-packages).
import assert from "node:assert/strict";
import { mkdirSync, readFileSync, rmSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { amble, launch, makePage, open, settled } from "./browser.mjs";

const { AMBLE_PAGES, AMBLE_SOURCE } = process.env;
const AXE = readFileSync(fileURLToPath(new URL("../../viewer/node_modules/axe-core/axe.min.js", import.meta.url)), "utf8");
const RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"];
const WIDTH = 1000;

let browser, lab, walker;
before(async () => {
  mkdirSync(AMBLE_PAGES, { recursive: true });
  lab = join(AMBLE_PAGES, "lab.html");
  rmSync(lab, { force: true });
  amble("lab", "-o", lab);
  walker = makePage("walker.html", join(AMBLE_SOURCE, "robots/servo/champion.json"));
  browser = await launch();
});
after(() => browser?.close());

/** [rule, places] of what axe-core finds wrong. */
async function violations(page) {
  await page.evaluate(AXE);
  const found = await page.evaluate((runOnly) => window.axe.run(document, { runOnly }), RULES);
  assert.ok(found.passes.length > 20, `${found.passes.length} rules applied`);
  return found.violations.map(({ id, nodes }) => [id, nodes.map(({ target }) => target.join(" "))]);
}

async function showRun(page) {
  await page.waitForFunction(() => window.amble.stage.walk);
  await page.evaluate(() => { window.amble.form.set({ robot: "servo", population: 20, seconds: 2, generations: 3, search: "map-elites" }); window.amble.chosen("robot"); });
  await page.getByRole("button", { name: "Start", exact: true }).click();
  await page.waitForFunction(() => window.amble.evolution?.state === "ended", null, { timeout: 120_000 });
  await page.locator("summary").evaluateAll((all) => all.slice(-2).forEach((one) => one.click()));
}

for (const colorScheme of ["light", "dark"]) {
  const context = { viewport: { width: WIDTH, height: 800 }, colorScheme };
  test(`axe-core finds nothing wrong in the lab before and after a run, ${colorScheme}`, async () => {
    const { page } = await open(browser, lab, { at_s: null, hash: "threads=2", ...context });
    assert.deepEqual(await violations(page), []);
    await showRun(page);
    assert.deepEqual(await violations(page), []);
    await page.close();
  });

  test(`axe-core finds nothing wrong in the page of a walker, ${colorScheme}`, async () => {
    const { page } = await open(browser, walker, context);
    await settled(page);
    assert.deepEqual(await violations(page), []);
    await page.close();
  });
}

test("axe-core would find a button without a name", async () => {
  const { page } = await open(browser, walker, {});
  await page.evaluate(() => document.querySelector("main").append(document.createElement("button")));
  assert.deepEqual((await violations(page)).map(([id]) => id), ["button-name"]);
  await page.close();
});
