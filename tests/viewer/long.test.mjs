// A page of five minutes is small, and its slider costs no more than a short walk's. How long a frame takes: tools/measure-browser.
import assert from "node:assert/strict";
import { statSync } from "node:fs";
import { after, before, test } from "node:test";
import { launch, makePage, open, recording } from "./browser.mjs";

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

const INPUTS = 60;

const places = (inputs) => Array.from({ length: inputs }, (_, i) => ((i * 37) % inputs) / inputs);

/** Moves the slider all over the walk: frames drawn. */
const scrub = (page) => page.evaluate(async (shares) => {
  const slider = document.getElementById("slider");
  window.amble.frames().length = 0;
  for (const share of shares) {
    slider.value = window.amble.duration * share;
    slider.dispatchEvent(new Event("input"));
    await new Promise(requestAnimationFrame);
  }
  await new Promise(requestAnimationFrame);
  return window.amble.frames().length;
}, places(INPUTS));

/** Shows the walk at the same places, all of it at once: changes of the document. */
const changes = (page) => page.evaluate((shares) => {
  const observer = new MutationObserver(() => {});
  observer.observe(document.body, { subtree: true, childList: true, attributes: true, characterData: true });
  for (const share of shares) {
    window.amble.seek(window.amble.duration * share);
    window.amble.render();
  }
  return observer.takeRecords().length;
}, places(INPUTS));

test("five minutes make a small page that shows how the phases drift", async () => {
  const path = makePage("drift.html", recording("long.rec"));
  const { size } = statSync(path);
  assert.ok(size < 3e6, `${size} bytes`);
  const { page, problems } = await open(browser, path);
  assert.match(await page.locator(".gait tr", { hasText: "Drift / min" }).textContent(), /^Drift \/ min(−?0\.00\d){4}$/);
  for (const span of await page.locator(".spans button").all()) await span.click(); // up to all five minutes
  await page.evaluate(() => { window.amble.seek(150); window.amble.render(); });
  assert.deepEqual(problems, []);
  await page.close();
});

test("a slider over five minutes draws a frame for each of its places, with no more changes than one over a few seconds", async () => {
  const told = [];
  for (const name of ["walk", "long"]) {
    const { page, problems } = await open(browser, makePage(`${name}-scrubbed.html`, recording(`${name}.rec`)));
    told.push({ frames: await scrub(page), changes: await changes(page) });
    assert.deepEqual(problems, []);
    await page.close();
  }
  const [short, long] = told;
  for (const { frames } of told) assert.ok(frames >= 0.9 * INPUTS, `${frames} frames`);
  assert.ok(short.changes >= INPUTS, `${short.changes} changes`);
  assert.ok(long.changes <= 1.5 * short.changes, `${long.changes} changes, ${short.changes} in a short walk`);
});
