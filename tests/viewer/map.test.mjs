// The page of a map of elites: cells are chosen and walk, one or two at a time.
import assert from "node:assert/strict";
import { rmSync, mkdirSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { afterChoice, chosenCells } from "../../viewer/src/map.js";
import { amble, launch, open, violationsAnywhere } from "./browser.mjs";

const { AMBLE_PAGES, AMBLE_SOURCE } = process.env;
let browser, path;

before(async () => {
  rmSync(AMBLE_PAGES, { recursive: true, force: true });
  mkdirSync(AMBLE_PAGES, { recursive: true });
  const run = join(AMBLE_PAGES, "run");
  const small = ["search.map_elites.batch=128", "search.map_elites.initial=128", "trial.duration_s=2"];
  amble("evolve", join(AMBLE_SOURCE, "configs/repertoire/quadruped.toml"), "--generations", "3", "--out", run,
    ...small.flatMap((setting) => ["--set", setting]));
  path = join(AMBLE_PAGES, "map.html");
  amble("repertoire", run, "--retest", "0", "--walkers", "6", "-o", path); // not tried again: the first is the best
  browser = await launch();
});
after(() => browser.close());

/** Waits until the page has begun anew with these walkers. */
const loaded = (page, cells) =>
  page.waitForFunction((want) => window.amble?.walkers.map((title) => /\d+/.exec(title)[0]).join() === want, cells.join());
const cellOf = (locator) => locator.evaluate((group) => Number(/cell(\d+)/.exec(group.getAttribute("class"))[1]));
const walkers = (page) => page.evaluate(() => window.amble.walkers.map((title) => Number(/\d+/.exec(title)[0])));

test("the first walker is the map's best, and cells that are chosen walk instead of it or beside it", async () => {
  const { page, problems } = await open(browser, path);
  const choosable = page.locator(".walks");
  assert.equal(await choosable.count(), 6);
  assert.ok(await page.locator("#map [class*=cell]").count() > 6, "there are elites that cannot be chosen");
  const [best] = await walkers(page);
  const shades = (locator) => locator.evaluateAll((groups) =>
    groups.map((group) => Number(/shade(\d)/.exec(group.getAttribute("class"))[1])));
  assert.equal((await shades(page.locator(`#map .cell${best}`)))[0], 8, "the darkest");

  const cells = [];
  for (let i = 0; i < 6; ++i) cells.push(await cellOf(choosable.nth(i)));
  const [a, b] = cells.filter((cell) => cell !== best);
  await page.locator(`#map .cell${a}`).click();
  await loaded(page, [a]);
  await page.locator(`#map .cell${b}`).click({ modifiers: ["Shift"] });
  await loaded(page, [a, b]);
  assert.ok(page.url().endsWith(`#cells=${a},${b}`));
  assert.equal(await page.locator("#map .chosen").count(), 2);
  await page.locator(`#map .cell${a}`).focus();
  await page.keyboard.press("Enter");
  await loaded(page, [a]);
  assert.equal(await page.locator(`#map .cell${a}`).getAttribute("aria-pressed"), "true");
  await page.locator("summary", { hasText: "How it filled" }).click();
  assert.ok(await page.getByText("QD score", { exact: true }).isVisible());
  assert.deepEqual(await violationsAnywhere(page), {});
  assert.deepEqual(problems, []);
  await page.close();
});

test("the page of an adaptation has a table of its trials, whose cells can be chosen there", async () => {
  const adapted = join(AMBLE_PAGES, "adapted.html");
  rmSync(adapted, { force: true });
  amble("adapt", join(AMBLE_PAGES, "run"), "--damage", "missing:FL", "--trials", "4", "--judge", "2", "-o", adapted);
  const { page, problems } = await open(browser, adapted);
  const rows = page.locator(".trials button");
  const tried = (await rows.allTextContents()).map(Number);
  assert.equal(new Set(tried).size, await page.locator(".walks").count());
  const [found] = await walkers(page);
  const other = tried.findIndex((cell) => cell !== found);
  if (other >= 0) {
    await rows.nth(other).click();
    await loaded(page, [tried[other]]);
    assert.equal(await rows.nth(other).getAttribute("aria-pressed"), "true");
  }
  assert.deepEqual(await violationsAnywhere(page), {});
  assert.deepEqual(problems, []);
  await page.close();
});

for (const [width, colorScheme] of [[360, "dark"], [1280, "light"]])
  test(`the map is within a window of ${width} px`, async () => {
    const { page } = await open(browser, path, { viewport: { width, height: 800 }, colorScheme });
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
    const box = await page.locator("#map svg").first().boundingBox();
    assert.ok(box.x >= 0 && box.x + box.width <= width, JSON.stringify(box));
    await page.close();
  });

test("the address names the cells that walk; what it names wrongly is passed over", () => {
  const list = [{ cell: 7 }, { cell: 40 }, { cell: 3 }];
  assert.deepEqual(chosenCells(list, ""), [7]);
  assert.deepEqual(chosenCells(list, "#t=2&cells=40,3"), [40, 3]);
  assert.deepEqual(chosenCells(list, "#cells=3,3,99,40,7"), [3, 40]);
  assert.deepEqual(chosenCells(list, "#cells=99"), [7]);
  assert.deepEqual(chosenCells(list, "#cells=,"), [7]);
});

test("a choice replaces, stands beside, or ends", () => {
  assert.deepEqual(afterChoice([7], 40, false), [40]);
  assert.deepEqual(afterChoice([7], 40, true), [7, 40]);
  assert.deepEqual(afterChoice([7, 40], 3, true), [7, 3]);
  assert.deepEqual(afterChoice([7, 40], 7, true), [40]);
  assert.deepEqual(afterChoice([7], 7, true), [7]);
});
