// The module that pages carry computes the native program's bits: `amble trial --inputs` repeats in C++ what was done in WebAssembly.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync, rmSync } from "node:fs";
import { before, test } from "node:test";
import { LiveRobot, chooseModule } from "../../viewer/src/amble.js";
import { again, champions, source } from "./champions.mjs";
import { STEPS, runSession } from "./sessions.mjs";

const { AMBLE_WORK } = process.env;
const text = (path) => readFileSync(path, "utf8");

let module;
before(async () => {
  ({ module } = await chooseModule([{ name: "amble", bytes: readFileSync(source("viewer/dist/amble.wasm")) }]));
  rmSync(AMBLE_WORK, { recursive: true, force: true });
  mkdirSync(AMBLE_WORK, { recursive: true });
});

/**
 * Sessions of each champion: numbers that are apart by the champions, of which there are as many as neither grounds nor damages divide. So seven
 * are on all grounds and have all damages, and AMBLE_SESSIONS=42 is all grounds with all damages.
 */
const SESSIONS = Number(process.env.AMBLE_SESSIONS ?? 7);

champions.forEach(([name, champion], first) =>
  test(`${name}: the same bits in ${SESSIONS} sessions of ${STEPS} steps, and in the trial of its file`, async () => {
    assert.equal(champions.length, 11);
    for (let i = 0; i < SESSIONS; ++i) {
      const robot = await LiveRobot.open(module, text(champion)), number = first + i * champions.length;
      assert.equal(robot.stepsAsRecorded(), robot.describe().recorded_steps);
      await runSession(robot, number);
      const { status, stdout, stderr } = again(champion, robot.inputs(), `session-${number}`);
      assert.equal(stderr, "");
      assert.match(stdout, new RegExp(`^steps +${STEPS}$`, "m"));
      assert.match(stdout, /^bits +the same in every step$/m, `session ${number}`);
      assert.equal(status, 0);
    }
  }));

test("the native program tells the first step that is another, and another champion", async () => {
  const champion = source("robots/servo/champion.json");
  const robot = await LiveRobot.open(module, text(champion));
  robot.step(20);
  const other = again(source("robots/biped/champion.json"), robot.inputs(), "other");
  assert.equal(other.status, 2);
  assert.match(other.stderr, /it is of another champion/);
  assert.equal(again(champion, robot.inputs(), "same").status, 0);
});

test("what cannot be done at once is refused any number of times, and the walk goes on as if it had not been asked", async () => {
  const champion = text(source("robots/servo/champion.json"));
  const robot = await LiveRobot.open(module, champion), undisturbed = await LiveRobot.open(module, champion);
  for (let i = 0; i < 1000; ++i) {
    for (const wrong of [-1, 0, 101, NaN, "1 m", undefined]) assert.throws(() => robot.lift(wrong), /lift: expected more than 0 and at most 100 m/);
    for (const wrong of [[NaN, 0, 0], [1e300, 0, 0], [1], undefined]) assert.throws(() => robot.push(wrong), /push: expected 3 numbers, N s/);
    assert.throws(() => robot.command([0.1, 0]), /command: this champion senses no commands/);
    for (const wrong of [-5, 0.5, NaN, undefined]) assert.throws(() => robot.step(wrong), /step: expected a whole number/);
  }
  assert.equal(robot.step(50), undisturbed.step(50));
  assert.equal(robot.hash(), undisturbed.hash());
  const told = await LiveRobot.open(module, text(source("robots/hexapod/steered.json")));
  for (const wrong of [[NaN, 0], [1], undefined]) assert.throws(() => told.command(wrong), /command: expected 2 numbers, m\/s and rad\/s/);
});

test("what does not fit the robot is refused in a sentence, and the walk goes on as if it had not been asked", async () => {
  const champion = text(source("robots/servo/champion.json"));
  const robot = await LiveRobot.open(module, champion), undisturbed = await LiveRobot.open(module, champion);
  robot.step(50);
  robot.push([0.1, 0, 0]);
  robot.step(10);
  await assert.rejects(robot.setDamage({ parts: [{ kind: "missing" }] }), /damage: key 'parts\[0\].leg' is missing/);
  await assert.rejects(robot.setGround({ ...robot.describe().ground, height_m: -3 }), /ground: key 'height_m' must be/);
  robot.step(40);
  undisturbed.step(50);
  undisturbed.push([0.1, 0, 0]);
  undisturbed.step(50);
  assert.equal(robot.hash(), undisturbed.hash());
});

test("what is no champion is refused in a sentence", async () => {
  const champion = text(source("robots/servo/champion.json"));
  await assert.rejects(LiveRobot.open(module, "{"), /not valid JSON/);
  await assert.rejects(LiveRobot.open(module, '{"format": "amble-robot"}'), /not a champion's file/);
  await assert.rejects(LiveRobot.open(module, champion.replace('"generation": ', '"generation": 1')), /altered: its checksum does not fit/);
  await assert.rejects(LiveRobot.open(module, champion.replace('"version": ', '"version": 9')), /version \d+ of the file format/);
});

test("a walk begins again as it was, with what has been changed", async () => {
  const robot = await LiveRobot.open(module, text(source("robots/servo/champion.json")));
  robot.step(100);
  const first = robot.hash();
  robot.restart({ asEvolved: true });
  robot.step(100);
  assert.equal(robot.hash(), first);
  await robot.setGround({ ...robot.describe().ground, slope_x: 0.1 });
  robot.restart();
  assert.equal(robot.describe().ground.slope_x, 0.1);
  robot.step(100);
  assert.notEqual(robot.hash(), first);
});
