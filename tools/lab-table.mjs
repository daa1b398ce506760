#!/usr/bin/env node
// The tables of docs/LAB.md: what comes out at the lab's settings. Runs are those of `amble evolve`, which have the lab's bits, with
// the configs that the lab writes; needs Node.js and a PROGRAM that was built.
//
//   tools/lab-table.mjs PROGRAM first [--seeds 10] [--folder DIR]          the first settings of each robot
//   tools/lab-table.mjs PROGRAM experiments [--seeds 3] [--folder DIR]     all experiments, or those that are named: --only leg,map
//   tools/lab-table.mjs PROGRAM costs                                      seconds of a processor, and megabytes
//
// DIR (default: runs/lab) keeps the runs; what is there of the same settings and program is not run again. --processes 2 go at a time.
// Example: tools/lab-table.mjs build/release/src/cli/amble experiments --only leg --seeds 1
import { execFile, execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, readdirSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";
import { chooseModule } from "../viewer/src/amble.js";
import { EXPERIMENTS } from "../viewer/src/lab/experiments.js";
import { DEFAULTS, WORLD, changedPlan, planOf } from "../viewer/src/lab/plan.js";
import { count, fail, programAt, readArguments, someOf, versionOf } from "./tool_input.mjs";

const source = (name) => fileURLToPath(new URL(`../${name}`, import.meta.url));
const { values: options, positionals: [program, what] } = readArguments({
  seeds: { type: "string" }, folder: { type: "string", default: "runs/lab" }, only: { type: "string" }, processes: { type: "string", default: "2" },
}, 2);
if (!["first", "experiments", "costs"].includes(what)) fail(`${what ?? "no table"}: expected PROGRAM first|experiments|costs (tools/lab-table.mjs --help)`);
process.env.AMBLE_PROGRAM = programAt(program);
const processes = count("--processes", options.processes), seedsAsked = options.seeds && count("--seeds", options.seeds);
const only = someOf("--only", options.only, EXPERIMENTS.map(({ id }) => id));
const version = versionOf(process.env.AMBLE_PROGRAM);
const { LabRun, robotsOf } = await import("../tests/browser/lab_runs.mjs");

const folder = resolve(options.folder), lab = join(folder, "lab.html"), run = promisify(execFile);
mkdirSync(folder, { recursive: true });
rmSync(lab, { force: true });
execFileSync(process.env.AMBLE_PROGRAM, ["lab", "-o", lab], { stdio: ["ignore", "ignore", "inherit"], cwd: source("") });
const { module } = await chooseModule([{ name: "amble", bytes: readFileSync(source("viewer/dist/amble.wasm")) }]);
const robots = await robotsOf(lab, module);

const amble = (...words) => run(process.env.AMBLE_PROGRAM, words, { cwd: source(""), maxBuffer: 1e8 });

/** A run's folder as files of the module. */
function filesOf(path) {
  const names = readdirSync(path, { recursive: true }).map(String).filter((name) => /^(checkpoint\.bin|archive\.bin|generations\.csv|champions.*\.json)$/.test(name));
  return names.map((name) => [name, readFileSync(join(path, name))]);
}

/** Loses the leg as the lab does: natively up to there, in the module for the change, and natively to the end. */
async function evolve(settings, robot, at) {
  const plan = planOf(settings, robot), begun = await LabRun.begin(module, plan), loses = settings.lost !== "never";
  begun.save(`${at}.config`);
  const first = loses ? ["--generations", String(settings.lostAt)] : [];
  await amble("evolve", join(`${at}.config`, "config.toml"), "--jobs", "1", ...first, "--out", `${at}.part`);
  if (loses) {
    const config = JSON.parse(Buffer.from(begun.files().find(([path]) => path === "config.json")[1]).toString());
    const kept = JSON.stringify({ ...JSON.parse(plan), config, new: false });
    const resumed = await LabRun.begin(module, kept, { files: filesOf(`${at}.part`) });
    resumed.change(changedPlan(kept, { ...settings, missing: robot.facts.legs[0] }, robot));
    rmSync(`${at}.part`, { recursive: true });
    resumed.save(`${at}.part`);
    await amble("resume", `${at}.part`, "--generations", String(settings.generations), "--jobs", "1");
  }
  rmSync(`${at}.config`, { recursive: true });
  renameSync(`${at}.part`, at);
}

/** Where a run with these settings, of this program, is. */
function placeOf(settings) {
  const robot = robots.get(settings.robotName), lost = settings.lost !== "never" && settings.lostAt;
  return join(folder, createHash("sha256").update(JSON.stringify([planOf(settings, robot), lost, version])).digest("hex").slice(0, 16));
}

/** Makes it, if it is not there; gives the rows of its table. */
async function rowsOf(settings, at) {
  const robot = robots.get(settings.robotName);
  if (!existsSync(at)) {
    for (const half of [`${at}.part`, `${at}.config`]) rmSync(half, { recursive: true, force: true });
    await evolve(settings, robot, at);
    writeFileSync(join(at, "settings.json"), JSON.stringify(settings));
  }
  const [header, ...lines] = readFileSync(join(at, "generations.csv"), "utf8").trim().split("\n").map((line) => line.split(","));
  return lines.map((cells) => Object.fromEntries(header.map((name, i) => [name, Number(cells[i])])));
}

/** All of them, so many at a time; what is asked for twice is run once. Gives what gives the rows of one. */
async function allRows(all) {
  const queue = [...new Map(all.map((one) => [placeOf(one), one]))], made = new Map();
  const work = async () => {
    for (let next; (next = queue.shift()); ) {
      const [at, settings] = next;
      made.set(at, await rowsOf(settings, at));
      console.error(`${settings.robotName}: ${settings.label}, seed ${settings.seed}; ${queue.length} to come`);
    }
  };
  await Promise.all(Array.from({ length: processes }, work));
  return (settings) => made.get(placeOf(settings));
}

const metres = (value) => value.toFixed(1);
const line = (...cells) => console.log(`| ${cells.join(" | ")} |`);
const seeds = (count) => Array.from({ length: seedsAsked ?? count }, (_, i) => i + 1);
const shown = robots.has(DEFAULTS.robot) ? DEFAULTS.robot : [...robots.keys()][0];
const complete = (set, robotName, label) => ({ ...DEFAULTS, ...WORLD, ...set, robotName, label });
const sum = (values) => values.reduce((total, value) => total + value, 0);

/** What the first settings reach, robot by robot: that which is shown first with more seeds, and the paper's with what it needs. */
async function first() {
  const names = [...robots.keys()].sort((a, b) => (b === shown) - (a === shown));
  const cases = names.map((name) => ({ name, all: seeds(name === shown ? 10 : 3), set: {}, label: name }));
  for (const name of names.filter((one) => one.startsWith("quadruped")))
    cases.push({ name, all: seeds(3), set: { population: 100, generations: 100, seconds: 12 }, label: `${name}, larger` });
  const settings = ({ name, set, label }, seed) => complete({ seed, ...set }, name, label);
  const rows = await allRows(cases.flatMap((one) => one.all.map((seed) => settings(one, seed))));
  line("robot", "seeds", "typically, m, after a sixth of the generations", "a third", "all", "best, m", "robot-steps, millions");
  line("---", "---", "---", "---", "---", "---", "---");
  for (const one of cases) {
    const runs = one.all.map((seed) => rows(settings(one, seed))), at = (share) => runs.map((run) => metres(run[Math.round(share * run.length) - 1].typical)).join(", ");
    const steps = runs.map((run) => sum(run.map((row) => row.steps)) / 1e6);
    line(one.label, `1 to ${one.all.length}`, at(1 / 6), at(1 / 3), at(1), runs.map((run) => metres(run.at(-1).best_so_far)).join(", "), metres(sum(steps) / steps.length));
  }
}

/** What generations cost in the module, in seconds of one processor, and how large the page is. */
async function costs() {
  line("robot", "robot-steps a second", "first 10 generations, s");
  line("---", "---", "---");
  for (const [name, robot] of robots) {
    const lab = await LabRun.begin(module, planOf({ ...DEFAULTS, ...WORLD }, robot)), before = process.cpuUsage();
    let steps = 0;
    for (let i = 0; i < 10; ++i) ({ steps } = lab.step());
    const { user, system } = process.cpuUsage(before), took_s = (user + system) / 1e6;
    line(name, Math.round(steps / took_s / 1000) * 1000, metres(took_s));
  }
  const bytes = readFileSync(lab).length, packed = /id="amble-module">(.*?)<\/script>/s.exec(readFileSync(lab, "utf8"))[1].length;
  console.log(`\nThe page: ${(bytes / 1e6).toFixed(2)} MB, ${(packed / 1e6).toFixed(2)} of it the simulator.`);
}

/** What is said of a run, beside its distances; `at`: its folder, `others`: those of the same seed in the other steps. */
const MORE = {
  together: (run) => fell(run),
  mutation: (run) => `median ${metres(run.at(-1).median)}, ${run.at(-1).species} species`,
  growth: (run) => `${run.at(-1).best_hidden} hidden nodes`,
  novelty: (run, at, settings) => spread(at, settings),
  leg: (run) => recovery(run),
  tiny: (run) => `${run.at(-1).species} species, ${flat(run)}`,
  noise: (run) => fell(run),
  rough: (run, at, settings, others) => elsewhere(at, others),
  map: (run) => `${run.at(-1).elites} cells`,
};

const fell = (run) => `${Math.round(100 * run.at(-1).typical_fell)} % fell`;

/** How far from their middle the next generation ends. */
async function spread(at, settings) {
  const plan = planOf(settings, robots.get(settings.robotName)), begun = await LabRun.begin(module, plan);
  const config = JSON.parse(Buffer.from(begun.files().find(([path]) => path === "config.json")[1]).toString());
  const { ends } = (await LabRun.begin(module, JSON.stringify({ ...JSON.parse(plan), config, new: false }), { files: filesOf(at) })).step();
  const x = ends.filter((_, i) => i % 2 === 0), y = ends.filter((_, i) => i % 2), middle = (all) => sum(all) / all.length;
  return `${metres(middle(x.map((one, i) => Math.hypot(one - middle(x), y[i] - middle(y)))))} m apart`;
}

/** What the champion typically does on the ground of the other step. */
async function elsewhere(at, [other]) {
  const { stdout } = await amble("trial", at, "--ground", join(other, "config.toml"), "--trials", "16");
  return `${metres(Number(/typically ([0-9.]+) m/.exec(stdout)[1]))} on the other ground`;
}

/** From the last generation with all legs to the generation that is typically as good. */
function recovery(run) {
  const at = run.findIndex((row, i) => i > 0 && row.best_so_far < run[i - 1].best_so_far), before = run[at - 1];
  const again = run.findIndex((row, i) => i >= at && row.best_so_far >= before.best_so_far);
  return `${metres(before.best_so_far)} before, ${metres(run[at].best_so_far)} after, ${again < 0 ? "never again" : `again at ${again}`}`;
}

/** The longest time without a better one, in generations. */
function flat(run) {
  let longest = 0, since = 0;
  run.forEach((row, i) => {
    since = i > 0 && row.best_so_far > run[i - 1].best_so_far ? 0 : since + 1;
    longest = Math.max(longest, since);
  });
  return `flat for ${longest}`;
}

/** What came out of each step of each experiment. */
async function experiments() {
  const chosen = EXPERIMENTS.filter(({ id }) => only.includes(id)), all = [];
  for (const { id, title, steps } of chosen)
    for (const { name, set } of steps) {
      const own = set.seed !== undefined ? [set.seed] : seeds(3);
      all.push({ id, title, name, runs: own.map((seed) => complete({ seed, ...set }, shown, `${id}, ${name}`)) });
    }
  const rows = await allRows(all.flatMap(({ runs }) => runs));
  line("experiment", "step", "best, m", "typically, m", "and");
  line("---", "---", "---", "---", "---");
  let before;
  for (const { id, title, name, runs } of all) {
    const more = [], others = (seed) => all.filter((one) => one.id === id && one.name !== name).map((one) => placeOf(one.runs.find((run) => run.seed === seed) ?? one.runs[0]));
    for (const one of MORE[id] ? runs : []) more.push(await MORE[id](rows(one), placeOf(one), one, others(one.seed)));
    const ends = runs.map((one) => rows(one)), last = (column) => ends.map((run) => metres(run.at(-1)[column])).join(", ");
    line(id === before ? "" : title, name, last("best_so_far"), last("typical"), more.join("; "));
    before = id;
  }
}

await { first, experiments, costs }[what]();
