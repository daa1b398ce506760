// A champion that is simulated in its page.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { deflateSync, inflateSync } from "node:zlib";
import { LiveRobot, chooseModule } from "../../viewer/src/amble.js";
import { launch, makePage, open, pictureOf, settled } from "./browser.mjs";

const { AMBLE_PAGES, AMBLE_PROGRAM, AMBLE_SOURCE } = process.env;
const CHAMPION = join(AMBLE_SOURCE, "robots/servo/champion.json");
const OBEYS = join(AMBLE_SOURCE, "robots/hexapod/steered.json");

let browser, walk;
before(async () => {
  browser = await launch();
  walk = makePage("live.html", CHAMPION, "--undisturbed");
});
after(() => browser.close());

/** Runs `steps` on a page whose walker is simulated, on which nothing may go wrong. */
async function onPage(options, steps, path = walk) {
  const { page, problems } = await open(browser, path, { hash: "live", ...options });
  try {
    await steps(page);
    assert.deepEqual(problems, []);
  } finally {
    await page.close();
  }
}

const time = (page) => page.evaluate(() => window.amble.time());
const hash = (page) => page.evaluate(() => window.amble.live().hash());
const simulate = (page, seconds) => page.evaluate((s) => { window.amble.simulate(s); window.amble.render(); }, seconds);
const description = (page) => page.evaluate(() => window.amble.live().describe());
const choose = (page, label, value) => page.locator("#live .live-row", { hasText: label }).locator("select").selectOption(value);
const move = (page, label, value) =>
  page.locator("#live .live-row", { hasText: label }).locator("input").evaluate((slider, to) => {
    slider.value = to;
    slider.dispatchEvent(new Event("change", { bubbles: true }));
  }, value);

/** What the native program says of all that was done on a page. */
async function natively(page, name, champion = CHAMPION) {
  const inputs = join(AMBLE_PAGES, name);
  writeFileSync(inputs, await page.evaluate(() => window.amble.live().inputs()));
  return spawnSync(AMBLE_PROGRAM, ["trial", champion, "--inputs", inputs], { encoding: "utf8" }).stdout;
}

test("a champion's page leads to itself simulated, and back", async () => {
  const { page, problems } = await open(browser, walk);
  await page.click(".live-link:not([aria-current])");
  await page.waitForFunction(() => window.amble?.live());
  await page.click(".live-link:not([aria-current])");
  await page.waitForFunction(() => window.amble?.live() === null);
  assert.deepEqual(problems, []);
  await page.close();
});

test("it walks by itself, and pause, slow motion and the way back in time are those of recordings", () =>
  onPage({ at_s: null }, async (page) => {
    await page.waitForFunction(() => window.amble.time() > 0.5);
    await page.click("#play");
    const stopped = await time(page), states = await hash(page);
    await page.waitForTimeout(300);
    assert.equal(await time(page), stopped);
    await page.evaluate(() => window.amble.seek(0.2));
    assert.ok(Math.abs((await time(page)) - 0.2) < 1e-9);
    assert.equal(await hash(page), states);
    await page.selectOption("#speed", "0.1");
    await page.evaluate(() => { window.amble.seek(1e9); window.amble.play(); });
    await page.waitForFunction((t) => window.amble.time() > t + 0.02, stopped);
  }));

test("this browser computes the bits of the champion's file, and of the module in Node.js after all that can be done", () =>
  onPage({}, async (page) => {
    await page.waitForFunction(() => /Exact: .* in all 1500 steps/.test(document.querySelector(".live-bits").textContent));
    const session = async (live) => {
      const { ground, robot } = live.describe();
      const part = { kind: "missing", leg: robot.legs[1].name, joint: "", body: "", angle_rad: 0, share: 1, mass_kg: 1, x_m: 0, y_m: 0, z_m: 0, from_s: 0 };
      live.step(300);
      live.push([0.2, 0.1, 0.05]);
      live.step(300);
      await live.setGround({ ...ground, kind: "stones", height_m: 0.02, slope_x: 0.05, friction: 0.7 });
      live.step(400);
      await live.setDamage({ parts: [part] });
      live.step(1000);
      return live.hash();
    };
    const { module } = await chooseModule([{ name: "amble", bytes: readFileSync(join(AMBLE_SOURCE, "viewer/dist/amble.wasm")) }]);
    const expected = await session(await LiveRobot.open(module, readFileSync(CHAMPION, "utf8")));
    assert.equal(await page.evaluate(`(${session})(window.amble.live())`), expected);
  }));

test("footfalls, timers, patterns and joints run along", () =>
  onPage({}, async (page) => {
    const seen = async () => {
      const all = page.locator("#analysis canvas"), pictures = [];
      for (let i = 0; i < (await all.count()); ++i) {
        await all.nth(i).scrollIntoViewIfNeeded(); // what is not seen is not painted
        await settled(page);
        pictures.push(await all.nth(i).evaluate((canvas) => canvas.toDataURL()));
      }
      return { pictures, now: await page.locator(".now-line").evaluateAll((lines) => lines.map((line) => line.getAttribute("x1"))) };
    };
    await simulate(page, 0.6);
    const before = await seen();
    await simulate(page, 0.73);
    const after = await seen();
    assert.ok(before.pictures.length >= 4 && before.now.length > 0, `${before.pictures.length} diagrams`);
    before.pictures.forEach((picture, i) => assert.ok(after.pictures[i] !== picture, `diagram ${i}`));
    assert.notDeepEqual(after.now, before.now);
  }));

test("dragging its body pushes it, and the native program repeats to the bit what was done", () =>
  onPage({}, async (page) => {
    await simulate(page, 1);
    const box = await page.locator("#stage .picture").boundingBox();
    const [x, y] = await page.evaluate(() => window.amble.seen(0));
    const at = [box.x + ((x + 1) / 2) * box.width, box.y + ((1 - y) / 2) * box.height];
    await page.mouse.move(...at);
    await page.mouse.down();
    await page.mouse.move(at[0] + 150, at[1] - 40, { steps: 4 });
    await page.waitForFunction(() => window.amble.time() > 1.4);
    await page.mouse.up();
    await page.evaluate(() => window.amble.pause());
    const { inputs } = JSON.parse(await page.evaluate(() => window.amble.live().inputs()));
    assert.ok(inputs.length > 5 && inputs.every(({ push_n_s }) => push_n_s), `${inputs.length} pushes`);
    await choose(page, "Kind", "rough");
    await move(page, "Uphill, forward", 0.1);
    await page.locator("#live .live-legs input").first().uncheck();
    await simulate(page, 3);
    assert.match(await natively(page, "dragged.json"), /^bits +the same in every step$/m);
  }));

test("a finger drags it as a mouse does, a second finger changes nothing, and the page does not scroll", () =>
  onPage({ viewport: { width: 390, height: 800 }, hasTouch: true, isMobile: true }, async (page) => {
    await simulate(page, 0.5);
    const box = await page.locator("#stage .picture").boundingBox();
    const [x, y] = await page.evaluate(() => window.amble.seen(0));
    const at = { x: box.x + ((x + 1) / 2) * box.width, y: box.y + ((1 - y) / 2) * box.height };
    const devtools = await page.context().newCDPSession(page), scrolled = await page.evaluate(() => scrollY);
    const touch = (type, ...points) => devtools.send("Input.dispatchTouchEvent", { type, touchPoints: points.map((point, id) => ({ id, ...point })) });
    const pushes = () => page.evaluate(() => JSON.parse(window.amble.live().inputs()).inputs.filter(({ push_n_s }) => push_n_s).length);
    await touch("touchStart", at);
    await touch("touchMove", { x: at.x + 70, y: at.y - 30 });
    await page.waitForFunction(() => window.amble.time() > 0.8);
    assert.ok((await pushes()) > 2, `${await pushes()} pushes`);
    const held = { x: at.x + 70, y: at.y - 30 };
    await touch("touchStart", held, { x: box.x + 8, y: box.y + 8 });
    await touch("touchMove", held, { x: box.x + 60, y: box.y + 8 });
    const so_far = await pushes(), now = await page.evaluate(() => window.amble.time());
    await page.waitForFunction((then) => window.amble.time() > then + 0.3, now);
    assert.ok((await pushes()) > so_far, "the first still pulls");
    await touch("touchEnd");
    await page.evaluate(() => window.amble.pause());
    assert.equal(await page.evaluate(() => scrollY), scrolled);
    assert.match(await natively(page, "touched.json"), /^bits +the same in every step$/m);
  }));

test("a push by button is a push, too, and ends", () =>
  onPage({}, async (page) => {
    await page.click("text=right →");
    await page.waitForFunction(() => window.amble.time() > 0.5);
    await page.evaluate(() => window.amble.pause());
    const { inputs } = JSON.parse(await page.evaluate(() => window.amble.live().inputs()));
    assert.deepEqual(inputs.map(({ step }) => step), [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]);
    assert.ok(inputs.every(({ push_n_s: [x, y, z] }) => x === 0 && y < 0 && z === 0));
  }));

test("what is lifted falls, and the native program repeats it to the bit", () =>
  onPage({}, async (page) => {
    await simulate(page, 0.5);
    await page.click("text=Lift and drop");
    await page.waitForFunction(() => window.amble.time() > 1);
    await page.evaluate(() => window.amble.pause());
    const { inputs } = JSON.parse(await page.evaluate(() => window.amble.live().inputs()));
    assert.equal(inputs.length, 1);
    assert.ok(inputs[0].lift_m > 0.05 && inputs[0].step > 40, JSON.stringify(inputs));
    assert.match(await natively(page, "dropped.json"), /^bits +the same in every step$/m);
  }));

test("the page of one that obeys opens live, and its recording is a link away", async () => {
  const path = makePage("drive.html", OBEYS), { page, problems } = await open(browser, path, { at_s: null });
  assert.ok(await page.evaluate(() => window.amble.live()));
  await page.getByRole("link", { name: "Recorded" }).click();
  await page.waitForFunction(() => window.amble?.live() === null && window.amble.duration > 10);
  await page.getByRole("link", { name: "Drive it live" }).click();
  await page.waitForFunction(() => window.amble?.live());
  assert.deepEqual(problems, []);
  await page.addInitScript(() => { WebAssembly.validate = () => false; }); // a browser that cannot simulate it
  await page.goto(new URL(page.url()).href.split("#")[0]);
  await page.reload();
  await page.waitForFunction(() => window.amble?.live() === null);
  assert.match(await page.locator("#trouble").textContent(), /cannot be driven here: .*This is its recording\.$/);
  await page.close();
  const { page: asked } = await open(browser, makePage("driven-in-ode.html", OBEYS, "--engine", "ode", "--undisturbed"), { at_s: null });
  assert.equal(await asked.evaluate(() => window.amble.live()), null);
  await asked.close();
});

test("one that obeys is told by keys, pad and gamepad, and the native program repeats to the bit what it was told", async () => {
  const path = makePage("steered.html", OBEYS, "--undisturbed");
  assert.ok(statSync(path).size <= 1.5e6);
  await onPage({}, async (page) => {
    const told = () => page.locator(".steer-said").textContent();
    const commands = async () => JSON.parse(await page.evaluate(() => window.amble.live().inputs())).inputs.map(({ command }) => command);
    const { most_speed_m_s: fast, most_turn_rad_s: turn } = (await description(page)).commands;
    const way = async () => {
      await page.locator(".path-from-above").scrollIntoViewIfNeeded();
      await settled(page);
      return page.locator("#analysis canvas").evaluateAll((all) => all.slice(0, 2).map((canvas) => canvas.toDataURL()));
    };
    const before = await way();
    assert.equal(await told(), "as it was evolved");
    await page.keyboard.down("ArrowUp");
    assert.match(await told(), /^told: 0\.28 m\/s$/);
    await simulate(page, 1);
    await page.keyboard.down("ArrowLeft");
    await simulate(page, 1);
    await page.keyboard.up("ArrowUp");
    await page.keyboard.up("ArrowLeft");
    assert.equal(await told(), "told: stop");
    for (const key of ["ArrowUp", "Shift"]) await page.keyboard.down(key);
    for (const key of ["ArrowUp", "Shift"]) await page.keyboard.up(key);
    assert.equal(await told(), "told: stop", "an arrow that is let go of while Shift is held is let go of");
    await simulate(page, 0.5);
    await page.locator(".steer-pad").scrollIntoViewIfNeeded();
    const pad = await page.locator(".steer-pad").boundingBox();
    await page.mouse.click(pad.x + pad.width - 1, pad.y + pad.height / 2);
    assert.match(await told(), /to the right$/);
    await simulate(page, 0.5);
    (await way()).forEach((picture, i) => assert.notEqual(picture, before[i], "what it is told and does runs along"));
    const sent = await commands();
    const close = (command, expected) => command.forEach((part, i) => assert.ok(Math.abs(part - expected[i]) < 1e-6, `${command}`));
    close(sent[0], [fast, 0]);
    close(sent[1], [fast, turn]);
    close(sent.at(-1), [0, -turn]);
    await page.evaluate(() => { navigator.getGamepads = () => [{ axes: [-1, -0.5] }]; });
    await page.waitForFunction(() => document.querySelector(".steer-said").textContent.endsWith("to the left"));
    await page.evaluate(() => { navigator.getGamepads = () => [{ axes: [0, 0] }]; });
    await page.waitForFunction(() => document.querySelector(".steer-said").textContent === "told: stop");
    await page.evaluate(() => { navigator.getGamepads = () => [{ axes: [0, -1] }]; });
    await page.waitForFunction(() => document.querySelector(".steer-said").textContent !== "told: stop");
    await page.evaluate(() => { navigator.getGamepads = () => [null]; }); // unplugged while it is held
    await page.waitForFunction(() => document.querySelector(".steer-said").textContent === "told: stop");
    await page.evaluate(() => window.amble.pause());
    await settled(page); // no picture asks for the stick any more
    await page.evaluate(() => {
      navigator.getGamepads = () => [{ axes: [0, -1] }];
      dispatchEvent(new Event("gamepadconnected"));
    });
    await page.waitForFunction(() => window.amble.playing()); // a stick wakes it
    await page.evaluate(() => window.amble.pause());
    assert.match(await natively(page, "steered-inputs.json", OBEYS), /^bits +the same in every step$/m);
  }, path);
});

test("sliders of the panel have their own keys", () =>
  onPage({}, async (page) => {
    const slope = page.locator("#live .live-row", { hasText: "Uphill, forward" }).locator("input");
    const before = await time(page);
    await slope.focus();
    for (let i = 0; i < 3; ++i) await page.keyboard.press("ArrowRight");
    assert.ok(Number(await slope.inputValue()) > 0.02, await slope.inputValue());
    assert.equal(await time(page), before);
    await page.waitForFunction(() => window.amble.live().describe().ground.slope_x > 0.02);
  }));

test("one that senses no commands is not offered any", () =>
  onPage({}, async (page) => {
    assert.equal(await page.locator(".steer-pad").count(), 0);
    assert.equal((await description(page)).commands, null);
  }));

test("that it has fallen is said to those who listen, once", () =>
  onPage({}, async (page) => {
    const told = page.getByRole("banner").getByRole("status");
    assert.equal(await told.textContent(), "It is upright.");
    await told.evaluate((element) => {
      window.changes = [];
      new MutationObserver(() => window.changes.push(element.textContent)).observe(element, { childList: true });
    });
    for (const leg of (await page.locator("#live .live-legs input").all()).slice(0, 3)) await leg.uncheck();
    for (let i = 0; i < 20 && (await told.textContent()) !== "It has fallen."; ++i) await simulate(page, 0.5);
    await simulate(page, 0.5);
    assert.equal(await page.locator("#subtitle").textContent(), "It has fallen.");
    assert.deepEqual(await page.evaluate(() => window.changes), ["It has fallen."]);
  }));

test("what is chosen is what it walks on and what it is", () =>
  onPage({}, async (page) => {
    await simulate(page, 0.5);
    const plane = await pictureOf(page);
    await choose(page, "Kind", "stairs");
    await settled(page);
    assert.notEqual((await pictureOf(page)).hash, plane.hash);
    await move(page, "Friction", 0.3);
    await choose(page, "Joint locked", "front_left_knee");
    await move(page, "Load", 0.5);
    await settled(page);
    const { ground, damage, mass_kg } = await description(page);
    assert.deepEqual([ground.kind, ground.friction], ["stairs", 0.3]);
    assert.deepEqual(damage.parts.map(({ kind }) => kind), ["locked", "payload"]);
    assert.ok(Math.abs(damage.parts[1].mass_kg - 0.5 * mass_kg) < 1e-9);
    await simulate(page, 2);
    const angles = await page.evaluate(() => [0.6, 2.5].map((t) => window.amble.pose(0, t).angles[0]));
    assert.ok(Math.abs(angles[0] - angles[1]) < 0.05, `the locked knee went from ${angles[0]} to ${angles[1]} rad`);
  }));

test("the past is shown on the ground and with the legs that were", () =>
  onPage({}, async (page) => {
    await page.evaluate(() => window.amble.pause());
    await simulate(page, 1);
    const shown = async (t) => {
      await page.evaluate((time) => window.amble.seek(time), t);
      await settled(page);
      return page.evaluate(() => ({ there: window.amble.foot(0, 3).there, heights: [0.7, 1.3, 2.1, 3.3].map((x) => window.amble.groundAt(0, x, 0.2)) }));
    };
    const before = await shown(0.5);
    await choose(page, "Kind", "stairs");
    await page.locator("#live .live-legs input").last().uncheck();
    await simulate(page, 1);
    const now = await shown(2);
    assert.deepEqual([before.there, now.there], [true, false]);
    assert.notDeepEqual(now.heights, before.heights);
    assert.deepEqual(await shown(0.5), before);
    await choose(page, "Kind", "hills"); // what is changed is the present, which is shown
    assert.ok((await time(page)) > 1.9);
  }));

test("it starts again with what was changed, or as it was evolved", () =>
  onPage({}, async (page) => {
    await page.locator("#live .live-legs input").last().uncheck();
    await simulate(page, 1);
    await page.click("text=Start again");
    await page.waitForFunction(() => window.amble.time() < 0.9);
    assert.equal((await description(page)).damage.parts.length, 1);
    await page.click("text=As it was evolved");
    await page.waitForFunction(() => document.querySelector("#live .live-legs input:not(:checked)") === null);
    assert.equal((await description(page)).damage.parts.length, 0);
  }));

test("it evolves twenty generations in the page, whose best walks there and is a champion's file that the native program repeats", () =>
  onPage({}, async (page) => {
    const evolve = page.locator("#live fieldset", { hasText: "Evolve it anew" });
    const button = (name) => evolve.getByRole("button", { name, exact: true });
    const status = () => evolve.locator("[role=status]").textContent();
    await move(page, "Population", 20);
    await move(page, "Length of a trial", 2);
    await button("Evolve").click();
    await page.waitForFunction(() => /Generation (19|[2-9]\d)/.test([...document.querySelectorAll("#live [role=status]")].at(-1).textContent));
    await button("Pause").click();
    await page.waitForTimeout(300);
    const paused = await status();
    await page.waitForTimeout(300);
    assert.equal(await status(), paused);
    const curve = await pictureOf(page, ".evolve-curve");
    assert.ok(curve.colours > 20, `only ${curve.colours} colours`);
    await page.emulateMedia({ colorScheme: "dark" });
    await settled(page);
    assert.notEqual((await pictureOf(page, ".evolve-curve")).hash, curve.hash);
    await page.emulateMedia({ colorScheme: "light" });
    await settled(page);
    assert.equal((await pictureOf(page, ".evolve-curve")).hash, curve.hash);

    await button("Show the best").click();
    await page.waitForFunction(() => /Exact: .* in all \d+ steps/.test(document.querySelector(".live-bits").textContent));
    assert.match(await page.locator("#title").textContent(), /Evolved in this page/);
    assert.ok((await page.locator("#analysis .cppn .neuron").count()) > 0, "its own network is drawn");
    await page.evaluate(() => window.amble.pause());
    await simulate(page, 2);
    const champion = join(AMBLE_PAGES, "evolved.json");
    writeFileSync(champion, await page.evaluate(() => window.amble.live().champion));
    assert.match(await natively(page, "evolved-inputs.json", champion), /^bits +the same in every step$/m);
    assert.ok(await page.evaluate(() => !dispatchEvent(new Event("beforeunload", { cancelable: true }))), "the browser asks before it is left");
    await Promise.all([page.waitForEvent("download"), button("Save the best").click()]);
    assert.ok(await page.evaluate(() => dispatchEvent(new Event("beforeunload", { cancelable: true }))));
    await button("Go on").click();
    await page.waitForFunction((before) => [...document.querySelectorAll("#live [role=status]")].at(-1).textContent !== before, paused);
    await button("From nothing again").click();
    assert.equal(await status(), "");
  }));

test("in a window 390 px wide nothing runs over, and all that can be chosen has a name", () =>
  onPage({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true }, async (page) => {
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390);
    const nameless = await page.locator("#live :is(input, select, button)").evaluateAll((controls) =>
      controls.filter((control) => !(control.labels?.[0]?.textContent.trim() || control.textContent.trim() || control.ariaLabel)).length);
    assert.equal(nameless, 0);
  }));

test("a champion's file that was altered is told, and nothing else is shown of it", async () => {
  const altered = walk.replace("live.html", "altered.html");
  const html = readFileSync(walk, "utf8"), packed = /"champion":"([^"]+)"/.exec(html)[1];
  const text = inflateSync(Buffer.from(packed, "base64")).toString(), other = text.replace('"generation": ', '"generation": 1');
  assert.notEqual(other, text);
  writeFileSync(altered, html.replace(packed, deflateSync(other).toString("base64")));
  const { page } = await open(browser, altered, { hash: "live" });
  assert.match(await page.locator("#trouble").textContent(), /altered: its checksum does not fit/);
  await page.close();
});

test("the page that README begins with is one to drive", () =>
  onPage({}, async (page) => {
    assert.ok(readFileSync(join(AMBLE_SOURCE, "README.md"), "utf8").includes("](docs/drive.html)"));
    await page.keyboard.down("ArrowUp");
    await simulate(page, 2);
    await page.keyboard.up("ArrowUp");
    assert.match(await page.locator(".steer-said").textContent(), /^told: /);
    const [x] = await page.evaluate(() => window.amble.placed(0)[0]);
    assert.ok(Math.abs(x) > 0.05, `${x} m`);
  }, join(AMBLE_SOURCE, "docs/drive.html")));
