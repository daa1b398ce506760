// A page of one walk, as a reader meets it.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { amble, cursors, launch, makePage, open, pictureOf, recording, settled, time } from "./browser.mjs";

let browser, walk;
before(async () => {
  browser = await launch();
  walk = makePage("walk.html", recording("walk.rec"));
});
after(() => browser.close());

/** Runs `steps` on a freshly opened page, on which nothing may go wrong. */
async function onPage(options, steps) {
  const { page, problems } = await open(browser, walk, options);
  try {
    await steps(page);
    assert.deepEqual(problems, []);
  } finally {
    await page.close();
  }
}

test("it plays by itself, without a word on the console and without asking any network", () =>
  onPage({ at_s: null }, async (page) => {
    await page.waitForFunction(() => window.amble.time() > 0.3);
    assert.equal(await page.evaluate(() => window.amble.drawnAs()), "outlines"); // as there is no graphics card
    await page.keyboard.press("Space");
    await page.waitForFunction(() => window.amble.drawnAs() === "solid");
  }));

test("who asks for less motion gets a page that waits", () =>
  onPage({ at_s: null, reducedMotion: "reduce" }, async (page) => {
    assert.equal(await page.evaluate(() => window.amble.playing()), false);
  }));

test("the stage is not blank, and the robot is elsewhere at 5 s than at 0 s", () =>
  onPage({}, async (page) => {
    const first = await pictureOf(page);
    assert.ok(first.colours > 200, `only ${first.colours} colours`);
    const [[x0]] = await page.evaluate(() => window.amble.placed(0));
    await page.evaluate(() => window.amble.seek(5));
    const later = await pictureOf(page);
    const [[x5]] = await page.evaluate(() => window.amble.placed(0));
    assert.notEqual(later.hash, first.hash);
    assert.ok(x5 - x0 > 1, `moved by ${x5 - x0} m`);
  }));

test("the pose at 5 s is the recorded one to the bit, and the feet stand where C++ says", () =>
  onPage({}, async (page) => {
    const expected = JSON.parse(readFileSync(recording("expected.json"), "utf8"));
    assert.equal(expected.time_s, 5);
    const pose = await page.evaluate(() => window.amble.pose(0, 5));
    assert.deepEqual([pose.root, pose.com, pose.angles], [expected.root, expected.com, expected.angles]);
    await page.evaluate(() => { window.amble.seek(5); window.amble.render(); });
    const [root, ...feet] = await page.evaluate(() => window.amble.placed(0));
    assert.deepEqual(root, expected.root.slice(0, 3));
    feet.forEach((foot, leg) => foot.forEach((value, axis) =>
      assert.ok(Math.abs(value - expected.feet_m[leg][axis]) < 1e-6, `foot ${leg}: ${foot}`)));
  }));

test("between two recorded poses it shows one between them", () =>
  onPage({}, async (page) => {
    const [a, m, b] = await page.evaluate(() => [5, 5.005, 5.02].map((t) => window.amble.pose(0, t).root));
    assert.ok(Math.abs(m[0] - (a[0] + 0.25 * (b[0] - a[0]))) < 1e-9);
    assert.ok(Math.abs(Math.hypot(...m.slice(3)) - 1) < 1e-9);
  }));

test("pause stops it", () =>
  onPage({ at_s: null }, async (page) => {
    await page.waitForFunction(() => window.amble.time() > 0.1);
    await page.click("#play");
    const stopped = await time(page);
    await page.waitForTimeout(400);
    assert.equal(await time(page), stopped);
    await page.click("#play");
    await page.waitForFunction((t) => window.amble.time() > t, stopped);
  }));

test("scrubbing the slider moves time and the cursor of every diagram in sight", () =>
  onPage({ viewport: { width: 1280, height: 1250 } }, async (page) => {
    const start = await cursors(page);
    assert.ok(start.plots.length >= 4 && start.patterns.length === 12);
    const slider = await page.locator("#slider").boundingBox();
    await page.mouse.move(slider.x + 8, slider.y + slider.height / 2);
    await page.mouse.down();
    await page.mouse.move(slider.x + slider.width / 3, slider.y + slider.height / 2, { steps: 4 });
    await page.mouse.up();
    const t = await time(page);
    assert.ok(Math.abs(t - 5) < 0.4, `at ${t} s`);
    const now = await cursors(page);
    for (const i of [0, 1]) assert.notEqual(now.plots[i], start.plots[i], `plot ${i}`);
    assert.notDeepEqual(now.patterns, start.patterns);
    await page.locator(".cursor").last().scrollIntoViewIfNeeded();
    await page.waitForFunction(() => [...document.querySelectorAll(".cursor")].at(-1).style.transform !== "");
  }));

test("a click in a diagram goes to its time", () =>
  onPage({}, async (page) => {
    const plot = await page.locator(".plot canvas").first().boundingBox();
    await page.mouse.click(plot.x + 72 + (plot.width - 82) / 2, plot.y + 20); // the middle of the first 5 s
    assert.ok(Math.abs((await time(page)) - 2.5) < 0.05, `at ${await time(page)} s`);
  }));

test("the keys do what the page says", () =>
  onPage({}, async (page) => {
    const press = async (key, expected) => {
      await page.keyboard.press(key);
      assert.ok(Math.abs((await time(page)) - expected) < 1e-6, `${key}: ${await time(page)} s, not ${expected} s`);
    };
    await press("ArrowRight", 0.02);
    await press("ArrowRight", 0.04);
    await press("ArrowLeft", 0.02);
    await press("Shift+ArrowRight", 1.02);
    await press("End", 15);
    await press("Home", 0);
    const speedAfter = async (key) => {
      await page.keyboard.press(key);
      await settled(page);
      return page.locator("#speed").inputValue();
    };
    assert.equal(await speedAfter("."), "2");
    assert.equal(await speedAfter(","), "1");
    await page.keyboard.press("c");
    assert.equal(await page.locator("[aria-label=Camera] [aria-pressed=true]").textContent(), "orbit");
    await page.keyboard.press("Space");
    await page.waitForFunction(() => window.amble.time() > 0.05);
    await page.keyboard.press("Space");
    assert.equal(await page.evaluate(() => window.amble.playing()), false);
    await page.focus("#back"); // Space plays, even when a button is in focus
    await page.keyboard.press("Space");
    assert.equal(await page.evaluate(() => window.amble.playing()), true);
  }));

test("letters, digits and marks can be switched off as keys, and the others stay", () =>
  onPage({}, async (page) => {
    const camera = () => page.locator("[aria-label=Camera] [aria-pressed=true]").textContent();
    const before = await camera();
    await page.locator("summary", { hasText: "Keys" }).click();
    await page.getByLabel("Letters, digits, comma and full stop are keys").focus();
    await page.keyboard.press("Space"); // by keyboard, as who needs it does
    assert.equal(await page.locator("#single-keys").isChecked(), false);
    for (const key of ["c", "k", ".", "2"]) await page.keyboard.press(key);
    assert.equal(await camera(), before);
    assert.equal(await page.locator("#speed").inputValue(), "1");
    assert.equal(await page.evaluate(() => window.amble.playing()), false);
    await page.keyboard.press("ArrowRight");
    assert.ok(Math.abs((await time(page)) - 0.02) < 1e-6);
    await page.getByLabel("Letters, digits, comma and full stop are keys").check();
    await page.keyboard.press("c");
    assert.notEqual(await camera(), before);
  }));

test("each camera shows another picture a second later", () =>
  onPage({}, async (page) => {
    const hashes = new Set();
    for (const mode of ["follow", "orbit", "still"]) {
      await page.evaluate((camera) => {
        window.amble.seek(0);
        window.amble.render();
        window.amble.camera(camera);
        window.amble.seek(1);
      }, mode);
      hashes.add((await pictureOf(page)).hash);
      await page.keyboard.press("r");
    }
    assert.equal(hashes.size, 3);
  }));

test("in a window 390 px wide all controls are in sight and nothing runs over", () =>
  onPage({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 }, async (page) => {
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390);
    await page.evaluate(() => document.getElementById("analysis").children[2].scrollIntoView());
    for (const id of ["play", "back", "forth", "start", "speed", "slider"]) {
      const box = await page.locator(`#${id}`).boundingBox();
      assert.ok(box.x >= 0 && box.x + box.width <= 390 && box.y >= 0 && box.y + box.height <= 844, `${id} is out of sight`);
      assert.ok(box.height >= 24 && box.width >= 36, `${id} is small for a finger`);
    }
    await page.tap("#forth");
    assert.ok(Math.abs((await time(page)) - 0.02) < 1e-6);
    const narrow = await page.evaluate(() => [...document.querySelectorAll(".plot, .patterns, .gait")]
      .every((part) => part.getBoundingClientRect().right <= 390));
    assert.ok(narrow);
  }));

test("light, dark and paper have their own colours, and paper shows no buttons", () =>
  onPage({ colorScheme: "light" }, async (page) => {
    const light = await pictureOf(page);
    await page.emulateMedia({ colorScheme: "dark" });
    await settled(page);
    const dark = await pictureOf(page);
    assert.notEqual(dark.hash, light.hash);
    await page.emulateMedia({ media: "print", colorScheme: "dark" });
    await settled(page);
    assert.notEqual((await pictureOf(page)).hash, dark.hash);
    assert.ok((await pictureOf(page, "#stage .paper")).colours > 200);
    assert.equal(await page.locator(".transport").isVisible(), false);
    assert.ok((await page.pdf()).length > 30_000);
  }));

test("one line on the command line refuses what is no recording", () => {
  for (const [file, reason] of [["nothing.rec", "No such file"], ["expected.json", "format"]])
    assert.throws(() => amble("view", recording(file), "-o", "/dev/null"), (error) => {
      assert.equal(error.stderr.trim().split("\n").length, 1);
      return error.stderr.includes(reason);
    });
});

test("render-video.mjs makes a picture, and says in a line what is missing", () => {
  const render = (environment, ...words) =>
    spawnSync(process.execPath, [fileURLToPath(new URL("../../tools/render-video.mjs", import.meta.url)), walk, ...words],
              { encoding: "utf8", env: { ...process.env, ...environment } });
  const picture = walk.replace(".html", ".png"), video = walk.replace(".html", ".mp4");
  const made = render({}, picture, "--at", "5", "--size", "320x200");
  assert.equal(made.status, 0, made.stderr);
  assert.equal(readFileSync(picture).subarray(1, 4).toString(), "PNG");
  for (const [environment, out, expected] of [
    [{ PATH: "" }, video, /^tools\/render-video.mjs: ffmpeg is missing .*\n$/],
    [{ CHROMIUM: "/no/browser" }, picture, /^tools\/render-video.mjs: \/no\/browser is missing .*\n$/],
  ]) {
    const failed = render(environment, out);
    assert.equal(failed.status, 2);
    assert.match(failed.stderr, expected);
  }
});
