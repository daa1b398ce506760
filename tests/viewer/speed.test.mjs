// A page of five minutes keeps up with its slider. Runs while no other test does.
import assert from "node:assert/strict";
import { statSync } from "node:fs";
import { after, before, test } from "node:test";
import { launch, makePage, open, recording } from "./browser.mjs";

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

test("five minutes scrub without a stall, and show how the phases drift", async (context) => {
  const path = makePage("long.html", recording("long.rec"));
  const { size } = statSync(path);
  assert.ok(size < 3e6, `${size} bytes`);
  const { page, problems } = await open(browser, path);
  assert.match(await page.locator(".gait tr", { hasText: "Drift / min" }).textContent(), /^Drift \/ min(−?0\.00\d){4}$/);
  const result = await page.evaluate(async () => {
    const slider = document.getElementById("slider");
    window.amble.frames().length = 0;
    const between = [];
    let last = performance.now();
    for (let i = 1; i <= 60; ++i) {
      slider.value = window.amble.duration * ((i * 37) % 60) / 60;
      slider.dispatchEvent(new Event("input"));
      await new Promise(requestAnimationFrame);
      between.push(performance.now() - last);
      last = performance.now();
    }
    const quantiles = (values) => {
      const sorted = [...values].sort((a, b) => a - b);
      return [0.5, 0.95, 1].map((q) => sorted[Math.floor(q * (sorted.length - 1))]);
    };
    return { work: quantiles(window.amble.frames()), between: quantiles(between), frames: window.amble.frames().length };
  });
  const text = (values) => values.map((value) => value.toFixed(1)).join(", ");
  context.diagnostic(`page of 300 s: ${size} bytes; per frame (median, 95 %, worst) ${text(result.work)} ms of work, ` +
                     `${text(result.between)} ms apart with a software renderer`);
  assert.ok(result.frames >= 54);
  assert.ok(result.work[1] < 50, "a frame's work must leave room for 20 frames a second");
  for (const span of await page.locator(".spans button").all()) await span.click(); // up to all five minutes
  await page.evaluate(() => { window.amble.frames().length = 0; window.amble.seek(150); window.amble.render(); });
  assert.ok((await page.evaluate(() => Math.max(...window.amble.frames()))) < 300);
  assert.deepEqual(problems, []);
});
