// Evolution in WebAssembly is that of C++ (evolution_test.cpp), to the bit.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { LiveRobot, Machine, chooseModule } from "../../viewer/src/amble.js";

const read = (name, as = "utf8") => readFileSync(fileURLToPath(new URL(`../../${name}`, import.meta.url)), as);
const SETTINGS = { seed: 1, population: 20, seconds: 2, add_node_share: 0.05, add_link_share: 0.15, feels_its_feet: true };

const { module } = await chooseModule([{ name: "amble", bytes: read("viewer/dist/amble.wasm", null) }]);

async function started(settings) {
  const machine = await Machine.start(module);
  machine.give("evolution_of", read("robots/servo/champion.json"));
  machine.give("evolve", JSON.stringify(settings));
  return machine;
}

/** What is told after each of some generations. */
function generations(machine, count) {
  const told = [];
  while (told.length < count) if (machine.exports.amble_evolution_advance(50)) told.push(machine.take("evolution_progress"));
  return told;
}

test("three generations are those of the native program", async () => {
  const machine = await started(SETTINGS);
  assert.deepEqual(generations(machine, 3), read("tests/browser/evolution.txt").trim().split("\n"));
  const robot = await LiveRobot.open(module, machine.take("evolution_champion"));
  assert.equal(robot.stepsAsRecorded(), robot.describe().recorded_steps);
  assert.ok(robot.describe().recorded_steps > 0);
});

test("settings that cannot be are refused in a sentence", async () => {
  await assert.rejects(started({ ...SETTINGS, population: 1 }), /settings: key 'population' must be/);
  await assert.rejects(started({ seed: 1 }), /settings: key 'population' is missing/);
});
