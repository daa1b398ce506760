// Parts of the page's program that need no browser.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { BoxGeometry, SphereGeometry } from "../../viewer/node_modules/three/build/three.module.js";
import { makePatch } from "../../viewer/make-patch.mjs";
import { LiveRobot, chooseModule } from "../../viewer/src/amble.js";
import { LiveWalk } from "../../viewer/src/live_walk.js";
import { nodesOf, passing } from "../../viewer/src/network.js";
import { patched } from "../../viewer/src/patch.js";
import { clipNear, cornersOf, hullOf } from "../../viewer/src/outlines.js";
import { niceAxis } from "../../viewer/src/plot.js";
import { GrowingRates, rates, wantedPath } from "../../viewer/src/told_path.js";
import { footfalls, lostLegs, runs } from "../../viewer/src/walk.js";
import { bestAfter, conditionOf, median } from "../../viewer/src/watch/all_curves.js";
import { placeOf } from "../../viewer/src/watch/map_picture.js";
import { clockText, rowReader, thinned } from "../../viewer/src/watch/rows.js";

/** Numbers in [0, 1), the same ones in each run (Lehmer's generator with the factor 48271). */
function* numbers() {
  for (let state = 1; ; state = (state * 48271) % 2147483647) yield state / 2147483647;
}

/** By its definition, touch by touch: gaps of fewer than `least` between touches are closed, then shorter stances dropped. */
function settledSlowly(touch, least) {
  const settled = touch.map((value) => value > 0.5);
  const eachRun = (of, action) => {
    for (let k = 0, first = 0; k < settled.length; first = ++k) {
      while (k + 1 < settled.length && settled[k + 1] === settled[first]) ++k;
      if (settled[first] === of) action(first, k + 1);
    }
  };
  const close = [], drop = [];
  eachRun(false, (first, end) => { if (first > 0 && end < settled.length && end - first < least) close.push([first, end]); });
  for (const [first, end] of close) settled.fill(true, first, end);
  eachRun(true, (first, end) => { if (end - first < least) drop.push([first, end]); });
  for (const [first, end] of drop) settled.fill(false, first, end);
  return settled;
}

test("stances are settled as by the definition, and chatter is what that changes", () => {
  const random = numbers();
  const next = () => random.next().value;
  for (let round = 0; round < 3000; ++round) {
    const stay = 0.3 + 0.69 * next(), least = Math.floor(7 * next());
    const touch = [];
    for (let k = Math.floor(60 * next()), value = 0; k > 0; --k) touch.push(next() < stay ? value : (value = 1 - value));
    const { stances, gaps, touches } = footfalls(runs(touch), least);
    const within = (list) => touch.map((_, k) => list.some(([first, end]) => first <= k && k < end));
    const settled = settledSlowly(touch, least);
    assert.deepEqual(within(stances), settled, `${touch.join("")}, ${least}`);
    const closed = within(gaps), dropped = within(touches);
    touch.forEach((value, k) => {
      assert.equal(closed[k], value === 0 && settled[k], `${touch.join("")}, ${least}: gap at ${k}`);
      if (value === 1) assert.equal(dropped[k], !settled[k], `${touch.join("")}, ${least}: touch at ${k}`);
    });
  }
});

test("an axis has at least two ticks, different ones, and holds what it is for", () => {
  const random = numbers();
  const next = () => random.next().value;
  for (let round = 0; round < 3000; ++round) {
    const lower = 4 * next() - 2, upper = lower + 10 ** (4 * next() - 3);
    const axis = niceAxis(lower, upper, 4);
    const slack = 1e-6 * (upper - lower);
    assert.ok(axis.lower <= lower + slack && upper <= axis.upper + slack, `${lower} … ${upper}`);
    assert.ok(axis.ticks.length >= 2 && axis.ticks.length <= 6, `${axis.ticks} for ${lower} … ${upper}`);
    assert.equal(new Set(axis.ticks.map(axis.text)).size, axis.ticks.length, `${axis.ticks.map(axis.text)}`);
    assert.ok(Math.abs(axis.ticks[0] - axis.lower) <= slack && Math.abs(axis.ticks.at(-1) - axis.upper) <= slack);
  }
});

test("watch: rows are read by the table's header, missing cells are no numbers", () => {
  const read = rowReader("generation,best,species,wall_s");
  const row = read("7,1.5,3,0.25");
  assert.deepEqual([row.generation, row.best, row.count, row.wall_s], [7, 1.5, 3, 0.25]);
  assert.deepEqual(row.species, []);
  assert.ok(Number.isNaN(rowReader("generation,species")("7,").count));
});

test("watch: of a long run few points are drawn, the last among them", () => {
  const rows = Array.from({ length: 10_001 }, (_, i) => i);
  assert.equal(thinned(rows.slice(0, 3000)).length, 3000);
  const drawn = thinned(rows.slice(0, 10_000));
  assert.ok(drawn.length <= 3001 && drawn[0] === 0 && drawn.at(-1) === 9999);
  assert.ok(drawn.every((row, i) => i === 0 || row > drawn[i - 1]));
});

test("watch: times are written as the program writes them", () => {
  assert.deepEqual([7, 750, 11_100, -1].map(clockText), ["0:07", "12:30", "3:05:00", "0:00"]);
});

test("watch: dimensions of a map nest, the last one's bin runs fastest", () => {
  const axes = [{ bins: 2 }, { bins: 3 }, { bins: 5 }, { bins: 7 }];
  const cell = ((1 * 3 + 2) * 5 + 4) * 7 + 6;
  assert.deepEqual(placeOf(axes, cell), { column: 1 * 5 + 4, row: 2 * 7 + 6 });
  assert.deepEqual(placeOf([{ bins: 4 }], 3), { column: 3, row: 0 });
});

/** A robot whose own pose looks along y, and which walks and turns as it is told, but for `slower`. */
function circling({ speed, turn, seconds, slower = 1 }) {
  const step_s = 0.02, count = Math.round(seconds / step_s) + 1, times = Array.from({ length: count }, (_, k) => k * step_s);
  const radius = speed / turn, along = (t) => turn * t * slower, quarter = Math.PI / 4;
  const rotations = times.map((t) => [Math.cos(along(t) / 2 + quarter), 0, 0, Math.sin(along(t) / 2 + quarter)]);
  return {
    poses: { step_s, count, first_s: 0 },
    com: [times.map((t) => radius * Math.sin(along(t))), times.map((t) => radius * (1 - Math.cos(along(t)))), times.map(() => 0.2)],
    rootColumns: [[], [], [], ...[0, 1, 2, 3].map((i) => rotations.map((rotation) => rotation[i]))],
    robot: { bodies: [{ rotation: [Math.cos(quarter), 0, 0, Math.sin(quarter)] }] },
    commands: [times.map(() => speed), times.map(() => turn)],
  };
}

test("a command that stays is a circle, which one who obeys walks", () => {
  const walk = circling({ speed: 0.3, turn: 0.5, seconds: 2 * Math.PI / 0.5 });
  const { headings, speeds, turns } = rates(walk), [x, y] = wantedPath(walk, headings);
  assert.ok(Math.abs(headings.at(-1) - 2 * Math.PI) < 0.02, `${headings.at(-1)} rad`);
  for (let k = 60; k + 60 < x.length; ++k) {
    assert.ok(Math.hypot(x[k] - walk.com[0][k], y[k] - walk.com[1][k]) < 0.01, `row ${k}`);
    assert.ok(Math.abs(speeds[k] - 0.3) < 0.005 && Math.abs(turns[k] - 0.5) < 1e-9, `row ${k}: ${speeds[k]} m/s, ${turns[k]} rad/s`);
  }
});

test("where a robot lags behind its commands, its rates say so and the wanted path does not", () => {
  const walk = circling({ speed: 0.3, turn: -0.5, seconds: 10, slower: 0.5 }), { headings, speeds, turns } = rates(walk);
  assert.ok(Math.abs(speeds[200] - 0.15) < 0.003 && Math.abs(turns[200] + 0.25) < 1e-9);
  const [x, y] = wantedPath(walk, headings), full = circling({ speed: 0.3, turn: -0.5, seconds: 10 });
  assert.ok(Math.hypot(x[400] - full.com[0][400], y[400] - full.com[1][400]) < 0.01);
});

test("where a robot lags behind, its heading error is as far as it lags, and no farther than its lead", () => {
  const walk = circling({ speed: 0.3, turn: -0.5, seconds: 30, slower: 0.5 }), errors = rates(walk).headingErrors;
  const lag = (row) => -0.25 * row * walk.poses.step_s;
  for (const row of [0, 100, 600]) assert.ok(Math.abs(errors[row] - lag(row)) < 1e-9, `row ${row}: ${errors[row]}`);
  assert.ok(Math.abs(errors.at(-1) - lag(errors.length - 1) - 2 * Math.PI) < 1e-9, "beyond half a turn the short way is the other");
  walk.controller = { heading_lead_rad: 1 };
  const held = rates(walk).headingErrors;
  for (const row of [0, 100]) assert.ok(Math.abs(held[row] - lag(row)) < 1e-9);
  for (const row of [250, 600, 1400]) assert.ok(Math.abs(held[row] + 1) < 1e-9, `row ${row}: ${held[row]}`);
});

test("of a walk that grows, heading and wanted path are those of the whole, and rates those of the second before", () => {
  const walk = circling({ speed: 0.3, turn: -0.5, seconds: 10, slower: 0.5 }), whole = rates(walk), table = new Map(), { count } = walk.poses;
  for (const name of GrowingRates.columns) table.set(name, new Float64Array(count));
  walk.poses.get = (name) => table.get(name);
  const growing = new GrowingRates(walk);
  for (let k = 0; k < count; ++k) growing.add(k);
  for (let k = 60; k < count; k += 7) {
    assert.ok(Math.abs(growing.headings[k] - whole.headings[k]) < 1e-12);
    assert.ok(Math.abs(growing.headingErrors[k] - whole.headingErrors[k]) < 1e-12);
    for (const axis of [0, 1]) assert.ok(Math.abs(growing.wanted[axis][k] - whole.wanted[axis][k]) < 1e-12);
    assert.ok(Math.abs(growing.turns[k] - whole.turns[k - 25]) < 1e-9 && Math.abs(growing.speeds[k] - 0.15) < 0.005);
  }
  assert.ok(Math.abs(growing.extents[0][1] - 0.3) < 1e-9 && Math.abs(growing.extents[1][0] + 0.5) < 1e-9);
});

/** The hexapod that obeys, told to turn and simulated here for so many seconds. */
async function steeredWalk(seconds) {
  const file = (path) => readFileSync(join(process.env.AMBLE_SOURCE, path));
  const { module } = await chooseModule([{ name: "amble", bytes: file("viewer/dist/amble.wasm") }]);
  const walk = new LiveWalk(await LiveRobot.open(module, file("robots/hexapod/steered.json").toString()), {});
  walk.command = [0.2, 0.3];
  walk.advance(seconds);
  return walk;
}

test("what sensors and SUPGs say, and what passes through links, is what neurons of the simulation hear", async () => {
  const walk = await steeredWalk(4), nodes = nodesOf(walk), { links } = walk.controller, heard = new Set();
  const nowOf = (row) => ({ walk, done: walk.told, row, t: row * walk.poses.step_s });
  for (let row = 20; row + 1 < walk.poses.count; row += 7) {
    const says = nodes.map((node) => node.say(nowOf(row))), phases = nodes.map((node) => node.phase(nowOf(row)));
    nodes.forEach((node, i) => {
      if (node.role !== "hidden") return assert.ok(says[i] !== null && Math.abs(says[i]) <= 1, node.name);
      const into = links.filter(({ target, port }) => target === i && port === "hidden");
      into.forEach(({ source }) => heard.add(nodes[source].name));
      const sum = into.reduce((total, link) => total + passing(link, says, phases), node.bias);
      const next = says[i] + node.step * (Math.tanh(sum) - says[i]);
      assert.ok(Math.abs(next - node.say(nowOf(row + 1))) < 0.01 * node.step, `${node.name}, row ${row}: ${next} in place of ${node.say(nowOf(row + 1))}`);
    });
  }
  for (const name of ["command_speed", "command_turn", "heading_error", "yaw_rate", "front_left.touch"]) assert.ok(heard.has(name), [...heard].join());
});

test("a leg that a damage takes away is gone from then on, in a walk that is recorded or simulated", async () => {
  const robot = { legs: [{ name: "a" }, { name: "b" }] };
  const damage = { parts: [{ kind: "numb", leg: "a", from_s: 0 }, { kind: "missing", leg: "b", from_s: 1.5 }] };
  assert.deepEqual(lostLegs(robot, damage), [{ leg: 1, from_s: 1.5 }]);
  assert.deepEqual(lostLegs(robot, null), []);
  const walk = await steeredWalk(0.5);
  const part = { kind: "missing", leg: walk.robot.legs[2].name, joint: "", body: "", angle_rad: 0, share: 0.5, mass_kg: 1, x_m: 0, y_m: 0, z_m: 0, from_s: 0 };
  await walk.live.setDamage({ parts: [part] });
  walk.renew();
  walk.advance(1);
  assert.deepEqual([walk.missingLegs(0.4), walk.missingLegs(0.9)], [[], [2]]);
});

test("couplings are still where legs keep the difference of their phases, and pull them back where they do not", () => {
  const turned = 2 * Math.PI * 0.25, link = { port: "coupling", source: 0, target: 1, weight: 0.8, in_phase: 0.8 * Math.cos(turned), out_of_phase: 0.8 * Math.sin(turned) };
  const pull = (source, target) => passing(link, [], [source, target]);
  assert.ok(Math.abs(pull(0.75, 0.5)) < 1e-12);
  assert.ok(pull(0.85, 0.5) > 0.4 && pull(0.65, 0.5) < -0.4, "a leg that is behind goes faster");
  assert.equal(pull(-1, 0.5), 0, "timers that stand couple with none");
});

test("a patch makes of a module any other, and one that is cut off is told", () => {
  const draw = numbers(), below = (count) => Math.floor(draw.next().value * count);
  const bytes = (count) => Uint8Array.from({ length: count }, () => below(256));
  for (let i = 0; i < 60; ++i) {
    const base = bytes(below(4000)), pieces = [];
    // Parts of the base in any order, some with a byte changed, and what is new between them.
    for (let k = below(8); k > 0; --k) {
      const from = below(base.length + 1), piece = base.slice(from, from + below(1500));
      if (piece.length && below(2)) piece[below(piece.length)] ^= 1 + below(255);
      pieces.push(piece, bytes(below(2) * below(300)));
    }
    const module = Uint8Array.from(pieces.flatMap((piece) => [...piece])), patch = makePatch(base, module);
    assert.deepEqual(patched(base, patch), module);
    if (module.length) assert.throws(() => patched(base, patch.subarray(0, patch.length - 1)), /damaged/);
  }
  const base = bytes(20000), module = base.slice();
  for (let at = 0; at < module.length; at += 100) module[at] += 3;
  assert.ok(makePatch(base, module).length < 700, "bytes that differ are few");
});

test("runs that differ by a number at the end are of one condition", () => {
  for (const [id, condition] of [["runs/supg-novelty-007", "supg-novelty"], ["supg-novelty-12", "supg-novelty"], ["7", "7"], ["a", "a"], ["x/seed_3", "seed"], ["supg/1", "supg"], ["ctrnn/1", "ctrnn"]])
    assert.equal(conditionOf(id), condition);
});

test("the best so far after a generation is that of the last step, as far as the run has got", () => {
  const run = { last: 9, steps: [[0, 0.5], [3, 1], [7, 2]] };
  assert.deepEqual([0, 2, 3, 6, 7, 9, 10].map((at) => bestAfter(run, at)), [0.5, 0.5, 1, 1, 2, 2, undefined]);
  assert.equal(median([3, 1, 2]), 2);
  assert.equal(median([4, 1, 2, 3]), 2.5);
});

test("a hull is what a rubber band would be, always the same way around", () => {
  const square = [[0, 0], [2, 0], [2, 2], [0, 2]], inside = [[1, 1], [0.5, 1.5], [1, 0], [2, 1]];
  for (const points of [[...square, ...inside], [...inside, ...square].reverse()]) {
    const hull = hullOf(points.map((point) => [...point]));
    assert.deepEqual([...hull].sort(), [...square].sort());
    const area = hull.reduce((sum, [x, y], i) => sum + x * hull[(i + 1) % 4][1] - y * hull[(i + 1) % 4][0], 0) / 2;
    assert.equal(area, 4);
  }
});

test("corners are a box's eight, and a ball's outline to a twentieth", () => {
  const box = cornersOf(new BoxGeometry(0.2, 3, 0.05));
  assert.equal(new Set(box.map((corner) => corner.toArray().map((value) => value.toFixed(4)).join())).size, 8);
  const ball = hullOf(cornersOf(new SphereGeometry(1, 24, 16)).map(({ x, z }) => [x, z]));
  const area = ball.reduce((sum, [x, y], i) => sum + x * ball[(i + 1) % ball.length][1] - y * ball[(i + 1) % ball.length][0], 0) / 2;
  assert.ok(area > 0.95 * Math.PI && area <= Math.PI, `${area}`);
});

test("what lies behind the eye is cut off where it crosses", () => {
  assert.deepEqual(clipNear([[0, 0, 1], [4, 0, 1], [4, 0, -1], [0, 0, -1]], 0), [[0, 0, 0], [0, 0, 1], [4, 0, 1], [4, 0, 0]]);
  assert.deepEqual(clipNear([[0, 0, -1], [1, 0, -1], [1, 1, -2]], 0.1), []);
});
