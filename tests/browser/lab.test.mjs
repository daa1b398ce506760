// A run in the lab is that of `amble evolve`, to the bit: the same table, the same champions, and either goes on with the other's run.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { join } from "node:path";
import { before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { chooseModule } from "../../viewer/src/amble.js";
import { DEFAULTS, WORLD, changedPlan, configsFor, planOf } from "../../viewer/src/lab/plan.js";
import { LabRun, amble, robotsOf, table } from "./lab_runs.mjs";

const WORK = join(process.env.AMBLE_WORK, "lab"), GENERATIONS = 4;
const source = (name) => fileURLToPath(new URL(`../../${name}`, import.meta.url));

let module, robots;
before(async () => {
  rmSync(WORK, { recursive: true, force: true });
  mkdirSync(WORK, { recursive: true });
  ({ module } = await chooseModule([{ name: "amble", bytes: readFileSync(source("viewer/dist/amble.wasm")) }]));
  amble("lab", "-o", join(WORK, "lab.html"));
  robots = await robotsOf(join(WORK, "lab.html"), module);
});

const planFor = (robot, settings) => planOf({ ...DEFAULTS, ...WORLD, population: 20, seconds: 2, generations: GENERATIONS, seed: 3, ...settings }, robots.get(robot));

/** The same run natively. */
async function natively(plan, name) {
  const folder = join(WORK, `${name}-native`);
  const config = (await LabRun.begin(module, plan)).save(join(WORK, `${name}-config`));
  amble("evolve", join(config, "config.toml"), "--jobs", "1", "--out", folder);
  return folder;
}

const champions = (folder) => readdirSync(join(folder, "champions")).sort();
function sameRun(folder, other) {
  assert.deepEqual(table(folder), table(other));
  assert.deepEqual(champions(folder), champions(other));
  for (const name of champions(folder))
    assert.equal(readFileSync(join(folder, "champions", name), "utf8"), readFileSync(join(other, "champions", name), "utf8"), name);
}

const RUNS = {
  "distance, other starts": ["quadruped (authors)", {}],
  "distance, without noise": ["servo", { noise: "none" }],
  "pushes and wrong sensors": ["hexapod", { noise: "strong" }],
  "novelty": ["servo", { search: "novelty" }],
  "a map": ["servo", { search: "map-elites" }],
  "rough ground, on Mars, a leg less": ["servo", { ground: "rough", slope: 0.1, gravity: 0.38, missing: "front_left" }],
  "sine waves": ["servo", { controller: "sine" }],
  "a CTRNN on two legs": ["biped", { controller: "ctrnn" }],
  "legs that start together": ["octopod", { controller: "together", feels: false }],
  "no mutation": ["servo", { mutation: "none" }],
  // The page has no button for these; a plan may ask for them.
  "weights by CMA-ES": ["servo", {}, (config) => { config.search.kind = "cma-es"; }],
  "a map by CMA-MAE": ["servo", { search: "map-elites" }, (config) => Object.assign(config.search.map_elites,
    { variation: "cma", crossover_probability: 0, batch: 20, cma: { emitters: 4, step: 0.1, learning_rate: 0.01, least_threshold: 0 } })],
};

/** The plan with its config changed. */
function withConfig(plan, change) {
  const changed = JSON.parse(plan);
  change(changed.config);
  return JSON.stringify(changed);
}

for (const [name, [robot, settings, change = () => {}]] of Object.entries(RUNS))
  test(`${name}: the table and the champions are those of amble evolve`, async () => {
    const plan = withConfig(planFor(robot, settings), change), slug = name.replaceAll(/\W+/g, "-");
    const run = await LabRun.begin(module, plan, { modules: 2, together: 7 });
    for (let i = 0; i < GENERATIONS; ++i) run.step();
    sameRun(run.save(join(WORK, slug)), await natively(plan, slug));
  });

for (const search of ["objective", "novelty", "map-elites"])
  test(`${search}: amble resume goes on with a run of the lab, and the lab with one of amble resume`, async () => {
    const plan = planFor("servo", { search }), run = await LabRun.begin(module, plan);
    for (let i = 0; i < 3; ++i) run.step();
    const folder = run.save(join(WORK, `${search}-resumed`));
    amble("resume", folder, "--generations", "5", "--jobs", "1");
    const paths = ["checkpoint.bin", "generations.csv", ...(search === "objective" ? [] : ["archive.bin"]), ...champions(folder).map((file) => `champions/${file}`)];
    const files = paths.map((path) => [path, readFileSync(join(folder, path))]);
    const again = await LabRun.begin(module, JSON.stringify({ ...JSON.parse(plan), config: configOf(run), new: false }), { files });
    assert.equal(again.generation, 5);
    for (const one of [run]) for (let i = 3; i < 7; ++i) one.step();
    for (let i = 5; i < 7; ++i) again.step();
    sameRun(again.save(join(WORK, `${search}-again`)), run.save(join(WORK, `${search}-whole`)));
    assert.match(amble("info", join(WORK, `${search}-again`)), /generation/);
  });

const configOf = (run) => JSON.parse(Buffer.from(run.files().find(([path]) => path === "config.json")[1]).toString());

test("a world that changes begins a new best, and the run can still be resumed", async () => {
  const robot = robots.get("servo"), settings = { ...DEFAULTS, ...WORLD, population: 20, seconds: 2, generations: 8 };
  const plan = planOf(settings, robot), run = await LabRun.begin(module, plan);
  for (let i = 0; i < 3; ++i) run.step();
  run.change(changedPlan(plan, { ...settings, missing: "front_left" }, robot));
  const told = run.step();
  assert.equal(told.best_generation, 3);
  assert.equal(told.best_so_far, told.best);
  const folder = run.save(join(WORK, "changed"));
  assert.match(readFileSync(join(folder, "config.toml"), "utf8"), /front_left/);
  amble("resume", folder, "--generations", "6", "--jobs", "1");
  run.step();
  run.step();
  assert.deepEqual(table(run.save(join(WORK, "changed-lab"))), table(folder));
});

test("one's own robot has the controllers of the gallery, in its size", async () => {
  const text = readFileSync(source("robots/octopod/champion.json"), "utf8"), { facts } = robots.get("octopod");
  const own = { name: "own", text, facts, configs: configsFor(facts, robots.get("quadruped (authors)")) };
  const plan = planOf({ ...DEFAULTS, ...WORLD, population: 10, seconds: 1, generations: 1 }, own);
  assert.equal(JSON.parse(plan).config.controller.supg.period_s, 0.45);
  const run = await LabRun.begin(module, plan);
  assert.ok(run.step().best > 0);
});

test("what cannot be is refused in a sentence", async () => {
  const plan = JSON.parse(planFor("servo", {})), refused = (changes, message) =>
    assert.rejects(LabRun.begin(module, JSON.stringify({ ...plan, ...changes })), message);
  await refused({ robot: "{}" }, /expected a robot.json of a run's folder, or a champion's file/);
  await refused({ robot: "no JSON" }, /not valid JSON/);
  await refused({ config: { ...plan.config, engine: "ode" } }, /in a page robots walk in the engine batch/);
  await refused({ config: { ...plan.config, population: { size: 1 } } }, /population.size/);
  await assert.rejects(LabRun.begin(module, JSON.stringify(plan), { files: [["checkpoint.bin", Buffer.from("no")]] }), /checkpoint.bin/);
});
