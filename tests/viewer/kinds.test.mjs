// Pages of other kinds: several walkers, falls, old browsers, damage.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { deflateSync, inflateSync } from "node:zlib";
import { amble, launch, makePage, open, pictureOf, recording, settled } from "./browser.mjs";

const CHAMPION = join(process.env.AMBLE_SOURCE, "robots/servo/champion.json");

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

async function onPage(path, options, steps) {
  const { page, problems } = await open(browser, path, options);
  try {
    await steps(page);
    assert.deepEqual(problems, []);
  } finally {
    await page.close();
  }
}

/** A copy of a page with other data. */
function changed(path, name, change) {
  const made = path.replace(/[^/]+$/, name);
  writeFileSync(made, change(readFileSync(path, "utf8")));
  return made;
}

test("two walkers move by one clock, side by side or one as a ghost of the other", () =>
  onPage(makePage("two.html", recording("walk.rec"), recording("slow.rec")), {}, async (page) => {
    assert.deepEqual(await page.evaluate(() => window.amble.walkers), ["test robot, walk", "test robot, slow"]);
    await page.evaluate(() => { window.amble.seek(10); window.amble.render(); });
    const [fast, slow] = await page.evaluate(() => [0, 1].map((i) => window.amble.placed(i)[0][0]));
    assert.ok(Math.abs(fast - 2.5) < 0.01 && Math.abs(slow - 1) < 0.01, `${fast} m, ${slow} m`);
    const side = await pictureOf(page);
    await page.keyboard.press("g");
    assert.notEqual((await pictureOf(page)).hash, side.hash);
    await page.keyboard.press("2");
    assert.equal(await page.locator(".walkers [aria-pressed=true]").textContent(), "test robot, slow");
    await settled(page);
    assert.equal(await page.locator("#now dd").nth(1).textContent(), "1.00 m");
  }));

test("many walkers are a list above the picture, which folds, and one story is told", () =>
  onPage(makePage("many.html", ...Array(6).fill(recording("walk.rec")), recording("slow.rec")), {}, async (page) => {
    const box = (selector) => page.locator(selector).boundingBox();
    const [list, stage] = [await box(".walker-list"), await box("#stage")];
    assert.ok(list.y + list.height <= stage.y, "the list is over the picture");
    assert.equal(await page.locator("#who").textContent(), "");
    await page.locator(".walkers button").nth(6).click();
    assert.match(await page.locator("#subtitle").textContent(), /^[^:]*slow[^:]*: 1\.\d+ m[^:]*$/);
    await page.locator(".walker-list summary").click();
    assert.equal(await page.locator(".walkers").isVisible(), false);
    assert.ok((await box(".walker-list")).height < list.height);
  }));

test("a list of very many walkers is folded at first", () =>
  onPage(makePage("very-many.html", ...Array(13).fill(recording("walk.rec"))), {}, async (page) => {
    assert.equal(await page.locator(".walkers").isVisible(), false);
    await page.locator(".walker-list summary").click();
    assert.equal(await page.locator(".walkers button").count(), 13);
  }));

test("the camera keeps walkers in sight that part", () =>
  onPage(makePage("parting.html", recording("walk.rec"), recording("long.rec")), {}, async (page) => {
    await page.evaluate(() => { window.amble.seek(60); window.amble.render(); });
    const places = await page.evaluate(() => [0, 1].map((i) => [window.amble.placed(i)[0][0], window.amble.seen(i)]));
    assert.ok(places[1][0] - places[0][0] > 10, "they are far apart");
    for (const [, place] of places) assert.ok(place.every((at) => Math.abs(at) < 0.9), `at ${place}`);
    for (const selected of ["1", "2"]) {
      await page.keyboard.press(selected);
      await page.keyboard.press("g");
      const ghosts = await page.evaluate(() => { window.amble.render(); return [0, 1].map((i) => window.amble.seen(i)); });
      for (const place of ghosts) assert.ok(place.every((at) => Math.abs(at) < 0.9), `as ghosts at ${place}`);
      await page.keyboard.press("g");
    }
    for (const [key, i] of [["1", 0], ["2", 1]]) { // too far apart for one picture, the selected walker stays in it
      await page.keyboard.press(key);
      const seen = await page.evaluate((walker) => {
        window.amble.seek(300);
        window.amble.render();
        return window.amble.seen(walker);
      }, i);
      assert.ok(seen.every((at) => Math.abs(at) < 0.9), `walker ${key} at ${seen}`);
    }
  }));

test("uneven ground is where the engines have it, and is drawn under its walker", () =>
  onPage(makePage("uneven.html", recording("walk.rec"), recording("uneven.rec")), {}, async (page) => {
    const heights = JSON.parse(readFileSync(recording("heights.json"), "utf8"));
    const worst = await page.evaluate((places) =>
      Math.max(...places.map(([x, y, height]) => Math.abs(window.amble.groundAt(1, x, y) - height))), heights);
    assert.ok(worst < 2e-4, `${worst} m`);
    assert.equal(await page.evaluate(() => window.amble.groundAt(0, 3, 3)), 0);
    await page.keyboard.press("2");
    await page.evaluate(() => { window.amble.seek(9); window.amble.render(); });
    const early = await pictureOf(page);
    assert.ok(early.colours > 20, "there is something to see");
  }));

test("a robot that fell at once is said to have fallen, and that no foot touched", () =>
  onPage(makePage("fell.html", recording("fell.rec")), {}, async (page) => {
    assert.match(await page.locator("#subtitle").textContent(), /then it fell after 0\.07 s/);
    assert.match(await page.locator("#analysis").textContent(), /No foot touched the ground/);
    assert.ok((await pictureOf(page)).colours > 200);
    await page.keyboard.press("End");
    assert.ok(Math.abs((await page.evaluate(() => window.amble.time())) - 0.07) < 1e-9);
  }));

test("a recording without a step gives a page that says so and shows the start pose", () =>
  onPage(makePage("empty.html", recording("empty.rec")), { at_s: null }, async (page) => {
    assert.match(await page.locator("#subtitle").textContent(), /no step was recorded/);
    assert.ok((await pictureOf(page)).colours > 200);
    for (const key of ["Space", "ArrowRight", "End"]) await page.keyboard.press(key);
    assert.equal(await page.evaluate(() => window.amble.time()), 0);
  }));

test("a controller without patterns is named by its kind, and has no timers", () => {
  const page = changed(makePage("walk2.html", recording("walk.rec")), "ctrnn.html",
                       (html) => {
    const packed = /"controller":"([^"]+)"/.exec(html)[1], text = inflateSync(Buffer.from(packed, "base64")).toString();
    return html.replace(packed, deflateSync(text.replace('"kind":"supg"', '"kind":"ctrnn"').replace('"patterns_rad":', '"others":')).toString("base64"));
  });
  return onPage(page, {}, async (opened) => {
    assert.match(await opened.locator("#analysis").textContent(), /of kind “ctrnn”/);
    assert.equal(await opened.locator(".patterns").count(), 0);
  });
});

test("a walker with neurons shows what they say, and what it typically does", () =>
  onPage(join(process.env.AMBLE_SOURCE, "docs/drive.html"), {}, async (page) => {
    assert.match(await page.locator("#subtitle").textContent(), /^Typically \d\.\d+ m in 15 s: half of 64 trials .*% fell .*\. Shown is its median trial: /);
    const neurons = page.locator("#analysis section", { hasText: "What each neuron beside the SUPGs says" });
    assert.equal(await neurons.locator("h2").textContent(), "Neurons");
    assert.equal(await neurons.locator("canvas").count(), 1);
    assert.match(await page.locator("#analysis").textContent(), /patterns, stretched and shifted by the links of neurons/);
  }));

for (const [hash, width, scheme] of [["recorded", 1400, "light"], ["live", 390, "dark"]])
  test(`the network of a mixed champion is folded, and open it follows the time, port and node that are chosen: ${hash}`, () =>
    onPage(join(process.env.AMBLE_SOURCE, "docs/drive.html"), { hash, viewport: { width, height: 900 }, colorScheme: scheme }, async (page) => {
      const network = page.locator("#analysis section", { has: page.getByRole("heading", { name: "Network", exact: true }) });
      const picture = network.locator("canvas"), words = network.locator(".note"), pictures = new Set();
      assert.ok(!(await picture.isVisible()));
      await network.locator("summary").click();
      const goTo = (t) => page.evaluate((seconds) => {
        if (window.amble.live() && window.amble.time() < seconds) window.amble.simulate(seconds - window.amble.time());
        window.amble.seek(seconds);
        window.amble.render();
      }, t);
      const isAnother = async (what) => {
        await settled(page);
        const seen = await picture.evaluate((canvas) => canvas.toDataURL());
        assert.ok(!pictures.has(seen), what);
        pictures.add(seen);
      };
      await picture.scrollIntoViewIfNeeded();
      await goTo(2);
      assert.match(await picture.getAttribute("aria-label"), /^The network: 11 sensors, 12 neurons, 18 SUPGs, 834 of 984 links$/);
      await isAnother("open");
      await goTo(2.3);
      await isAnother("later");
      for (const name of ["hidden", "amplitude", "rate", "shift", "coupling", "weights"]) {
        await network.getByRole("button", { name, exact: true }).click();
        await isAnother(name);
      }
      await network.getByRole("button", { name: "all", exact: true }).click();
      await network.getByRole("combobox", { name: "Node" }).selectOption("front_left.hidden 1");
      assert.match(await words.textContent(), /^front_left\.hidden 1: [+−]\d\.\d\d\. Most of \d+ links into it: [\w.]+( \d)? [+−]\d\.\d\d \(hidden\), /);
      await isAnother("one node");
      const { width: across } = await picture.boundingBox();
      await picture.click({ position: { x: across / 2, y: 36 } }); // what the robot is told is in the middle
      assert.match(await words.textContent(), /^command_stop: \+[01]\.00\. No links lead into it\.$/);
      assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= width);
    }));

/** A model of a table on ten legs, each with a hip and a knee. */
function tenLegs() {
  const legs = [0, 1, 2, 3, 4].flatMap((row) => [["L", 1], ["R", -1]].map(([side, y]) => ({ name: `${side}${row + 1}`, x: 0.6 - 0.3 * row, y: 0.14 * y })));
  const bodies = legs.map(({ name, x, y }) => `<body name="${name}" pos="${x} ${y} 0"><joint name="${name}_hip" axis="0 1 0" range="-0.6 0.6"/>
    <geom type="capsule" size="0.02" fromto="0 0 0 0 0 -0.15" mass="0.2"/><body name="${name}_shank" pos="0 0 -0.15">
    <joint name="${name}_knee" axis="0 1 0" range="0 0.8"/><geom type="capsule" size="0.02" fromto="0 0 0 0 0 -0.15" mass="0.1"/>
    <geom name="${name}_foot" type="sphere" pos="0 0 -0.17" size="0.03" mass="0.05"/></body></body>`);
  const motors = legs.flatMap(({ name }) => ["hip", "knee"].map((joint) => `<position joint="${name}_${joint}" kp="20" forcerange="-8 8"/>`));
  return `<mujoco><worldbody><body name="torso" pos="0 0 0.36"><freejoint/><geom type="box" size="0.7 0.1 0.05" mass="6"/>${bodies.join("")}
    </body></worldbody><actuator>${motors.join("")}</actuator></mujoco>`;
}

test("of ten legs every column of the table and every pattern is in sight, also on a phone", async () => {
  const folder = mkdtempSync(join(tmpdir(), "amble-"));
  try {
    writeFileSync(join(folder, "table.xml"), tenLegs());
    amble("robot", "--init", join(folder, "table.xml"), "-o", join(folder, "table"));
    amble("evolve", join(folder, "table/evolve.toml"), "--set", "population.size=4", "--set", "trial.duration_s=6", "--generations", "1",
          "--out", join(folder, "run"));
    const path = makePage("ten.html", join(folder, "run"));
    for (const width of [360, 800, 1280])
      await onPage(path, { viewport: { width, height: 800 } }, async (page) => {
        assert.equal(await page.locator(".gait tr").count(), 11, "a head, and a row for each leg");
        assert.equal(await page.locator(".pattern-leg").count(), 10);
        const cut = await page.evaluate(() => [...document.querySelectorAll(".gait th, .gait td, .pattern-head, .pattern-head *, .panel svg")]
          .filter((part) => {
            const { right } = part.getBoundingClientRect(), box = part.closest(".scroll, .patterns, .analysis").getBoundingClientRect();
            return right > Math.min(box.right, innerWidth) + 0.5 || part.scrollWidth > part.clientWidth + 1 && part.clientWidth > 0;
          }).map((part) => part.textContent || part.tagName));
        assert.deepEqual(cut, [], `${width} px wide`);
      });
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test("a foot on the ground stands out from a leg of any colour", () =>
  onPage(makePage("feet.html", recording("walk.rec")), { viewport: { width: 400, height: 300 } }, async (page) => {
    for (const colorScheme of ["light", "dark"]) {
      await page.emulateMedia({ colorScheme });
      await settled(page);
      const feet = await page.evaluate(() => [...Array(50).keys()].flatMap((i) => {
        window.amble.seek(i * 0.08);
        window.amble.render();
        return [0, 1, 2, 3].map((leg) => ({ ...window.amble.foot(0, leg), touching: window.amble.touching(0, leg, i * 0.08) }));
      }));
      const legs = await page.evaluate(() => [...Array(8).keys()].map((leg) =>
        getComputedStyle(document.documentElement).getPropertyValue(`--c${leg}`).trim()));
      const parts = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
      const apart = (a, b) => Math.hypot(...parts(a).map((value, i) => value - parts(b)[i]));
      for (const { colour, outlined, touching } of feet) {
        assert.equal(outlined, touching);
        if (touching) for (const leg of legs) assert.ok(apart(colour, leg) > 80, `${colour} on ${leg}, ${colorScheme}`);
        else assert.ok(legs.includes(colour), colour);
      }
      assert.ok(feet.some(({ touching }) => touching) && feet.some(({ touching }) => !touching));
    }
  }));

test("the gait is named, in all and around the present", () =>
  onPage(makePage("gait.html", recording("walk.rec")), {}, async (page) => {
    assert.equal(await page.locator(".gait-name").textContent(), "trot");
    const rows = async () => (await page.locator(".gait tr").allTextContents()).map((row) => row.replaceAll(/\s+/g, " "));
    assert.match(await page.locator(".gait-head").textContent(), /between walking and running, duty factor 0\.500, stride 1\.00 s/);
    assert.deepEqual((await rows()).slice(1, 6),
                     ["Duty factor50 %50 %50 %50 %", "Phase0.500.000.000.50", "R1.001.001.001.00", "Drift / min––––",
                      "Stride, s1.001.001.001.00"]);
    assert.match((await rows())[6], /^Nowthe first 2 s do not count/);
    await page.evaluate(() => { window.amble.seek(3); window.amble.render(); });
    assert.match((await rows())[6], /^Now2 … 7 s: trot/);
    assert.equal((await rows())[8], "Phase0.500.000.000.50");
    assert.match(await page.locator(".gait-box dl").textContent(), /Speed0\.25\d m\/sStraightness.*Froude number.*Cost of transport–/);
  }));

test("chatter of the feet is a hairline, and counts in the diagram as little as in the table", () =>
  onPage(makePage("chatter.html", recording("chatter.rec"), recording("walk.rec")), {}, async (page) => {
    const [chattering, clean] = await page.evaluate(() => [0, 1].map((i) => [0, 1, 2, 3].map((leg) => window.amble.stances(i, leg))));
    assert.deepEqual(chattering, clean);
    assert.equal(clean[0].length, 15);
    assert.match(await page.locator("#analysis").textContent(), /a gap or a touch under 0\.08 s, which does not count/);
    assert.equal(await page.locator(".gait-name").textContent(), "trot");
    assert.match(await page.locator(".gait tr").nth(1).textContent(), /Duty factor50 %50 %50 %50 %/);
    const chatters = await pictureOf(page, ".plot canvas");
    await page.keyboard.press("2");
    assert.notEqual((await pictureOf(page, ".plot canvas")).hash, chatters.hash);
  }));

test("where gaits have no names the headline is how the feet go", () => {
  const page = changed(makePage("walk4.html", recording("walk.rec")), "nameless.html",
                       (text) => text.replaceAll('"gait":"trot"', '"gait":null'));
  return onPage(page, {}, async (opened) => {
    assert.equal(await opened.locator(".gait-name").textContent(), "between walking and running");
    assert.match(await opened.locator(".gait-head").textContent(), /running duty factor 0\.500, stride 1\.00 s$/);
    assert.doesNotMatch(await opened.locator(".gait-box").textContent(), /no name|null/i);
  });
});

test("a recording without gait figures shows the share of time on the ground", () => {
  const page = changed(makePage("walk3.html", recording("walk.rec")), "no-gait.html", (text) =>
    text.replace(/(id="amble-data">)(.*?)(<\/script>)/s, (all, before, json, behind) => {
      const data = JSON.parse(json);
      for (const walker of data.walkers) walker.gait = null;
      return before + JSON.stringify(data).replaceAll("<", "\\u003c") + behind;
    }));
  return onPage(page, {}, async (opened) => {
    assert.equal(await opened.locator(".gait tr").count(), 2);
    assert.match(await opened.locator(".gait").textContent(), /On the ground50 %/);
  });
});

/** A page of the best of the first generation of each experiment. */
function championsPage(name, ...experiments) {
  const folder = mkdtempSync(join(tmpdir(), "amble-"));
  try {
    const runs = experiments.map((experiment) => {
      const run = join(folder, experiment);
      amble("evolve", fileURLToPath(new URL(`../../configs/authors/${experiment}.toml`, import.meta.url)), "--set", "population.size=40",
            "--set", "trial.duration_s=0.5", "--generations", "1", "--out", run);
      return run;
    });
    return makePage(name, ...runs, "--seconds", "3");
  } finally {
    rmSync(folder, { recursive: true });
  }
}

const SUPG_INPUTS = ["bias", "leg", "joint_type", "time"];

test("the page of a champion has its CPPN and the cost of transport", () =>
  onPage(championsPage("champion.html", "supg-objective"), {}, async (page) => {
    assert.deepEqual(await page.locator(".terminal text").allTextContents(), SUPG_INPUTS);
    assert.ok((await page.locator(".wire.plus path").count()) > 1);
    const colours = await page.evaluate(() => ["plus", "minus"].map((sign) =>
      getComputedStyle(document.querySelector(`.wire.${sign} path`)).stroke));
    assert.notEqual(colours[0], colours[1]);
    const cost = /Cost of transport(\d+\.\d\d) \((\d+\.\d\d)\)$/.exec(await page.locator(".gait-box dl").textContent());
    assert.ok(cost && Number(cost[1]) < Number(cost[2]), "positive work, and beside it the work that counts braking too");
    assert.match(await page.locator(".gait-box").textContent(), /the motors’ positive work \/ \(weight × way\)/);
  }));

test("champions of two kinds are side by side, each with its own CPPN and diagrams", () =>
  onPage(championsPage("kinds.html", "supg-objective", "ctrnn-objective"), {}, async (page) => {
    assert.deepEqual(await page.evaluate(() => window.amble.walkers),
                     ["quadruped (authors), supg-objective", "quadruped (authors), ctrnn-objective"]);
    const first = await pictureOf(page);
    assert.deepEqual(await page.locator(".terminal text").allTextContents(), SUPG_INPUTS);
    assert.equal(await page.locator(".patterns").count(), 1);
    await page.keyboard.press("2");
    const inputs = await page.locator(".terminal text").allTextContents();
    assert.ok(inputs.includes("source.x") && inputs.includes("target.y"), `${inputs}`);
    assert.ok((await page.locator(".wire path").count()) > 9);
    assert.match(await page.locator("#analysis").textContent(), /of kind “ctrnn”/);
    assert.equal(await page.locator(".patterns").count(), 0);
    await page.keyboard.press("1");
    assert.deepEqual(await page.locator(".terminal text").allTextContents(), SUPG_INPUTS);
    await page.evaluate(() => window.amble.seek(0.5));
    assert.notEqual((await pictureOf(page)).hash, first.hash);
  }));

/** The stage in squares of 8 × 8 pixels, each with its mean red, green and blue. */
const squares = (page) => page.evaluate(() => {
  window.amble.render();
  const stage = document.querySelector("#stage canvas"), copy = document.createElement("canvas");
  [copy.width, copy.height] = [Math.floor(stage.width / 8), Math.floor(stage.height / 8)];
  const paint = copy.getContext("2d");
  paint.imageSmoothingQuality = "high";
  paint.drawImage(stage, 0, 0, copy.width, copy.height);
  return [...paint.getImageData(0, 0, copy.width, copy.height).data].filter((_, i) => i % 4 < 3);
});

/** How a page looks by WebGL and in outlines: mean difference of the squares' colours, and the share of those that differ by over 40, of 255. */
async function apart(without, path, place, prepare = () => {}) {
  const pages = [await open(browser, path, place), await open(without, path, place)].map(({ page }) => page);
  for (const page of pages) await prepare(page);
  const [one, other] = [await squares(pages[0]), await squares(pages[1])];
  await Promise.all(pages.map((page) => page.close()));
  assert.equal(one.length, other.length);
  const all = one.map((value, i) => Math.abs(value - other[i]));
  return { mean: all.reduce((sum, value) => sum + value, 0) / all.length, far: all.filter((value) => value > 40).length / all.length };
}

/** Takes the near leg of a live walker away, which changes the picture. */
async function withoutLeg(page) {
  await page.evaluate(() => { window.amble.pause(); window.amble.simulate(0.5 - window.amble.time()); window.amble.render(); });
  const before = await squares(page);
  await page.locator("#live .live-legs input").nth(1).uncheck();
  await settled(page);
  await page.evaluate(() => window.amble.render());
  const after = await squares(page), changed = after.filter((value, i) => Math.abs(value - before[i]) > 40).length;
  assert.ok(changed > after.length / 500, `${changed} of ${after.length} values of the picture changed`);
}

test("outlines look like what WebGL draws: alone, as ghosts, on uneven ground, without a leg", async () => {
  const without = await launch({ gl: false });
  try {
    const cases = {
      alone: [1.5, makePage("walk7.html", recording("walk.rec")), { at_s: 0.5 }],
      ghosts: [1.5, makePage("two7.html", recording("walk.rec"), recording("slow.rec")), { at_s: 1 }, (page) => page.evaluate(() => window.amble.layout("ghosts"))],
      uneven: [5, makePage("rough7.html", recording("uneven.rec")), { at_s: 0.5 }], // without shadows
      "without a leg": [1.5, makePage("live7.html", CHAMPION, "--undisturbed"), { hash: "live" }, withoutLeg],
    };
    for (const [what, [most, path, place, prepare]] of Object.entries(cases)) {
      const { mean, far } = await apart(without, path, place, prepare);
      assert.ok(mean < most && far < most / 200, `${what}: mean difference ${mean} of 255, ${far} of the squares over 40`);
    }
  } finally {
    await without.close();
  }
});

test("without WebGL the picture is drawn in outlines, and moves with the diagrams", async () => {
  const path = makePage("walk5.html", recording("walk.rec")), without = await launch({ gl: false });
  try {
    const { page, problems } = await open(without, path, { at_s: 0.5 });
    assert.ok((await pictureOf(page)).colours > 100);
    assert.equal(await page.evaluate(() => window.amble.drawnAs()), "outlines");
    const before = await pictureOf(page);
    await page.keyboard.press("Shift+ArrowRight");
    assert.notEqual((await pictureOf(page)).hash, before.hash);
    const moved = await page.evaluate(() => { window.amble.render(); return document.querySelector(".cursor").style.transform; });
    assert.notEqual(moved, "translateX(72.00px)");
    assert.deepEqual(problems.filter((problem) => !/WebGL/.test(problem)), []);
    await page.close();
  } finally {
    await without.close();
  }
});

test("where the browser takes WebGL away the picture goes on in outlines", async () => {
  const { page, problems } = await open(browser, makePage("walk8.html", recording("walk.rec")), { at_s: 0.5 });
  const before = await pictureOf(page);
  assert.equal(await page.evaluate(() => {
    window.amble.render(); // in the same step as what follows: where a processor draws, the next frame may be outlines for a moment
    const drawn = window.amble.drawnAs();
    document.querySelector("#stage canvas").getContext("webgl2").getExtension("WEBGL_lose_context").loseContext();
    return drawn;
  }), "solid");
  await page.waitForFunction(() => window.amble.drawnAs() === "outlines");
  assert.ok((await pictureOf(page)).colours > 100);
  await page.keyboard.press("Shift+ArrowRight");
  assert.notEqual((await pictureOf(page)).hash, before.hash);
  assert.deepEqual(problems.filter((problem) => !/Context Lost/.test(problem)), []);
  await page.close();
});

test("damaged data is reported in the page", async () => {
  const damaged = changed(makePage("walk6.html", recording("walk.rec")), "damaged.html",
                          (text) => text.replace(/"data":"(.{200}).{40}/, '"data":"$1'));
  const { page } = await open(browser, damaged);
  assert.match(await page.locator("#trouble").textContent(), /could not be shown/);
  await page.close();
});

test("of a walker with commands the page has what it was told and the way there, and of others not", async () => {
  const recorded = join(process.env.AMBLE_PAGES, "told.rec");
  rmSync(recorded, { force: true });
  amble("trial", join(process.env.AMBLE_SOURCE, "robots/hexapod/steered.json"), "--command", "0.2,0.3; 0,0", "--seconds", "6", "--undisturbed", "--record", recorded);
  const headings = (page) => page.locator("h2").allTextContents();
  await onPage(makePage("told.html", recorded), { at_s: 2 }, async (page) => {
    assert.ok((await headings(page)).includes("Told and done"));
    const path = page.locator(".path-from-above");
    assert.match(await path.getAttribute("aria-label"), /At the end they are \d\.\d m apart\.$/);
    const early = await pictureOf(page, ".path-from-above");
    assert.ok(early.colours > 10, `${early.colours} colours`);
    await page.evaluate(() => { window.amble.seek(5); window.amble.render(); });
    assert.notEqual((await pictureOf(page, ".path-from-above")).hash, early.hash);
  });
  await onPage(makePage("untold.html", recording("walk.rec")), {}, async (page) =>
    assert.ok(!(await headings(page)).includes("Told and done")));
});
